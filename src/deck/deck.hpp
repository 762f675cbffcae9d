// Runs a deck: a Lua program that declares problems and runs them (manual: the deck language). No Lua shows here.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh_limits.hpp"
#include "run/run_problem.hpp"

namespace dygita {

// Who computes: run_problem and check_report, or a test's own.
struct Engine {
  std::function<std::shared_ptr<const RunResult>(const Problem&, const RunRequest&)> run;
  std::function<std::string(const Problem&)> check;
};

struct DeckOptions {
  std::filesystem::path path;
  std::optional<std::string> text;                            // in place of the file's
  std::vector<std::pair<std::string, std::string>> settings;  // --set: name, number or expression in units
  std::filesystem::path out = "out";
  int threads = 0;
  double time_limit = 60.0;      // s of processor time of the deck's own code
  double memory_limit = 1024.0;  // MB of the deck's own data
  MeshLimits meshes;
  bool write_files = true;
  bool write_frames = true;         // those of output.vtk
  bool write_state = true;          // what continue_run needs
  double checkpoint_every = 180.0;  // s between two times that a run is brought to the disk; 0: never
  bool is_study = true;        // the table of several cases, and cases checked cold; not while one of them is continued
  std::filesystem::path from;  // --from: folder of an earlier run, whose static steps are started from; empty: none
  std::string solver;  // --solver: an expression that takes the place of every problem's solver; empty: the deck's
};

struct DeckOutcome {
  int n_runs = 0;
  std::vector<std::string> not_converged;  // "problem 'crush', case 'base'"
  bool interrupted = false;                // by the user; what was computed is written
  int n_written = 0;                       // runs and ensembles that came to their ends
  // Of an ensemble that has not come to its end and does not write its members: those that have, which leave nothing.
  std::optional<int> lost_members{};
  std::string differing;                                   // why a repeated run is not the one of the record
  std::vector<std::pair<std::string, double>> parameters;  // of param{}, --set included
};

// Runs the deck to its end. Throws InputError (deck, mesh, limits; with file:line), NumericalError.
DeckOutcome run_deck(const DeckOptions& options, const Engine& engine);

// Declares and checks everything, says what each problem:run would compute, solves nothing. The deck continues with nan
// for every result; what fails because of that is said and is not an error.
DeckOutcome check_deck(const DeckOptions& options, const Engine& engine);

// "tighten=0.04*mm" as name and expression. Throws InputError.
std::pair<std::string, std::string> parse_setting(const std::string& text);

// A number or an expression in units, as --set takes it; `what` names it in messages ("--until"). Throws InputError.
double parse_quantity(const std::string& what, const std::string& text);

// The reference of the deck language, Markdown.
std::string deck_reference();

// The same as definitions for editors: Lua with the annotations of LuaLS and EmmyLua.
std::string deck_definitions();

// "0.1.0".
std::string version();

// Call first in main: threads that wait must not spin, and OpenBLAS must not take the kernels of an old processor
// (set_up_process, better_blas_kernels).
void prepare_process(char** argv);

}  // namespace dygita

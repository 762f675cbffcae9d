// The state file of a run: its interface fields and all that `dygita continue` needs to go on from them (manual, "The
// state file").
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/own_files.hpp"
#include "persistence/state_parts.hpp"

namespace dygita {

inline constexpr const char* state_file_name = own_file::state;

// One run over all increments: the first, or one that continued it.
struct Effort {
  double tolerance = 0.0, static_tolerance = 0.0;  // asked for
  int more_iterations = 0;                         // --iterations; 0: none
  long iterations = 0;
  double seconds = 0.0;
};

struct StateStep {
  std::string name;
  bool is_static = false;
  int increments = 0;     // of the step in full; those kept may be fewer
  double duration = 0.0;  // s; 0: static
  double worst_indicator = 0.0;
};

struct RunState {
  std::string program, problem, case_name;                        // program: version that wrote it
  std::string deck_path, deck_text, solver;                       // absolute path; solver: --solver, empty: the deck's
  std::vector<std::pair<std::string, std::string>> settings;      // --set, as written
  std::vector<std::pair<std::string, std::string>> mesh_digests;  // substructure, digest
  std::vector<double> loads;                                      // samples of every load, see load_samples
  std::vector<StateStep> steps;
  std::vector<Effort> efforts;  // oldest first; the last is that of the fields kept
  bool converged = true, interrupted = false;
  std::shared_ptr<const InterfaceFields> fields;
  StateParts parts;  // where ranks have written the fields; none: they go to the state file

  long n_increments() const;  // kept
};

// All of a state but its fields, as bytes and back. Throws InputError where they are damaged.
std::string identity_bytes(const RunState& state);
RunState state_of_identity(std::string bytes);

// Writes a state whole or not at all (to <path>.tmp, then renamed), one increment after the other. Throws InputError
// with the system's reason, and where the fields cannot be read back.
void write_state(const std::filesystem::path& path, const RunState& state);

// Reads a state; its fields stay in the file, which is left open, or in those of its parts. Of several ranks the first
// looks whether the fields are whole, of parts each at some. Throws InputError: no state file, another version or
// machine, damaged.
RunState read_state(const std::filesystem::path& path);

}  // namespace dygita

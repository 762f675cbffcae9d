// Runs one problem from its declaration to its output directory: solver, what was asked for, files.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "files/run_lock.hpp"
#include "files/run_writer.hpp"
#include "model/model.hpp"
#include "persistence/checkpoint_file.hpp"
#include "persistence/state_file.hpp"
#include "result/result.hpp"

namespace dygita {

class SharedOperators;
// What members of an ensemble share, by the tolerance of a pass; the first member makes it.
using OperatorsOfMembers = std::map<double, std::shared_ptr<SharedOperators>>;

struct RunRequest {
  std::filesystem::path out = "out";  // files go to out/<problem>/<case_name>/
  std::string case_name = "base";
  int threads = 0;  // 0: as many as the machine has
  bool write_files = true;
  bool write_frames = true;  // those of output.vtk
  bool is_trial = false;     // to compare with: a case once more, from scratch
  bool write_state = true;   // what a later continuation needs, where the solver keeps it: beside the fields
  std::string deck_text;     // the deck's,
  std::vector<std::pair<std::string, std::string>> settings;  // and --set, as written
  // The run continued: each increment starts from its fields, and its folder `replaces` is replaced once the new
  // results are complete, or at least reach as far as the old ones did.
  std::shared_ptr<const RunState> continues;
  std::filesystem::path replaces;
  // The same run continues where it was stopped or killed: over what its checkpoint has, in the folder `replaces`; in
  // place where no run has come to an end there.
  std::shared_ptr<CheckpointFile> checkpoint;
  bool is_in_place = false;
  std::shared_ptr<RunLock> lock;    // held by who asks; null: the run takes its own
  double checkpoint_every = 180.0;  // s; 0: none
  std::vector<int> pieces;          // of each substructure, those of the run that is continued; empty: as it comes
  RunIdentity identity;
  std::shared_ptr<const RunResult> start_from;  // an earlier case: the iteration starts from its interface fields
  // Folder of an earlier run, whose fields the iteration of the first static steps starts from; empty: none.
  std::filesystem::path from;
  std::shared_ptr<OperatorsOfMembers> shared;  // with the other members; null: the run is by itself
};

// Computes and writes; says what it does in a few lines. Throws InputError, NumericalError.
std::shared_ptr<const RunResult> run_problem(const Problem& problem, const RunRequest& request);

// What would be computed (sizes, unknowns, interface points, steps, predicted memory), as text; checks everything that
// can be checked without a factorisation (facing nodes, meshes, supports); solves nothing.
std::string check_report(const Problem& problem);

}  // namespace dygita

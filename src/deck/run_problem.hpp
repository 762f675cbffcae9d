// Runs one problem from its declaration to its output directory: solver, what was asked for, files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "model/model.hpp"
#include "output/run_writer.hpp"
#include "result/result.hpp"

namespace dygita {

struct RunRequest {
  std::filesystem::path out = "out";  // files go to out/<problem>/<case_name>/
  std::string case_name = "base";
  int threads = 0;                    // 0: as many as the machine has
  bool write_files = true;
  bool write_frames = true;  // those of output.vtk
  RunIdentity identity;
  std::shared_ptr<const RunResult> start_from;  // an earlier case: the iteration starts from its interface fields
};

// Computes and writes; says what it does in a few lines. Throws InputError, NumericalError.
std::shared_ptr<const RunResult> run_problem(const Problem& problem, const RunRequest& request);

// What would be computed (sizes, unknowns, interface points, steps, predicted memory), as text; checks everything that can be
// checked without a factorisation (facing nodes, meshes, supports); solves nothing.
std::string check_report(const Problem& problem);

}  // namespace dygita

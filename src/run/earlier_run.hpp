// `dygita run --from`: a finished tightening serves other shocks (manual, "Another shock on the same tightening").
#pragma once

#include <filesystem>
#include <vector>

#include "model/model.hpp"
#include "persistence/state_file.hpp"

namespace dygita {

// An earlier run whose interface fields the static steps of a problem start from. They are a first guess: each
// increment is iterated until it has converged, whatever the fields are.
class EarlierRun {
 public:
  // Collective. Throws InputError: no run, no state, damaged; `own`, the folder of the run that asks, would be
  // replaced.
  EarlierRun(const std::filesystem::path& folder, const std::filesystem::path& own);

  // For the static steps that begin both; says what is used of them. Throws InputError with what differs: the solver
  // iterates nothing, other meshes, other first steps.
  StartFields fields_for(const Problem& problem) const;
  // Of each substructure; empty: as many as the problem has by itself.
  std::vector<int> pieces_for(const Problem& problem) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void check_meshes(const Problem& problem) const;
  size_t n_common_steps(const Problem& problem) const;
  bool has_same_loads(const Problem& problem, size_t n_steps) const;

  std::filesystem::path folder_;  // absolute
  RunState state_;
};

}  // namespace dygita

// A run once more as its record states it (manual, "Repeat a run").
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "run/run_problem.hpp"

namespace dygita {

// Takes the place of run_problem while the deck of a record runs: compares deck and meshes with those of the record
// before, and tables after.
class Repetition {
 public:
  // record: a run.json, or the folder it lies in. Throws InputError: none, or damaged.
  explicit Repetition(const std::filesystem::path& record);

  const std::filesystem::path& deck() const { return deck_; }
  const std::string& solver() const { return solver_; }  // --solver; empty: the deck's own
  // The parameters of the record, as --set takes them.
  const std::vector<std::pair<std::string, std::string>>& settings() const { return settings_; }

  // Those of its files that the run was told to leave out are left out again.
  bool has_frames() const { return has_frames_; }
  bool has_state() const { return has_state_; }
  const std::filesystem::path& from() const { return from_; }  // of --from; empty: none

  // Throws InputError: deck or meshes have changed; and what run_problem throws.
  std::shared_ptr<const RunResult> run(const Problem& problem, const RunRequest& request);
  bool is_done() const { return is_done_; }
  // Tables that differ from those of the record, "a.csv, b.csv".
  const std::string& differing() const { return differing_; }
  // "problem 'crush', case 'base'".
  std::string label() const;

 private:
  void check_same(const RunRequest& request) const;
  void compare_tables(const std::filesystem::path& folder);

  std::filesystem::path folder_, deck_, from_;
  std::string differing_;
  std::string problem_, case_, deck_digest_, solver_, kernels_, version_;
  std::vector<std::pair<std::string, std::string>> settings_;
  std::map<std::string, std::string> meshes_, tables_;  // digests, by substructure and by file
  bool has_frames_ = true, has_state_ = true, is_done_ = false;
};

}  // namespace dygita

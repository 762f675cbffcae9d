// New results in the place of old ones: beside them until they are complete, then both change places.
#pragma once

#include <filesystem>
#include <string>

namespace dygita {

class Replacement {
 public:
  // `directory`: of the results to be replaced. Nothing is made yet. Throws InputError where something other than a
  // folder has the place of the new ones, a link too.
  explicit Replacement(const std::filesystem::path& directory);
  // Without `commit`: the old results are unchanged, the new ones are gone.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  // A hidden sibling of the old results, for RunWriter to fill.
  const std::filesystem::path& work() const { return work_; }

  // The new results take the place of the old ones in one move; files there that no run of ours wrote stay,
  // those whose names new results have in `directory`.kept, as a warning says. Throws InputError with the system's
  // reason; then the old ones are still there. The old one of `dropped`, and of `dropped`.parts, does not stay.
  void commit(const std::string& dropped = "");

 private:
  std::filesystem::path keep();

  std::filesystem::path directory_, work_;
  bool is_committed_ = false;
};

}  // namespace dygita

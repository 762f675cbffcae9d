// New results in the place of old ones: beside them until they are complete, then both change places.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dygita {

class Replacement {
 public:
  // `directory`: of the results to be replaced. `dropped`: files of runs there, and folders of their parts, that no
  // manifest lists and that do not stay. What a killed run has left in the place of the new results is removed, what
  // others put there goes to the old ones, unless another process `clears` it. Throws InputError where something other
  // than a folder is there, a link too.
  explicit Replacement(const std::filesystem::path& directory, std::vector<std::string> dropped = {},
                       bool clears = true);
  // Without `commit`: the old results are unchanged, the new ones are gone.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  // A hidden sibling of the old results, for RunWriter to fill.
  const std::filesystem::path& work() const { return work_; }

  // The new results take the place of the old ones in one move; files there that no run of ours wrote stay, those
  // whose names new results have in `directory`.kept, as a warning says. Throws InputError with the system's reason;
  // then the old ones are still there.
  void commit();

 private:
  std::filesystem::path keep();
  void give_back();

  std::filesystem::path directory_, work_;
  std::vector<std::string> dropped_;
  bool is_committed_ = false;
};

}  // namespace dygita

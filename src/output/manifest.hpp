// The list, in an output directory, of the files that runs wrote there: what a later run may remove.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace dygita {

class Manifest {
 public:
  static constexpr const char* file_name = ".dygita-files";

  // Removes from `directory` the files that a manifest there lists, and the directories that this leaves empty; then
  // starts a new list. Entries that lead out of the directory, also through a link, are passed over. Throws InputError
  // where it cannot write.
  explicit Manifest(std::filesystem::path directory);

  // To be called before a file is written, so that a run which is killed leaves nothing unlisted. `relative` to the
  // directory.
  void add(const std::filesystem::path& relative);
  // Throws InputError where the folder has been taken away, or emptied: what could not be written there has that
  // reason.
  void check_there() const;

  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path directory_;
  std::vector<std::filesystem::path> files_;
  std::set<std::string> known_;  // the same
};

}  // namespace dygita

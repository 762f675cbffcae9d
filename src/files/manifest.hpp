// The list, in an output directory, of the files that runs wrote there: what a later run may remove.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace dygita {

class Manifest {
 public:
  static constexpr const char* file_name = ".dygita-files";

  // Removes from `directory` the files that a manifest there lists, and the directories that this leaves empty; then
  // starts a new list. Entries that lead out of the directory, also through a link, are passed over. Throws InputError
  // where it cannot write.
  explicit Manifest(std::filesystem::path directory);

  // Removes what a manifest in `directory` lists, the manifest, and the directory where this leaves it empty; nothing
  // where there is none.
  static void clear(const std::filesystem::path& directory);

  // To be called before a file is written, so that a run which is killed leaves nothing unlisted. `relative` to the
  // directory.
  void add(const std::filesystem::path& relative);
  // Throws InputError where the folder has been taken away, or emptied.
  void check_there() const;
  // write(); where that throws an InputError and the folder is no more, that is the reason to be told.
  template <class Write>
  void while_there(const Write& write) const {
    try {
      write();
    } catch (const InputError&) {
      check_there();
      throw;
    }
  }

  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path directory_;
  std::vector<std::filesystem::path> files_;
  std::set<std::string> known_;  // the same
};

}  // namespace dygita

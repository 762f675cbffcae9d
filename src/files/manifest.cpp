#include "files/manifest.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "base/plain_file.hpp"
#include "files/files.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

constexpr const char* title = "# Files that dygita wrote here; its next run into this directory removes them.\n";

// An entry names a file below the directory, by a plain path and not through a link to elsewhere.
bool stays_inside(const fs::path& directory, const fs::path& entry) {
  if (entry.empty() || entry.is_absolute()) return false;
  if (std::any_of(entry.begin(), entry.end(), [](const fs::path& part) { return part == ".." || part == "."; }))
    return false;
  std::error_code error;
  const fs::path home = fs::canonical(directory, error);
  if (error) return false;
  const fs::path parent = fs::weakly_canonical(directory / entry.parent_path(), error);
  return !error && std::mismatch(home.begin(), home.end(), parent.begin(), parent.end()).first == home.end();
}

void remove_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(path, error))) return;
  fs::remove(path, error);
}

void remove_listed(const fs::path& directory) {
  if (is_no_file(directory / Manifest::file_name)) return;
  require_readable(directory / Manifest::file_name);
  std::ifstream list(directory / Manifest::file_name);
  std::set<fs::path, std::greater<>> parents;  // deepest first
  for (std::string line; std::getline(list, line);) {
    if (line.starts_with('#') || !stays_inside(directory, line)) continue;
    remove_file(directory / line);
    remove_file(directory / (line + ".tmp"));
    for (fs::path parent = fs::path(line).parent_path(); !parent.empty(); parent = parent.parent_path()) {
      parents.insert(parent);
    }
  }
  std::error_code error;
  for (const fs::path& parent : parents) fs::remove(directory / parent, error);  // fails, as it should, if not empty
}

}  // namespace

Manifest::Manifest(fs::path directory) : directory_(std::move(directory)) {
  remove_listed(directory_);
  write_text(directory_ / file_name, title);
}

void Manifest::clear(const fs::path& directory) {
  std::error_code error;
  if (fs::is_symlink(fs::symlink_status(directory, error))) return;  // to somebody's results
  if (!fs::is_regular_file(directory / file_name, error)) return;
  remove_listed(directory);
  remove_file(directory / file_name);
  fs::remove(directory, error);  // fails, as it should, if not empty
}

void Manifest::check_there() const {
  if (std::error_code error; !fs::exists(directory_ / file_name, error))
    throw InputError("'" + directory_.string() + "' was removed or emptied while the run wrote there");
}

void Manifest::add(const fs::path& relative) {
  if (!known_.insert(relative.generic_string()).second) return;
  check_there();
  errno = 0;
  std::ofstream list(directory_ / file_name, std::ios::app | std::ios::binary);
  list << relative.generic_string() << '\n';
  list.close();
  if (!list) throw InputError("cannot write '" + (directory_ / file_name).string() + "': " + reason_not_written(errno));
  files_.push_back(relative);
}

}  // namespace dygita

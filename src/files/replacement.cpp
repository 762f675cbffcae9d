#include "files/replacement.hpp"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "files/manifest.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

// One move where the file system can exchange, two where it cannot.
bool exchange(const fs::path& a, const fs::path& b) {
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
  const fs::path aside = a.string() + ".old";
  if (std::rename(a.c_str(), aside.c_str()) != 0) return false;
  if (std::rename(b.c_str(), a.c_str()) == 0) return std::rename(aside.c_str(), b.c_str()) == 0;
  const int reason = errno;
  std::rename(aside.c_str(), a.c_str());
  errno = reason;
  return false;
}

// What others put beside the old results goes where it was; folders of ours that it lies in are there again. Nothing
// goes through a link. False: something has a new result in its place, or could not be moved, and is still in `from`.
bool carry_over(const fs::path& from, const fs::path& to) {
  std::error_code error;
  bool is_done = true;
  for (const fs::directory_entry& entry : fs::directory_iterator(from, error)) {
    const fs::path target = to / entry.path().filename();
    if (!fs::exists(fs::symlink_status(target))) {
      fs::rename(entry.path(), target, error);
      is_done = is_done && !error;
    } else if (fs::is_directory(entry.symlink_status()) && fs::is_directory(fs::symlink_status(target))) {
      is_done = carry_over(entry.path(), target) && is_done;
    } else {
      is_done = false;
    }
  }
  return is_done;
}

}  // namespace

Replacement::Replacement(const fs::path& directory, std::vector<std::string> dropped, bool clears)
    : directory_(fs::canonical(directory)), dropped_(std::move(dropped)) {
  work_ = directory_.parent_path() / ("." + directory_.filename().string() + ".continued");
  // What a killed run has left there is a folder; a link would lead to the old results, or anywhere.
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(work_, ignored);
  if (fs::exists(there) && !fs::is_directory(there))
    throw InputError("'" + work_.string() + "' is a link or a file, where new results are to be written: remove it");
  if (clears) give_back();
}

Replacement::~Replacement() {
  if (is_committed_) return;
  std::error_code error;
  fs::remove_all(work_, error);
}

// What could not go back stays under a name that no continuation writes to.
fs::path Replacement::keep() {
  const fs::path wanted = directory_.string() + ".kept";
  fs::path kept = wanted;
  for (int i = 2; fs::exists(fs::symlink_status(kept)); ++i) kept = wanted.string() + std::to_string(i);
  return std::rename(work_.c_str(), kept.c_str()) == 0 ? kept : work_;
}

// Takes away what runs wrote to `work`: a run that was killed, or, after the exchange, the one before. What others put
// there goes to the results, as after an exchange that was the last a run did.
void Replacement::give_back() {
  Manifest::clear(work_);
  std::error_code error;
  for (const std::string& name : dropped_) {
    if (!fs::is_directory(fs::symlink_status(work_ / name, error))) fs::remove(work_ / name, error);
    remove_parts(work_ / (name + ".parts"));
  }
  if (!fs::exists(fs::symlink_status(work_, error))) return;
  if (carry_over(work_, directory_))
    fs::remove_all(work_, error);
  else
    warn(fmt::format("'{}' keeps what was beside the old results under names that new ones have", keep().string()));
}

void Replacement::commit() {
  if (!exchange(directory_, work_))
    throw InputError("cannot put the new results in the place of '" + directory_.string() +
                     "': " + std::strerror(errno));
  is_committed_ = true;
  give_back();
}

}  // namespace dygita

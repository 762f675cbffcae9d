#include "files/run_lock.hpp"

#include <fcntl.h>
#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "files/files.hpp"

namespace dygita {

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// "pid host since"; what the file of a holder says.
struct Holder {
  long pid = 0;
  std::string host, since;
};

Holder read_holder(int descriptor) {
  std::array<char, 512> text{};
  Holder holder;
  if (pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return holder;
  std::istringstream words(text.data());
  words >> holder.pid >> holder.host;
  std::getline(words >> std::ws, holder.since);
  return holder;
}

// Where the file system knows no locks, a process of this machine that still runs holds it, and any of another may.
bool may_live(const Holder& holder) {
  if (holder.pid <= 0) return false;
  return holder.host != host_name() || kill(static_cast<pid_t>(holder.pid), 0) == 0 || errno == EPERM;
}

// A second name of a file of somebody's, or a pipe, would be emptied or waited for.
void require_own(int descriptor, const std::filesystem::path& path) {
  struct stat found {};
  if (fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink <= 1) return;
  close(descriptor);
  throw InputError(fmt::format("'{}' is no file of its own, but {}, and not a lock of dygita: remove it", path.string(),
                               S_ISREG(found.st_mode) ? "a second name of another" : "something else"));
}

bool is_same_file(int descriptor, const std::filesystem::path& path) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

enum class Attempt { held, by_another, again };

Attempt attempt(int descriptor, const std::filesystem::path& path) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK || may_live(read_holder(descriptor))) return Attempt::by_another;
  }
  return is_same_file(descriptor, path) ? Attempt::held : Attempt::again;  // its holder may just have removed it
}

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::filesystem::path& lock, int descriptor) {
  const Holder holder = read_holder(descriptor);
  const std::string who = holder.pid > 0
                              ? fmt::format("process {} on {}, since {}", holder.pid, holder.host, holder.since)
                              : "another process";
  const std::string remedy = holder.pid > 0 && holder.host != host_name()
                                 ? fmt::format("; if it has died there, remove '{}'", lock.string())
                                 : "";
  throw InputError(fmt::format("'{}' is being written by {}\n    wait for it, end it, or write elsewhere with --out{}",
                               folder.string(), who, remedy));
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder) {
  const std::filesystem::path parent = folder.has_parent_path() ? folder.parent_path() : ".";
  make_directory(parent);
  path_ = parent / ("." + folder.filename().string() + ".lock");
  for (Attempt found = Attempt::again; found != Attempt::held;) {
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0 && errno == ELOOP)
      throw InputError(fmt::format("'{}' is a link, and not a lock of dygita: remove it", path_.string()));
    if (descriptor_ < 0) throw InputError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(errno)));
    require_own(descriptor_, path_);
    found = attempt(descriptor_, path_);
    if (found == Attempt::by_another) {
      try {
        refuse(folder, path_, descriptor_);
      } catch (...) {
        close(descriptor_);
        throw;
      }
    }
    if (found == Attempt::again) close(descriptor_);
  }
  const std::string text = fmt::format("{} {} {:%Y-%m-%d %H:%M:%S}\n", static_cast<long>(getpid()), host_name(),
                                       fmt::localtime(std::time(nullptr)));
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, text.data(), text.size(), 0) < 0) {
    // A full disk: the lock holds, it only does not say whose it is.
  }
}

RunLock::~RunLock() {
  std::error_code ignored;
  if (is_same_file(descriptor_, path_)) std::filesystem::remove(path_, ignored);
  close(descriptor_);
}

}  // namespace dygita

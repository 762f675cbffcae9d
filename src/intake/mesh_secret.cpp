#include "intake/mesh_secret.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace dygita {

namespace {

namespace fs = std::filesystem;

constexpr size_t n_bytes = 32;

fs::path folder_of_state() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    return value && value[0] == '/' ? fs::path(value) : fs::path();
  };
  if (const fs::path state = absolute("XDG_STATE_HOME"); !state.empty()) return state / "dygita";
  const fs::path home = absolute("HOME");
  return home.empty() ? home : home / ".local/state/dygita";
}

// Of this user alone, and no second name of something else.
std::string read_secret(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return "";
  struct stat found {};
  std::array<char, n_bytes> bytes{};
  const bool is_own = fstat(file, &found) == 0 && S_ISREG(found.st_mode) && found.st_nlink == 1 &&
                      found.st_uid == geteuid() && (found.st_mode & 077) == 0 && found.st_size == n_bytes;
  const bool is_whole = is_own && read(file, bytes.data(), n_bytes) == static_cast<ssize_t>(n_bytes);
  close(file);
  return is_whole ? std::string(bytes.data(), n_bytes) : "";
}

// Whole or not at all; one that another process has made meanwhile stays.
void make_secret(const fs::path& path) {
  std::error_code ignored;
  fs::create_directories(path.parent_path().parent_path(), ignored);
  mkdir(path.parent_path().c_str(), 0700);
  std::array<char, n_bytes> bytes;
  if (getrandom(bytes.data(), n_bytes, 0) != static_cast<ssize_t>(n_bytes)) return;
  const std::string beside = path.string() + "." + std::to_string(getpid());
  const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) return;
  const bool is_whole = write(file, bytes.data(), n_bytes) == static_cast<ssize_t>(n_bytes);
  if (close(file) != 0 || !is_whole ||
      renameat2(AT_FDCWD, beside.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) != 0)
    unlink(beside.c_str());
}

}  // namespace

std::string own_secret() {
  const fs::path folder = folder_of_state();
  if (folder.empty()) return "";
  const fs::path path = folder / "secret";
  if (std::string secret = read_secret(path); !secret.empty()) return secret;
  make_secret(path);
  return read_secret(path);
}

}  // namespace dygita

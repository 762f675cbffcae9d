#include "intake/mesh_cache.hpp"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/plain_file.hpp"
#include "base/sha256.hpp"
#include "intake/mesh_file.hpp"
#include "intake/mesh_secret.hpp"
#include "intake/mesher_process.hpp"

namespace dygita {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "dygita mesh 1\n";
constexpr size_t n_digest = 32, n_length = 8;

// A descriptor that is closed.
struct Opened {
  explicit Opened(int descriptor) : number(descriptor) {}
  ~Opened() {
    if (number >= 0) close(number);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  int number;
};

int open_folder(const fs::path& folder) {
  return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

std::string bytes_in(const std::string& file) {
  try {
    return text_of_file(file);
  } catch (const InputError&) {  // the mesher says what is wrong with it
    return "";
  }
}

// A file of its own, no longer than the limit; empty: none.
std::string read_entry(int folder, const std::string& name, double limit) {
  const Opened file(openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat found {};
  if (file.number < 0 || fstat(file.number, &found) != 0 || !S_ISREG(found.st_mode) || found.st_nlink != 1) return "";
  if (static_cast<double>(found.st_size) > limit) return "";
  // Nearly all holes: nothing that was written here, and seconds to be read only to be refused.
  constexpr off_t of_blocks = 512, densest = 64;
  if (found.st_blocks * of_blocks < found.st_size / densest) return "";
  std::string bytes(static_cast<size_t>(found.st_size), '\0');
  size_t n = 0;
  for (ssize_t got; n < bytes.size() && (got = read(file.number, &bytes[n], bytes.size() - n)) > 0;)
    n += static_cast<size_t>(got);
  if (n != bytes.size()) return "";
  futimens(file.number, nullptr);  // used last: it goes last
  return bytes;
}

bool write_entry(int folder, const std::string& name, std::string_view bytes) {
  const std::string beside = fmt::format("{}.{}", name, getpid());
  const int file = openat(folder, beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) return false;
  bool is_whole = true;
  while (!bytes.empty() && is_whole) {
    const ssize_t n = write(file, bytes.data(), bytes.size());
    is_whole = n > 0;
    if (is_whole) bytes.remove_prefix(static_cast<size_t>(n));
  }
  if (close(file) == 0 && is_whole && renameat(folder, beside.c_str(), folder, name.c_str()) == 0) return true;
  unlinkat(folder, beside.c_str(), 0);
  return false;
}

// Ours by their names, also those that a killed process has left half written.
bool is_name_of_entry(const std::string& name) {
  constexpr size_t n = 2 * n_digest;
  return name.size() > n && name.substr(n).starts_with(".mesh") &&
         std::all_of(name.begin(), name.begin() + n, [](unsigned char c) { return std::isxdigit(c); });
}

// The oldest, until the others take no more than the limit.
void remove_old(const fs::path& folder, int opened, double limit) {
  struct Entry {
    std::string name;
    timespec used;
    double bytes;
  };
  std::vector<Entry> entries;
  double all = 0.0;
  std::error_code error;
  for (const fs::directory_entry& found : fs::directory_iterator(folder, error)) {
    const std::string name = found.path().filename();
    struct stat status {};
    if (!is_name_of_entry(name) || fstatat(opened, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    if (S_ISDIR(status.st_mode)) continue;
    entries.push_back({name, status.st_mtim, static_cast<double>(status.st_size)});
    all += entries.back().bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
  });
  for (size_t i = 0; i < entries.size() && all > limit; all -= entries[i++].bytes)
    unlinkat(opened, entries[i].name.c_str(), 0);
}

// Size and time of the files that the mesher is made of, a line each; empty: one of them is gone.
std::string told_of(const std::vector<std::string>& paths) {
  std::string text;
  for (const std::string& path : paths) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0 || path.find('\n') != std::string::npos) return "";
    text += fmt::format("{} {}.{:09} {}\n", found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec, path);
  }
  return text;
}

std::vector<std::string> paths_in(std::string_view told) {
  std::vector<std::string> paths;
  for (size_t end; (end = told.find('\n')) != std::string_view::npos; told.remove_prefix(end + 1)) {
    std::string_view line = told.substr(0, end);
    for (int word = 0; word < 2; ++word) line.remove_prefix(std::min(line.size(), line.find(' ') + 1));
    paths.emplace_back(line);
  }
  return paths;
}

std::string length_of(size_t n) {
  std::string bytes;
  for (size_t i = 0; i < n_length; ++i) bytes += static_cast<char>(std::uint64_t{n} >> (8 * i));
  return bytes;
}

// What is signed: the question, of what the mesher was made, the answer, each with its length.
std::string signature(const std::string& secret, const std::string& question, std::string_view told,
                      std::string_view answer) {
  std::string all = length_of(question.size()) + question + length_of(told.size());
  all.append(told).append(length_of(answer.size())).append(answer);
  return bytes_of(hmac_sha256(secret, all));
}

}  // namespace

MeshCache::MeshCache(const MesherTask& task, const std::string& file, const std::string& folder)
    : task_(task), file_(file), folder_((folder.empty() ? fs::path(".") : fs::path(folder)) / folder_name) {
  if (!(mesh_limits().cache > 0.0) || is_trusted_mesh(file)) return;
  const std::string kind = kind_of_file(file);
  if (kind != "step" && kind != "brep") return;
  secret_ = own_secret();
  if (!secret_.empty()) asked_ = question();
  if (!asked_.empty()) name_ = hexadecimal(hmac_sha256(secret_, asked_)) + ".mesh";
}

std::string MeshCache::question() const {
  const std::string text = bytes_in(file_);
  if (text.empty() || text.find("DOCUMENT_FILE") != std::string::npos) return "";
  MesherTask task = task_;
  task.path = "";
  task.memory_limit = 0.0;
  task.readable.clear();
  std::string asked = bytes_of(sha256(text)) + to_bytes(task);
  for (const char* name : {"LD_LIBRARY_PATH", "LD_PRELOAD"})
    if (const char* value = std::getenv(name)) asked += std::string("\n") + name + "=" + value;
  return asked;
}

std::string MeshCache::find() {
  if (name_.empty()) return "";
  const Opened folder(open_folder(folder_));
  if (folder.number < 0) return "";
  const std::string bytes = read_entry(folder.number, name_, mesh_limits().cache);
  constexpr size_t before = magic.size() + n_digest + n_length;
  if (bytes.size() < before || !bytes.starts_with(magic)) return "";
  const std::string_view rest = std::string_view(bytes).substr(before);
  std::uint64_t n_told = 0;
  for (size_t i = 0; i < n_length; ++i)
    n_told |= std::uint64_t{static_cast<unsigned char>(bytes[before - n_length + i])} << (8 * i);
  if (n_told > rest.size()) return "";
  const std::string_view told = rest.substr(0, n_told), answer = rest.substr(n_told);
  if (bytes.substr(magic.size(), n_digest) != signature(secret_, asked_, told, answer)) return "";
  if (told_of(paths_in(told)) != told) return "";
  is_found_ = true;
  return std::string(answer);
}

void MeshCache::keep(const std::string& answer, const std::vector<std::string>& libraries) const {
  if (name_.empty() || is_found_) return;
  const std::string told = told_of(libraries);
  const double limit = mesh_limits().cache;
  if (told.empty() || static_cast<double>(answer.size() + told.size()) > limit) return;
  if (question() != asked_) return;  // the file has changed meanwhile
  mkdir(folder_.c_str(), 0755);
  const Opened folder(open_folder(folder_));
  if (folder.number < 0) return;
  std::string bytes(magic);
  bytes += signature(secret_, asked_, told, answer) + length_of(told.size()) + told + answer;
  if (write_entry(folder.number, name_, bytes)) remove_old(folder_, folder.number, limit);
}

}  // namespace dygita

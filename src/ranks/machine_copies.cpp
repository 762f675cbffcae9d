#include "ranks/machine_copies.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <spdlog/fmt/fmt.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

constexpr int least_bytes = 64 << 10;  // smaller arrays are not worth a mapping
constexpr int most_mappings = 10000;   // a process may have 65,530, three for each

size_t page_size() {
  static const auto size = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

// A descriptor that is closed.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

bool write_all(int descriptor, const char* from, size_t n_bytes) {
  while (n_bytes > 0) {
    const ssize_t n = ::write(descriptor, from, n_bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    from += n;
    n_bytes -= static_cast<size_t>(n);
  }
  return true;
}

bool has_content(int descriptor, const void* expected, size_t n_bytes) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || static_cast<size_t>(status.st_size) != n_bytes) return false;
  void* const there = mmap(nullptr, n_bytes, PROT_READ, MAP_SHARED, descriptor, 0);
  if (there == MAP_FAILED) return false;
  const bool is_equal = std::memcmp(there, expected, n_bytes) == 0;
  munmap(there, n_bytes);
  return is_equal;
}

}  // namespace

MachineCopies::MachineCopies(std::string folder, std::string prefix)
    : folder_(std::move(folder)), prefix_(std::move(prefix)) {}

MachineCopies::Outcome MachineCopies::share(const void* array, size_t n_bytes) {
  if (is_impossible_ || n_mappings_ >= most_mappings) return Outcome::impossible;
  const size_t page = page_size();
  const auto first = (reinterpret_cast<std::uintptr_t>(array) + page - 1) / page * page;
  const auto last = (reinterpret_cast<std::uintptr_t>(array) + n_bytes) / page * page;
  if (n_bytes < static_cast<size_t>(least_bytes) || last <= first) return Outcome::too_small;
  auto* const at = reinterpret_cast<void*>(first);
  const size_t size = last - first;
  Checksum digest;
  digest.add(at, size);
  const std::string path = fmt::format("{}/{}{:016x}_{}", folder_, prefix_, digest.value(), size);
  if (const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC)}; file.number >= 0)
    return map(file.number, at, size);
  if (const Outcome written = write(path, at, size); written != Outcome::shared) return written;
  const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  return file.number >= 0 ? map(file.number, at, size) : Outcome::impossible;
}

// Under another name until it is whole.
MachineCopies::Outcome MachineCopies::write(const std::string& path, const void* from, size_t n_bytes) {
  const std::string part = path + ".part";
  const Descriptor file{open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR)};
  if (file.number < 0 && errno == EEXIST) return Outcome::being_written;
  if (file.number >= 0 && write_all(file.number, static_cast<const char*>(from), n_bytes) &&
      rename(part.c_str(), path.c_str()) == 0) {
    written_.push_back(path);
    return Outcome::shared;
  }
  if (file.number >= 0) unlink(part.c_str());
  is_impossible_ = true;
  return Outcome::impossible;
}

MachineCopies::Outcome MachineCopies::map(int descriptor, void* at, size_t n_bytes) {
  if (!has_content(descriptor, at, n_bytes)) return Outcome::impossible;  // digests of two contents may be equal
  if (mmap(at, n_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_FIXED, descriptor, 0) == MAP_FAILED) {
    is_impossible_ = true;
    return Outcome::impossible;
  }
  bytes_ += static_cast<double>(n_bytes);
  ++n_mappings_;
  return Outcome::shared;
}

void MachineCopies::forget_files() {
  for (const std::string& path : written_) unlink(path.c_str());
  written_.clear();
}

namespace {

struct Shared {
  fs::path folder;
  std::unique_ptr<MachineCopies> copies;  // null: no folder for temporary files
  std::map<const void*, std::weak_ptr<const void>> known;
  struct Waiting {
    MachineArray array;
    std::shared_ptr<const void> owner;  // or null
  };
  std::vector<Waiting> waiting;  // being written by others

  Shared() {
    std::error_code error;
    folder = fs::temp_directory_path(error);
    if (!error) copies = std::make_unique<MachineCopies>(folder.string(), prefix());
  }
  void share(const MachineArray& array, const std::shared_ptr<const void>& owner) {
    if (copies->share(array.data(), array.size()) == MachineCopies::Outcome::being_written)
      waiting.push_back({array, owner});
  }
  static std::string prefix() { return "dygita_meshes_" + ranks::name_of_job() + "_"; }
};

Shared& shared_here();

// Files of all ranks of this machine, where one ends them by an error.
void forget_on_machine() {
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(shared_here().folder, ignored))
    if (file.path().filename().string().starts_with(Shared::prefix())) fs::remove(file.path(), ignored);
}

Shared& shared_here() {
  static Shared shared;
  return shared;
}

std::string folder_of_files() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  return error ? "a folder of temporary files, which there is none of" : folder.string();
}

}  // namespace

// An array that malloc maps by itself begins right after its header. Otherwise the threshold is where malloc's own rule
// ends, once arrays of that size have been freed.
LikePages::LikePages() {
  if (ranks::count_on_machine() > 1) mallopt(M_MMAP_THRESHOLD, least_bytes);
}

LikePages::~LikePages() {
  constexpr int most_by_rule = 32 << 20;
  if (ranks::count_on_machine() == 1) return;
  mallopt(M_MMAP_THRESHOLD, most_by_rule);
  mallopt(M_TRIM_THRESHOLD, 2 * most_by_rule);
}

void share_on_machine(const std::shared_ptr<const void>& owner, const std::vector<MachineArray>& arrays) {
  if (ranks::count_on_machine() == 1) return;
  Shared& here = shared_here();
  std::weak_ptr<const void>& known = here.known[owner.get()];
  if (!here.copies || known.lock() == owner) return;
  known = owner;
  ranks::before_stop(forget_on_machine);
  for (const MachineArray& array : arrays) here.share(array, owner);
}

void share_on_machine(const std::vector<MachineArray>& arrays) {
  if (ranks::is_alone()) return;
  if (ranks::count_on_machine() > 1 && shared_here().copies) {
    ranks::before_stop(forget_on_machine);
    for (const MachineArray& array : arrays) shared_here().share(array, nullptr);
  }
  ranks::any(false);  // all are written
  bool is_impossible = false;
  if (ranks::count_on_machine() > 1) {
    Shared& here = shared_here();
    for (const auto& [array, owner] : std::exchange(here.waiting, {})) here.copies->share(array.data(), array.size());
    is_impossible = !here.copies || here.copies->is_impossible();
  }
  if (ranks::any(is_impossible))
    warn(fmt::format("meshes cannot be shared in {}: each rank keeps a copy (TMPDIR selects another folder)",
                     folder_of_files()));
  if (ranks::count_on_machine() > 1 && shared_here().copies) shared_here().copies->forget_files();
  ranks::before_stop(nullptr);
}

double bytes_shared_on_machine() {
  return ranks::count_on_machine() > 1 && shared_here().copies ? shared_here().copies->bytes() : 0.0;
}

}  // namespace dygita

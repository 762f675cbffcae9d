#include "fuzz/target.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace dygita::fuzz {

namespace fs = std::filesystem;

void demand(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

MemoryFile::MemoryFile(const std::string& bytes) : descriptor_(memfd_create("input", MFD_CLOEXEC)) {
  demand(descriptor_ >= 0, "no file in memory");
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    demand(n > 0, "no room for a file in memory");
    done += static_cast<size_t>(n);
  }
}

MemoryFile::~MemoryFile() { close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

Scratch::Scratch() {
  std::error_code error;
  const fs::path home = fs::is_directory("/dev/shm", error) ? fs::path("/dev/shm") : fs::temp_directory_path();
  std::string pattern = (home / "dygita_fuzz_XXXXXX").string();
  demand(mkdtemp(pattern.data()) != nullptr, "no folder");
  outer_ = pattern;
  inner_ = outer_ / "inner";
  fs::create_directory(inner_);
  std::ofstream(outer_ / "outside") << "outside";
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(outer_, ignored);
}

void Scratch::empty() const {
  for (const auto& entry : fs::directory_iterator(inner_)) fs::remove_all(entry.path());
}

void Scratch::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(inner_ / name, std::ios::binary) << bytes;
}

void Scratch::demand_nothing_outside_was_touched() const {
  int n = 0;
  for (const auto& entry : fs::directory_iterator(outer_)) n += entry.path().filename() != ".inner.lock";
  demand(n == 2, "files came or went outside of the folder");
  std::string text;
  std::getline(std::ifstream(outer_ / "outside"), text);
  demand(text == "outside", "a file outside of the folder was written");
}

void Scratch::demand_alone(const std::string& name) const {
  for (const auto& entry : fs::directory_iterator(inner_))
    demand(entry.path().filename() == name, "a file came into the folder");
}

}  // namespace dygita::fuzz

#include "base/memory.hpp"

#include <sys/mman.h>
#include <sys/sysinfo.h>

#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

namespace dygita {

MemoryReserve::MemoryReserve(std::size_t bytes)
    : at_(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)),
      bytes_(bytes) {
  if (at_ == MAP_FAILED) at_ = nullptr;
}

void MemoryReserve::release() {
  if (at_) munmap(at_, bytes_);
  at_ = nullptr;
}

namespace {

// What a file of /proc says behind a name, in kB there; 0: nothing.
double bytes_in(const char* file, const char* name) {
  std::ifstream told(file);
  for (std::string line; std::getline(told, line);)
    if (line.starts_with(name)) return 1024.0 * std::strtod(line.c_str() + line.find(':') + 1, nullptr);
  return 0.0;
}

}  // namespace

double available_memory() { return bytes_in("/proc/meminfo", "MemAvailable:"); }

double resident_memory() { return bytes_in("/proc/self/status", "VmRSS:"); }

double peak_memory() { return bytes_in("/proc/self/status", "VmHWM:"); }

bool exceeds_memory(std::uint64_t bytes) {
  constexpr std::uint64_t small = std::uint64_t{1} << 26;  // asked for often
  if (bytes <= small) return false;
  const double available = available_memory();
  return available > 0.0 && static_cast<double>(bytes) > available;
}

void require_memory(std::size_t bytes) {
  void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (at == MAP_FAILED) throw std::bad_alloc();
  munmap(at, bytes);
}

double memory_of_machine() {
  struct sysinfo info {};
  return sysinfo(&info) == 0 ? static_cast<double>(info.totalram) * info.mem_unit : 0.0;
}

}  // namespace dygita

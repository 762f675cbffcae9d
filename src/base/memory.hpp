// Where memory runs out: kept back for what is to be written then, and asked for before a library that would not ask.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dygita {

// Address space set aside and not touched: it takes no memory until it is given back, and what fails for want of memory
// before leaves room for the results.
class MemoryReserve {
 public:
  explicit MemoryReserve(std::size_t bytes);  // none where there is none
  ~MemoryReserve() { release(); }
  MemoryReserve(const MemoryReserve&) = delete;
  MemoryReserve& operator=(const MemoryReserve&) = delete;
  void release();

 private:
  void* at_;
  std::size_t bytes_;
};

// Bytes that the machine could give without swapping (MemAvailable of /proc/meminfo); 0: it does not tell.
double available_memory();

// Bytes of memory that the machine has; 0: it does not tell.
double memory_of_machine();

// Bytes of this process that are in memory now, and that were at most.
double resident_memory();
double peak_memory();

// Is it more than the machine could give now? What a file says of its own length is a stranger's.
bool exceeds_memory(std::uint64_t bytes);

// Throws std::bad_alloc where so many bytes cannot be had now.
void require_memory(std::size_t bytes);

// By how much the heap grows at a time (set_up_process), as large as glibc makes that of a thread; it fails where there
// is not as much, however little is asked.
inline constexpr std::size_t heap_growth = std::size_t{64} << 20;

}  // namespace dygita

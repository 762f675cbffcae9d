// What every fuzzer needs: a program of tests/fuzz is one function that takes bytes, and answers a crash, a report of a
// sanitizer or an exception other than the errors of users where it finds a fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/log.hpp"

// The target, and what changes an input in its place (optional): both as libFuzzer calls them, by names of its own.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size);
extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most, unsigned seed);
extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, size_t size, size_t most);

namespace dygita::fuzz {

inline std::string text_of(const std::uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Runs it; the errors that users are told are no finding, any other exception is. True where nothing was thrown.
template <class Attempt>
bool attempt(Attempt&& it) {
  bool is_good = false;
  try {
    it();
    is_good = true;
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  } catch (const std::bad_alloc&) {
  }
  take_warnings();
  return is_good;
}

// Ends the program, as a sanitizer does, where the condition does not hold.
void demand(bool condition, const char* what);

// A file in memory, and the name under which it is opened.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const;

 private:
  int descriptor_;
};

// A folder of this process, in memory where the system has /dev/shm, with a file beside the inner one that nothing may
// touch.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& folder() const { return inner_; }  // empty at first
  void empty() const;                                             // again
  void write(const std::string& name, const std::string& bytes) const;
  void demand_nothing_outside_was_touched() const;
  void demand_alone(const std::string& name) const;  // in the inner one

 private:
  std::filesystem::path outer_, inner_;
};

}  // namespace dygita::fuzz

// Ranks of one machine read the same deck and make the same meshes: what is large of these is in memory once for all.
// By hand, since the arrays are those that std::vector and Eigen have made: shared windows of MPI want to allocate
// them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dygita {

// Arrays whose pages are those of files, which all processes that have an array of the same content map: memory for
// one, and the system may drop pages that nobody reads and read them again. Addresses and contents stay; who changes a
// value gets a page of its own, as of any private mapping. The files are found by their contents.
class MachineCopies {
 public:
  // Files are <folder>/<prefix><digest>; the prefix belongs to the processes that share them.
  MachineCopies(std::string folder, std::string prefix);
  MachineCopies(const MachineCopies&) = delete;
  MachineCopies& operator=(const MachineCopies&) = delete;
  ~MachineCopies() { forget_files(); }

  enum class Outcome { shared, too_small, being_written, impossible };
  // The whole pages of an array, heap memory of this process that no other thread changes now. being_written: by
  // another process, which nobody waits for. After `impossible` (no space, no rights) nothing more is shared.
  Outcome share(const void* array, size_t n_bytes);
  // Files that this process has written lose their names; who maps them keeps them.
  void forget_files();
  double bytes() const { return bytes_; }  // that are shared
  bool is_impossible() const { return is_impossible_; }

 private:
  Outcome write(const std::string& path, const void* from, size_t n_bytes);
  Outcome map(int descriptor, void* at, size_t n_bytes);

  std::string folder_, prefix_;
  std::vector<std::string> written_;
  double bytes_ = 0.0;
  int n_mappings_ = 0;
  bool is_impossible_ = false;
};

// While it lives, where several ranks are on this machine, large arrays begin at the same place of a page in all of
// them: what they have in common can be shared.
class LikePages {
 public:
  LikePages();
  ~LikePages();
  LikePages(const LikePages&) = delete;
  LikePages& operator=(const LikePages&) = delete;
};

// Heap memory that nobody changes any more.
using MachineArray = std::span<const std::byte>;
template <class Array>
MachineArray machine_array(const Array& array) {
  return std::as_bytes(std::span(array.data(), static_cast<size_t>(array.size())));
}
// Where several ranks are on this machine: the owner's arrays as one of them has them, once for each owner. Not
// collective.
void share_on_machine(const std::shared_ptr<const void>& owner, const std::vector<MachineArray>& arrays);
// Collective. These, and what could not be shared when it was made; afterwards no file has a name. Warns where the
// folder of temporary files does not take them: then each rank keeps its own.
void share_on_machine(const std::vector<MachineArray>& arrays);
double bytes_shared_on_machine();

}  // namespace dygita

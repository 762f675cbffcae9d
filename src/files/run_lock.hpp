// One run at a time in a folder.
#pragma once

#include <filesystem>

namespace dygita {

// Held from its making to its end by a hidden file beside the run's folder, `.<case>.lock`, that names process, machine
// and time. The system gives it up when the process ends, however it ends.
class RunLock {
 public:
  // folder: out/<problem>/<case>; its parent is made. Throws InputError: held by another process, which it names;
  // folder that cannot be made.
  explicit RunLock(const std::filesystem::path& folder);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace dygita

// What the mesher may not do.
#pragma once

#include <string>
#include <vector>

namespace dygita {

// From now on, for good: no program is started, no socket opened, no file written, no more memory taken than `memory`
// (bytes; 0: any), no core left behind; the process ends with the one that started it. By seccomp, and by Landlock
// where the kernel has it, which also lets nothing be read but `readable` (folders with all in them, files) and the
// system's libraries; where it has not, a warning says so. Throws InputError where the kernel refuses seccomp.
void confine(double memory, const std::vector<std::string>& readable);

}  // namespace dygita

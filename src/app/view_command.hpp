// dygita view: ParaView, set up for a run.
#pragma once

#include <string>

namespace dygita {

struct ViewCommand {
  std::string run;                   // folder of a run
  std::string program = "paraview";  // a name to look up in PATH, or a path
};

// Becomes ParaView with the run's view.py. Returns only by throwing InputError: the folder holds no run or no frames,
// or there is no such program.
[[noreturn]] void start_view(const ViewCommand& command);

}  // namespace dygita

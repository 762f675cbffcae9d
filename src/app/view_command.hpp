// dygita view: ParaView, set up for a run.
#pragma once

#include <string>

namespace dygita {

struct ViewCommand {
  std::string run;                   // folder of a run
  std::string program = "paraview";  // a name to look up in PATH, or a path
};

// Becomes ParaView with a script written afresh of what the run's view.py says (view_script_again): what else stands in
// a folder that may be a stranger's is not run. Returns only by throwing InputError: the folder holds no run or no
// frames, or there is no such program.
[[noreturn]] void start_view(const ViewCommand& command);

}  // namespace dygita

// Which kernels of panels are in use: chosen for the processor when the program starts.
#pragma once

#include <string>
#include <vector>

#include "numerics/panel_kernels.hpp"

namespace dygita {

// The first of those available, or the one that the environment's DYGITA_KERNELS names. Throws InputError where that is
// unknown or needs another processor.
const PanelKernels& panel_kernels();
// Uses the kernels of this name from now on, for comparisons. Throws as above.
void use_panel_kernels(const std::string& name);
// Those that this processor can run, the widest first; "generic", the last, runs everywhere.
std::vector<std::string> available_panel_kernels();

}  // namespace dygita

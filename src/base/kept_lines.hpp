// What a run says while others run beside it.
#pragma once

#include <string>
#include <vector>

namespace dygita {

// From now on the lines of say (base/log.hpp) are kept there; null: they are printed again.
void keep_lines(std::vector<std::string>* there);

// Is the progress of work shown (set_progress_enabled)?
bool is_progress_enabled();

}  // namespace dygita

// Which arguments of an entry of the table of laws need not be given.
#pragma once

#include <string>

namespace dygita {

// "normal?" is given or not; "approach[]" any number of times, as approach[1], approach[2] and so on.
inline bool is_optional(const std::string& argument) { return argument.ends_with("?") || argument.ends_with("[]"); }

}  // namespace dygita

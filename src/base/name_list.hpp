// Names in a line for people.
#pragma once

#include <string>
#include <vector>

namespace dygita {

// "'a', 'b', 'c', 'd', 'e', 'f' and 9 more": all where there are seven or fewer.
std::string list_of_names(const std::vector<std::string>& names);

}  // namespace dygita

// The floors of the house: which module may include which, and which third-party headers are whose.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dygita::architecture {

// What the text of a source of `module` includes against the floors, one line each: "line 3: latin may not include
// deck/run_problem.hpp". Includes behind // or inside /* */ do not count.
std::vector<std::string> violations(const std::string& module, const std::string& text);

// Modules that have a floor.
std::vector<std::string> modules();

// What a module may include, itself left out.
std::set<std::string> below(const std::string& module);

}  // namespace dygita::architecture

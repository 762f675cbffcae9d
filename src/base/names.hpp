// The closest known name to a misspelt one: every "did you mean" comes from here.
#pragma once

#include <string>
#include <vector>

namespace dygita {

// The known name nearest to `name` (Levenshtein distance, less than half the word), or "" when none is near.
std::string closest_name(const std::string& name, const std::vector<std::string>& known);

// "did you mean 'young'? known: damping, density, name" with the known names sorted.
std::string did_you_mean(const std::string& name, std::vector<std::string> known);

}  // namespace dygita

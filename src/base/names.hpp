// Names: the closest known one to a misspelt one (every "did you mean" comes from here), and as those of files.
#pragma once

#include <string>
#include <vector>

namespace dygita {

// The known name nearest to `name` (Levenshtein distance, less than half the word), or "" when none is near, or the
// name is longer than any is.
std::string closest_name(const std::string& name, const std::vector<std::string>& known);

// "did you mean 'young'? known: damping, density, name" with the known names sorted; of names that differ by a number
// at their end both neighbours: "did you mean 'M6' or 'M8'?".
std::string did_you_mean(const std::string& name, std::vector<std::string> known);

// The text as it can be printed: control characters but line ends and tabs as \xNN, so that no text moves a cursor.
std::string printable(const std::string& text);

// The name as a file's or directory's: '/', '\' and control characters become '_', a '.' in front too, an empty name
// "unnamed". A name that check_problem lets through is unchanged.
std::string file_name_of(const std::string& name);

// The text with small letters.
std::string in_lower_case(std::string text);

}  // namespace dygita

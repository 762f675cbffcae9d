// A deck that says what an .inp says: ready to run where it can, with a comment by line where it cannot.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct ImportOptions {
  std::string file;               // .inp
  std::string units = "mm t s";   // of the file
  std::vector<std::string> skip;  // types of elements that are left out
};

// Lua. What no deck says stands as comments, and as an error(...) that stops the deck until its reader deletes it.
// Throws InputError as AbaqusModel does.
std::string deck_of_abaqus(const ImportOptions& options);

}  // namespace dygita

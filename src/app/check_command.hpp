// dygita check: what would be computed and, with --picture, what it would be computed on.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "deck/deck.hpp"

namespace dygita {

// Checks problems and draws each into a file, once whatever the number of its cases: FILE, then FILE with the problem's
// name before its ending.
class CheckWithPicture {
 public:
  // Ends in .svg or .html, else InputError; empty: nothing is drawn.
  explicit CheckWithPicture(const std::filesystem::path& file);

  // The check's report. The picture is there even where the check then refuses the problem.
  std::string operator()(const Problem& problem);

 private:
  std::filesystem::path file_;
  std::set<std::string> drawn_;
};

}  // namespace dygita

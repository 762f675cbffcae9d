// Everything a deck declared, to tell what it never used.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"

namespace dygita {

class Register {
 public:
  // Notes an object that refers to those of `uses`; answers its id. `label` as in "support 'wall'".
  int add(std::string label, Origin origin, std::vector<int> uses);

  // Notes that an object does something by itself: a problem that ran.
  void mark_used(int id) { entries_[static_cast<size_t>(id)].is_used = true; }

  // "crush.lua:30: support 'wall' is declared but never used" for each object that no used one refers to, outermost
  // only: what serves an unused object alone is not told.
  std::vector<std::string> unused() const;

 private:
  struct Entry {
    std::string label;
    Origin origin;
    std::vector<int> uses;
    bool is_used = false;
  };
  std::vector<Entry> entries_;
};

}  // namespace dygita

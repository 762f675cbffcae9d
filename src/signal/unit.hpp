// Units as the titles of tables write them: "acceleration [g]", "time (ms)".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace dygita {

inline constexpr double standard_gravity = 9.80665;  // m/s^2

struct Unit {
  double factor = 1.0;  // of one of it, in SI
  std::string si;       // "m/s^2"; empty: without dimension
};

// The unit of a text ("g", "m/s²", "kN"); blanks do not matter. None where it is not known.
std::optional<Unit> unit_named(const std::string& text);

// The title of a column. Its unit is as written, without brackets.
struct Title {
  std::string name;
  std::optional<std::string> unit;
};

// The titles in a line above columns that `separator` separates: between separators, other separators or blanks, where
// a bracket closes a title, whichever gives one for each column; else as many as there are. A unit stands in [ ], ( )
// or { }, or behind a comma or "in" where it is known: "acceleration, g".
std::vector<Title> titles_of(const std::string& line, size_t n_columns, char separator);

// Whether they are units alone, known ones: the line of units below that of titles. An empty one is of text.
bool are_units(const std::vector<Title>& titles);

// The unit that a title gives; none where it gives none. Throws InputError at `origin` on one that is not known, or not
// of the dimension `si`, where that is given ("s", "Hz").
std::optional<Unit> unit_of(const Title& title, const Origin& origin, const std::string& si = "");

// "time_ms", "acc/g": a name that ends with a unit outside of brackets, where nothing reads it; the unit, or nothing.
std::string unit_in_name(const std::string& name);

// Warns of a title without a unit whose name ends with one.
void doubt_name(const Title& title, const Origin& origin);

}  // namespace dygita

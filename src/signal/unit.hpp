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

// The title of a column. Its unit is what stands in [ ] or ( ), without them.
struct Title {
  std::string name;
  std::optional<std::string> unit;
};

// The titles in a line: separated by commas, semicolons or tabs, else by blanks, where a unit closes its title.
std::vector<Title> titles_of(const std::string& line);

// The unit that a title gives; none where it gives none. Throws InputError at `origin` on one that is not known, or not
// of the dimension `si`, where that is given ("s", "Hz").
std::optional<Unit> unit_of(const Title& title, const Origin& origin, const std::string& si = "");

// The units of a table of two columns, from the lines above its numbers: titles, then perhaps a line of units alone. A
// comment (#) that is written as titles counts where there is no other.
class TwoColumns {
 public:
  // The dimensions that the columns must have where they give a unit; of the second "": any.
  TwoColumns(std::string first, std::string second) : wanted_{std::move(first), std::move(second)} {}

  void comment(const std::string& line, const Origin& origin);
  // A line without numbers; false where it cannot be titles or units. Throws as unit_of does, and where one unit is
  // given and it is not clear of which column.
  bool take(const std::string& line, const Origin& origin);

  const std::optional<Unit>& unit(int column) const { return units_[column]; }
  const std::string& text(int column) const { return texts_[column]; }  // of the unit, as written
  double factor(int column) const { return units_[column] ? units_[column]->factor : 1.0; }

 private:
  bool take_units_alone(const std::vector<Title>& titles);
  void doubt_name(const Title& title, const Origin& origin) const;

  std::string wanted_[2], texts_[2];
  std::optional<Unit> units_[2];
  bool has_titles_ = false, is_from_comment_ = false;
};

// "time_ms", "acc/g": a name that ends with a unit outside of brackets, where nothing reads it; the unit, or nothing.
std::string unit_in_name(const std::string& name);

}  // namespace dygita

// Warnings of one kind, told together: the worst in full, the others by what they are of.
#pragma once

#include <string>

namespace dygita {

struct KindOfWarning {
  std::string kind;     // equal for those that are told together
  double rank = 0.0;    // the highest is the worst
  std::string subject;  // what it is of: "output.srs 'above'"
  bool is_serious = false;
};

// A warning that waits for others of its kind, until `tell_warnings`.
void warn(const std::string& message, const KindOfWarning& of);

// Says what waits, serious kinds first. Also called by take_warnings, for the record.
void tell_warnings();

}  // namespace dygita

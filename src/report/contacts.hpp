// What the contacts of a run did in the steps that matter: those of the motion, else the last static one.
#pragma once

#include <string>
#include <vector>

#include "files/run_folder.hpp"

namespace dygita {

// Forces in N, lengths in m, shares of 1; nan where it is not known.
struct Contact {
  std::string name;
  double area, friction;
  double at_rest;                       // pressed, at the end of the last static step before
  double lowest, highest;               // pressed
  double shear, closed, opening;        // closed: smallest share of the area
  double sliding, slip, friction_used;  // sliding: largest share of what is closed

  // All that touches, and one way: what spreads under a bolt's head slips everywhere, and carries next to nothing.
  bool slides() const { return sliding > 0.999 && highest > 0.0 && friction_used > 0.5; }
  bool parts() const { return closed == 0.0 && highest > 0.0; }  // nothing touches any more, at an instant
  bool has_changed() const { return slides() || parts(); }
};

// Empty in runs of earlier versions, which have not watched them. Those that come nearest to sliding first.
std::vector<Contact> contacts_of(const Json& record);

}  // namespace dygita

// The solids of a STEP or BREP file before they are meshed: names, sizes, which are copies, where they touch.
#pragma once

#include <string>

#include "intake/mesher_task.hpp"
#include "mesh/box_grid.hpp"
#include "mesher/step_contacts.hpp"

namespace dygita {

struct Solid {
  int tag = 0;
  SolidNames part;
  std::vector<int> surfaces;
  std::vector<std::string> surface_names;  // of the file, by surface
  double size = 0.0;                       // of the model's unit
  std::optional<SolidCopy> copy;
};

// Of gmsh's current model, those that the options ask for; unit: m, of the model. Throws InputError: none, a name in
// the options that no part has.
std::vector<Solid> read_solids(const StepOptions& options, double unit);

Box box_of(int dimension, int tag);
// Where the solids touch each other.
StepContacts contacts_of(const std::vector<Solid>& solids);
// Do they count?
bool is_finer_at_contacts(const StepOptions& options);

}  // namespace dygita

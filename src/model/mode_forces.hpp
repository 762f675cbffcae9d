// Modes as an output of a run has them, for loads and outputs of its later steps.
#pragma once

#include "model/model.hpp"

namespace dygita {

class ModeShapes {
 public:
  virtual ~ModeShapes() = default;
  // Of the `number`-th mode (from 1), whose largest displacement is one, on a substructure: 3 x its nodes. Its shape;
  // mass times shape (kg), the forces of a modal acceleration of one. Both are zero before a run; throw NumericalError
  // where a run comes here before its modes are there.
  virtual Points shape(const Substructure& part, int number) const = 0;
  virtual Points mass_times_shape(const Substructure& part, int number) const = 0;
  virtual double generalised_mass(int number) const = 0;  // kg
  virtual double frequency(int number) const = 0;         // Hz
  virtual double damping_ratio(int number) const = 0;     // of the materials and of laws that damp
};

}  // namespace dygita

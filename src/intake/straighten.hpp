// Curved cells that tangle where a surface bends within a cell.
#pragma once

#include "intake/tagged_model.hpp"

namespace dygita {

struct Straightened {
  std::string volume;
  int n_cells = 0;             // straightened, of n_curved
  int n_curved = 0;            // cells of order two in all
  double volume_change = 0.0;  // relative, of the volume
};

// "ring.step: 7 of 261 curved cells of volume 'bolt' were tangled ...".
std::string text_of(const Straightened& one, const std::string& file);

// Puts the further nodes of cells of order two on their chords where the Jacobian falls below a tenth of that of the
// straight cell, at a node or a quadrature point; neighbours that this tangles follow. Nodes shared between volumes
// stay shared. One entry a volume with such cells.
std::vector<Straightened> straighten(TaggedModel& model);

}  // namespace dygita

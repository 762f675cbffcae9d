// Mass and stiffness of a linear assembly on interface coordinates and fixed-interface modes (manual, eq. D2-D7).
#pragma once

#include "reduction/linear_assembly.hpp"
#include "reduction/superelement.hpp"

namespace dygita {

// The interface coordinates of some faces: q = W u on the nodes of the faces.
struct InterfaceCoordinates {
  std::vector<Superelement::Row> rows;       // of q
  std::vector<Superelement::Row> dependent;  // motions that are no rows, since rows before have them
  SparseMatrix w;                            // what is held for the fixed-interface modes, on the assembly's unknowns
  Mat of_rows;             // motion of what is held for a unit of each row: identity but for rigid faces
  std::vector<int> nodes;  // of the faces, counted through all substructures
};

// Motions of the faces as the request asks: six means (fewer where a support holds them, or the face is a line), rigid,
// or node by node. Throws InputError where a rigid face is partly held, or nothing of a face can move.
InterfaceCoordinates interface_coordinates(const LinearAssembly& assembly, const Problem& problem,
                                           const SuperelementRequest& request);

// The reduced model (Craig, Bampton 1968; Kim, Lee 2015). Throws InputError where something can move freely with the
// interface held, or the dense matrices of the interface would be too large; NumericalError.
Superelement condense(const LinearAssembly& assembly, const Problem& problem, const SuperelementRequest& request);

}  // namespace dygita

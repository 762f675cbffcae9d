// Pieces that are one piece, moved and turned: one factor serves them all (manual, equal substructures).
#pragma once

#include <optional>

#include "pieces/piece_operator.hpp"

namespace dygita {

// The rotation from the first piece to the second, if the matrix of the second is that of the first in turned axes with
// the same unknowns on the interface; which directions their rows have there, and how stiff these are, is left open.
// of_first: the first one's unknowns.
std::optional<Mat3> turn_between(const PieceSetup& first, const FreeUnknowns& of_first, const PieceSetup& second);

// Are the rows of two pieces with the same order of unknowns the same ones, one after the other, for all that a
// stiffness on them depends on?
bool have_equal_rows(const PieceOperator& one, const PieceOperator& other);

// Is T^T k T the same on both? k: one a row, N s/m or N/m.
bool have_equal_springs(const PieceOperator& one, const Vec& k, const PieceOperator& other, const Vec& k_other);

}  // namespace dygita

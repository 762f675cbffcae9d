// By how much the diagonal mass of cells of order two keeps waves behind (manual, eq. Q12).
#pragma once

#include "model/model.hpp"
#include "pieces/piece.hpp"

namespace dygita {

// kg s^2: of the frequency w of a motion the share w^2 / 2 times this, over the mass that moves, is missing. Zero where
// the mass is not such a diagonal.
double mass_lag(const Piece& piece, const Substructure& body);

}  // namespace dygita

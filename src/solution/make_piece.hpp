// Which kind of piece a set-up asks for, and what it will hold.
#pragma once

#include "solution/full_piece.hpp"

namespace dygita {

// A piece that answers to interface data: condensed, unless almost all of it is interface or the plain path is asked
// for. twin: an equal piece, built before, whose operator serves this one too; or null. Throws NumericalError.
std::unique_ptr<ImplicitPiece> make_piece(const PieceSetup& setup, bool is_plain, const ImplicitPiece* twin);

// Memory (bytes) that it will hold, known before factorising; has_twin: its operator is another's.
double predicted_bytes(const PieceSetup& setup, bool has_twin);

}  // namespace dygita

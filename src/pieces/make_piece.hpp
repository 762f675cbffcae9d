// Which kind of piece a set-up asks for, and what it will hold.
#pragma once

#include "pieces/full_piece.hpp"

namespace dygita {

// An equal piece, built before, whose operator serves another too, and how the other is turned to it; or null.
struct Twin {
  const ImplicitPiece* piece = nullptr;
  Mat3 turn = Mat3::Identity();
  bool is_same = false;  // it is this very piece, of another run
};

// A piece that answers to interface data: condensed, unless almost all of it is interface or the plain path is asked
// for. Throws NumericalError.
std::unique_ptr<ImplicitPiece> make_piece(const PieceSetup& setup, bool is_plain, const Twin& twin);

// Memory (bytes) that it will hold, known before factorising; has_twin: its operator is another's.
double predicted_bytes(const PieceSetup& setup, bool has_twin);

}  // namespace dygita

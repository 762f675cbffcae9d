// The pieces of a step, built from its exchange and its conditions.
#pragma once

#include "pieces/make_piece.hpp"
#include "step/step_model.hpp"

namespace dygita {

using Pieces = std::vector<std::unique_ptr<Piece>>;

// One of every body, factorised side by side on the threads at hand; those equal to an earlier one share its operator,
// and those that an earlier run of the step has (null: none) share what it made. Throws NumericalError.
struct StepOperators;
Pieces make_pieces(const StepModel& model, const std::vector<Body>& bodies, const StepOperators* earlier);
// For a solver that factorises them together.
Pieces make_assembled_pieces(const StepModel& model, const std::vector<Body>& bodies);
// A piece of the latter.
AssembledPiece& assembled_piece(const StepModel& model, int i);

// Pieces that are solved together, at most 16 in a group.
std::vector<std::vector<int>> group_equal(const Pieces& pieces);

// Memory (bytes) that all of them will hold; nothing is factorised.
double predicted_bytes(const StepModel& model, const std::vector<Body>& bodies);

}  // namespace dygita

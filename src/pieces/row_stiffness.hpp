// What of a piece stands against a force at one of its interface rows, and how rows at the same nodes share it (manual,
// eq. K6, K8).
#pragma once

#include "pieces/condensed_piece.hpp"

namespace dygita {

// Takes the reference stiffness that the factor includes off the Schur complement.
void take_reference_off(const PieceOperator& op, int n_interior, Mat& schur);

// Of each row (N s/m; static N/m): the diagonal of S0 in its direction where the rows of its side are of one node each,
// else that of (T S0^-1 T^T)^-1 with T the rows of its side of the interface.
Vec stiffness_of_rows(const Condensation& condensation, const PieceOperator& op);

// Fills n_sharing: how many laws there are at the nodes of each row and along it.
void share_nodes(std::vector<InterfaceRow>& rows);

}  // namespace dygita

// Fields on the pieces of substructures that are cut, where a node has several copies, wherever these are.
#pragma once

#include "partition/cut.hpp"

namespace dygita {

// fields: 3 x n_nodes of each piece, of which a rank has those of its own pieces, or of all where `has_all` says so.
// Both are collective unless it does.

// What the owner of a node has, at all copies of it.
void give_to_copies(const Cut& cut, bool has_all, std::vector<Points>& fields);
// The sum over all copies, in the order of the pieces, at the owner; other copies keep what they have.
void sum_on_owners(const Cut& cut, bool has_all, std::vector<Points>& fields);

}  // namespace dygita

// Where something is: faces, regions and targets of a problem, their parts, nodes and names.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mean_nodes.hpp"
#include "model/model.hpp"

namespace dygita {

const Substructure& part_of(const FaceOrRegion& place);
std::string label_of(const FaceOrRegion& place);
std::vector<int> nodes_at(const FaceOrRegion& place);  // of the part's mesh, increasing
// The mean motion of a place, in the coordinates of the part's mesh: of all points of a face, of the nodes of a region.
MeanNodes mean_of(const FaceOrRegion& place);

// On one part, every node of one also a node of the other.
bool one_in_other(const FaceOrRegion& a, const FaceOrRegion& b);
// On one part with the same nodes.
bool coincide(const FaceOrRegion& a, const FaceOrRegion& b);
// Two faces with a facet, or two regions with a node in common.
bool overlap(const FaceOrRegion& a, const FaceOrRegion& b);

Target target_of(const FaceOrRegion& place);
// The face or region of a target, if it is one.
std::optional<FaceOrRegion> place_of(const Target& target);
bool is_wall(const Target& target);

// "face 'punch.zmin'", "a region of 'punch'", "interface.contact 'touch'", "support.wall 'wall'".
std::string describe(const Target& target);
std::string describe(const Interface& interface);
std::string describe(const Support& support);

// Every support in force in some step, each once, the problem's own first.
std::vector<SupportPtr> all_supports(const Problem& problem);
bool has_dynamic_step(const Problem& problem);

}  // namespace dygita

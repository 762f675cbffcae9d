// Substructures in words: what a check reports of them, what a run says of their stress.
#pragma once

#include <string>
#include <vector>

#include "interfaces/surfaces.hpp"
#include "result/result.hpp"

namespace dygita {

// "  substructure 'rod': 120 nodes, 80 cells, steel, 0.0123 kg, 8 x 8 x 60 mm\n".
std::string part_line(const Substructure& part);
// "'flange' 4, 'plate' 16": the substructures that are cut; pieces: of each.
std::string list_pieces(const Problem& problem, const std::vector<int>& pieces);
// Warns of substructures that have fewer than the deck asks for.
void warn_of_uncut(const Problem& problem, const std::vector<int>& pieces);
// "  1.23 kg in all\n".
std::string mass_line(const Problem& problem);

// "  base 'table': in the 30 ms of the dynamic steps its velocity changes by ..." of each support that is shaken: a
// record of velocity, or one with an offset, shows there.
std::vector<std::string> base_lines(const Problem& problem);

// Warns of each substructure that leaves the elastic range of its material.
void warn_of_stresses(const Problem& problem, const RunResult& result);
// "  smallest margin against yield 0.32, in 'rod' (485 MPa of 640)", and a line with the largest failure index; empty
// where no material has a yield or strengths.
std::string stress_line(const Problem& problem, const RunResult& result);

// An interface or a wall: its points, its area, and on which side its points are where meshes do not match.
std::string surface_line(const Surface& surface);

}  // namespace dygita

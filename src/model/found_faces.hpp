// Faces of interfaces that a deck declares between whole parts: those that touch.
#pragma once

#include <array>

#include "base/warnings.hpp"
#include "meeting/touching.hpp"
#include "model/model.hpp"

namespace dygita {

// A part, or one of its faces.
struct InterfaceSide {
  SubstructurePtr part;
  std::optional<Face> face;

  std::string label() const { return face ? face->label() : part->name; }
};

struct FoundFaces {
  Face side_1, side_2;
  Touching touching;
};

// Where a round face lies on a plane, those of both within the distance (m, `touching.within`) in which a load may
// bring them together; none where nothing lies on a line or at a point. For contact, of which the deck gives no
// distance.
std::optional<FoundFaces> beside_the_line(const FoundFaces& found);

// Those of both sides that touch, within a distance (m) or a hundredth of the facets. Throws InputError where they
// nowhere do: how far they are apart and where, or that they overlap.
FoundFaces find_faces(const InterfaceSide& one, const InterfaceSide& other, std::optional<double> within);

struct TouchingPair {
  int part_1, part_2;  // in the list asked for, part_1 < part_2
  FoundFaces found;
};

// Every pair of parts that touch where no interface of theirs has the facets already.
std::vector<TouchingPair> all_touching(const std::vector<SubstructurePtr>& parts,
                                       const std::vector<InterfacePtr>& interfaces, std::optional<double> within);

// Of pairs of parts that touch nowhere, by their numbers in the list, how far the nearest two are apart, and where;
// empty where none has facets.
std::string nearest_apart(const std::vector<SubstructurePtr>& parts, const std::vector<std::array<int, 2>>& pairs);

// "1200 mm^2 on 2 surfaces, gaps -0.01 to 0.02 mm between facets, within 0.05 mm".
std::string describe(const Touching& touching);

// What to say of faces that are taken for touching, within a distance (m), and do not: how far they are apart, or in
// each other, beyond what facets leave between round surfaces; empty where they do.
struct GapDoubt {
  std::string apart, on_average;
  double largest = 0.0;    // m
  bool is_hidden = false;  // facets are as far off their round surfaces
  bool is_slight = false;  // facets may hide all of it
  bool overlaps = false;
  // Cylinders around one axis, or such spheres: the gap is the same all around; or one of these on a plane.
  bool is_known = false;

  bool is_empty() const { return apart.empty(); }
  std::string neglected() const;
  std::string kept() const;
};
// Doubts of one kind are told together.
KindOfWarning kind_of(const GapDoubt& doubt, bool is_kept, const std::string& who_1, const std::string& who_2);
// m, how far apart facets of round faces may be that meet: all around between cylinders around one axis, or such
// spheres, that are apart; beside the line where one lies on a plane; else 0.
double reach_of_round(const Face& side_1, const Face& side_2);
GapDoubt doubt_of_gap(const Face& side_1, const Face& side_2, double within);

}  // namespace dygita

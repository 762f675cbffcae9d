// Hexahedra for the parts of a hexagon bolt around z, whose round sections have their nominal area.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// A head or a nut, one with its length of shank.
struct BoltEnd {
  double diameter;      // m, of the shank
  double across_flats;  // m, of the hexagon
  double height;        // m, of the hexagon
  double shank;         // m, length
  double bearing;       // m, z of the face that bears
  bool is_above;        // the hexagon is above that face, the shank below; else the other way round
  int around = 12;      // cells around the shank, a multiple of 12
  int order = 1;
};

// Faces: cut (end of the shank), bearing (the hexagon around the shank), end (the other end), flats, shank (its side).
MeshPtr bolt_end_mesh(const BoltEnd& bolt);

struct WasherShape {
  double inner, outer;    // m, diameters
  double low, thickness;  // m
  int around = 12;        // cells around, as of the bolt's shank
  int order = 1;
};

// Faces: lower, upper, inside, outside.
MeshPtr washer_mesh(const WasherShape& washer);

// Cells of those meshes, before they are made.
double n_cells(const BoltEnd& bolt);
double n_cells(const WasherShape& washer);

}  // namespace dygita

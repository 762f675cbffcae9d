// A picture of the assembly: boundary facets seen from afar, those that nothing hides, back to front.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace dygita {

struct PictureFacet {
  int part = 0;                             // substructure
  double value = 0.0;                       // mean of the nodes'
  double light = 1.0;                       // cosine between its normal and the light, 0 ... 1
  std::vector<std::array<int, 2>> corners;  // tenths of a pixel
};

struct Picture {
  int width = 0, height = 0;                 // px
  std::vector<PictureFacet> facets;          // back to front
  std::vector<std::array<int, 4>> edges;     // x1 y1 x2 y2, tenths of a pixel: sharp edges that are seen
  std::vector<std::array<int, 4>> outline;   // the same, of the undeformed assembly
  std::vector<std::array<int, 2>> axes;      // tips of x, y, z, unit length: 1000
  double value_low = 0.0, value_high = 0.0;  // of all nodes
  int n_facets = 0;                          // of the boundary, before any were left out
  bool is_cut = false;
};

// Where a picture is seen from, and what of it is left out; one for all pictures of a run.
struct View {
  Mat3 axes = Mat3::Identity();   // rows: to the right, up, towards the reader
  Vec3 centre = Vec3::Zero();     // m
  double size = 1.0;              // m, across the picture's width
  int width = 640, height = 480;  // px
  bool is_cut = false;            // what lies in front of a plane is left out, cells divided where it passes
  Vec3 cut = Vec3::Zero();        // its normal, unit, towards the reader
  Vec3 cut_at = Vec3::Zero();     // m, a point of it
};

// An isometric view that the whole assembly fits in, flatter for what is long and thin; laid on its side if it is tall.
View whole_view_of(const std::vector<SubstructurePtr>& parts);
// The same from the side that hides the fewest parts, cut in half where one still cannot be seen.
View view_of(const std::vector<SubstructurePtr>& parts);

// From one side, the undeformed parts large in it: turned about the vertical (degrees, 0: from the front right), from
// above or, negative, below.
View view_of_side(const std::vector<SubstructurePtr>& parts, double turn, double elevation);

// Pixels across and down, and depth towards the reader (3 x n), of places (m).
Points projected(const Points& x, const View& view);
std::array<int, 2> tenths(const Points& projected, int i);  // of a pixel

// Do the undeformed parts leave a place in sight, or hide it by less than `tolerance` of the view's width?
bool is_seen(const std::vector<SubstructurePtr>& parts, const View& view, const Vec3& place, double tolerance);

// Deformed by `scale` times `displacement` (m, 3 x n_nodes each; empty: undeformed) with `values` at nodes (empty:
// zero). Facets that others hide are left out; where more than `most_facets` are seen, nodes are merged until they are
// fewer.
Picture make_picture(const std::vector<SubstructurePtr>& parts, const View& view,
                     const std::vector<Points>& displacement, const std::vector<Vec>& values, double scale,
                     int most_facets = 2500);

// A round factor (1, 2, 5 times a power of ten) that draws the largest displacement as a twentieth of the view's width;
// 1 at least for motions that are large themselves; 0 where nothing moves, or something has left the picture.
double picture_scale(const View& view, const std::vector<Points>& displacement);

}  // namespace dygita

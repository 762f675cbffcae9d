// motion.json: the picture of a report that turns. Its size is bounded: 1 MB, whatever the mesh and the number of
// steps.
#pragma once

#include <string>
#include <vector>

#include "drawing/turning_mesh.hpp"
#include "model/own_files.hpp"
#include "result/frame.hpp"
#include "result/skin_motion.hpp"

namespace dygita {

inline constexpr const char* motion_file = own_file::motion;

// JSON as embedded/turn.js reads it; numbers are little-endian in base64. Displacements to 1/32767 of the frame's
// largest component, stresses (cube roots) to 1/255 of the frame's largest. Displacements and stresses that are not
// finite become zero.
std::string motion_text(const Problem& problem, const SkinMotion& motion);

// The same of natural modes, whose frames have shapes of the parts: each swings where it stands.
std::string shapes_text(const Problem& problem, const std::vector<Frame>& modes);
// Its file, of an output whose files are called so: "modes_shapes.json".
inline std::string shapes_file(const std::string& stem) { return stem + "_shapes.json"; }

struct TurningLabel {
  std::string name, color;  // color empty: grey
};

// The assembly at rest, its facets named and coloured by `names`, the list that `labels` counts in.
std::string assembly_text(const Problem& problem, const std::vector<FacetLabels>& labels,
                          const std::vector<TurningLabel>& names, const std::string& coloring);

// The figure that turns, from either text; hidden until its script runs. The page must have embedded/turn.js.
std::string turning_figure(const std::string& json, const std::string& title, const std::string& caption);

}  // namespace dygita

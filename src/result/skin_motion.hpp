// The skin of the assembly at a few instants of every step, for a rotating picture.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct SkinFrame {
  std::string step;
  int i_step = 0;
  bool is_static = false;
  double time = 0.0;                // s, of the run
  std::vector<float> displacement;  // m, x y z of each node of SkinMotion::nodes, part after part
  std::vector<float> von_mises;     // Pa, of the same
  int missed = 0;                   // increments up to here, of all steps, that have not converged
};

struct SkinMotion {
  std::vector<std::vector<int>> nodes;  // of each substructure: corners of its boundary facets, increasing
  std::vector<SkinFrame> frames;        // in the order of time
};

}  // namespace dygita

// What a mass between lumped and consistent lacks of the lumped one, by edges: C = M - M_s (manual, eq. S13).
#pragma once

#include <vector>

#include "fem/mass.hpp"

namespace dygita {

// In single precision; a translation has none, as in EdgeBlocks, whose fields these are.
class MassEdges {
 public:
  MassEdges() = default;  // none: the mass is lumped
  MassEdges(const Mesh& mesh, const Elastic& material, const WaveTuning& tuning, const std::vector<char>& keeps_lumped);

  bool empty() const { return others_.empty(); }
  // y += C x, both 4 n long.
  void add_product(const double* x, double* y) const;
  double bytes() const { return 4.0 * static_cast<double>(starts_.size() + others_.size() + values_.size()); }

 private:
  std::vector<int> starts_, others_;
  std::vector<float> values_;  // kg
};

}  // namespace dygita

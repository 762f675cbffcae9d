#include "mesh/smooth_patches.hpp"

#include <algorithm>
#include <cmath>

namespace dygita {

namespace {

const double least_cosine_in_patch = std::cos(35.0 * M_PI / 180.0);

}  // namespace

std::vector<int> smooth_patches(const std::vector<Facet>& facets, const std::vector<Vec3>& normals) {
  std::map<std::pair<int, int>, std::vector<int>> beside;
  for (size_t f = 0; f < facets.size(); ++f) {
    const std::span<const int> corners = facets[f].corners();
    for (size_t k = 0; k < corners.size(); ++k)
      beside[std::minmax(corners[k], corners[(k + 1) % corners.size()])].push_back(static_cast<int>(f));
  }
  std::vector<int> patch(facets.size());
  for (size_t f = 0; f < patch.size(); ++f) patch[f] = static_cast<int>(f);
  const auto root = [&](int f) {
    while (patch[f] != f) f = patch[f] = patch[patch[f]];
    return f;
  };
  for (const auto& [edge, both] : beside)
    if (both.size() == 2 && normals[both[0]].dot(normals[both[1]]) > least_cosine_in_patch)
      patch[root(both[0])] = root(both[1]);
  for (size_t f = 0; f < patch.size(); ++f) patch[f] = root(static_cast<int>(f));
  return patch;
}

}  // namespace dygita

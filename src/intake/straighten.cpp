#include "intake/straighten.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "mesh/jacobian.hpp"
#include "mesh/raise_order.hpp"

namespace dygita {

namespace {

constexpr double smallest_ratio = 0.1;
constexpr int most_rounds = 10;

using Nodes = std::unordered_map<size_t, Vec3>;

Points places(const Nodes& nodes, const size_t* cell, int n) {
  Points x(3, n);
  for (int a = 0; a < n; ++a) x.col(a) = nodes.at(cell[a]);
  return x;
}

// The cell with every further node in the middle of its corners.
Points straight(const Points& curved, int n_corners, const std::vector<std::vector<int>>& middles) {
  Points x = curved;
  for (size_t m = 0; m < middles.size(); ++m)
    x.col(n_corners + static_cast<Eigen::Index>(m)) = curved(Eigen::all, middles[m]).rowwise().mean();
  return x;
}

// A cell whose Jacobians, or those of the straight one, are of the wrong sign throughout has its nodes the other way
// round: both are compared in absolute terms.
bool is_tangled(CellType type, const Points& curved, const Points& straight) {
  const double sign = cell_volume(type, straight) < 0.0 ? -1.0 : 1.0;
  const Vec own = sign * sampled_jacobians(type, curved), of_straight = sign * sampled_jacobians(type, straight);
  return ((own - smallest_ratio * of_straight).array() < 0.0).any();
}

double volume_of(const TaggedVolume& volume, const Nodes& nodes) {
  double sum = 0.0;
  for (const auto& [type, cells] : volume.cells) {
    const int n = nodes_per_cell(type);
    for (size_t first = 0; first < cells.size(); first += static_cast<size_t>(n))
      sum += std::abs(cell_volume(type, places(nodes, &cells[first], n)));
  }
  return sum;
}

}  // namespace

std::string text_of(const Straightened& one, const std::string& file) {
  return fmt::format(
      "{}: {} of {} curved cells of volume '{}' were inverted and now have straight edges; its volume changes by "
      "{:.2g} "
      "%; smaller cells on curved surfaces reduce their number",
      file, one.n_cells, one.n_curved, one.volume, 100.0 * one.volume_change);
}

std::vector<Straightened> straighten(TaggedModel& model) {
  struct Done {
    std::unordered_set<size_t> cells;  // by the position of their first node
  };
  std::vector<std::map<CellType, Done>> done(model.volumes.size());
  std::vector<double> before;
  for (const TaggedVolume& volume : model.volumes) before.push_back(volume_of(volume, model.nodes));
  bool has_changed = true;
  for (int round = 0; round < most_rounds && has_changed; ++round) {
    has_changed = false;
    for (size_t v = 0; v < model.volumes.size(); ++v)
      for (const auto& [type, cells] : model.volumes[v].cells) {
        const CellShape& row = cell_shape(type);
        const int n = nodes_per_cell(type);
        if (n == row.n_corners) continue;
        const std::vector<std::vector<int>> middles = middle_corners(type);
        for (size_t first = 0; first < cells.size(); first += static_cast<size_t>(n)) {
          const Points x = places(model.nodes, &cells[first], n), chords = straight(x, row.n_corners, middles);
          if (!is_tangled(type, x, chords)) continue;
          for (int a = row.n_corners; a < n; ++a) model.nodes[cells[first + static_cast<size_t>(a)]] = chords.col(a);
          done[v][type].cells.insert(first);
          has_changed = true;
        }
      }
  }
  std::vector<Straightened> all;
  for (size_t v = 0; v < model.volumes.size(); ++v) {
    Straightened one{model.volumes[v].name};
    for (const auto& [type, cells] : model.volumes[v].cells)
      if (nodes_per_cell(type) > cell_shape(type).n_corners)
        one.n_curved += static_cast<int>(cells.size()) / nodes_per_cell(type);
    for (const auto& [type, cells] : done[v]) one.n_cells += static_cast<int>(cells.cells.size());
    if (one.n_cells == 0) continue;
    one.volume_change = volume_of(model.volumes[v], model.nodes) / before[v] - 1.0;
    all.push_back(one);
  }
  return all;
}

}  // namespace dygita

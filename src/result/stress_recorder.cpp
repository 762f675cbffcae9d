#include "result/stress_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/assembly.hpp"

namespace dygita {

namespace {

// Evenly over the step, its last increment always.
bool is_sampled(const Instant& instant) {
  const long n = instant.model.step->n_increments(), i = instant.increment + 1;
  const long samples = std::min<long>(n, stress_instants);
  return instant.is_static() || (i * samples) / n != ((i - 1) * samples) / n;
}

}  // namespace

StressRecorder::StressRecorder(const Problem& problem) : problem_(problem) {
  for (size_t i = 0; i < problem.substructures.size(); ++i) {
    const Substructure& part = *problem.substructures[i];
    if (!part.yield) continue;
    Watched& watched = watched_.emplace_back();
    watched.peak.part = static_cast<int>(i);
    watched.peak.yield = *part.yield;
    watched.volumes = nodal_volumes(*part.mesh);
    watched.largest = Vec::Zero(part.mesh->n_nodes());
  }
}

void StressRecorder::accept(const Instant& instant) {
  if (watched_.empty()) return;
  const bool looks_at_all = is_sampled(instant);
  for (Watched& watched : watched_) looks_at_all ? look_at_all(instant, watched) : look_at_hot(instant, watched);
}

std::vector<PartStress> StressRecorder::take() {
  std::vector<PartStress> peaks;
  for (const Watched& watched : watched_) peaks.push_back(watched.peak);
  return peaks;
}

void StressRecorder::meet(const Instant& instant, double stress, int node, Watched& watched) const {
  // What is not a number stays: a margin must not look fine because its stress was lost.
  if (std::isnan(watched.peak.von_mises) || stress <= watched.peak.von_mises) return;
  const Substructure& part = *problem_.substructures[watched.peak.part];
  watched.peak.von_mises = stress;
  watched.peak.time = instant.time();
  watched.peak.step = instant.i_step;
  watched.peak.place = part.mesh->nodes.col(node) + part.place;
}

void StressRecorder::look_at_all(const Instant& instant, Watched& watched) {
  const Substructure& part = *problem_.substructures[watched.peak.part];
  const Vec stress = von_mises(nodal_stress(*part.mesh, part.material, instant.displacement(watched.peak.part)));
  double above = 0.0;
  for (int i = 0; i < static_cast<int>(stress.size()); ++i) {
    meet(instant, stress[i], i, watched);
    if (stress[i] > watched.peak.yield) above += watched.volumes[i];
  }
  watched.peak.above = std::max(watched.peak.above, above / watched.volumes.sum());
  watched.largest = watched.largest.cwiseMax(stress);
  if (!instant.is_static()) follow(*part.mesh, watched);
}

void StressRecorder::look_at_hot(const Instant& instant, Watched& watched) {
  const Substructure& part = *problem_.substructures[watched.peak.part];
  if (watched.hot.empty()) {  // nothing is known yet of where to look
    look_at_all(instant, watched);
    return;
  }
  const Points all = instant.displacement(watched.peak.part);
  const Points own = all(Eigen::all, watched.node);
  const Vec stress = von_mises(nodal_stress(watched.around, part.material, own));
  for (const int i : watched.hot) meet(instant, stress[i], watched.node[i], watched);
}

// The cells that touch the most stressed nodes: a node's stress is the mean of all cells around it.
void StressRecorder::follow(const Mesh& mesh, Watched& watched) {
  std::vector<int> order(static_cast<size_t>(mesh.n_nodes()));
  std::iota(order.begin(), order.end(), 0);
  const auto n_hot = std::min<std::ptrdiff_t>(most_hot_nodes, static_cast<std::ptrdiff_t>(order.size()));
  std::nth_element(order.begin(), order.begin() + (n_hot - 1), order.end(),
                   [&](int a, int b) { return watched.largest[a] > watched.largest[b]; });
  std::vector<char> is_hot(order.size(), 0);
  for (std::ptrdiff_t i = 0; i < n_hot; ++i) is_hot[static_cast<size_t>(order[i])] = 1;
  std::vector<int> number(order.size(), -1);
  watched.node.clear();
  watched.hot.clear();
  watched.around.blocks.clear();
  for (const CellBlock& block : mesh.blocks) {
    CellBlock& some = watched.around.blocks.emplace_back(CellBlock{block.type, {}});
    const int n = nodes_per_cell(block.type);
    for (int c = 0; c < block.n_cells(); ++c) {
      const int* cell = block.cell(c);
      if (std::none_of(cell, cell + n, [&](int node) { return is_hot[static_cast<size_t>(node)] != 0; })) continue;
      for (int a = 0; a < n; ++a) {
        int& own = number[static_cast<size_t>(cell[a])];
        if (own < 0) {
          own = static_cast<int>(watched.node.size());
          watched.node.push_back(cell[a]);
          if (is_hot[static_cast<size_t>(cell[a])]) watched.hot.push_back(own);
        }
        some.nodes.push_back(own);
      }
    }
  }
  watched.around.nodes = mesh.nodes(Eigen::all, watched.node);
}

}  // namespace dygita

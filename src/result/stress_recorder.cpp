#include "result/stress_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
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
  }
}

void StressRecorder::prepare(const Instant& instant) {
  cut_ = instant.model.cut;
  std::vector<std::vector<int>> nodes(problem_.substructures.size());
  for (Watched& watched : watched_) {
    std::vector<int>& all = nodes[static_cast<size_t>(watched.peak.part)];
    all.resize(static_cast<size_t>(mesh_of(watched).n_nodes()));
    std::iota(all.begin(), all.end(), 0);
    if (!is_watched_here(*cut_, watched.peak.part)) continue;
    watched.volumes = nodal_volumes(mesh_of(watched));
    watched.largest = Vec::Zero(mesh_of(watched).n_nodes());
  }
  all_ = WatchedNodes(*cut_, std::move(nodes));
}

// As long as nothing is known of where to look, everywhere.
void StressRecorder::accept(const Instant& instant) {
  if (watched_.empty()) return;
  if (!cut_) prepare(instant);
  const bool looks_at_all = is_sampled(instant) || !has_hot_;
  (looks_at_all ? all_ : hot_).take(instant);
  for (Watched& watched : watched_) {
    if (!is_watched_here(*cut_, watched.peak.part)) continue;
    looks_at_all ? look_at_all(instant, watched) : look_at_hot(instant, watched);
  }
  if (looks_at_all && !instant.is_static()) follow();
}

void StressRecorder::settle() {
  if (ranks::is_alone() || !cut_) return;
  constexpr int n = 7;
  std::vector<int> n_of(problem_.substructures.size(), 0);
  for (const Watched& watched : watched_) n_of[static_cast<size_t>(watched.peak.part)] = n;
  const std::vector<double> all = of_all_parts(*cut_, n_of, [&](int part, double* to) {
    for (const Watched& watched : watched_) {
      if (watched.peak.part != part) continue;
      const PartStress& own = watched.peak;
      const double numbers[n] = {own.von_mises, own.time, static_cast<double>(own.step), own.place[0], own.place[1],
                                 own.place[2],  own.above};
      std::copy_n(numbers, n, to);
    }
  });
  const double* of = all.data();
  for (Watched& watched : watched_) {
    PartStress& peak = watched.peak;
    peak.von_mises = of[0], peak.time = of[1], peak.step = static_cast<int>(of[2]), peak.place = {of[3], of[4], of[5]};
    peak.above = of[6];
    of += n;
  }
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
  const Vec stress = von_mises(nodal_stress(*part.mesh, part.material, all_.displacement(watched.peak.part)));
  double above = 0.0;
  for (int i = 0; i < static_cast<int>(stress.size()); ++i) {
    meet(instant, stress[i], i, watched);
    if (stress[i] > watched.peak.yield) above += watched.volumes[i];
  }
  watched.peak.above = std::max(watched.peak.above, above / watched.volumes.sum());
  watched.largest = watched.largest.cwiseMax(stress);
}

void StressRecorder::look_at_hot(const Instant& instant, Watched& watched) {
  const Elastic& material = problem_.substructures[watched.peak.part]->material;
  const Vec stress = von_mises(nodal_stress(watched.around, material, hot_.displacement(watched.peak.part)));
  for (const int i : watched.hot) meet(instant, stress[i], watched.node[i], watched);
}

// The cells that touch the most stressed nodes: a node's stress is the mean of all cells around it. Of parts on several
// ranks all need to know which these are.
void StressRecorder::follow() {
  std::vector<int> n_shared(problem_.substructures.size(), 0);
  for (const Watched& watched : watched_)
    if (!is_on_one_rank(*cut_, watched.peak.part))
      n_shared[static_cast<size_t>(watched.peak.part)] = std::min(most_hot_nodes, mesh_of(watched).n_nodes());
  std::map<int, Watched*> of_part;
  for (Watched& watched : watched_) of_part[watched.peak.part] = &watched;
  const std::vector<double> shared = of_all_parts(*cut_, n_shared, [&](int part, double* to) {
    if (n_shared[static_cast<size_t>(part)] == 0) return;
    const std::vector<int> hot = most_stressed(*of_part.at(part));
    std::copy(hot.begin(), hot.end(), to);
  });
  const double* next = shared.data();
  std::vector<std::vector<int>> nodes(problem_.substructures.size());
  for (Watched& watched : watched_) {
    const int part = watched.peak.part, n = n_shared[static_cast<size_t>(part)];
    if (n > 0)
      surround(mesh_of(watched), {next, next + n}, watched);
    else if (is_watched_here(*cut_, part))
      surround(mesh_of(watched), most_stressed(watched), watched);
    next += n;
    nodes[static_cast<size_t>(part)] = watched.node;
  }
  hot_ = WatchedNodes(*cut_, std::move(nodes));
  has_hot_ = true;
}

std::vector<int> StressRecorder::most_stressed(const Watched& watched) {
  std::vector<int> order(static_cast<size_t>(watched.largest.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto n_hot = std::min<std::ptrdiff_t>(most_hot_nodes, static_cast<std::ptrdiff_t>(order.size()));
  std::nth_element(order.begin(), order.begin() + (n_hot - 1), order.end(),
                   [&](int a, int b) { return watched.largest[a] > watched.largest[b]; });
  order.resize(static_cast<size_t>(n_hot));
  return order;
}

void StressRecorder::surround(const Mesh& mesh, const std::vector<int>& hot, Watched& watched) {
  std::vector<char> is_hot(static_cast<size_t>(mesh.n_nodes()), 0);
  for (const int node : hot) is_hot[static_cast<size_t>(node)] = 1;
  const auto touches = [&](const int* cell, int n) {
    return std::any_of(cell, cell + n, [&](int node) { return is_hot[static_cast<size_t>(node)] != 0; });
  };
  std::vector<int> number(is_hot.size(), -1);
  for (const CellBlock& block : mesh.blocks) {
    const int n = nodes_per_cell(block.type);
    for (int c = 0; c < block.n_cells(); ++c)
      if (touches(block.cell(c), n))
        for (int a = 0; a < n; ++a) number[static_cast<size_t>(block.cell(c)[a])] = 0;
  }
  watched.node.clear();
  watched.hot.clear();
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    if (number[static_cast<size_t>(node)] < 0) continue;
    number[static_cast<size_t>(node)] = static_cast<int>(watched.node.size());
    if (is_hot[static_cast<size_t>(node)]) watched.hot.push_back(static_cast<int>(watched.node.size()));
    watched.node.push_back(node);
  }
  watched.around.blocks.clear();
  for (const CellBlock& block : mesh.blocks) {
    CellBlock& some = watched.around.blocks.emplace_back(CellBlock{block.type, {}});
    const int n = nodes_per_cell(block.type);
    for (int c = 0; c < block.n_cells(); ++c)
      if (touches(block.cell(c), n))
        for (int a = 0; a < n; ++a) some.nodes.push_back(number[static_cast<size_t>(block.cell(c)[a])]);
  }
  watched.around.nodes = mesh.nodes(Eigen::all, watched.node);
}

}  // namespace dygita

#include "result/skin_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "fem/assembly.hpp"

namespace dygita {

namespace {

constexpr int most_frames = 20, fewest_frames = 6;
constexpr double most_bytes = 64e6;

std::vector<int> boundary_nodes(const Mesh& mesh) {
  std::vector<int> nodes;
  for (const Facet& facet : boundary_facets(mesh.blocks))
    nodes.insert(nodes.end(), facet.nodes().begin(), facet.nodes().end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// Of `n` in a row, `kept` evenly, the last one always.
bool is_kept(int i, int n, int kept) { return kept >= n || (long{i} + 1) * kept / n != long{i} * kept / n; }

}  // namespace

std::vector<int> shared_out(const std::vector<bool>& is_static, int n_frames) {
  const int n = static_cast<int>(is_static.size());
  const int n_static = static_cast<int>(std::count(is_static.begin(), is_static.end(), true)), n_dynamic = n - n_static;
  // A third at most goes to static steps where something moves.
  const int for_static = n_dynamic > 0 ? std::min(n_static, std::max(1, n_frames / 3)) : n_frames;
  const int for_dynamic = n_dynamic > 0 ? n_frames - std::min(n_static, for_static) : 0;
  std::vector<int> samples;
  int i_static = 0, i_dynamic = 0;
  for (const bool still : is_static) {
    const int i = still ? i_static++ : i_dynamic++, of = still ? n_static : n_dynamic,
              frames = still ? for_static : for_dynamic;
    samples.push_back(frames >= of ? frames / of : is_kept(i, of, frames));
  }
  return samples;
}

void SkinRecorder::prepare(const Instant& instant) {
  cut_ = instant.model.cut;
  double n_nodes = 1.0;
  std::vector<std::vector<int>> of_layers;
  for (size_t i = 0; i < problem_.substructures.size(); ++i) {
    const Mesh& mesh = *problem_.substructures[i]->mesh;
    const int part = static_cast<int>(i);
    motion_.nodes.push_back(boundary_nodes(mesh));
    const bool is_needed = is_watched_here(*cut_, part) || !is_on_one_rank(*cut_, part);
    layers_.push_back(is_needed ? layer_of(mesh, motion_.nodes.back()) : Layer{});
    of_layers.push_back(layers_.back().node_of);
    n_nodes += static_cast<double>(motion_.nodes.back().size());
  }
  nodes_ = WatchedNodes(*cut_, std::move(of_layers));
  const double affordable = std::floor(most_bytes / (4.0 * sizeof(float) * n_nodes));
  std::vector<bool> is_static;
  for (const StepPtr& step : problem_.steps) is_static.push_back(step->is_static);
  samples_ = shared_out(is_static, static_cast<int>(std::clamp<double>(affordable, fewest_frames, most_frames)));
}

SkinRecorder::Layer SkinRecorder::layer_of(const Mesh& mesh, const std::vector<int>& boundary) {
  Layer layer;
  std::vector<char> is_boundary(static_cast<size_t>(mesh.n_nodes()), 0);
  for (const int node : boundary) is_boundary[node] = 1;
  std::vector<int> number(static_cast<size_t>(mesh.n_nodes()), -1);
  for (const CellBlock& block : mesh.blocks) {
    CellBlock& kept = layer.mesh.blocks.emplace_back(CellBlock{block.type, {}});
    const int n = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      const int* cell = block.cell(i);
      if (std::none_of(cell, cell + n, [&](int node) { return is_boundary[node]; })) continue;
      for (int a = 0; a < n; ++a) {
        int& to = number[cell[a]];
        if (to < 0) {
          to = static_cast<int>(layer.node_of.size());
          layer.node_of.push_back(cell[a]);
        }
        kept.nodes.push_back(to);
      }
    }
  }
  std::erase_if(layer.mesh.blocks, [](const CellBlock& block) { return block.nodes.empty(); });
  layer.mesh.nodes = mesh.nodes(Eigen::all, layer.node_of);
  for (const int node : boundary) layer.boundary.push_back(number[node]);
  return layer;
}

// displacement: of the layer's nodes.
SkinRecorder::PartFrame SkinRecorder::drawn(int part, const Points& displacement) const {
  const Layer& layer = layers_[static_cast<size_t>(part)];
  const Elastic& material = problem_.substructures[static_cast<size_t>(part)]->material;
  const Vec stress = von_mises(nodal_stress(layer.mesh, material, displacement));
  PartFrame frame;
  for (const int node : layer.boundary) {
    for (int d = 0; d < 3; ++d) frame.displacement.push_back(static_cast<float>(displacement(d, node)));
    frame.von_mises.push_back(static_cast<float>(stress[node]));
  }
  return frame;
}

void SkinRecorder::accept(const Instant& instant) {
  if (!cut_) prepare(instant);
  missed_ += !instant.converged;
  const int n = instant.model.step->n_increments(), samples = std::min(n, samples_[instant.i_step]);
  if (samples == 0 || !is_kept(instant.increment, n, samples)) return;
  motion_.frames.push_back(
      {instant.model.step->name, instant.i_step, instant.is_static(), instant.time(), {}, {}, missed_});
  nodes_.take(instant);
  std::vector<PartFrame>& frame = drawn_.emplace_back(layers_.size());
  parallel_for(static_cast<int>(frame.size()), [&](int part) {
    if (is_watched_here(*cut_, part)) frame[static_cast<size_t>(part)] = drawn(part, nodes_.displacement(part));
  });
}

void SkinRecorder::add(const AssemblyScene& scene) {
  SkinFrame frame{scene.step, 0, scene.is_static, scene.time, {}, {}, scene.missed};
  for (size_t i = 0; i < problem_.steps.size(); ++i)
    if (problem_.steps[i]->name == scene.step) frame.i_step = static_cast<int>(i);
  const auto place = [](const SkinFrame& a, const SkinFrame& b) {
    return std::pair(a.i_step, a.time) < std::pair(b.i_step, b.time);
  };
  const auto at = std::upper_bound(motion_.frames.begin(), motion_.frames.end(), frame, place);
  // A static step is told by its last increment, which samples always hold.
  if (at != motion_.frames.begin()) {
    const SkinFrame& before = *std::prev(at);
    if (before.i_step == frame.i_step && (frame.is_static || before.time == frame.time)) return;
  }
  std::vector<PartFrame> parts(layers_.size());
  for (size_t i = 0; i < parts.size(); ++i)
    if (is_watched_here(*cut_, static_cast<int>(i)))
      parts[i] = drawn(static_cast<int>(i), scene.displacement[i](Eigen::all, layers_[i].node_of));
  drawn_.insert(drawn_.begin() + (at - motion_.frames.begin()), std::move(parts));
  motion_.frames.insert(at, std::move(frame));
}

SkinMotion SkinRecorder::take() {
  const auto append = [](const std::vector<double>& values, std::vector<float>& to) {
    to.insert(to.end(), values.begin(), values.end());
  };
  for (size_t k = 0; k < drawn_.size(); ++k)
    for (size_t i = 0; i < layers_.size(); ++i) {
      const PartFrame& own = drawn_[k][i];
      const int watcher = watcher_of(*cut_, static_cast<int>(i));
      append(ranks::to_first(watcher, {own.displacement.begin(), own.displacement.end()}),
             motion_.frames[k].displacement);
      append(ranks::to_first(watcher, {own.von_mises.begin(), own.von_mises.end()}), motion_.frames[k].von_mises);
    }
  return std::move(motion_);
}

}  // namespace dygita

#include "watch/skin_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "fem/assembly.hpp"
#include "watch/growth.hpp"

namespace dygita {

namespace {

constexpr int most_frames = 20, fewest_frames = 6;
constexpr double most_bytes = 64e6;

std::vector<int> boundary_nodes(const Mesh& mesh) {
  std::vector<int> nodes;
  for (const Facet& facet : boundary_facets(mesh))
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
  is_ready_ = true;
  views_.prepare(instant.model.cut);
  double n_nodes = 1.0;
  const size_t n_parts = problem_.substructures.size();
  std::vector<std::vector<int>> of_layers(n_parts);
  motion_.nodes.resize(n_parts);
  layers_.resize(n_parts);
  parallel_for(static_cast<int>(n_parts), [&](int part) {
    const auto i = static_cast<size_t>(part);
    const PartView& view = views_.of(part);
    motion_.nodes[i] = boundary_nodes(*problem_.substructures[i]->mesh);
    if (!view.is_empty()) layers_[i] = layer_of(view, motion_.nodes[i]);
    for (const int node : layers_[i].in_view) of_layers[i].push_back(view.node(node));
  });
  for (const std::vector<int>& nodes : motion_.nodes) n_nodes += static_cast<double>(nodes.size());
  nodes_ = WatchedNodes(views_.cut(), std::move(of_layers));
  const double affordable = std::floor(most_bytes / (4.0 * sizeof(float) * n_nodes));
  std::vector<bool> is_static;
  for (const StepPtr& step : problem_.steps) is_static.push_back(step->is_static);
  samples_ = shared_out(is_static, static_cast<int>(std::clamp<double>(affordable, fewest_frames, most_frames)));
}

// boundary: of the part, increasing.
SkinRecorder::Layer SkinRecorder::layer_of(const PartView& view, const std::vector<int>& boundary) {
  Layer layer;
  const Mesh& mesh = view.mesh();
  if (!mesh.has_cells()) {  // never cut: its nodes as they are
    auto some = std::make_shared<Mesh>();
    some->nodes = mesh.nodes(Eigen::all, boundary);
    layer.mesh = some;
    layer.in_view = boundary;
    for (size_t i = 0; i < boundary.size(); ++i) layer.boundary.push_back(static_cast<int>(i));
    return layer;
  }
  std::vector<char> is_boundary(static_cast<size_t>(mesh.n_nodes()), 0);
  for (int i = 0; i < mesh.n_nodes(); ++i)
    is_boundary[static_cast<size_t>(i)] =
        view.owner(i) >= 0 && std::binary_search(boundary.begin(), boundary.end(), view.node(i));
  std::vector<std::vector<char>> is_kept;
  for (const CellBlock& block : mesh.blocks) {
    std::vector<char>& kept = is_kept.emplace_back();
    const int n = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i)
      kept.push_back(std::any_of(block.cell(i), block.cell(i) + n,
                                 [&](int node) { return is_boundary[static_cast<size_t>(node)] != 0; }));
  }
  std::tie(layer.mesh, layer.in_view) = some_cells(mesh, is_kept);
  for (size_t i = 0; i < layer.in_view.size(); ++i)
    if (is_boundary[static_cast<size_t>(layer.in_view[i])]) layer.boundary.push_back(static_cast<int>(i));
  return layer;
}

// displacement: of the layer's nodes.
SkinRecorder::PartFrame SkinRecorder::drawn(int part, const Points& displacement, double growth) const {
  const Layer& layer = layers_[static_cast<size_t>(part)];
  const Elastic& material = problem_.substructures[static_cast<size_t>(part)]->material;
  const Vec stress =
      von_mises(nodal_stress(*layer.mesh, material, without_growth(displacement, growth, layer.mesh->nodes)));
  PartFrame frame;
  for (const int node : layer.boundary) {
    for (int d = 0; d < 3; ++d) frame.displacement.push_back(static_cast<float>(displacement(d, node)));
    frame.von_mises.push_back(static_cast<float>(stress[node]));
  }
  return frame;
}

void SkinRecorder::accept(const Instant& instant) {
  if (!is_ready_) prepare(instant);
  missed_ += !instant.converged;
  const int n = instant.model.step->n_increments(), samples = std::min(n, samples_[instant.i_step]);
  if (samples == 0 || !is_kept(instant.increment, n, samples)) return;
  motion_.frames.push_back(
      {instant.model.step->name, instant.i_step, instant.is_static(), instant.time(), {}, {}, missed_});
  nodes_.take(instant);
  std::vector<PartFrame>& frame = drawn_.emplace_back(layers_.size());
  parallel_for(static_cast<int>(frame.size()), [&](int part) {
    if (layers_[static_cast<size_t>(part)].mesh)
      frame[static_cast<size_t>(part)] = drawn(part, nodes_.displacement(part), growth_at(instant, part));
  });
}

void SkinRecorder::add(const AssemblyScene& scene, const std::vector<double>& growth) {
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
  parallel_for(static_cast<int>(parts.size()), [&](int part) {
    const auto i = static_cast<size_t>(part);
    if (layers_[i].mesh) parts[i] = drawn(part, scene.displacement[i](Eigen::all, layers_[i].in_view), growth[i]);
  });
  drawn_.insert(drawn_.begin() + (at - motion_.frames.begin()), std::move(parts));
  motion_.frames.insert(at, std::move(frame));
}

SkinMotion SkinRecorder::take() {
  for (size_t k = 0; k < drawn_.size(); ++k)
    for (size_t i = 0; i < layers_.size(); ++i) append(static_cast<int>(i), drawn_[k][i], motion_.frames[k]);
  return std::move(motion_);
}

// On rank 0 that of all ranks, each of which has some of the part's boundary nodes.
void SkinRecorder::append(int part, const PartFrame& own, SkinFrame& frame) const {
  const Cut& cut = views_.cut();
  const std::vector<int>& boundary = motion_.nodes[static_cast<size_t>(part)];
  const size_t first = frame.von_mises.size();
  frame.von_mises.resize(first + boundary.size());
  frame.displacement.resize(3 * frame.von_mises.size());
  for (const int rank : ranks_of(cut, part)) {
    const std::vector<double> moved = ranks::to_first(rank, {own.displacement.begin(), own.displacement.end()}),
                              loaded = ranks::to_first(rank, {own.von_mises.begin(), own.von_mises.end()});
    if (!ranks::is_first()) continue;
    size_t k = 0;
    for (size_t i = 0; i < boundary.size(); ++i) {
      if (cut.piece(cut.owner(part, boundary[i]).piece).rank != rank) continue;
      for (size_t d = 0; d < 3; ++d) frame.displacement[3 * (first + i) + d] = static_cast<float>(moved[3 * k + d]);
      frame.von_mises[first + i] = static_cast<float>(loaded[k++]);
    }
  }
}

}  // namespace dygita

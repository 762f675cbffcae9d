#include "watch/stress_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "fem/assembly.hpp"
#include "watch/growth.hpp"

namespace dygita {

namespace {

// Evenly over the step, its last increment always.
bool is_sampled(const Instant& instant) {
  const long n = instant.model.step->n_increments(), i = instant.increment + 1;
  const long samples = std::min<long>(n, stress_instants);
  return instant.is_static() || (i * samples) / n != ((i - 1) * samples) / n;
}

// Of each rank that has pieces of a part n numbers, known on all. fill(to): writes those of this rank, if it has some.
template <class Fill>
std::vector<double> of_ranks(const std::vector<int>& ranks, int n, Fill&& fill) {
  std::vector<double> values(ranks.size() * static_cast<size_t>(n), 0.0);
  std::vector<int> offset{0};
  for (size_t i = 0; i < ranks.size(); ++i) {
    if (ranks[i] == ranks::me()) fill(values.data() + offset.back());
    offset.push_back(offset.back() + n);
  }
  ranks::Segments(ranks, offset).complete(values.data());
  return values;
}

}  // namespace

StressRecorder::StressRecorder(const Problem& problem, PartViews& views) : problem_(problem), views_(views) {
  for (size_t i = 0; i < problem.substructures.size(); ++i) {
    const Substructure& part = *problem.substructures[i];
    if (!part.yield && !part.material.has_strength()) continue;
    Watched& watched = watched_.emplace_back();
    watched.peak.part = static_cast<int>(i);
    watched.peak.is_index = !part.yield;
    watched.peak.allowed = part.yield.value_or(1.0);
  }
}

void StressRecorder::prepare(const Instant& instant) {
  is_ready_ = true;
  views_.prepare(instant.model.cut);
  for (Watched& watched : watched_) {
    if (view_of(watched).is_empty()) continue;
    watched.volumes = nodal_volumes(view_of(watched).mesh());
    watched.largest = Vec::Zero(watched.volumes.size());
    watched.above.resize(view_of(watched).pieces().size());
  }
}

// As long as nothing is known of where to look, everywhere.
void StressRecorder::accept(const Instant& instant) {
  if (watched_.empty()) return;
  if (!is_ready_) prepare(instant);
  const bool looks_at_all = is_sampled(instant) || !has_hot_;
  if (looks_at_all)
    views_.take(instant);
  else
    hot_.take(instant);
  double used = 0.0;
  for (Watched& watched : watched_) {
    if (view_of(watched).is_empty()) continue;
    if (looks_at_all)
      used = std::max(used, look_at_all(instant, watched));
    else
      look_at_hot(instant, watched);
  }
  if (looks_at_all) used = ranks::largest(used);
  is_nearest_ = used > used_;
  used_ = std::max(used, used_);
  ++n_looks_;
  n_at_all_ += looks_at_all;
  if (looks_at_all && !instant.is_static()) follow();
}

void StressRecorder::settle() {
  if (!is_ready_) return;
  for (Watched& watched : watched_) {
    settle_peak(watched);
    settle_above(watched);
  }
}

// What is not a number comes before all else, then the largest, of equal ones the first.
void StressRecorder::settle_peak(Watched& watched) const {
  constexpr int n = 10;
  const std::vector<double> all = of_ranks(ranks_of(views_.cut(), watched.peak.part), n, [&](double* to) {
    const PartStress& own = watched.peak;
    const double numbers[n] = {own.largest,
                               static_cast<double>(watched.met.look),
                               static_cast<double>(watched.met.node),
                               own.time,
                               static_cast<double>(own.step),
                               own.place[0],
                               own.place[1],
                               own.place[2],
                               static_cast<double>(own.ply),
                               static_cast<double>(watched.mode)};
    std::copy_n(numbers, n, to);
  });
  const double* worst = all.data();
  for (const double* of = all.data(); of < all.data() + all.size(); of += n) {
    const auto rank = [](const double* x) { return std::isnan(x[0]) ? std::numeric_limits<double>::infinity() : x[0]; };
    if (std::tuple(-rank(of), of[1], of[2]) < std::tuple(-rank(worst), worst[1], worst[2])) worst = of;
  }
  PartStress& peak = watched.peak;
  peak.largest = worst[0], peak.time = worst[3], peak.step = static_cast<int>(worst[4]);
  peak.place = {worst[5], worst[6], worst[7]};
  peak.ply = static_cast<int>(worst[8]);
  peak.mode = name_of(static_cast<FailureMode>(worst[9]));
}

// Volumes are added piece by piece, those of all nodes first.
void StressRecorder::settle_above(Watched& watched) const {
  const Cut& cut = views_.cut();
  const int part = watched.peak.part, n = 1 + n_at_all_, n_pieces = cut.n_pieces(part);
  std::vector<int> owner, offset{0};
  for (int i = 0; i < n_pieces; ++i) {
    owner.push_back(cut.piece(cut.first(part) + i).rank);
    offset.push_back(offset.back() + n);
  }
  std::vector<double> values(static_cast<size_t>(offset.back()), 0.0);
  const PartView& view = view_of(watched);
  for (size_t k = 0; k < view.pieces().size(); ++k) {
    std::vector<double> own;
    for (int i = 0; i < static_cast<int>(watched.volumes.size()); ++i)
      if (view.owner(i) == static_cast<int>(k)) own.push_back(watched.volumes[i]);
    double* to = values.data() + offset[static_cast<size_t>(view.pieces()[k] - cut.first(part))];
    *to = sum_of(own);
    std::copy(watched.above[k].begin(), watched.above[k].end(), to + 1);
  }
  ranks::Segments(owner, offset).complete(values.data());
  Vec sums = Vec::Zero(n);
  for (int i = 0; i < n_pieces; ++i) sums += Eigen::Map<const Vec>(values.data() + offset[static_cast<size_t>(i)], n);
  for (int look = 1; look < n; ++look) watched.peak.above = std::max(watched.peak.above, sums[look] / sums[0]);
}

int StressRecorder::nearest_to_limit() const {
  int part = -1;
  double used = 0.0;
  for (const Watched& watched : watched_) {
    if (!(watched.peak.largest / watched.peak.allowed > used)) continue;
    used = watched.peak.largest / watched.peak.allowed;
    part = watched.peak.part;
  }
  return part;
}

std::vector<PartStress> StressRecorder::take() {
  std::vector<PartStress> peaks;
  for (const Watched& watched : watched_) peaks.push_back(watched.peak);
  return peaks;
}

NodalFailure StressRecorder::measure(const Watched& watched, const Mesh& mesh, const Points& strained) const {
  const Elastic& material = problem_.substructures[static_cast<size_t>(watched.peak.part)]->material;
  if (watched.peak.is_index) return nodal_failure(mesh, material, strained);
  return {von_mises(nodal_stress(mesh, material, strained)), {}, {}};
}

void StressRecorder::meet(const Instant& instant, const NodalFailure& found, int at, int node, Watched& watched) const {
  // What is not a number stays: a margin must not look fine because its stress was lost.
  if (std::isnan(watched.peak.largest) || found.index[at] <= watched.peak.largest) return;
  const PartView& view = view_of(watched);
  watched.peak.largest = found.index[at];
  if (!found.ply.empty()) watched.peak.ply = found.ply[static_cast<size_t>(at)];
  if (!found.mode.empty()) watched.mode = found.mode[static_cast<size_t>(at)];
  watched.peak.time = instant.time();
  watched.peak.step = instant.i_step;
  watched.peak.place = view.mesh().nodes.col(node) + problem_.substructures[watched.peak.part]->place;
  watched.met = {n_looks_, view.node(node)};
}

double StressRecorder::look_at_all(const Instant& instant, Watched& watched) {
  const PartView& view = view_of(watched);
  const Points strained =
      without_growth(views_.field(watched.peak.part), growth_at(instant, watched.peak.part), view.mesh().nodes);
  const NodalFailure found = measure(watched, view.mesh(), strained);
  const Vec& stress = found.index;
  for (std::vector<double>& above : watched.above) above.push_back(0.0);
  for (int i = 0; i < static_cast<int>(stress.size()); ++i) {
    const int owner = view.owner(i);
    if (owner < 0) continue;
    meet(instant, found, i, i, watched);
    if (stress[i] > watched.peak.allowed) watched.above[static_cast<size_t>(owner)].back() += watched.volumes[i];
  }
  watched.largest = watched.largest.cwiseMax(stress);
  return stress.size() > 0 ? stress.maxCoeff() / watched.peak.allowed : 0.0;
}

void StressRecorder::look_at_hot(const Instant& instant, Watched& watched) {
  const Points strained =
      without_growth(hot_.displacement(watched.peak.part), growth_at(instant, watched.peak.part), watched.around.nodes);
  const NodalFailure found = measure(watched, watched.around, strained);
  for (const int i : watched.hot) meet(instant, found, i, watched.node[i], watched);
}

// The cells that touch the most stressed nodes: a node's stress is the mean of all cells around it.
void StressRecorder::follow() {
  std::vector<std::vector<int>> nodes(problem_.substructures.size());
  for (Watched& watched : watched_) {
    const PartView& view = view_of(watched);
    const std::vector<int> hot = hottest_of_all(watched);
    if (view.is_empty()) continue;
    surround(view.mesh(), hot, watched);
    for (const int node : watched.node) nodes[static_cast<size_t>(watched.peak.part)].push_back(view.node(node));
  }
  hot_ = WatchedNodes(views_.cut(), std::move(nodes));
  has_hot_ = true;
}

// Of the nodes that are here; of those that are as stressed, the first.
std::vector<int> StressRecorder::most_stressed(const Watched& watched) const {
  const PartView& view = view_of(watched);
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(watched.largest.size()); ++i)
    if (view.owner(i) >= 0) order.push_back(i);
  const auto n_hot = std::min<std::ptrdiff_t>(most_hot_nodes, static_cast<std::ptrdiff_t>(order.size()));
  std::partial_sort(order.begin(), order.begin() + n_hot, order.end(), [&](int a, int b) {
    return std::pair(-watched.largest[a], a) < std::pair(-watched.largest[b], b);
  });
  order.resize(static_cast<size_t>(n_hot));
  return order;
}

// Those among them that are here.
std::vector<int> StressRecorder::hottest_of_all(const Watched& watched) const {
  const PartView& view = view_of(watched);
  std::vector<int> own = view.is_empty() ? std::vector<int>() : most_stressed(watched);
  const std::vector<int> ranks = ranks_of(views_.cut(), watched.peak.part);
  if (ranks.size() == 1) return own;
  const std::vector<double> all = of_ranks(ranks, 2 * most_hot_nodes, [&](double* to) {
    std::fill_n(to, 2 * most_hot_nodes, -1.0);
    for (const int i : own) *to++ = watched.largest[i], *to++ = static_cast<double>(view.node(i));
  });
  std::vector<std::pair<double, double>> order;
  for (size_t i = 0; i < all.size(); i += 2)
    if (all[i + 1] >= 0.0) order.emplace_back(-all[i], all[i + 1]);
  std::sort(order.begin(), order.end());
  if (order.size() <= static_cast<size_t>(most_hot_nodes)) return own;
  const std::pair<double, double> last = order[static_cast<size_t>(most_hot_nodes) - 1];
  std::erase_if(own, [&](int i) { return std::pair(-watched.largest[i], double(view.node(i))) > last; });
  return own;
}

void StressRecorder::surround(const Mesh& mesh, const std::vector<int>& hot, Watched& watched) {
  std::vector<char> is_hot(static_cast<size_t>(mesh.n_nodes()), 0);
  for (const int node : hot) is_hot[static_cast<size_t>(node)] = 1;
  std::vector<std::vector<char>> touches;
  for (const CellBlock& block : mesh.blocks) {
    std::vector<char>& of_block = touches.emplace_back();
    const int n = nodes_per_cell(block.type);
    for (int c = 0; c < block.n_cells(); ++c)
      of_block.push_back(std::any_of(block.cell(c), block.cell(c) + n,
                                     [&](int node) { return is_hot[static_cast<size_t>(node)] != 0; }));
  }
  MeshPtr around;
  std::tie(around, watched.node) = some_cells(mesh, touches);
  watched.around = *around;
  watched.hot.clear();
  for (size_t i = 0; i < watched.node.size(); ++i)
    if (is_hot[static_cast<size_t>(watched.node[i])]) watched.hot.push_back(static_cast<int>(i));
}

}  // namespace dygita

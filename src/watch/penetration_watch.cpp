#include "watch/penetration_watch.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "base/log.hpp"
#include "base/warnings.hpp"

namespace dygita {

namespace {

constexpr int looks = 100;               // a step, evenly
constexpr double smallest_depth = 1e-5;  // of the smaller part's size: deformation that no face can tell from rounding

bool is_looked_at(const Instant& instant) {
  const long n = instant.model.step->n_increments(), i = instant.increment + 1, k = std::min<long>(n, looks);
  return (i * k) / n != ((i - 1) * k) / n;
}

// In um where mm would be all zeros.
std::string length_text(double length) {
  return length < 1e-5 ? fmt::format("{:.3g} um", 1e6 * length) : fmt::format("{:.3g} mm", 1e3 * length);
}

}  // namespace

void PenetrationWatch::begin_step(const Instant& start) {
  if (std::exchange(has_begun_, true)) return;
  pairs_ = doubt_neighbours(problem_, *start.model.surfaces);
  tell_warnings();
  std::erase_if(pairs_, [](const Unjoined& pair) { return !pair.neighbours.are_near(); });
  deepest_.resize(pairs_.size());
  displacement_.resize(problem_.substructures.size());
  for (const Unjoined& pair : pairs_) {
    need(pair.neighbours.nodes_1, pair.part_1, pair.part_2);
    need(pair.neighbours.nodes_2, pair.part_2, pair.part_1);
  }
  for (auto& [part, nodes] : needed_) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    displacement_[static_cast<size_t>(part)].resize(3,
                                                    problem_.substructures[static_cast<size_t>(part)]->mesh->n_nodes());
  }
}

void PenetrationWatch::need(const std::vector<NearNode>& nodes, int part, int other) {
  for (const NearNode& near : nodes) {
    needed_[part].push_back(near.node);
    needed_[other].insert(needed_[other].end(), near.facet.nodes().begin(), near.facet.nodes().end());
  }
}

void PenetrationWatch::accept(const Instant& instant) {
  if (pairs_.empty() || !is_looked_at(instant)) return;
  for (const auto& [part, nodes] : needed_)
    displacement_[static_cast<size_t>(part)](Eigen::all, nodes) = instant.displacement(part, nodes);
  for (size_t p = 0; p < pairs_.size(); ++p) look(instant, p);
}

void PenetrationWatch::look(const Instant& instant, size_t pair) {
  const Unjoined& of = pairs_[pair];
  Deepest& deepest = deepest_[pair];
  const auto look_at = [&](const std::vector<NearNode>& nodes, int part, int other) {
    const Points &u = displacement_[static_cast<size_t>(part)], &v = displacement_[static_cast<size_t>(other)];
    for (const NearNode& near : nodes) {
      Vec3 apart = u.col(near.node);
      for (size_t a = 0; a < near.facet.nodes().size(); ++a) apart -= near.weights[a] * v.col(near.facet.nodes()[a]);
      const double depth = -near.gap - near.normal.dot(apart);
      if (depth <= deepest.depth) continue;
      deepest = {depth, &near, part, other, instant.model.step, instant.time()};
    }
  };
  look_at(of.neighbours.nodes_1, of.part_1, of.part_2);
  look_at(of.neighbours.nodes_2, of.part_2, of.part_1);
}

void PenetrationWatch::finish() const {
  std::vector<size_t> deep;
  for (size_t p = 0; p < pairs_.size(); ++p)
    if (deepest_[p].depth > smallest_depth * pairs_[p].size) deep.push_back(p);
  std::sort(deep.begin(), deep.end(), [&](size_t a, size_t b) { return deepest_[a].depth > deepest_[b].depth; });
  const size_t most_told = 3;
  for (size_t i = 0; i < std::min(deep.size(), most_told); ++i) warn(text_of(deep[i]));
  if (deep.size() <= most_told) return;
  std::string others;
  for (size_t i = most_told; i < deep.size(); ++i)
    others += fmt::format("{}'{}' and '{}' {}", i == most_told ? "" : ", ", name_of(pairs_[deep[i]].part_1),
                          name_of(pairs_[deep[i]].part_2), length_text(deepest_[deep[i]].depth));
  warn(fmt::format("{} more pairs overlap without an interface: {}", deep.size() - most_told, others));
}

const std::string& PenetrationWatch::name_of(int part) const {
  return problem_.substructures[static_cast<size_t>(part)]->name;
}

std::string PenetrationWatch::text_of(size_t pair) const {
  const Deepest& deepest = deepest_[pair];
  const Substructure& body = *problem_.substructures[static_cast<size_t>(deepest.part)];
  const Vec3 x = 1e3 * (body.mesh->nodes.col(deepest.at->node) + body.place);
  return fmt::format(
      "substructures '{}' and '{}' overlap by {} without an interface, at ({:.4g}, {:.4g}, {:.4g}) "
      "mm "
      "through {}, in step '{}'{}: an interface.contact would prevent this",
      name_of(pairs_[pair].part_1), name_of(pairs_[pair].part_2), length_text(deepest.depth), x[0], x[1], x[2],
      face_with(*problem_.substructures[static_cast<size_t>(deepest.other)], deepest.at->facet), deepest.step->name,
      deepest.step->is_static ? "" : fmt::format(" at {:.4g} ms", 1e3 * deepest.time));
}

}  // namespace dygita

#include "result/linked_parts.hpp"

#include <map>
#include <numeric>

#include "law/law.hpp"

namespace dygita {

LinkedParts::LinkedParts(const Problem& problem)
    : parent_(problem.substructures.size() + 1), n_groups_(static_cast<int>(parent_.size())) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int LinkedParts::root(int i) const {
  const auto above = [&](int j) -> int& { return parent_[static_cast<size_t>(j)]; };
  while (above(i) != i) i = above(i) = above(above(i));
  return i;
}

void LinkedParts::link(int i, int j) {
  i = root(i), j = root(j);
  if (i == j) return;
  parent_[static_cast<size_t>(i)] = j;
  --n_groups_;
}

void LinkedParts::begin_step(const Instant& start) {
  const StepModel& model = start.model;
  const int ground = static_cast<int>(parent_.size()) - 1;
  for (int part = 0; part < ground; ++part)
    if (!model.conditions.held[static_cast<size_t>(part)].empty()) link(part, ground);
  for (const SupportPtr& support : supports_of(*model.problem, *model.step))
    if (support->kind->absorbs())
      for (const FaceOrRegion& on : support->on)
        link(index_of(model.problem->substructures, std::get<Face>(on).part.get()), ground);
  find_forces(start);
}

void LinkedParts::accept(const Instant& instant) {
  if (!are_one()) find_forces(instant);
}

void LinkedParts::find_forces(const Instant& instant) {
  const std::vector<Surface>& surfaces = *instant.model.surfaces;
  const int ground = static_cast<int>(parent_.size()) - 1;
  const auto other = [&](const Surface& surface) { return surface.part_2 < 0 ? ground : surface.part_2; };
  std::vector<int> open;
  std::vector<double> forces;  // N, sums of magnitudes
  for (int s = 0; s < static_cast<int>(surfaces.size()); ++s) {
    const Surface& surface = surfaces[static_cast<size_t>(s)];
    if (root(surface.part_1) == root(other(surface))) continue;
    double force = 0.0;
    instant.for_each_point_here(s, [&](const LawState& point) { force += point.force.lpNorm<1>(); });
    open.push_back(s);
    forces.push_back(force);
  }
  if (open.empty()) return;
  if (!ranks::is_alone()) forces = ranks::sums(forces);
  for (size_t i = 0; i < open.size(); ++i) {
    const Surface& surface = surfaces[static_cast<size_t>(open[i])];
    if (forces[i] > 0.0) link(surface.part_1, other(surface));
  }
}

double LinkedParts::energy_as_wholes(const Instant& instant, std::span<const double> momenta, const Mat3& free) const {
  struct Group {
    Vec3 momentum = Vec3::Zero();
    double mass = 0.0;
  };
  std::map<int, Group> groups;
  const Cut& cut = *instant.model.cut;
  for (int i = 0; i < cut.n_pieces(); ++i) {
    Group& group = groups[root(cut.piece(i).part)];
    group.momentum += Eigen::Map<const Vec3>(momenta.data() + 3 * static_cast<size_t>(i));
    group.mass += instant.model.pieces[static_cast<size_t>(i)]->node_masses().sum();
  }
  const int held = root(static_cast<int>(parent_.size()) - 1);
  double energy = 0.0;
  for (auto& [at, group] : groups) {
    if (at == held) group.momentum = free * group.momentum;
    energy += 0.5 * group.momentum.squaredNorm() / group.mass;
  }
  return energy;
}

}  // namespace dygita

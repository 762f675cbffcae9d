#include "watch/linked_parts.hpp"

#include <algorithm>
#include <map>

#include "law/law.hpp"

namespace dygita {

LinkedParts::LinkedParts(const Problem& problem)
    : sets_(static_cast<int>(problem.substructures.size()) + 1),
      ground_(static_cast<int>(problem.substructures.size())) {}

void LinkedParts::link_held(const StepModel& model) {
  const auto holds = [](const auto& node) {
    const Held& held = node.second;
    for (int j = 0; j < held.n; ++j)
      if (held.is_held(j)) return true;
    return false;
  };
  for (int part = 0; part < ground_; ++part) {
    const Mesh& mesh = *model.problem->substructures[static_cast<size_t>(part)]->mesh;
    const auto& held = model.conditions.held[static_cast<size_t>(part)];
    if (std::any_of(held.begin(), held.end(), holds) || mesh.inside->resisted_motions(mesh.nodes).cols() > 0)
      sets_.join(part, ground_);
  }
  for (const SupportPtr& support : supports_of(*model.problem, *model.step))
    if (support->kind->absorbs())
      for (const FaceOrRegion& on : support->on)
        sets_.join(index_of(model.problem->substructures, std::get<Face>(on).part.get()), ground_);
}

void LinkedParts::begin_step(const Instant& start) {
  const StepModel& model = start.model;
  link_held(model);
  masses_.clear();
  for (const auto& piece : model.pieces) masses_.push_back(piece->mass());
  find_forces(start);
}

void LinkedParts::accept(const Instant& instant) {
  if (!are_one()) find_forces(instant);
}

int LinkedParts::other(const Surface& surface) const {
  return surface.part_2 >= 0 ? surface.part_2 : surface.is_on_ground ? ground_ : surface.part_1;
}

void LinkedParts::link_ties(const Instant& instant) {
  for (const Surface& surface : *instant.model.surfaces)
    if (const Shown shown = surface.declared_law().shown();
        !(shown.gap && shown.states) && takes_part(*instant.model.problem, *instant.model.step, surface))
      sets_.join(surface.part_1, other(surface));
}

std::vector<int> LinkedParts::let_go(const Instant& instant) {
  LinkedParts links(*instant.model.problem);
  links.link_held(instant.model);
  links.link_ties(instant);
  for (int part = 0; part < links.ground_; ++part)
    if (!instant.model.external_force(part, instant.state).isZero(0.0)) links.sets_.join(part, links.ground_);
  constexpr double left_by_iteration = 1e-6;  // of the largest force, on parts that nothing loads
  links.find_forces(instant, left_by_iteration);
  std::map<int, int> n_parts;
  for (int part = 0; part < links.ground_; ++part) ++n_parts[links.sets_.root(part)];
  int most = links.sets_.root(links.ground_);
  if (!n_parts.contains(most))
    most = std::max_element(n_parts.begin(), n_parts.end(), [](const auto& a, const auto& b) {
             return a.second < b.second;
           })->first;
  std::vector<int> parts;
  for (int part = 0; part < links.ground_; ++part)
    if (links.sets_.root(part) != most) parts.push_back(part);
  return parts;
}

// least: of the largest of these forces.
void LinkedParts::find_forces(const Instant& instant, double least) {
  const std::vector<Surface>& surfaces = *instant.model.surfaces;
  std::vector<int> open;
  std::vector<double> forces;  // N, sums of magnitudes
  for (int s = 0; s < static_cast<int>(surfaces.size()); ++s) {
    const Surface& surface = surfaces[static_cast<size_t>(s)];
    if (least == 0.0 && sets_.root(surface.part_1) == sets_.root(other(surface))) continue;
    double force = 0.0;
    instant.for_each_point_here(s, [&](int, const LawState& point) { force += point.force.lpNorm<1>(); });
    open.push_back(s);
    forces.push_back(force);
  }
  if (open.empty()) return;
  if (!ranks::is_alone()) forces = ranks::sums(forces);
  least *= *std::max_element(forces.begin(), forces.end());
  for (size_t i = 0; i < open.size(); ++i) {
    const Surface& surface = surfaces[static_cast<size_t>(open[i])];
    if (forces[i] > least) sets_.join(surface.part_1, other(surface));
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
    Group& group = groups[sets_.root(cut.piece(i).part)];
    group.momentum += Eigen::Map<const Vec3>(momenta.data() + 3 * static_cast<size_t>(i));
    group.mass += masses_[static_cast<size_t>(i)];
  }
  const int held = sets_.root(ground_);
  double energy = 0.0;
  for (auto& [at, group] : groups) {
    if (at == held) group.momentum = free * group.momentum;
    energy += 0.5 * group.momentum.squaredNorm() / group.mass;
  }
  return energy;
}

}  // namespace dygita

#include "watch/linked_parts.hpp"

#include <map>

#include "law/law.hpp"

namespace dygita {

LinkedParts::LinkedParts(const Problem& problem)
    : sets_(static_cast<int>(problem.substructures.size()) + 1),
      ground_(static_cast<int>(problem.substructures.size())) {}

void LinkedParts::begin_step(const Instant& start) {
  const StepModel& model = start.model;
  for (int part = 0; part < ground_; ++part)
    if (const Mesh& mesh = *model.problem->substructures[static_cast<size_t>(part)]->mesh;
        !model.conditions.held[static_cast<size_t>(part)].empty() ||
        mesh.inside->resisted_motions(mesh.nodes).cols() > 0)
      sets_.join(part, ground_);
  for (const SupportPtr& support : supports_of(*model.problem, *model.step))
    if (support->kind->absorbs())
      for (const FaceOrRegion& on : support->on)
        sets_.join(index_of(model.problem->substructures, std::get<Face>(on).part.get()), ground_);
  masses_.clear();
  for (const auto& piece : model.pieces) masses_.push_back(piece->mass());
  find_forces(start);
}

void LinkedParts::accept(const Instant& instant) {
  if (!are_one()) find_forces(instant);
}

void LinkedParts::find_forces(const Instant& instant) {
  const std::vector<Surface>& surfaces = *instant.model.surfaces;
  const auto other = [&](const Surface& surface) {
    return surface.part_2 >= 0 ? surface.part_2 : surface.is_on_ground ? ground_ : surface.part_1;
  };
  std::vector<int> open;
  std::vector<double> forces;  // N, sums of magnitudes
  for (int s = 0; s < static_cast<int>(surfaces.size()); ++s) {
    const Surface& surface = surfaces[static_cast<size_t>(s)];
    if (sets_.root(surface.part_1) == sets_.root(other(surface))) continue;
    double force = 0.0;
    instant.for_each_point_here(s, [&](int, const LawState& point) { force += point.force.lpNorm<1>(); });
    open.push_back(s);
    forces.push_back(force);
  }
  if (open.empty()) return;
  if (!ranks::is_alone()) forces = ranks::sums(forces);
  for (size_t i = 0; i < open.size(); ++i) {
    const Surface& surface = surfaces[static_cast<size_t>(open[i])];
    if (forces[i] > 0.0) sets_.join(surface.part_1, other(surface));
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

#include "run/part_lines.hpp"

#include <cmath>

#include "base/log.hpp"
#include "mesh/cell_quality.hpp"
#include "model/load.hpp"
#include "model/places.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

// How many of the six motions as a whole something inside resists.
std::string held_inside(Eigen::Index n) {
  return n == 0 ? ", free" : n == 6 ? ", held inside" : fmt::format(", held inside against {} of 6 rigid motions", n);
}

// "  substructure 'launcher': superelement of 312 rows, 100 points and 4 modes, to be used up to 30 kHz, 2.1 kg".
std::string condensed_line(const Substructure& part, const CondensedBody& body, const Vec3& size) {
  return fmt::format(
      "  substructure '{}': superelement of {} rows, {} points on {} faces{}{}, {:.4g} kg, {:.4g} x {:.4g} x "
      "{:.4g} mm\n",
      part.name, body.n_rows(), body.n_places(), part.mesh->faces.size() + part.mesh->point_groups.size(),
      body.valid_to > 0.0 ? fmt::format(", to be used up to {:.4g} Hz", body.valid_to) : "",
      held_inside(body.resisted_motions(part.mesh->nodes).cols()), body.mass_of_parts, size[0], size[1], size[2]);
}

// "    waves of 'ply' along axis 1: 9293, 1838, 1838 m/s; ...", of a material with directions.
std::string wave_lines(const Elastic& material) {
  if (material.is_isotropic()) return "";
  std::string text = fmt::format("    waves of '{}' along its axis", material.name);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 speeds = material.wave_speeds(Vec3::Unit(axis));
    text += fmt::format("{} {}: {:.0f}, {:.0f}, {:.0f} m/s", axis == 0 ? "" : ";", axis + 1, speeds[0], speeds[1],
                        speeds[2]);
  }
  return text +
         fmt::format("; of all directions {:.0f} to {:.0f} m/s\n", material.s_wave_speed(), material.p_wave_speed());
}

}  // namespace

std::string part_line(const Substructure& part) {
  const Points& nodes = part.mesh->nodes;
  const Vec3 size = 1e3 * (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff());
  if (const CondensedBody* own = part.mesh->inside->matrices()) return condensed_line(part, *own, size);
  return fmt::format(
             "  substructure '{}': {} nodes, {} cells (worst shape {:.2g}), {}, {:.4g} kg, {:.4g} x {:.4g} x {:.4g} "
             "mm\n",
             part.name, part.mesh->n_nodes(), part.mesh->n_cells(), worst_shape(*part.mesh), part.material.name,
             part.material.density * volume(*part.mesh), size[0], size[1], size[2]) +
         wave_lines(part.material);
}

std::string list_pieces(const Problem& problem, const std::vector<int>& pieces) {
  std::string list;
  for (size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i] > 1)
      list += fmt::format("{}'{}' {}", list.empty() ? "" : ", ", problem.substructures[i]->name, pieces[i]);
  return list;
}

void warn_of_uncut(const Problem& problem, const std::vector<int>& pieces) {
  std::vector<std::string> fewer;
  for (size_t i = 0; i < pieces.size(); ++i)
    if (problem.substructures[i]->mesh->has_cells() && pieces[i] < problem.solver.pieces)
      fewer.push_back(fmt::format("'{}' in {}", problem.substructures[i]->name, pieces[i]));
  if (fewer.empty() || problem.monolithic || problem.explicit_dynamics) return;
  constexpr size_t most_told = 5;
  std::string list;
  for (size_t i = 0; i < std::min(most_told, fewer.size()); ++i) list += (i > 0 ? ", " : "") + fewer[i];
  if (fewer.size() > most_told) list += fmt::format(" and {} more", fewer.size() - most_told);
  warn(fmt::format("solver.latin{{ pieces = {} }} leaves {}: {}", problem.solver.pieces, list,
                   problem.mass().is_moved_from_contact ? "mass that moves from contact nodes does not cross a cut"
                                                        : "a piece has 8 cells or more"));
}

std::string mass_line(const Problem& problem) {
  double mass = 0.0;
  const std::vector<double> volume = volumes(problem);
  for (size_t i = 0; i < volume.size(); ++i) mass += mass_of(*problem.substructures[i], volume[i]);
  return fmt::format("  {:.4g} kg in all\n", mass);
}

namespace {

// Of a base since the first step.
struct BaseJourney {
  Vec3 velocity = Vec3::Zero(), path = Vec3::Zero();  // m/s, m
  Vec3 gained = Vec3::Zero();                         // m/s, in dynamic steps
  double time = 0.0;                                  // s, of dynamic steps
  bool is_shaken = false;
};

// A base that is shaken no more keeps its velocity; a static step finds it at rest.
void go_on(const Support& support, const Step& step, BaseJourney& base) {
  if (step.is_static) {
    base.velocity.setZero();
    return;
  }
  constexpr int most = 20000;
  const int n = std::min(step.n_increments(), most);
  const double dt = step.duration / n;
  std::vector<const BaseMotion*> motions;
  std::vector<Effect> effects;
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects()) effects.push_back(effect);
  for (const Effect& effect : effects)
    if (const auto* motion = std::get_if<BaseMotion>(&effect); motion && motion->on.get() == &support)
      motions.push_back(motion);
  base.is_shaken |= !motions.empty();
  for (int i = 0; i < n; ++i) {
    Vec3 change = Vec3::Zero();
    for (const BaseMotion* motion : motions)
      change += motion->direction * motion->acceleration.integral(i * dt, (i + 1) * dt);
    base.path += dt * (base.velocity + 0.5 * change);
    base.velocity += change;
    base.gained += change;
  }
  base.time += step.duration;
}

}  // namespace

std::vector<std::string> base_lines(const Problem& problem) {
  std::vector<std::string> lines;
  for (const SupportPtr& support : all_supports(problem)) {
    BaseJourney base;
    for (const StepPtr& step : problem.steps) go_on(*support, *step, base);
    const Vec3 v = base.gained + Vec3::Zero(), u = 1e3 * base.path + Vec3::Zero();  // no "-0"
    if (base.is_shaken)
      lines.push_back(
          fmt::format("  base '{}': in the {:.4g} ms of the dynamic steps its velocity changes by ({:.3g}, {:.3g}, "
                      "{:.3g}) m/s, and its final displacement is ({:.3g}, {:.3g}, {:.3g}) mm",
                      support->name, 1e3 * base.time, v[0], v[1], v[2], u[0], u[1], u[2]));
  }
  return lines;
}

namespace {

// " in ply 3 (matrix in tension)".
std::string failing(const PartStress& peak) {
  return (peak.ply >= 0 ? fmt::format(" in ply {}", peak.ply + 1) : "") +
         (peak.mode.empty() ? "" : " (" + peak.mode + ")");
}

}  // namespace

void warn_of_stresses(const Problem& problem, const RunResult& result) {
  for (const PartStress& peak : result.stresses) {
    const Substructure& part = *problem.substructures[static_cast<size_t>(peak.part)];
    if (std::isnan(peak.largest))
      warn(fmt::format("the stress of substructure '{}' is not a number: its margin against {} is not known", part.name,
                       peak.is_index ? "failure" : "yield"));
    const double share = 100.0 * peak.above;
    const bool is_beyond = peak.margin() < limit::yield_margin;
    if (is_beyond && peak.is_index)
      warn(fmt::format(
          "substructure '{}' reaches a failure index of {:.4g}, above 1: '{}' fails{}, in up to {} % of its volume at "
          "once. The material model stays elastic; peaks at edges and corners are mesh-dependent",
          part.name, peak.largest, part.material.name, failing(peak),
          share > 9.95 ? fmt::format("{:.0f}", share) : fmt::format("{:.2g}", share)));
    else if (is_beyond)
      warn(fmt::format(
          "substructure '{}' reaches {:.4g} MPa (von Mises), above the yield of {:.4g} MPa of '{}': up to {} % of its "
          "volume at once. The material model stays elastic; peaks at edges and corners are mesh-dependent",
          part.name, peak.largest / 1e6, peak.allowed / 1e6, part.material.name,
          share > 9.95 ? fmt::format("{:.0f}", share) : fmt::format("{:.2g}", share)));
  }
}

// "  smallest margin against yield 0.32, in 'rod' (485 MPa of 640)", "  largest failure index 0.7, in 'skin' in ply 3".
std::string stress_line(const Problem& problem, const RunResult& result) {
  std::string line;
  for (const bool is_index : {false, true}) {
    const PartStress* least = nullptr;
    for (const PartStress& peak : result.stresses)
      if (peak.is_index == is_index && (!least || !(peak.margin() >= least->margin()))) least = &peak;
    if (!least) continue;
    const std::string& name = problem.substructures[static_cast<size_t>(least->part)]->name;
    if (!line.empty()) line += "\n";
    line += is_index ? fmt::format("  largest failure index {:.3g}, in '{}'{}", least->largest, name, failing(*least))
                     : fmt::format("  smallest margin against yield {:.3g}, in '{}' ({:.4g} MPa of {:.4g})",
                                   least->margin(), name, least->largest / 1e6, least->allowed / 1e6);
  }
  return line;
}

std::string surface_line(const Surface& surface) {
  const Facing& facing = surface.facing;
  if (facing.is_of_sums())
    return surface.wall ? fmt::format("  {} '{}'{}\n", surface.wall->kind->word(), surface.name(),
                                      surface.is_of_rotation ? ", a rotation" : "")
                        : fmt::format("  interface '{}': mean motions of {} and {}\n", surface.name(),
                                      surface.interface->side_1.label(), surface.interface->side_2.label());
  std::string line = fmt::format("  {} '{}': {} points, {:.4g} mm^2", surface.interface ? "interface" : "wall",
                                 surface.name(), surface.n_points(), facing.areas.sum() * 1e6);
  if (surface.interface && surface.interface->cyclic)
    line += fmt::format("; {} turned by {:.4g} degrees", surface.interface->side_2.label(),
                        360.0 / surface.interface->cyclic->n);
  const bool is_of_like_meshes = surface.interface && surface.interface->cyclic && facing.size_ratio == 1.0;
  if (surface.interface && !facing.matches() && !is_of_like_meshes) {
    const Face& carrier = facing.carrier == 1 ? surface.interface->side_1 : surface.interface->side_2;
    const double ratio = std::max(facing.size_ratio, 1.0 / facing.size_ratio);
    line += "; meshes do not match: points on " + carrier.label() +
            (ratio < 1.05
                 ? ", facets of one size"
                 : fmt::format(", facets {:.2g} times {}", ratio, facing.size_ratio >= 1.0 ? "larger" : "smaller"));
    if (facing.n_merged > 0) line += fmt::format(", {} points merged into neighbours", facing.n_merged);
  }
  return line + "\n";
}

}  // namespace dygita

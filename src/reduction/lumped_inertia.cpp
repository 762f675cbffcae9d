#include "reduction/lumped_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/log.hpp"
#include "fem/assembly.hpp"
#include "fem/mass.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/jacobian.hpp"
#include "mesh/shape_functions.hpp"
#include "model/joint_path.hpp"
#include "model/output.hpp"
#include "model/support.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr double most = 1.2;     // of the true moment: torsion a tenth too low
constexpr double slender = 2.0;  // length over width of what twists rather than turns
constexpr double slow = 0.02;    // of the speed of what turns as a whole

// Integrals of x x^T.
Mat3 material_moments(const Mesh& mesh, const Vec3& centre) {
  Mat3 moments = Mat3::Zero();
  for (const CellBlock& block : mesh.blocks) {
    const ShapeFunctions& shape = shape_functions(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      const Points x = cell_nodes(mesh.nodes, block, i).colwise() - centre;
      for (const QuadraturePoint& point : cell_shape(block.type).mass.points) {
        const Vec3 xi = vector_of(point.at), at = x * shape.values(xi);
        const Mat3 jacobian = x * shape.slopes(xi);
        moments += point.weight * jacobian.determinant() * at * at.transpose();
      }
    }
  }
  return moments;
}

// A plane of symmetry along the axis: nothing turns about it.
bool is_kept_from_turning(const Problem& problem, const SubstructurePtr& part, const Vec3& axis) {
  const double across = 0.1;
  for (const StepPtr& step : problem.steps) {
    if (step->is_static) continue;
    for (const SupportPtr& support : supports_of(problem, *step)) {
      if (support->kind->holds(false) != Directions::normal) continue;
      for (const FaceOrRegion& place : support->on) {
        const Face* face = std::get_if<Face>(&place);
        if (!face || face->part != part) continue;
        Vec3 area = Vec3::Zero();
        for (const Facet& facet : face->facets()) area += facet_area_vector(part->mesh->nodes, facet);
        if (std::abs(area.normalized().dot(axis)) < across) return true;
      }
    }
  }
  return false;
}

// Is it of natural frequencies, those of the lumped masses?
bool has_modes(const Output& output) {
  const Columns columns = output.columns();
  return !columns.empty() && columns.front().name == "frequency";
}

bool is_slender(const Mesh& mesh, const Vec3& axis) {
  const Eigen::RowVectorXd along = axis.transpose() * mesh.nodes;
  const Points beside = mesh.nodes - axis * along;
  const double width = (beside.rowwise().maxCoeff() - beside.rowwise().minCoeff()).maxCoeff();
  return along.maxCoeff() - along.minCoeff() > slender * width;
}

// Only springs, walls, sums and means of faces hold it.
bool turns_as_a_whole(const Problem& problem, const SubstructurePtr& part) {
  for (const StepPtr& step : problem.steps) {
    if (step->is_static && problem.steps.size() > 1) continue;
    for (const SupportPtr& support : supports_of(problem, *step))
      if (!support->kind->law() && std::any_of(support->on.begin(), support->on.end(), [&](const FaceOrRegion& place) {
            return &part_of(place) == part.get();
          }))
        return false;
  }
  return std::none_of(problem.interfaces.begin(), problem.interfaces.end(), [&](const InterfacePtr& interface) {
    if (interface->side_1.part != part && interface->side_2.part != part) return false;
    return !interface->means && !is_isolator(*interface);
  });
}

struct SlowPart {
  const Substructure* part;
  LumpedInertia inertia;

  double behind() const { return 1.0 - 1.0 / inertia.ratio; }
};

// In motion, or in modes of an output: nothing else asks for inertia.
struct Asked {
  bool moves = false, swings = false;

  explicit Asked(const Problem& problem) {
    for (const StepPtr& step : problem.steps) moves = moves || !step->is_static;
    for (const OutputPtr& output : problem.outputs) swings = swings || has_modes(*output);
  }
  // Modes have the consistent mass of such cells; motions may not, where they are explicit.
  bool lumps(const Mesh& mesh) const { return mesh.has_cells() && (moves || (swings && !has_consistent_mass(mesh))); }
};

bool is_tuned_implicitly(const Problem& problem) {
  const bool is_tuned = problem.monolithic ? problem.monolithic->mass.is_tuned : problem.solver.mass.is_tuned;
  return is_tuned && !problem.explicit_dynamics;
}

}  // namespace

LumpedInertia lumped_inertia(const Mesh& mesh, bool has_twist) {
  const Vec volumes = nodal_volumes(mesh);
  const Vec3 centre = mesh.nodes * volumes / volumes.sum();
  const Points arm = mesh.nodes.colwise() - centre;
  const Mat3 lumped = arm * volumes.asDiagonal() * arm.transpose(), material = material_moments(mesh, centre);
  const EigenPairs principal = symmetric_eigen(material);
  LumpedInertia worst;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = principal.vectors.col(i);
    if (!has_twist && is_slender(mesh, axis)) continue;
    const double ratio = (lumped.trace() - axis.dot(lumped * axis)) / (material.trace() - axis.dot(material * axis));
    if (ratio > worst.ratio) worst = {ratio, axis};
  }
  return worst;
}

void doubt_slow_turning(const Problem& problem) {
  const Asked asked(problem);
  std::vector<SlowPart> slow_parts;
  std::set<const Mesh*> told;
  for (const SubstructurePtr& part : problem.substructures) {
    if (!asked.lumps(*part->mesh) || has_consistent_mass(*part->mesh) || !turns_as_a_whole(problem, part) ||
        !told.insert(part->mesh.get()).second)
      continue;
    const SlowPart turning{part.get(), lumped_inertia(*part->mesh, false)};
    if (turning.behind() >= slow) slow_parts.push_back(turning);
  }
  if (slow_parts.empty()) return;
  std::stable_sort(slow_parts.begin(), slow_parts.end(),
                   [](const SlowPart& a, const SlowPart& b) { return a.inertia.ratio > b.inertia.ratio; });
  const SlowPart& worst = slow_parts.front();
  const LumpedInertia& inertia = worst.inertia;
  std::string others;
  for (size_t i = 1; i < slow_parts.size(); ++i)
    others += fmt::format("{}'{}' {:.2g} %", i == 1 ? "; also " : ", ", slow_parts[i].part->name,
                          100.0 * slow_parts[i].behind());
  warn(fmt::format(
      "{}problem '{}': substructure '{}' turns as a whole, and its masses at the nodes have {:.3g} times the moment of "
      "inertia of the material about the axis ({:.2g}, {:.2g}, {:.2g}): under a torque it spins {:.2g} % too slowly, "
      "and swings on springs {:.2g} % too slowly; use more cells (n across: 2/n^2 too much), or cells of order two{}",
      worst.part->origin.prefix(), problem.name, worst.part->name, inertia.ratio, inertia.axis[0], inertia.axis[1],
      inertia.axis[2], 100.0 * worst.behind(), 100.0 * (1.0 - 1.0 / std::sqrt(inertia.ratio)), others));
}

void doubt_lumped_inertia(const Problem& problem) {
  doubt_slow_turning(problem);
  if (is_tuned_implicitly(problem)) return;
  const Asked asked(problem);
  std::set<const Mesh*> told;
  for (const SubstructurePtr& part : problem.substructures) {
    if (!asked.lumps(*part->mesh) || !told.insert(part->mesh.get()).second) continue;
    const LumpedInertia lumped = lumped_inertia(*part->mesh);
    if (lumped.ratio < most || !is_slender(*part->mesh, lumped.axis) ||
        is_kept_from_turning(problem, part, lumped.axis))
      continue;
    warn(fmt::format(
        "{}problem '{}': the masses of substructure '{}' at its nodes have {:.2g} times the moment of inertia "
        "of the material about the axis ({:.2g}, {:.2g}, {:.2g}): its torsional frequencies are up to {:.0f} % too low "
        "with lumped mass; use more cells across, or solver.latin{{ mass = \"tuned\" }}",
        part->origin.prefix(), problem.name, part->name, lumped.ratio, lumped.axis[0], lumped.axis[1], lumped.axis[2],
        100.0 * (1.0 - 1.0 / std::sqrt(lumped.ratio))));
  }
}

}  // namespace dygita

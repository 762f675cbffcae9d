#include "reduction/lumped_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "base/union_find.hpp"
#include "fem/assembly.hpp"
#include "fem/mass.hpp"
#include "law/law.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/jacobian.hpp"
#include "mesh/shape_functions.hpp"
#include "model/joint_path.hpp"
#include "model/output.hpp"
#include "model/places.hpp"
#include "model/support.hpp"
#include "numerics/dense.hpp"
#include "step/integration.hpp"

namespace dygita {

namespace {

constexpr double most = 1.2;     // of the true moment: torsion a tenth too low
constexpr double slender = 2.0;  // length over width of what twists rather than turns
constexpr double slow = 0.02;    // of the speed of what turns as a whole

// Integrals of (x, 1)(x, 1)^T by mass: of the masses at the nodes, and of the material.
struct Moments {
  Eigen::Matrix4d lumped = Eigen::Matrix4d::Zero(), material = lumped;

  void add(const Mesh& mesh, double density, bool is_lumped = true);
};

void Moments::add(const Mesh& mesh, double density, bool is_lumped) {
  Eigen::Matrix4d own = Eigen::Matrix4d::Zero();
  for (const CellBlock& block : mesh.blocks) {
    const ShapeFunctions& shape = shape_functions(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      const Points x = cell_nodes(mesh.nodes, block, i);
      for (const QuadraturePoint& point : cell_shape(block.type).mass.points) {
        const Vec3 xi = vector_of(point.at);
        const Vec3 at = x * shape.values(xi);
        const Mat3 jacobian = x * shape.slopes(xi);
        own += density * point.weight * jacobian.determinant() * at.homogeneous() * at.homogeneous().transpose();
      }
    }
  }
  material += own;
  const Eigen::Matrix4Xd nodes = mesh.nodes.colwise().homogeneous();
  if (is_lumped) own = density * nodes * nodal_volumes(mesh).asDiagonal() * nodes.transpose();
  lumped += own;
}

Mat3 about_centre(const Eigen::Matrix4d& moments) {
  const Vec3 first = moments.topRightCorner<3, 1>();
  return moments.topLeftCorner<3, 3>() - first * first.transpose() / moments(3, 3);
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

bool is_slender(const Points& nodes, const Vec3& axis) {
  const Eigen::RowVectorXd along = axis.transpose() * nodes;
  const Points beside = nodes - axis * along;
  const double width = (beside.rowwise().maxCoeff() - beside.rowwise().minCoeff()).maxCoeff();
  return along.maxCoeff() - along.minCoeff() > slender * width;
}

LumpedInertia worst_of(const Moments& moments, const Points& nodes, bool has_twist) {
  const Mat3 lumped = about_centre(moments.lumped), material = about_centre(moments.material);
  const EigenPairs principal = symmetric_eigen(material);
  LumpedInertia worst;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = principal.vectors.col(i);
    if (!has_twist && is_slender(nodes, axis)) continue;
    const double ratio = (lumped.trace() - axis.dot(lumped * axis)) / (material.trace() - axis.dot(material * axis));
    if (ratio > worst.ratio) worst = {ratio, axis};
  }
  return worst;
}

// Explicit motions have masses at nodes alone, whatever the cells.
bool is_asked_to_be_explicit(const Problem& problem, const Substructure& part) {
  return !problem.monolithic && asked_of(problem, part) == IntegrationChoice::explicitly;
}

bool may_be_explicit(const Problem& problem, const Substructure& part) {
  return is_asked_to_be_explicit(problem, part) ||
         (!problem.monolithic && asked_of(problem, part) == IntegrationChoice::as_cheapest &&
          !loses_by_diagonal(*part.mesh));
}

// Substructures that are bonded to each other.
struct Whole {
  std::vector<SubstructurePtr> parts;
  LumpedInertia inertia;

  void measure(const Problem& problem);
  double behind() const { return 1.0 - 1.0 / inertia.ratio; }
  std::string label() const {
    std::vector<std::string> names;
    for (const SubstructurePtr& part : parts) names.push_back(part->name);
    return (names.size() == 1 ? "" : "the bonded body of ") + list_of_names(names);
  }
};

void Whole::measure(const Problem& problem) {
  Moments moments;
  Points nodes(3, 0);
  for (const SubstructurePtr& part : parts) {
    const Mesh& mesh = *part->mesh;
    moments.add(mesh, part->material.density, !has_consistent_mass(mesh) || is_asked_to_be_explicit(problem, *part));
    nodes.conservativeResize(3, nodes.cols() + mesh.n_nodes());
    nodes.rightCols(mesh.n_nodes()) = mesh.nodes;
  }
  inertia = worst_of(moments, nodes, false);
}

bool is_bond(const Interface& interface) { return interface.law->is_tie() && !interface.means && !interface.cyclic; }

// In the order of their first substructures. Only springs, walls, sums and means of faces hold each.
std::vector<Whole> what_turns_as_a_whole(const Problem& problem) {
  const auto& parts = problem.substructures;
  const int n = static_cast<int>(parts.size());
  const auto index = [&](const Substructure* part) { return index_of(parts, part); };
  UnionFind bonded(n);
  for (const InterfacePtr& interface : problem.interfaces)
    if (is_bond(*interface)) bonded.join(index(interface->side_1.part.get()), index(interface->side_2.part.get()));
  std::set<int> held;
  for (const StepPtr& step : problem.steps) {
    if (step->is_static && has_dynamic_step(problem)) continue;
    for (const SupportPtr& support : supports_of(problem, *step))
      if (!support->kind->law())
        for (const FaceOrRegion& place : support->on) held.insert(bonded.root(index(&part_of(place))));
  }
  for (const InterfacePtr& interface : problem.interfaces) {
    const int one = bonded.root(index(interface->side_1.part.get())),
              other = bonded.root(index(interface->side_2.part.get()));
    if (!interface->means && !is_isolator(*interface) && (one != other || interface->cyclic)) held.insert({one, other});
  }
  std::map<int, Whole> wholes;
  for (int i = 0; i < n; ++i)
    if (const int root = bonded.root(i); !held.contains(root)) wholes[root].parts.push_back(parts[i]);
  std::vector<Whole> in_order;
  for (auto& [root, whole] : wholes) in_order.push_back(std::move(whole));
  return in_order;
}

// In motion, or in modes of an output: nothing else asks for inertia.
struct Asked {
  bool moves = false, swings = false;

  explicit Asked(const Problem& problem) {
    for (const StepPtr& step : problem.steps) moves = moves || !step->is_static;
    for (const OutputPtr& output : problem.outputs) swings = swings || has_modes(*output);
  }
  // Modes have the consistent mass of such cells; motions may not, where they are explicit.
  bool lumps(const Problem& problem, const Substructure& part) const {
    if (!part.mesh->has_cells()) return false;
    return has_consistent_mass(*part.mesh) ? moves && may_be_explicit(problem, part) : moves || swings;
  }
};

bool is_tuned_implicitly(const Problem& problem) {
  const bool is_tuned = problem.monolithic ? problem.monolithic->mass.is_tuned : problem.solver.mass.is_tuned;
  return is_tuned && !problem.explicit_dynamics;
}

}  // namespace

LumpedInertia lumped_inertia(const Mesh& mesh, bool has_twist) {
  Moments moments;
  moments.add(mesh, 1.0);
  return worst_of(moments, mesh.nodes, has_twist);
}

void doubt_slow_turning(const Problem& problem) {
  const Asked asked(problem);
  std::vector<Whole> slow_ones;
  std::set<std::vector<const Mesh*>> told;
  for (Whole& whole : what_turns_as_a_whole(problem)) {
    std::vector<const Mesh*> meshes;
    for (const SubstructurePtr& part : whole.parts) meshes.push_back(part->mesh.get());
    const auto lumps = [&](const SubstructurePtr& part) {
      return asked.lumps(problem, *part) &&
             (!has_consistent_mass(*part->mesh) || is_asked_to_be_explicit(problem, *part));
    };
    const auto has_cells = [](const Mesh* mesh) { return mesh->has_cells(); };
    if (!std::all_of(meshes.begin(), meshes.end(), has_cells) ||
        !std::any_of(whole.parts.begin(), whole.parts.end(), lumps) || !told.insert(meshes).second)
      continue;
    whole.measure(problem);
    if (whole.behind() >= slow) slow_ones.push_back(std::move(whole));
  }
  if (slow_ones.empty()) return;
  std::stable_sort(slow_ones.begin(), slow_ones.end(),
                   [](const Whole& a, const Whole& b) { return a.inertia.ratio > b.inertia.ratio; });
  const Whole& worst = slow_ones.front();
  const LumpedInertia& inertia = worst.inertia;
  std::string others;
  for (size_t i = 1; i < slow_ones.size(); ++i)
    others +=
        fmt::format("{}{} {:.2g} %", i == 1 ? "; also " : ", ", slow_ones[i].label(), 100.0 * slow_ones[i].behind());
  warn(fmt::format(
      "{}problem '{}': {}{} turns as a whole, and its masses at the nodes have {:.3g} times the moment of "
      "inertia of the material about the axis ({:.2g}, {:.2g}, {:.2g}): under a torque it spins {:.2g} % too slowly, "
      "and swings on springs {:.2g} % too slowly; use more cells (n across: 2/n^2 too much), or {}{}",
      worst.parts.front()->origin.prefix(), problem.name, worst.parts.size() == 1 ? "substructure " : "", worst.label(),
      inertia.ratio, inertia.axis[0], inertia.axis[1], inertia.axis[2], 100.0 * worst.behind(),
      100.0 * (1.0 - 1.0 / std::sqrt(inertia.ratio)),
      has_consistent_mass(*worst.parts.front()->mesh) ? "integration = \"implicit\"" : "cells of order two", others));
}

void doubt_lumped_inertia(const Problem& problem) {
  doubt_slow_turning(problem);
  if (is_tuned_implicitly(problem)) return;
  const Asked asked(problem);
  std::set<const Mesh*> told;
  for (const SubstructurePtr& part : problem.substructures) {
    if (!asked.lumps(problem, *part) || !told.insert(part->mesh.get()).second) continue;
    const LumpedInertia lumped = lumped_inertia(*part->mesh);
    if (lumped.ratio < most || !is_slender(part->mesh->nodes, lumped.axis) ||
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

// One sector of a ring: one axis for all cut faces, and nothing that differs from sector to sector.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "base/overloaded.hpp"
#include "checks/parts.hpp"
#include "mesh/face_nodes.hpp"
#include "model/extent.hpp"
#include "model/load.hpp"

namespace dygita::check {

namespace {

constexpr double nearly_zero = 1e-6;

const char* whole_ring = "in one sector every sector has it in its own direction: model the whole ring";

void is_one_ring(const Problem& problem, const Interface& first, const Interface& other, double size) {
  const CyclicSymmetry &a = *first.cyclic, &b = *other.cyclic;
  const std::string who = describe(other) + " and " + describe(first);
  if (a.n != b.n)
    fail(problem, other.origin, fmt::format("{} have n = {} and n = {}: sectors of one ring", who, b.n, a.n));
  if (a.along.cross(b.along).norm() > nearly_zero || a.distance(b.through) > nearly_zero * size)
    fail(problem, other.origin, who + " have different axes: sectors of one ring have one");
}

// A field of accelerations is the same in all sectors where, turned with the place, it is that of the turned place.
bool is_cyclic(const CyclicSymmetry& cyclic, const BodyForce& force, const Box& box) {
  double off = 0.0, size = 0.0;
  for (const Vec3& x : {box.low, box.high, Vec3(0.5 * (box.low + box.high))}) {
    const Vec3 here = force.unit(x), there = force.unit(cyclic.through + cyclic.turn * (x - cyclic.through));
    off = std::max(off, (there - cyclic.turn * here).norm());
    size = std::max(size, here.norm());
  }
  return off <= nearly_zero * size;
}

void is_same_in_all(const Problem& problem, const CyclicSymmetry& cyclic, const Step& step, const Load& load,
                    const Box& box) {
  const auto refuse = [&](const std::string& what) {
    fail(problem, load.origin, "step '" + step.name + "': " + load.path + " " + what, whole_ring);
  };
  for (const Effect& effect : load.effects())
    std::visit(overloaded{[&](const BaseMotion& base) {
                            if (base.direction.cross(cyclic.along).norm() > nearly_zero)
                              refuse("shakes " + describe(*base.on) +
                                     " across the axis of the ring of which an interface.cyclic makes a sector");
                          },
                          [&](const BodyForce& force) {
                            if (!is_cyclic(cyclic, force, box))
                              refuse(
                                  "does not act alike around the axis of the ring of which an interface.cyclic "
                                  "makes a sector");
                          },
                          [](const NodalForces&) {}, [](const PrescribedMotion&) {}, [](const Tightening&) {},
                          [](const Release&) {}},
               effect);
}

// A flat cut.
struct Plane {
  Vec3 at, normal;
  double tolerance;  // m

  explicit Plane(const Face& face) {
    const FaceNodes nodes = face_nodes(*face.part->mesh, face.facets());
    const Points x = face.part->mesh->nodes(Eigen::all, nodes.nodes).colwise() + face.part->place;
    at = x.rowwise().mean();
    normal = nodes.vectors.rowwise().sum().normalized();
    tolerance = 1e-6 * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
    is_flat = (normal.transpose() * (x.colwise() - at)).cwiseAbs().maxCoeff() < tolerance;
  }
  bool has_facet_of(const Substructure& part) const {
    const std::vector<Facet> facets = boundary_facets(*part.mesh);
    return std::any_of(facets.begin(), facets.end(), [&](const Facet& facet) {
      const auto nodes = facet.nodes();
      return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
        return std::abs(normal.dot(part.mesh->nodes.col(node) + part.place - at)) < tolerance;
      });
    });
  }
  bool is_flat;
};

// A part with facets in both planes of the cuts is cut by them, as far as one can tell.
void doubt_free_cuts(const Problem& problem, const Interface& first) {
  const Plane one(first.side_1), other(first.side_2);
  if (!one.is_flat || !other.is_flat) return;
  for (const SubstructurePtr& part : problem.substructures) {
    const bool is_tied =
        std::any_of(problem.interfaces.begin(), problem.interfaces.end(), [&](const InterfacePtr& interface) {
          return interface->cyclic && (interface->side_1.part == part || interface->side_2.part == part);
        });
    if (!is_tied && part->mesh->has_cells() && one.has_facet_of(*part) && other.has_facet_of(*part))
      warn(fmt::format(
          "{}substructure '{}' has facets in both planes of the cuts of '{}' and no interface.cyclic: it is "
          "free there; give it one of its own if it goes all around",
          part->origin.prefix(), part->name, first.name));
  }
}

}  // namespace

void cyclic(const Problem& problem) {
  const Interface* first = nullptr;
  const Box box = extent_of(problem.substructures);
  for (const InterfacePtr& interface : problem.interfaces) {
    if (!interface->cyclic) continue;
    if (!first) first = interface.get();
    is_one_ring(problem, *first, *interface, box.size().norm());
  }
  if (!first) return;
  doubt_free_cuts(problem, *first);
  const CyclicSymmetry& ring = *first->cyclic;
  for (const SubstructurePtr& part : problem.substructures)
    if (part->velocity.cross(ring.along).norm() > nearly_zero * part->velocity.norm())
      fail(problem, part->origin,
           "'velocity' of substructure '" + part->name +
               "' is across the axis of the ring of which an interface.cyclic makes a sector",
           whole_ring);
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads) is_same_in_all(problem, ring, *step, *load, box);
}

}  // namespace dygita::check

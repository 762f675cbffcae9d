// One sector of a ring: one axis for all cut faces, and nothing that differs from sector to sector.
#include <spdlog/fmt/fmt.h>

#include "base/overloaded.hpp"
#include "checks/parts.hpp"
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

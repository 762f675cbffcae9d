#include "interfaces/check_preloads.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/overloaded.hpp"
#include "interfaces/loads.hpp"
#include "law/law.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

constexpr double smallest_preload = 1e6;  // Pa, mean stress: below it hardly anyone tightens a bolt

// A preload adds up forces along the normals of its points: where these turn, that is no force of a bolt.
void check_direction(const Facing& facing, const Load& load, const std::string& who) {
  constexpr double one_way = 0.99;  // of the area, seen along the mean normal: a dome of 11 degrees either way
  const Vec3 sum = facing.normals * facing.areas;
  const double share = sum.norm() / facing.areas.sum();
  if (share >= one_way) return;
  const Vec along = facing.normals.transpose() * sum.normalized();
  const double turn = std::acos(std::clamp(along.minCoeff(), -1.0, 1.0)) * 180.0 / std::numbers::pi;
  throw InputError(
      load.origin,
      fmt::format(
          "{}, whose faces turn: {}; the forces along the normals, which a preload sums, oppose each other\n    "
          "tighten the bolt at a flat section of its shank: bond two parts there, apply the preload to that interface, "
          "and bond this one without a load",
          who,
          share > 0.01
              ? fmt::format("normals are up to {:.0f} degrees off their mean, with a projected area of {:.3g} %", turn,
                            100.0 * share)
              : "closed around, so that their normals have no mean"));
}

void check_preload(const Problem& problem, const Step& step, const Load& load, const PreloadForce& preload,
                   const std::vector<Surface>& surfaces) {
  const Interface& interface = *preload.on;
  const Facing& facing = surfaces.at(index_of(problem.interfaces, &interface)).facing;
  if (facing.is_of_sums())
    throw InputError(load.origin,
                     fmt::format("{} acts on interface '{}', which joins mean motions: tighten the shank of a "
                                 "bolt, whose halves are bonded point by point",
                                 load.path, interface.name));
  const double area = facing.areas.sum();
  double most = 0.0;
  for (int i = 0; i < step.increments; ++i)
    most = std::max(most, LoadValue{preload.value, 0.0}.at_static(i, step.increments));
  const std::string who = fmt::format("problem '{}': step '{}': {} asks for {:.6g} N through interface.{} '{}'",
                                      problem.name, step.name, load.path, most, interface.law->word(), interface.name);
  check_direction(facing, load, who);
  if (most > 0.0 && most < smallest_preload * area)
    warn(fmt::format("{}{}, a mean stress of {:.2g} MPa: was a unit forgotten, as in {:.6g}*kN?", load.origin.prefix(),
                     who, 1e-6 * most / area, most));
  const TensionLimit law = interface.law->tension_limit();
  const double limit = law.traction * area;
  if (most < limit) return;
  const std::string force = fmt::format("{:.6g} N ({:.4g} MPa on {:.4g} mm^2)", limit, law.traction / 1e6, area * 1e6);
  throw InputError(
      load.origin,
      fmt::format("{}, which cannot be reached: {}\n    the largest force is below {:.6g} N{}", who,
                  fmt::format(fmt::runtime(law.why), force), limit, law.cure.empty() ? "" : "; or " + law.cure));
}

}  // namespace

void check_preloads(const Problem& problem, const std::vector<Surface>& surfaces) {
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        std::visit(
            overloaded{[&](const PreloadForce& preload) { check_preload(problem, *step, *load, preload, surfaces); },
                       Ignored<NodalForces, BodyForce, PrescribedMotion, BaseMotion, Shortening, Release>()},
            effect);
}

}  // namespace dygita

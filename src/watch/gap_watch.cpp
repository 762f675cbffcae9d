#include "watch/gap_watch.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "law/law.hpp"
#include "model/extent.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

// The deepest penetration of an interface's points that are here, m. Where asperities give way there is none.
double depth_of(const Instant& instant, int surface) {
  double depth = 0.0;
  const Law& law = (*instant.model.surfaces)[static_cast<size_t>(surface)].declared_law();
  instant.for_each_point_here(surface, [&](int, const LawState& point) {
    if (point.gap < -depth && law.tangent(point, true).stiffness[0] == 0.0) depth = -point.gap;
  });
  return depth;
}

}  // namespace

void GapWatch::begin_step(const Instant& start) {
  constexpr double something = 1e-6;                   // of the part's size
  if (start.i_step == 0 || start.is_static()) return;  // a static step pushes it out
  const Problem& problem = *start.model.problem;
  const Step& before = *problem.steps[static_cast<size_t>(start.i_step) - 1];
  for (size_t s = 0; s < start.model.surfaces->size(); ++s) {
    const Surface& surface = (*start.model.surfaces)[s];
    if (!surface.wall || !surface.declared_law().shown().gap || !takes_part(problem, *start.model.step, surface) ||
        takes_part(problem, before, surface))
      continue;
    const Substructure& part = *problem.substructures[static_cast<size_t>(surface.part_1)];
    walls_.push_back({surface.wall, start.model.step, &part, depth_of(start, static_cast<int>(s)),
                      something * extent_of(part).size().norm()});
  }
}

void GapWatch::accept(const Instant& instant) {
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s)
    if ((*instant.model.surfaces)[s].declared_law().shown().gap)
      deepest_ = std::max(deepest_, depth_of(instant, static_cast<int>(s)));
}

void GapWatch::settle() {
  deepest_ = ranks::largest(deepest_);
  for (New& wall : walls_) wall.depth = ranks::largest(wall.depth);
}

void GapWatch::finish(RunResult& result) const {
  result.figures.largest_penetration = deepest_;
  for (const New& wall : walls_)
    if (wall.depth > wall.least)
      result.warnings.push_back(fmt::format(
          "step '{}': support.wall '{}' appears where '{}' already is, up to {:.4g} mm behind it: it stops further "
          "penetration but does not push the part out; list the wall in the preceding steps too, or check its 'gap'",
          wall.step->name, wall.wall->name, wall.part->name, 1e3 * wall.depth));
}

}  // namespace dygita

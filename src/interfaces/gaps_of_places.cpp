#include "interfaces/gaps_of_places.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/warnings.hpp"
#include "meeting/round_surfaces.hpp"

namespace dygita {

namespace {

// What the deck adds to the gap of a point, by the nodes of one side that the point moves with; NaN: a scan does not
// reach some of them.
double form_of(const std::unordered_map<int, double>& form, const SideTrace& side, int i) {
  constexpr double nothing = 1e-12;
  double sum = 0.0;
  for (int k = 0; k < side.n_shares(i); ++k)
    if (const auto& share = side.share(i, k); std::abs(share.weight) > nothing)
      sum += share.weight * form.at(share.node);
  return sum;
}

// By the nodes of the side that carries the points, or, where a scan does not reach these, by those of the other.
void add_form(const Interface& interface, Facing& facing) {
  if (interface.form[0].empty()) return;
  const std::array<const SideTrace*, 2> sides = {&facing.side_1, &facing.side_2};
  const size_t own = facing.carrier == 2 ? 1 : 0;
  for (int i = 0; i < facing.n_points(); ++i) {
    double gap = form_of(interface.form[own], *sides[own], i);
    if (std::isnan(gap)) gap = form_of(interface.form[1 - own], *sides[1 - own], i);
    if (std::isnan(gap)) {
      const Vec3 x = facing.places.col(i);
      throw InputError(
          interface.origin,
          fmt::format("interface '{}': the scan in 'gap' has no point near ({:g}, {:g}, {:g}) mm, where '{}' and '{}' "
                      "meet\n    a place is seen within `smooth` of a point: is `unit`, `plane` or `frame` another?",
                      interface.name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2], interface.side_1.label(),
                      interface.side_2.label()));
    }
    facing.gaps[i] += gap;
  }
}

std::string who(const Interface& interface) {
  return fmt::format("interface '{}': {}", interface.name,
                     interface.is_gap_drawn ? "no 'gap' is given" : "'gap' = \"geometry\"");
}

}  // namespace

// Gaps of the places mean nothing where facets of round faces are as far off; those of surfaces that are known between
// the nodes hold there too, if they change little from one node to the next (manual, eq. J6). One that a deck does not
// ask for is no interference in a step that would throw the parts apart.
void take_gaps_of_places(const Problem& problem, const Interface& interface, Facing& facing) {
  constexpr double of_largest = 0.1, of_round = 0.01, rounding = 1e-12;
  const Vec of_facets = facing.gaps;
  add_form(interface, facing);
  const auto largest = [&] { return facing.n_points() > 0 ? facing.gaps.cwiseAbs().maxCoeff() : 0.0; };
  double off = facing.sagitta, allowed = of_largest;
  const bool are_off = off > allowed * largest() && off > rounding;
  if (are_off || interface.is_gap_drawn)
    if (const auto round = round_gaps(placed(interface.side_1), placed(interface.side_2), facing);
        round && (are_off || round->is_on_flat)) {
      facing.gaps += round->gaps - of_facets;
      off = std::max(round->bend, round->off);
      if (round->is_on_flat && interface.is_gap_drawn) {  // a parabola beside a line, as finely as the mesh has it
        facing.gaps.array() -= round->missed;
        off = 0.0;
      }
      allowed = of_round;
    }
  if (off > allowed * largest() && off > rounding)
    throw InputError(
        interface.origin,
        fmt::format("{}: the facets of '{}' and '{}' are up to {:.3g} mm off the round face they represent, "
                    "the largest gap between them is {:.3g} mm\n    {}, or refine the mesh",
                    who(interface), interface.side_1.label(), interface.side_2.label(), 1e3 * off, 1e3 * largest(),
                    interface.is_gap_drawn ? "closed = true starts the interface closed; declare the gap"
                                           : "declare the gap as a length"));
  if (!interface.is_gap_drawn || problem.steps.empty() || problem.steps.front()->is_static) return;
  const double least = facing.n_points() > 0 ? facing.gaps.minCoeff() : 0.0;
  facing.gaps = facing.gaps.cwiseMax(0.0);
  if (-least > of_largest * largest())
    warn(fmt::format(
             "{}{}: '{}' and '{}' overlap by up to {:.2g} mm, which is left out, since the first step is dynamic; "
             "put a step.static before it to press them apart",
             interface.origin.prefix(), who(interface), interface.side_1.label(), interface.side_2.label(),
             -1e3 * least),
         {"interference left out", -least, "'" + interface.name + "'"});
}

}  // namespace dygita

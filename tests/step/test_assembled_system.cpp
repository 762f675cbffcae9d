// Static steps in one system: tangents beside the factor of others against a factor of their own.
#include <gtest/gtest.h>

#include "base/progress.hpp"
#include "step/assembled_system.hpp"
#include "step/blocks.hpp"
#include "step/step_ends.hpp"

namespace dygita::assembled_system_tests {
namespace {

constexpr double k = 3e7;  // N/m, about what a point of these cubes has behind it

// A tower of cubes in contact, pressed from above and aside.
Problem tower() {
  Problem problem = two_cubes(contact(0.3), {}, 3);
  const BlockPtr top = cube("top", 0, 0, 2, 3);
  problem.interfaces.push_back(interface("upper",
                                         face(std::const_pointer_cast<Substructure>(problem.substructures[1]), "zmax"),
                                         face(top, "zmin"), contact(0.3)));
  problem.substructures.push_back(top);
  problem.steps = {static_step(
      "press", 1,
      {number("traction", {face(top, "zmax")}, -20e6, 2), number("traction", {face(top, "xmax")}, 3e6, 0)})};
  problem.solver.integration = IntegrationChoice::implicitly;
  set_progress_enabled(false);
  return problem;
}

// A spring between both sides of a point, normal and tangential (N/m); from_normal: what friction follows by.
PointTangent spring(const std::vector<int>& unknowns, double normal, double tangential, double from_normal = 0.0) {
  PointTangent point{unknowns, Mat::Zero(6, 6), {}, {}, normal};
  const Vec3 stiffness(normal, tangential, tangential);
  for (int d = 0; d < 3; ++d)
    for (const int a : {0, 3})
      for (const int b : {0, 3}) point.matrix(a + d, b + d) = a == b ? stiffness[d] : -stiffness[d];
  if (from_normal == 0.0) return point;
  point.normal = point.following = Vec::Zero(6);
  point.normal[0] = -normal, point.normal[3] = normal;
  point.following[1] = -from_normal, point.following[4] = from_normal;
  return point;
}

Tangents all_closed(const AssembledSystem& system) {
  Tangents tangents;
  for (const std::vector<int>& unknowns : system.unknowns_of_points())
    tangents.points.push_back(spring(unknowns, 1e3 * k, 1e3 * k));
  return tangents;
}

// A point has opened, another slides, and a preload gives way.
Tangents some_changed(const AssembledSystem& system, bool slides) {
  Tangents tangents = all_closed(system);
  PreloadTangent preload{{}, 0.0, {}};
  for (size_t i = 0; i < tangents.points.size(); ++i) {
    const std::vector<int> unknowns = tangents.points[i].unknowns;
    if (i == 6) tangents.points[i] = spring(unknowns, 1e-3 * k, 1e-3 * k);
    if (i == 8 && slides) tangents.points[i] = spring(unknowns, 1e3 * k, 1e-3 * k, 0.3);
    if (i > 4) continue;
    preload.stiffness += 0.02 * k;
    preload.column.emplace_back(unknowns[0], -0.01 * k);
    preload.column.emplace_back(unknowns[3], 0.01 * k);
  }
  tangents.preloads = {preload};
  return tangents;
}

struct Fields {
  Vec velocity, force;
};

Fields solved(AssembledSystem& system, const StepModel& model) {
  Fields fields{Vec::Zero(model.n_q()), Vec::Zero(model.n_q())};
  EXPECT_TRUE(system.solve(fields.velocity, fields.force));
  EXPECT_LT(system.imbalance(), 1e-11);
  return fields;
}

TEST(AssembledSystem, finds_beside_a_factor_of_other_tangents_what_their_own_factor_finds) {
  Modelled of(tower(), 0, true);
  start_step(of.model, of.state);
  of.model.loads->evaluate(0);
  for (size_t i = 0; i < of.model.pieces.size(); ++i)
    of.model.pieces[i]->begin(of.model.piece_force(static_cast<int>(i), of.state), {}, 0.0);
  AssembledSystem own(of.model), beside(of.model);
  beside.set_tangents(all_closed(beside));
  const Fields before = solved(beside, of.model);
  for (const bool slides : {false, true}) {
    const Tangents tangents = some_changed(own, slides);
    own.set_tangents(tangents);
    beside.set_other_tangents(tangents, Vec::Constant(of.model.n_q(), k));
    const Fields right = solved(own, of.model), found = solved(beside, of.model);
    EXPECT_GT(beside.n_products(), 0);
    const double changed_by = (right.force - before.force).norm();
    EXPECT_GT(changed_by, 0.05 * before.force.norm());
    EXPECT_LT((found.force - right.force).norm(), 0.005 * changed_by) << slides;
    EXPECT_LT((found.velocity - right.velocity).norm(), 0.005 * (right.velocity - before.velocity).norm()) << slides;
  }
  // Its own tangents again, without a new factor.
  beside.set_own();
  const Fields again = solved(beside, of.model);
  EXPECT_EQ(again.force, before.force);
}

TEST(AssembledSystem, tells_of_its_factor_and_is_stopped_within_it) {
  Modelled of(tower(), 0, true);
  AssembledSystem system(of.model);
  int n_told = 0;
  system.be_watched([&](const std::string& doing) {
    EXPECT_EQ(doing.find("factor "), 0U) << doing;
    if (++n_told == 3) throw std::runtime_error("stopped");
  });
  EXPECT_THROW(system.set_tangents(all_closed(system)), std::runtime_error);
  EXPECT_EQ(n_told, 3);
}

}  // namespace
}  // namespace dygita::assembled_system_tests

// Moments of inertia of lumped masses.
#include <gtest/gtest.h>

#include "base/log.hpp"
#include "law/law.hpp"
#include "mesh/box.hpp"
#include "model/support.hpp"
#include "reduction/lumped_inertia.hpp"

namespace dygita::lumped_inertia_tests {
namespace {

TEST(LumpedInertia, of_a_bar_follows_its_cells_across) {
  for (const int n : {1, 2, 4}) {
    const LumpedInertia found = lumped_inertia(*box_mesh(Vec3(0.1, 0.2, 0.3), Vec3(0.01, 0.01, 0.1), {n, n, 10 * n}));
    EXPECT_NEAR(found.ratio, 1.0 + 2.0 / (n * n), 1e-9) << n;
    EXPECT_NEAR(std::abs(found.axis.z()), 1.0, 1e-9) << n;
  }
}

struct Bar {
  std::shared_ptr<Substructure> part = std::make_shared<Substructure>();
  std::shared_ptr<Step> step = std::make_shared<Step>();
  Problem problem;

  explicit Bar(int n) {
    part->name = "bar";
    part->mesh = box_mesh(Vec3::Zero(), Vec3(0.01, 0.01, 0.1), {n, n, 10 * n});
    step->duration = step->dt = 1e-6;
    problem.name = "twist";
    problem.substructures = {part};
    problem.steps = {step};
    take_warnings();
  }
  std::vector<std::string> warnings() const {
    doubt_lumped_inertia(problem);
    return take_warnings();
  }
};

TEST(LumpedInertia, is_doubted_in_slender_parts_that_may_twist) {
  const std::vector<std::string> said = Bar(2).warnings();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("'bar' at its nodes have 1.5 times the moment of inertia"), std::string::npos) << said[0];
  EXPECT_NE(said[0].find("its torsional frequencies are up to 18 % too low"), std::string::npos) << said[0];
  EXPECT_TRUE(Bar(4).warnings().empty());
}

TEST(LumpedInertia, is_not_doubted_where_masses_are_tuned_nothing_moves_or_symmetry_forbids_it) {
  Bar tuned(2), still(2), quarter(2);
  tuned.problem.solver.mass.is_tuned = true;
  still.step->is_static = true;
  auto plane = std::make_shared<Support>();
  plane->kind = make_support("symmetry");
  plane->on = {Face{quarter.part, "xmin"}};
  quarter.problem.supports = {plane};
  for (const Bar* bar : {&tuned, &still, &quarter}) EXPECT_TRUE(bar->warnings().empty());
  plane->on = {Face{quarter.part, "zmin"}};  // across the axis
  EXPECT_EQ(quarter.warnings().size(), 1u);
}

// Two plates of one cell through the thickness are a body with two: half of each one's excess, and what bonds them.
TEST(LumpedInertia, is_doubted_of_what_is_bonded_and_turns_together) {
  Problem problem;
  problem.name = "spin";
  auto step = std::make_shared<Step>();
  step->duration = step->dt = 1e-6;
  problem.steps = {step};
  for (const int i : {0, 1}) {
    auto part = std::make_shared<Substructure>();
    part->name = i == 0 ? "low" : "high";
    part->mesh = box_mesh(Vec3(0.0, 0.0, 0.01 * i), Vec3(0.03, 0.02, 0.01), {12, 2, 1});
    part->material.density = 1000.0 * (1 + i);
    problem.substructures.push_back(part);
  }
  const auto said = [&] {
    doubt_slow_turning(problem);
    return take_warnings();
  };
  take_warnings();
  auto tie = std::make_shared<Interface>();
  tie->name = "tie";
  tie->side_1 = {problem.substructures[0], "zmax"};
  tie->side_2 = {problem.substructures[1], "zmin"};
  tie->law = make_law("bonded");
  problem.interfaces = {tie};
  const std::vector<std::string> of_both = said();
  ASSERT_EQ(of_both.size(), 1u);
  // Masses m and 2 m: about x, of thicknesses h and width w = 2 h, (m + 2 m)(w^2 + h^2)/12 + 2/3 m h^2 of the material;
  // two cells across w and one through h add 1/2 of w^2 and 2 of h^2 to the first term.
  const double ratio = (3.0 * (4.0 * 1.5 + 3.0) / 12.0 + 2.0 / 3.0) / (3.0 * (4.0 + 1.0) / 12.0 + 2.0 / 3.0);
  EXPECT_NE(
      of_both[0].find(fmt::format("the bonded body of 'low', 'high' turns as a whole, and its masses at the nodes "
                                  "have {:.3g} times the moment",
                                  ratio)),
      std::string::npos)
      << of_both[0];
  auto floor = std::make_shared<Support>();
  floor->kind = make_support("fixed");
  floor->on = {Face{problem.substructures[1], "zmax"}};
  problem.supports = {floor};
  EXPECT_TRUE(said().empty()) << "what holds one holds both";
  problem.supports.clear();
  tie->law = make_law("contact", {{"friction", 0.0}, {"gap", 0.0}});
  EXPECT_TRUE(said().empty()) << "contact may part";
}

}  // namespace
}  // namespace dygita::lumped_inertia_tests

// Which rows the faces of a superelement have: supports, single nodes, rigid faces, the number of modes.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"
#include "reduction/superelement.hpp"

namespace dygita::test::superelement_faces_tests {
namespace {

// A block on two planes of symmetry.
DeckRun block(const std::string& element, const std::string& supports = "{ planes }") {
  return run_text(R"(
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700 }
local a = substructure{ name = "a", material = m, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 3, 3, 6 } } }
local planes = support.symmetry{ name = "planes", on = { a:face "xmin", a:face "zmin" } }
local corner = a:where(function(x, y, z) return near(x, 20*mm) and near(y, 20*mm) and near(z, 40*mm) end)
local element = output.superelement{ name = "element", )" +
                  element + R"( }
local result = problem{ name = "block", substructures = { a }, supports = )" +
                  supports + R"(, steps = { step.static{ name = "rest" } }, outputs = { element } }:run{}
)")
      .at(0);
}
const Superelement& element_of(const DeckRun& run) {
  return *std::any_cast<const SuperelementPtr&>(run.findings("element").model);
}
int n_interface(const Superelement& e) {
  return static_cast<int>(e.rows.size() - static_cast<size_t>(e.fixed_frequencies.size()));
}

TEST(SuperelementFaces, have_no_row_for_a_motion_that_a_support_holds) {
  const DeckRun run = block("on = { a:face 'xmin', a:face 'zmax' }, modes = 10");
  const Superelement& e = element_of(run);
  ASSERT_EQ(n_interface(e), 3 + 6);
  std::vector<int> left;
  for (int i = 0; i < 3; ++i) left.push_back(e.rows[i].direction);
  EXPECT_EQ(left, (std::vector<int>{1, 2, 3}));  // along y and z, about x
  EXPECT_EQ(e.rows[3].direction, 0);
  EXPECT_NEAR(e.rows[3].place[2], 40e-3, 1e-12);
}

TEST(SuperelementFaces, of_one_node_have_its_three_displacements) {
  for (const char* motion : {"mean", "nodes", "rigid"}) {
    const DeckRun run = block("on = corner, modes = 10, motion = '" + std::string(motion) + "'");
    EXPECT_EQ(n_interface(element_of(run)), 3) << motion;
  }
}

// A node has no rotation: what would be its rows moves nothing, has no mass, and would make every frequency zero.
TEST(SuperelementFaces, of_one_node_give_one_model_whatever_the_motion) {
  const Superelement nodes = element_of(block("on = corner, modes = 10, motion = 'nodes'"));
  const Superelement rigid = element_of(block("on = corner, modes = 10, motion = 'rigid'"));
  ASSERT_EQ(rigid.frequencies.size(), nodes.frequencies.size());
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(rigid.frequencies[i], nodes.frequencies[i], 1e-6 * nodes.frequencies[5]) << i;
  EXPECT_GT(rigid.frequencies[5], 100.0);
}

// Two bars on each other, free in space: as springs hold points between faces that do not match, a rounding of them
// must not be stiffness.
TEST(SuperelementFaces, of_free_bodies_have_six_motions_at_zero) {
  for (const char* order : {"1", "2"})
    for (const char* gap : {"0", "1"}) {
      const DeckRun run = run_text(R"(
local p = param{ order = 2, gap = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function bar(name, z) return substructure{ name = name, material = steel, place = { 0, 0, z },
  mesh = mesh.box{ size = { 720*mm, 25.4*mm, 12.7*mm }, cells = { 24, 2, 1 }, order = p.order } } end
local a, b = bar("a", 0), bar("b", 12.7*mm + (p.gap == 1 and 0.1*mm or 0))
local lap = interface.contact{ name = "lap", between = { a:face "zmax", b:face "zmin" }, friction = 0.2, within = 0.2*mm, gap = p.gap == 1 and "geometry" or 0 }
local squeeze = step.static{ name = "squeeze", increments = 2, loads = { load.pressure{ on = { a:face "zmin", b:face "zmax" }, history = 10*MPa } } }
problem{ name = "f2", substructures = { a, b }, interfaces = { lap }, steps = { squeeze },
  outputs = { output.superelement{ name = "element", on = { a:face "xmin", b:face "xmax" }, up_to = 1*kHz } } }:run{}
)",
                                   {{"order", order}, {"gap", gap}})[0];
      const Vec& frequencies = element_of(run).frequencies;
      std::printf("order %s, gap %s: %.5f ... %.5f, %.3f Hz\n", order, gap, frequencies[0], frequencies[5],
                  frequencies[6]);
      EXPECT_EQ(frequencies[5], 0.0);
      EXPECT_GT(frequencies[6], 100.0);
    }
}

TEST(SuperelementFaces, by_nodes_leave_out_what_is_held) {
  const DeckRun run = block("on = a:face 'zmax', modes = 10, motion = 'nodes'");
  EXPECT_EQ(n_interface(element_of(run)), 3 * 16 - 4);  // four nodes on the plane of symmetry
}

TEST(SuperelementFaces, that_are_partly_held_cannot_be_rigid) {
  testing::internal::CaptureStderr();
  const DeckRun run = block("on = a:face 'zmax', modes = 10, motion = 'rigid'");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(run.findings("element").model.has_value());
  EXPECT_NE(said.find("a node of a.zmax is held by a support"), std::string::npos) << said;
}

TEST(SuperelementFaces, keep_as_many_modes_as_asked_for_and_say_how_far_they_reach) {
  const DeckRun run = block("on = a:face 'zmax', modes = 7");
  const Superelement& e = element_of(run);
  EXPECT_EQ(e.fixed_frequencies.size() - e.n_residual, 7);
  EXPECT_NEAR(e.valid_to, 0.5 * e.fixed_frequencies[6], 1e-9 * e.valid_to);
  EXPECT_EQ(e.damping.size(), 0);
  // All modes there are: nothing is left out that others would have to stand for, and the frequencies are the whole's.
  const DeckRun all = block("on = a:face 'zmax', modes = 2000");
  EXPECT_EQ(element_of(all).n_residual, 0);
  EXPECT_EQ(static_cast<int>(element_of(all).rows.size()), element_of(all).n_unknowns);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(e.frequencies[i], element_of(all).frequencies[i], 1e-3 * e.frequencies[i] + 0.1)
        << i;  // rigid: zero but for rounding
}

// A bar that only stretches: the static stiffness E A / L and the mass of a rod are known.
TEST(SuperelementFaces, of_a_rod_have_its_static_stiffness) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local rod = substructure{ name = "rod", material = m, mesh = mesh.box{ size = { 5*mm, 5*mm, 100*mm }, cells = { 1, 1, 40 } } }
local element = output.superelement{ name = "element", on = { rod:face "zmin", rod:face "zmax" }, up_to = 30*kHz }
problem{ name = "rod", substructures = { rod }, supports = {}, steps = { step.static{ name = "rest" } }, outputs = { element } }:run{}
)")
                          .at(0);
  const Superelement& e = element_of(run);
  const double k = 200e9 * 25e-6 / 0.1;
  EXPECT_NEAR(e.stiffness(2, 2), k, 1e-9 * k);
  EXPECT_NEAR(e.stiffness(2, 8), -k, 1e-9 * k);
  EXPECT_NEAR(e.mass(2, 2), 8000 * 25e-6 * 0.1 / 3,
              1e-3 * 8000 * 25e-6 * 0.1);  // of a linear motion, but for the lumped cells
  EXPECT_NEAR(e.mass_of_parts, 8000 * 25e-6 * 0.1, 1e-12);
  // Stretching, free at both ends: c / (2 L).
  const double f = std::sqrt(200e9 / 8000) / 0.2;
  double nearest = 1e9;
  for (const double other : e.frequencies) nearest = std::min(nearest, std::abs(other - f));
  EXPECT_LT(nearest, 2e-3 * f);
}

}  // namespace
}  // namespace dygita::test::superelement_faces_tests

// Static steps with all parts in one system, beside the same steps part by part.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::assembled_tests {
namespace {

// Two clamps on one foot, meshes that do not match, friction: bolts tightened one after the other, then one head is
// pushed aside.
const std::string clamps = R"(
local p = param{ assembled = 1, monolithic = 0, bolts = 2, push = 2*MPa, yield = 1*GPa }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.3, density = 2700 }
local function part(name, metal, at, size, cells)
  return substructure{ name = name, material = metal, mesh = mesh.box{ origin = at, size = size, cells = cells } }
end
local foot = part("foot", steel, { 0, 0, -2*mm }, { p.bolts * 10*mm, 4*mm, 2*mm }, { p.bolts * 5, 3, 2 })
local parts, joints, shanks, heads = { foot }, {}, {}, {}
local function join(i) joints[#joints + 1] = i return i end
for i = 1, p.bolts do
  local x = (i - 1) * 10*mm
  local left = part("left" .. i, soft, { x, 0, 0 }, { 3*mm, 4*mm, 8*mm }, { 2, 2, 4 })
  local right = part("right" .. i, soft, { x + 5*mm, 0, 0 }, { 3*mm, 4*mm, 8*mm }, { 2, 3, 4 })
  local rod = part("rod" .. i, steel, { x + 3*mm, 1*mm, 0 }, { 2*mm, 2*mm, 8*mm }, { 2, 2, 4 })
  local head = part("head" .. i, steel, { x, 0, 8*mm }, { 8*mm, 4*mm, 2*mm }, { 8, 4, 2 })
  heads[i] = head
  for _, one in ipairs{ left, right, rod, head } do parts[#parts + 1] = one end
  for _, sleeve in ipairs{ left, right } do
    join(interface.contact{ name = sleeve.name .. "_top", between = { sleeve:face "zmax", head:face "zmin" }, friction = 0.2 })
    join(interface.contact{ name = sleeve.name .. "_foot", between = { sleeve:face "zmin", foot:face "zmax" }, friction = 0.2 })
  end
  join(interface.bonded{ name = "thread" .. i, between = { rod:face "zmin", foot:face "zmax" } })
  shanks[i] = join(interface.plastic{ name = "shank" .. i, between = { rod:face "zmax", head:face "zmin" }, yield = p.yield, hardening = 50*MPa/mm })
end
local steps, outputs, last = {}, { output.energy{} }, nil
for i = 1, p.bolts do
  last = step.static{ name = "tighten " .. i, after = last, loads = { load.preload{ on = shanks[i], force = 400 } } }
  steps[#steps + 1] = last
end
steps[#steps + 1] = step.static{ name = "push", after = last, increments = 3, loads = { load.traction{ on = heads[1]:face "xmax", x = -p.push } } }
for _, joint in ipairs(joints) do outputs[#outputs + 1] = output.joint{ name = "at_" .. joint.name, on = joint } end
outputs[#outputs + 1] = output.history{ name = "head", on = heads[1]:face "zmax", quantity = "displacement" }
problem{ name = "clamps", substructures = parts, interfaces = joints, supports = { support.fixed{ name = "base", on = foot:face "zmin" } },
  steps = steps, outputs = outputs,
  solver = p.monolithic == 1 and solver.monolithic{} or solver.latin{ static_tolerance = 1e-10, static_steps = p.assembled == 1 and "assembled" or "iterated" } }:run{}
)";

void expect_same(const DeckRun& one, const DeckRun& other, double near) {
  EXPECT_TRUE(one.result->converged);
  EXPECT_TRUE(other.result->converged);
  for (const char* axis : {"x", "z"}) EXPECT_LT(difference(one.column("head", axis), other.column("head", axis)), near);
  for (const char* joint : {"at_left1_top", "at_right1_foot", "at_shank1", "at_right2_top", "at_thread2"})
    EXPECT_LT(difference(one.column(joint, "normal"), other.column(joint, "normal")), near) << joint;
}

TEST(AssembledStatics, of_loose_and_tight_clamps_are_those_part_by_part_in_far_fewer_iterations) {
  const DeckRun together = run_text(clamps).at(0), apart = run_text(clamps, {{"assembled", "0"}}).at(0);
  expect_same(together, apart, 1e-5);
  EXPECT_LT(together.result->mean_iterations, 40.0);
  EXPECT_LT(together.result->mean_iterations, 0.5 * apart.result->mean_iterations);
  // The bolt has its force when its turn comes.
  EXPECT_NEAR(together.column("at_shank1", "normal").at(0), 400.0, 1e-4);
}

TEST(AssembledStatics, follow_a_shank_that_yields) {
  const Settings yields = {{"yield", "70e6"}};
  const DeckRun together = run_text(clamps, yields).at(0);
  expect_same(together, run_text(clamps, {{"yield", "70e6"}, {"assembled", "0"}}).at(0), 1e-5);
}

// Limits of friction that stay a step behind come closer by the same factor each time.
TEST(AssembledStatics, find_the_last_eight_digits_of_a_block_that_slides_in_a_few_iterations) {
  const std::string slide = R"(
local p = param{ tolerance = 1e-4 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local low = substructure{ name = "low", material = steel, mesh = mesh.box{ size = { 20*mm, 10*mm, 5*mm }, cells = { 8, 4, 2 } } }
local high = substructure{ name = "high", material = steel, mesh = mesh.box{ origin = { 2*mm, 1*mm, 5*mm }, size = { 16*mm, 8*mm, 5*mm }, cells = { 7, 3, 2 } } }
local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = 0.4 }
problem{ name = "slide", substructures = { low, high }, interfaces = { seam }, supports = { support.fixed{ name = "floor", on = low:face "zmin" } },
  steps = { step.static{ name = "push", loads = { load.pressure{ on = high:face "zmax", history = 50*MPa }, load.traction{ on = high:face "xmin", x = 56*MPa } } } },
  solver = solver.latin{ static_steps = "assembled", static_tolerance = p.tolerance },
  outputs = { output.energy{}, output.joint{ name = "seam", on = seam } } }:run{}
)";
  const DeckRun near = run_text(slide).at(0), far = run_text(slide, {{"tolerance", "1e-12"}}).at(0);
  EXPECT_TRUE(far.result->converged);
  EXPECT_GT(far.column("seam", "slip").at(0), 0.0);
  EXPECT_LE(far.result->mean_iterations, near.result->mean_iterations + 4.0);
}

// Four clamps are more loose parts than Newton's method settles alone.
TEST(AssembledStatics, are_those_of_the_monolithic_reference) {
  for (const char* yield : {"1e9", "70e6"}) {
    const DeckRun latin = run_text(clamps, {{"bolts", "4"}, {"yield", yield}}).at(0);
    const DeckRun monolithic = run_text(clamps, {{"bolts", "4"}, {"yield", yield}, {"monolithic", "1"}}).at(0);
    expect_same(latin, monolithic, 1e-6);
    EXPECT_LT(monolithic.result->mean_iterations, 50.0);
  }
}

TEST(AssembledStatics, have_the_same_bits_for_any_number_of_threads) {
  const DeckRun one = run_text(clamps, {}, 1).at(0), two = run_text(clamps, {}, 2).at(0);
  EXPECT_EQ(one.column("head", "x"), two.column("head", "x"));
  EXPECT_EQ(one.column("at_shank2", "normal"), two.column("at_shank2", "normal"));
}

// Tractions of ties between unlike meshes that hardly move a stiff side come with the stiffness of the tie, which is to
// be that of the stiff side a thousand times over, not of the core.
TEST(AssembledStatics, solve_a_soft_core_glued_between_stiff_parts_in_as_few_iterations_as_a_linear_problem_is_worth) {
  const std::string panel = R"(
local p = param{ monolithic = 0, tolerance = 1e-8 }
local stiff = material.elastic{ name = "aluminium", young = 71*GPa, poisson = 0.33, density = 2800 }
local soft = material.elastic{ name = "honeycomb", young = 520*MPa, poisson = 0.3, density = 60 }
local function part(name, metal, at, size, cells)
  return substructure{ name = name, material = metal, mesh = mesh.box{ origin = at, size = size, cells = cells } }
end
local skin = part("skin", stiff, { 0, 0, -1*mm }, { 40*mm, 20*mm, 1*mm }, { 7, 4, 1 })
local core = part("core", soft, { 0, 0, 0 }, { 30*mm, 20*mm, 18*mm }, { 4, 3, 3 })
local edge = part("edge", stiff, { 30*mm, 0, 0 }, { 10*mm, 20*mm, 18*mm }, { 3, 5, 5 })
local cover = part("cover", stiff, { 0, 0, 18*mm }, { 40*mm, 20*mm, 1*mm }, { 9, 5, 1 })
local glue = interface.bonded{ name = "glue", between = "all touching", of = { skin, core, edge, cover } }
problem{ name = "panel", substructures = { skin, core, edge, cover }, interfaces = { glue },
  supports = { support.fixed{ name = "frame", on = edge:face "xmax" } },
  steps = { step.static{ name = "pull", loads = { load.traction{ on = cover:face "zmax", z = 1*MPa } } } },
  solver = p.monolithic == 1 and solver.monolithic{} or solver.latin{ static_steps = "assembled", static_tolerance = p.tolerance },
  outputs = { output.energy{}, output.history{ name = "tip", on = cover:face "xmin", quantity = "displacement" },
    output.joint{ name = "seam", on = glue["core/edge"] } } }:run{}
)";
  EXPECT_LE(run_text(panel).at(0).result->mean_iterations, 5.0);
  const DeckRun latin = run_text(panel, {{"tolerance", "1e-10"}}).at(0),
                monolithic = run_text(panel, {{"monolithic", "1"}}).at(0);
  EXPECT_TRUE(latin.result->converged);
  EXPECT_LT(difference(latin.column("tip", "z"), monolithic.column("tip", "z")), 1e-7);
  for (const char* column : {"normal", "shear"})
    EXPECT_LT(difference(latin.column("seam", column), monolithic.column("seam", column)), 1e-6) << column;
}

// What has nothing in common is no assembly of many parts: four clamps of three each are solved as one of them.
TEST(AssembledStatics, are_not_asked_for_by_many_copies_of_a_few_parts) {
  const std::string copies = R"(
local p = param{ n = 4, way = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local parts, joints, floors, loads, outputs = {}, {}, {}, {}, { output.energy{} }
for i = 1, p.n do
  local function part(name, z, cells)
    local made = substructure{ name = name .. i, material = steel, mesh = mesh.box{ origin = { i * 30*mm, 0, z }, size = { 10*mm, 10*mm, 5*mm }, cells = cells } }
    parts[#parts + 1] = made return made
  end
  local low, middle, high = part("low", 0, { 3, 3, 2 }), part("middle", 5*mm, { 4, 4, 2 }), part("high", 10*mm, { 3, 3, 2 })
  joints[#joints + 1] = interface.contact{ name = "lower" .. i, between = { low:face "zmax", middle:face "zmin" }, friction = 0.3 }
  outputs[#outputs + 1] = output.joint{ name = "lower" .. i, on = joints[#joints] }
  joints[#joints + 1] = interface.contact{ name = "upper" .. i, between = { middle:face "zmax", high:face "zmin" }, friction = 0.3 }
  floors[#floors + 1] = support.fixed{ name = "floor" .. i, on = low:face "zmin" }
  loads[#loads + 1] = load.pressure{ on = high:face "zmax", history = 20*MPa }
  loads[#loads + 1] = load.traction{ on = high:face "xmin", x = 5*MPa }
end
problem{ name = "copies", substructures = parts, interfaces = joints, supports = floors, outputs = outputs,
  steps = { step.static{ name = "press", loads = loads } }, solver = solver.latin{ static_steps = ({ [0] = "automatic", "assembled", "iterated" })[p.way] } }:run{}
)";
  const DeckRun one = run_text(copies, {{"n", "1"}}).at(0), four = run_text(copies).at(0);
  const DeckRun together = run_text(copies, {{"way", "1"}}).at(0);
  for (const char* joint : {"lower1", "lower4"})
    for (const char* column : {"normal", "shear"}) {
      EXPECT_LT(difference(four.column(joint, column), one.column("lower1", column)), 1e-6) << joint << " " << column;
      EXPECT_LT(difference(together.column(joint, column), one.column("lower1", column)), 1e-6)
          << joint << " " << column;
    }
  EXPECT_LT(four.result->mean_iterations, 1.5 * one.result->mean_iterations);
  EXPECT_EQ(run_text(copies, {{"way", "2"}}).at(0).column("lower2", "shear"), four.column("lower2", "shear"));
  EXPECT_NE(together.column("lower2", "shear"), four.column("lower2", "shear"));
}

}  // namespace
}  // namespace dygita::test::assembled_tests

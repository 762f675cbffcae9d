// What is not computed twice: equal substructures share a factor, what nothing has reached is not solved, factors are
// stored in single precision, interface fields go to a file. Each beside the run that does without.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::savings_tests {
namespace {

// A plate on a clamped side carries n equal posts in frictional contact, each pressed and hit in its own way.
const std::string standing_posts = R"(
local p = param{ n = 3, last = 1, plain = 0, single = 0, tolerance = 1e-9, history = 512 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local other = material.elastic{ name = "other", young = 210*GPa * p.last, poisson = 0.3, density = 7800 }
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { p.n * 4*mm, 2*mm, 2*mm }, cells = { 4 * p.n, 2, 2 } } }
local post_mesh = mesh.box{ size = { 2*mm, 2*mm, 4*mm }, cells = { 2, 2, 4 } }
local parts, joints, press, outputs = { plate }, {}, {}, { output.energy{} }
for i = 1, p.n do
  local post = substructure{ name = "post" .. i, material = i == p.n and other or steel, mesh = post_mesh, place = { (4*i - 3)*mm, 0, 2*mm } }
  parts[#parts + 1] = post
  joints[i] = interface.contact{ name = "foot" .. i, between = { plate:face "zmax", post:face "zmin" }, friction = 0.3 }
  press[i] = load.traction{ on = post:face "zmax", z = -20*MPa * i, x = 1*MPa }
  outputs[#outputs + 1] = output.history{ name = "top" .. i, on = post:face "zmax", quantity = "velocity" }
end
local base = support.fixed{ name = "base", on = plate:face "zmin" }
local set = step.static{ name = "set", loads = press }
local hit = step.dynamic{ name = "hit", after = set, duration = 6*us, dt = 0.1*us,
  loads = { load.traction{ on = parts[2]:face "zmax", z = history.half_sine{ peak = -80*MPa, duration = 2*us }, x = 1*MPa } } }
problem{ name = "posts", substructures = parts, interfaces = joints, supports = { base }, steps = { set, hit }, outputs = outputs,
  solver = solver.latin{ integration = 'implicit', tolerance = p.tolerance, static_tolerance = 1e-10, plain = p.plain == 1, static_steps = "iterated", precision = p.single == 1 and "single" or "double", history_memory = p.history } }:run{}
)";

// Sectors of a ring, each with a foot in frictional contact with a plate and tied to the next sector, all copies of one
// at 23 degrees to each other about an axis that is none of x, y and z; a post on each does not match its sector's
// mesh.
const std::string turned_sectors = R"(
local p = param{ n = 4, plain = 0, own = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local axis, step_angle = { 1, 2, 2 }, 23*deg
local n = p.n
local function copies(name, size, cells, origin)
  local list = {}
  local of = { name = name, material = steel, mesh = mesh.box{ size = size, cells = cells, origin = origin } }
  if p.own == 0 then return pattern.circle{ n = n, axis = axis, angle = step_angle, of = substructure(of) } end
  for i = 1, n do  -- a density of its own, by less than rounding would show
    of.name, of.place = name .. "[" .. i .. "]", { translate = { 0, 0, 0 }, rotate = { axis = axis, angle = (i - 1) * step_angle } }
    of.material = material.elastic{ name = "steel " .. name .. i, young = 210*GPa, poisson = 0.3, density = 7800 * (1 + i * 1e-13) }
    list[i] = substructure(of)
  end
  return list
end
local seats = copies("seat", { 4*mm, 4*mm, 2*mm }, { 4, 4, 2 }, { 20*mm, 0, -2*mm })
local sectors = copies("sector", { 4*mm, 4*mm, 3*mm }, { 4, 4, 3 }, { 20*mm, 0, 0 })
local posts = copies("post", { 2*mm, 2*mm, 4*mm }, { 3, 3, 4 }, { 21*mm, 1*mm, 3*mm })
local parts, joints, loads, hits, ends, bases, outputs = {}, {}, {}, {}, {}, {}, { output.energy{} }
for i = 1, n do
  for _, one in ipairs{ seats[i], sectors[i], posts[i] } do parts[#parts + 1] = one end
  joints[#joints + 1] = interface.contact{ name = "foot" .. i, between = { seats[i]:face "zmax", sectors[i]:face "zmin" }, friction = 0.3 }
  joints[#joints + 1] = interface.bonded{ name = "glue" .. i, between = { sectors[i]:face "zmax", posts[i]:face "zmin" } }
  bases[i] = seats[i]:face "zmin"
  ends[i] = posts[i]:face "xmax"
  loads[i] = load.pressure{ on = posts[i]:face "zmax", history = (10 + 3 * i)*MPa }
  hits[i] = load.pressure{ on = posts[i]:face "zmax", history = function(t) return (10 + 3 * i)*MPa * (1 + 0.4 * i * math.sin(math.pi * math.min(t / (2*us), 1))) end }
  outputs[#outputs + 1] = output.history{ name = "top" .. i, on = posts[i]:face "zmax", quantity = "velocity" }
end
hits[#hits + 1] = load.traction{ on = posts[2]:face "ymax", z = history.half_sine{ peak = -40*MPa, duration = 2*us }, x = 3*MPa }
local set = step.static{ name = "set", loads = loads }
local hit = step.dynamic{ name = "hit", after = set, duration = 6*us, dt = 0.1*us, loads = hits }
problem{ name = "turned", substructures = parts, interfaces = joints, steps = { set, hit }, outputs = outputs,
  supports = { support.fixed{ name = "base", on = bases }, support.absorbing{ name = "ends", on = ends } },
  solver = solver.latin{ integration = 'implicit', tolerance = 1e-9, static_tolerance = 1e-10, plain = p.plain == 1, static_steps = "iterated", precision = "double" } }:run{}
)";

constexpr const char* n_shared = "substructures that share another's factor, over all steps";

TEST(EqualSubstructures, share_a_factor_and_are_solved_as_if_each_had_its_own) {
  const DeckRun shared = run_text(standing_posts).at(0);
  EXPECT_TRUE(shared.result->converged);
  EXPECT_EQ(shared.figure(n_shared), 2 * 2);  // two of three posts, in two steps
  // A post that is not quite like the others has its own.
  const DeckRun own = run_text(standing_posts, {{"last", "1 + 1e-13"}}).at(0);
  EXPECT_EQ(own.figure(n_shared), 2 * 1);
  const DeckRun plain = run_text(standing_posts, {{"plain", "1"}}).at(0);
  for (const char* top : {"top1", "top2", "top3"})
    for (const char* axis : {"x", "z"}) {
      EXPECT_LT(difference(own.column(top, axis), shared.column(top, axis)), 1e-6) << top << axis;
      EXPECT_LT(difference(plain.column(top, axis), shared.column(top, axis)), 1e-6) << top << axis;
    }
  EXPECT_LT(shared.figure("memory of factors and interface operators [MB]"),
            0.85 * own.figure("memory of factors and interface operators [MB]"));
}

TEST(EqualSubstructures, at_any_angle_share_a_factor_and_are_solved_as_if_each_had_its_own) {
  const DeckRun shared = run_text(turned_sectors).at(0), own = run_text(turned_sectors, {{"own", "1"}}).at(0),
                plain = run_text(turned_sectors, {{"plain", "1"}}).at(0);
  EXPECT_TRUE(shared.result->converged);
  EXPECT_EQ(shared.figure(n_shared), 2 * 3 * 3);  // three of four seats, sectors and posts, in two steps
  EXPECT_EQ(own.figure(n_shared), 0);
  EXPECT_LT(shared.figure("memory of factors and interface operators [MB]"),
            0.4 * own.figure("memory of factors and interface operators [MB]"));
  for (const char* top : {"top2", "top3", "top4"})
    for (const char* axis : {"x", "y", "z"}) {
      EXPECT_LT(difference(own.column(top, axis), shared.column(top, axis)), 1e-6) << top << axis;
      EXPECT_LT(difference(plain.column(top, axis), shared.column(top, axis)), 1e-6) << top << axis;
    }
}

TEST(EqualSubstructures, more_than_sixteen_are_solved_in_groups) {
  const DeckRun many = run_text(standing_posts, {{"n", "18"}}).at(0),
                plain = run_text(standing_posts, {{"n", "18"}, {"plain", "1"}}).at(0);
  EXPECT_EQ(many.figure(n_shared), 2 * 17);
  for (const char* top : {"top1", "top9", "top18"})
    EXPECT_LT(difference(plain.column(top, "z"), many.column(top, "z")), 1e-6) << top;
}

TEST(SinglePrecision, of_what_is_stored_changes_results_less_than_the_tolerance_allows) {
  const Settings usual{{"tolerance", "1e-6"}}, single{{"tolerance", "1e-6"}, {"single", "1"}};
  const DeckRun a = run_text(standing_posts, usual).at(0), b = run_text(standing_posts, single).at(0);
  EXPECT_LT(b.figure("energy imbalance [%]"), 1e-3);
  for (const char* top : {"top1", "top2", "top3"})
    EXPECT_LT(difference(a.column(top, "z"), b.column(top, "z")), 2e-5) << top;
}

TEST(SinglePrecision, does_not_drift_in_four_thousand_increments) {
  const std::string flight = R"(
local p = param{ single = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", material = steel, velocity = { 3, 0, 1 }, mesh = mesh.box{ size = { 2*mm, 2*mm, 10*mm }, cells = { 3, 3, 12 } } }
local knock = step.dynamic{ name = "knock", duration = 400*us, dt = 0.1*us,
  loads = { load.traction{ on = bar:face "zmax", z = history.half_sine{ peak = 50*MPa, duration = 3*us } } } }
local tip = output.history{ name = "tip", on = bar:face "zmin", quantity = "displacement" }
problem{ name = "flight", substructures = { bar }, steps = { knock }, outputs = { tip, output.energy{} },
  solver = solver.latin{ integration = 'implicit', precision = p.single == 1 and "single" or "double" } }:run{}
)";
  const DeckRun a = run_text(flight).at(0), b = run_text(flight, {{"single", "1"}}).at(0);
  for (const char* axis : {"x", "z"}) EXPECT_LT(difference(a.column("tip", axis), b.column("tip", axis)), 1e-5) << axis;
  EXPECT_LT(b.figure("energy imbalance [%]"),
            1e-2);  // between two products by K the recurrence follows the stored factor
}

TEST(SinglePrecision, is_what_a_substructure_of_more_than_a_thousand_unknowns_is_stored_in) {
  const std::string block = R"(
local p = param{ n = 4, single = -1, tolerance = 1e-6 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { p.n, p.n, p.n } } }
local hit = step.dynamic{ name = "hit", duration = 1*us, dt = 0.25*us, loads = { load.pressure{ on = cube:face "zmax", history = 50*MPa } } }
problem{ name = "block", substructures = { cube }, supports = { support.wall{ name = "wall", on = cube:face "zmin" } }, steps = { hit }, outputs = { output.energy{} },
  solver = solver.latin{ integration = "implicit", tolerance = p.tolerance, precision = ({ [0] = "double", [1] = "single" })[p.single] } }:run{}
)";
  const auto megabytes = [&](const char* n, const char* single, const char* tolerance = "1e-6") {
    const Settings settings{{"n", n}, {"single", single}, {"tolerance", tolerance}};
    return run_text(block, settings).at(0).figure("memory of factors and interface operators [MB]");
  };
  EXPECT_EQ(megabytes("5", "-1"), megabytes("5", "0"));  // 648 unknowns
  EXPECT_EQ(megabytes("6", "-1"), megabytes("6", "1"));  // 1029
  EXPECT_LT(megabytes("6", "1"), 0.8 * megabytes("6", "0"));
  EXPECT_EQ(megabytes("6", "-1", "1e-8"), megabytes("6", "0", "1e-8"));
}

TEST(SinglePrecision, is_not_for_long_windows_and_the_warning_of_a_stall_says_so) {
  const std::string pressed = R"(
local p = param{ single = -1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 24*mm, 24*mm, 12*mm }, cells = { 8, 8, 5 } } } end
local a, b = block("a", 0), block("b", 12*mm)
local joint = interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 }
local hit = step.dynamic{ name = "hit", duration = 60*us, dt = 1*us, loads = { load.pressure{ on = b:face "zmax", history = history.half_sine{ peak = 40*MPa, duration = 20*us } } } }
problem{ name = "pressed", substructures = { a, b }, interfaces = { joint }, supports = { support.fixed{ name = "base", on = a:face "zmin" } }, steps = { hit }, outputs = { output.energy{} },
  solver = solver.latin{ integration = "implicit", window = "whole", precision = ({ [1] = "single" })[p.single] } }:run{}
)";
  const DeckRun usual = run_text(pressed).at(0);
  EXPECT_TRUE(usual.result->converged);
  EXPECT_LT(usual.figure("energy imbalance [%]"), 1e-4);
  testing::internal::CaptureStderr();
  EXPECT_FALSE(run_text(pressed, {{"single", "1"}}).at(0).result->converged);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("precision = \"double\""), std::string::npos);
}

// The last line of the report: "... degrees of freedom, ... increments in all, X MB for factors and interface
// operators, ...".
double predicted_megabytes(const Problem& problem) {
  const std::string report = check_report(problem);
  const size_t end = report.find(" MB for factors");
  if (end == std::string::npos) throw std::runtime_error("no memory in: " + report);
  return std::stod(report.substr(report.rfind(' ', end - 1) + 1));
}

TEST(Check, predicts_the_memory_within_a_fifth) {
  const std::string block = R"(
local p = param{ single = 0, tolerance = 1e-6, pieces = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = steel, mesh = mesh.box{ size = { 14*mm, 14*mm, 14*mm }, cells = { 14, 14, 14 } } }
local wall = support.wall{ name = "wall", on = cube:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 1*us, dt = 0.25*us, loads = { load.traction{ on = cube:face "zmax", z = -50*MPa } } }
problem{ name = "block", substructures = { cube }, supports = { wall }, steps = { hit }, outputs = { output.energy{} },
  solver = solver.latin{ integration = 'implicit', precision = p.single == 1 and "single" or "double", tolerance = p.tolerance, pieces = p.pieces } }:run{}
)";
  for (const Settings& settings : {Settings{}, Settings{{"pieces", "4"}}, Settings{{"single", "1"}},
                                   Settings{{"single", "1"}, {"tolerance", "1e-4"}}}) {
    const DeckRun run = run_text(block, settings).at(0);
    const double held = run.figure("memory of factors and interface operators [MB]");
    EXPECT_NEAR(predicted_megabytes(run.problem), held, 0.2 * held);
  }
}

TEST(QuietSubstructures, are_not_solved_until_something_reaches_them) {
  const std::string chain = R"(
local p = param{ n = 12, plain = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bars, ties = {}, {}
for i = 1, p.n do
  bars[i] = substructure{ name = "bar" .. i, material = steel, mesh = mesh.box{ origin = { 0, 0, (i - 1) * 4*mm }, size = { 2*mm, 2*mm, 4*mm }, cells = { 2, 2, 8 } } }
  if i > 1 then ties[#ties + 1] = interface.bonded{ name = "tie" .. i, between = { bars[i - 1]:face "zmax", bars[i]:face "zmin" } } end
end
local knock = step.dynamic{ name = "knock", duration = 6*us, dt = 0.1*us,
  loads = { load.traction{ on = bars[1]:face "zmin", z = history.half_sine{ peak = 50*MPa, duration = 2*us } } } }
local tip = output.history{ name = "tip", on = bars[6]:face "zmax", quantity = "velocity", direction = { 0, 0, 1 } }
problem{ name = "chain", substructures = bars, interfaces = ties, steps = { knock }, outputs = { tip, output.energy{} },
  solver = solver.latin{ integration = 'implicit', plain = p.plain == 1 } }:run{}
)";
  const DeckRun quiet = run_text(chain).at(0), plain = run_text(chain, {{"plain", "1"}}).at(0);
  EXPECT_LT(difference(plain.column("tip", "velocity"), quiet.column("tip", "velocity")), 1e-5);
  EXPECT_LT(quiet.figure("energy imbalance [%]"), 1e-3);
  // The wave travels 36 of 48 mm: on average more than half of the bars rest.
  const double spared = quiet.figure("substitutions spared where nothing changed"),
               solved = quiet.figure("substitutions");
  EXPECT_GT(spared, 0.3 * (spared + solved));
  EXPECT_LT(spared, 0.7 * (spared + solved));
}

// A washer between two plates is nothing but interface: full solves of it are cheaper than products with its operator.
TEST(ThinSubstructures, are_solved_in_full_and_give_the_same) {
  const std::string washer = R"(
local p = param{ plain = 0, tie = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function plate(name, z, t, k)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 20*mm, 20*mm, t }, cells = { 20, 20, k } } }
end
local low, washer, up = plate("low", 0, 3*mm, 3), plate("washer", 3*mm, 1*mm, 1), plate("up", 4*mm, 3*mm, 3)
local a = interface.contact{ name = "a", between = { low:face "zmax", washer:face "zmin" }, friction = 0.2 }
local between = { washer:face "zmax", up:face "zmin" }
local b = p.tie == 1 and interface.bonded{ name = "b", between = between } or interface.contact{ name = "b", between = between, friction = 0.2 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local press = step.static{ name = "press", loads = { load.traction{ on = up:face "zmax", z = -50*MPa } } }
local hit = step.dynamic{ name = "hit", after = press, duration = 5*us, dt = 0.2*us, loads = { load.traction{ on = up:face "zmax", z = history.half_sine{ peak = -100*MPa, duration = 3*us }, x = 10*MPa } } }
local top = output.history{ name = "top", on = up:face "zmax", quantity = "velocity" }
problem{ name = "washer", substructures = { low, washer, up }, interfaces = { a, b }, supports = { base }, steps = { press, hit }, outputs = { top, output.energy{} },
  solver = solver.latin{ integration = 'implicit', plain = p.plain == 1, tolerance = 1e-8, static_tolerance = 1e-10 } }:run{}
)";
  for (const char* tie : {"0", "1"}) {
    const DeckRun run = run_text(washer, {{"tie", tie}}).at(0),
                  plain = run_text(washer, {{"tie", tie}, {"plain", "1"}}).at(0);
    EXPECT_TRUE(run.result->converged);
    EXPECT_EQ(run.figure("pieces solved in full at each iteration, over all steps"), 2);
    for (const char* axis : {"x", "z"})
      EXPECT_LT(difference(plain.column("top", axis), run.column("top", axis)), 1e-6) << axis;
  }
}

TEST(InterfaceFields, beyond_the_budget_come_back_from_a_file) {
  std::string text = standing_posts;
  text.replace(text.find("problem{"), 8, "local function case(start)\nreturn problem{");
  text.replace(text.find(":run{}"), 6,
               ":run{ start_from = start, case = start and 'again' or 'first' }\nend\ncase(case())\n");
  const auto in_memory = run_text(text), in_file = run_text(text, {{"history", "0.01"}});
  EXPECT_EQ(in_memory.at(0).figure("interface fields kept in a file [MB]"), 0.0);
  EXPECT_GT(in_file.at(0).figure("interface fields kept in a file [MB]"), 0.01);
  EXPECT_LE(in_file.at(0).figure("interface fields kept in memory [MB]"), 0.01);
  EXPECT_LT(in_memory.at(1).result->iterations, 0.3 * in_memory.at(0).result->iterations);
  EXPECT_EQ(in_file.at(1).result->iterations, in_memory.at(1).result->iterations);
  EXPECT_EQ(in_file.at(1).column("top1", "z"), in_memory.at(1).column("top1", "z"));
}

}  // namespace
}  // namespace dygita::test::savings_tests

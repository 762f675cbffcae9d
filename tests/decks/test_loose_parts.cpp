// Parts that nothing holds and nothing touches rest in static steps, however these are solved.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::loose_parts_tests {
namespace {

// A lid above a column that a ring of forces makes shorter, or longer, and moves sideways.
const std::string lidded = R"(
local p = param{ gap = 2, pull = -4000, symmetric = 0 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local column = substructure{ name = "column", material = alloy, mesh = mesh.box{ size = { 20*mm, 20*mm, 60*mm }, cells = { 3, 3, 8 } } }
local lid = substructure{ name = "lid", material = alloy, mesh = mesh.box{ origin = { 0, 0, 60*mm }, size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 } } }
local contact = interface.contact{ name = "contact", between = { column:face "zmax", lid:face "zmin" }, friction = 0.3, gap = p.gap*um }
local ring = load.force{ on = column:where(function(x, y, z) return z > 29.9*mm and z < 52.4*mm end), z = p.pull, x = 200 }
local supports = { support.fixed{ name = "floor", on = column:face "zmin" } }
if p.symmetric == 1 then supports[2] = support.symmetry{ name = "half", on = { column:face "ymin", lid:face "ymin" } } end
problem{ name = "lidded", substructures = { column, lid }, interfaces = { contact }, supports = supports,
  steps = { step.static{ name = "press", increments = 2, loads = { ring } } },
  outputs = { output.joint{ name = "contact", on = contact },
              output.history{ name = "column", on = column:face "zmax", quantity = "displacement" },
              output.history{ name = "lid", on = lid:face "zmin", quantity = "displacement" } } }:run{}
)";

constexpr const char* solvers[] = {"latin{ static_steps = 'iterated' }", "latin{ static_steps = 'assembled' }",
                                   "monolithic"};

TEST(LoosePart, rests_where_what_is_under_it_goes_away) {
  for (const char* solver : solvers)
    for (const char* gap : {"2", "0"})
      for (const char* symmetric : {"0", "1"}) {
        const DeckRun run = run_text(lidded, {{"gap", gap}, {"symmetric", symmetric}}, 0, solver)[0];
        EXPECT_LT(run.column("column", "z").back(), -4e-6);
        for (const char* of : {"x", "y", "z"})
          EXPECT_NEAR(run.column("lid", of).back(), 0.0, 1e-11)
              << solver << " " << gap << " " << symmetric << " " << of;
        EXPECT_EQ(run.column("contact", "normal").back(), 0.0);
      }
}

// Loads that differ by their last digits come to the end in other ways: after one in thirty the lid was pushed.
TEST(LoosePart, rests_whatever_the_last_digits_are) {
  for (int i = 0; i < 100; ++i) {
    const std::string pull = "-4000.0000" + std::to_string(1000 + i);
    const DeckRun run = run_text(lidded, {{"gap", "0"}, {"symmetric", "1"}, {"pull", pull}}, 0, solvers[1])[0];
    ASSERT_TRUE(run.result->converged) << pull;
    for (const char* of : {"x", "z"}) EXPECT_NEAR(run.column("lid", of).back(), 0.0, 1e-14) << pull << of;
  }
}

// Two blocks pressed together at 100 MPa and let go, beside one that stays under load; then the base is shaken.
const std::string let_go = R"(
local p = param{ increments = 2, on_wall = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, x, z) return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { x, 0, z }, size = { 10*mm, 10*mm, 20*mm }, cells = { 2, 2, 4 } } } end
local low, high, other = block("low", 0, 0), block("high", 0, 20*mm), block("other", 50*mm, 0)
local seat = interface.contact{ name = "seat", between = { low:face "zmax", high:face "zmin" }, friction = 0.3 }
local wall = support.wall{ name = "wall", on = low:face "zmin", friction = 0.3 }
local held = support.fixed{ name = "held", on = p.on_wall == 1 and { other:face "zmin" } or { low:face "zmin", other:face "zmin" } }
local function loads(pressure) return { load.pressure{ on = high:face "zmax", history = pressure }, load.pressure{ on = other:face "zmax", history = 300*MPa } } end
local press = step.static{ name = "press", increments = 2, loads = loads(100*MPa) }
local let_go = step.static{ name = "let_go", after = press, increments = p.increments, loads = loads(0) }
local steps = { press, let_go }
if p.on_wall == 0 then
  steps[3] = step.dynamic{ name = "shock", after = let_go, duration = 40*us, dt = 0.5*us, loads = { load.pressure{ on = other:face "zmax", history = 300*MPa },
    load.base_acceleration{ on = held, direction = { 0, 0, 1 }, history = history.half_sine{ peak = 2000, duration = 20*us } } } }
end
problem{ name = "let_go", substructures = { low, high, other }, interfaces = { seat }, supports = { held, p.on_wall == 1 and wall or nil }, steps = steps,
  outputs = { output.joint{ name = "seat", on = seat }, output.momentum{ name = "high", of = high } } }:run{}
)";

TEST(LoosePart, rests_where_a_load_is_taken_off) {
  const double momentum = run_text(let_go, {}, 0, "monolithic")[0].column("high", "z").back();
  EXPECT_GT(momentum, 5e-4);
  for (const char* n : {"1", "2", "4"}) {
    const DeckRun shaken = run_text(let_go, {{"increments", n}}, 0, solvers[0])[0];
    EXPECT_NEAR(shaken.column("high", "z").back(), momentum, 0.03 * momentum) << n;
    const DeckRun on_wall = run_text(let_go, {{"increments", n}, {"on_wall", "1"}}, 0, solvers[0])[0];
    EXPECT_NEAR(on_wall.column("seat", "opening").back(), 0.0, 1e-12) << n;
    EXPECT_LT(on_wall.result->figures.energy_gain.value(), 0.5) << n;
  }
}

// Blocks in a row, a micrometre apart: the first one is moved by 5 um and back to -5 um, or drawn away at once.
TEST(LoosePart, in_a_row_moves_as_far_as_it_is_pushed) {
  const std::string row = R"(
local p = param{ first = 5, second = -5 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local blocks, seats, sides, outputs = {}, {}, {}, {}
for i = 1, 4 do
  blocks[i] = substructure{ name = "b" .. i, material = steel, mesh = mesh.box{ size = { 5*mm, 5*mm, 10*mm }, cells = { 1, 1, 2 }, origin = { 0, 0, (i - 1) * 10*mm } } }
  sides[#sides + 1], sides[#sides + 2] = blocks[i]:face "xmin", blocks[i]:face "ymin"
  if i > 1 then seats[i - 1] = interface.contact{ name = "c" .. i, between = { blocks[i - 1]:face "zmax", blocks[i]:face "zmin" }, gap = 1*um } end
  outputs[i] = output.history{ name = "u" .. i, on = blocks[i]:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
end
local guide = support.symmetry{ name = "guide", on = sides }
local function move(name, after, z) return step.static{ name = name, after = after, loads = { load.displacement{ on = blocks[1]:face "zmin", z = z*um } } } end
local one = move("one", nil, p.first)
problem{ name = "row", substructures = blocks, interfaces = seats, supports = { guide }, steps = { one, move("two", one, p.second) }, outputs = outputs }:run{}
)";
  for (const char* solver : {solvers[0], solvers[1]}) {
    const DeckRun pushed = run_text(row, {}, 0, solver)[0], drawn = run_text(row, {{"first", "-5"}}, 0, solver)[0];
    const std::vector<double> ends = {-5e-6, 4e-6, 3e-6, 2e-6};
    for (int i = 0; i < 4; ++i) {
      const std::string name = "u" + std::to_string(i + 1);
      EXPECT_NEAR(pushed.column(name, "displacement").back(), ends[static_cast<size_t>(i)], 1e-12) << solver << name;
      EXPECT_NEAR(drawn.column(name, "displacement").back(), i == 0 ? -5e-6 : 0.0, 1e-12) << solver << name;
    }
  }
}

// Plates pressed at 100 MPa and let go, whose meshes do not match: a lid must not fly.
TEST(LoosePart, between_unlike_meshes_stays_where_it_was) {
  const std::string plates = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local parts, seats, outputs = {}, {}, {}
for i = 1, 3 do
  local n = i % 2 == 0 and 2 or 3
  parts[i] = substructure{ name = "p" .. i, material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 5*mm }, cells = { n, n, 2 }, origin = { 0, 0, (i - 1) * 5*mm } } }
  if i > 1 then seats[i - 1] = interface.contact{ name = "c" .. i, between = { parts[i - 1]:face "zmax", parts[i]:face "zmin" } } end
  outputs[i] = output.history{ name = "u" .. i, on = parts[i]:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
end
local base = support.fixed{ name = "base", on = parts[1]:face "zmin" }
local function press(name, after, p) return step.static{ name = name, after = after, loads = { load.pressure{ on = parts[3]:face "zmax", history = p } } } end
local on = press("on", nil, 100*MPa)
problem{ name = "plates", substructures = parts, interfaces = seats, supports = { base }, steps = { on, press("off", on, 0) }, outputs = outputs }:run{}
)";
  for (const char* solver : solvers) {
    const DeckRun run = run_text(plates, {}, 0, solver)[0];
    EXPECT_TRUE(run.result->converged) << solver;
    for (const char* name : {"u1", "u2", "u3"})
      EXPECT_NEAR(run.column(name, "displacement").back(), 0.0, 1e-8) << solver << name;
  }
}

// Two plates beside the middle of a base, pressed and let go, while another place of the base is pressed: they have
// slid outwards and come back with the base as far as friction has held them, not as the next system happens to have
// them.
TEST(LoosePart, on_a_base_that_moves_is_where_friction_has_left_it) {
  const std::string plates = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local function box(name, x, z, sx, sz, cells) return substructure{ name = name, material = steel, mesh = mesh.box{ size = { sx*mm, 20*mm, sz*mm }, cells = cells, origin = { x*mm, 0, z*mm } } } end
local base, low, high, beside = box("base", -30, -10, 60, 10, { 6, 2, 2 }), box("low", -20, 0, 20, 5, { 2, 2, 1 }), box("high", -20, 5, 20, 5, { 2, 2, 1 }), box("beside", 10, 0, 20, 5, { 2, 2, 1 })
local function seat(name, a, b) return interface.contact{ name = name, between = { a:face "zmax", b:face "zmin" }, friction = 0.2 } end
local function push(name, after, here, there)
  return step.static{ name = name, after = after, loads = { load.pressure{ on = high:face "zmax", history = here*MPa }, load.pressure{ on = beside:face "zmax", history = there*MPa } } }
end
local on = push("on", nil, 100, 0)
local off = push("off", on, 0, 0)
problem{ name = "plates", substructures = { base, low, high, beside }, interfaces = { seat("c1", base, low), seat("c2", low, high), seat("c3", base, beside) },
  supports = { support.fixed{ name = "floor", on = base:face "zmin" } }, steps = { on, off, push("beside", off, 0, 100) },
  outputs = { output.history{ name = "u", on = high:face "zmax", quantity = "displacement" } } }:run{}
)";
  const DeckRun asked = run_text(plates, {}, 0, solvers[0])[0];
  const std::vector<double> x = asked.column("u", "x");
  EXPECT_GT(std::abs(x.back()), 1e-8);
  for (const char* solver : solvers) {
    const DeckRun run = run_text(plates, {}, 0, solver)[0];
    EXPECT_TRUE(run.result->converged) << solver;
    for (size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(run.column("u", "x")[i], x[i], 0.02 * std::abs(x[1])) << solver << i;
  }
}

TEST(LoosePart, is_pushed_by_what_comes) {
  for (const char* solver : solvers) {
    const DeckRun run = run_text(lidded, {{"pull", "4000"}}, 0, solver)[0];
    const double column = run.column("column", "z").back(), lid = run.column("lid", "z").back();
    EXPECT_GT(column, 4e-6);
    EXPECT_GT(lid, column - 2.5e-6) << solver;  // of corners that tilt, besides the gap
    EXPECT_LT(lid, column + 1e-6) << solver;
  }
}

// An interference of 10 um pushes a block off, that nothing holds.
TEST(LoosePart, that_an_interference_presses_out_goes_as_far_as_that_and_rests) {
  const std::string pressed_out = R"(
local p = param{ increments = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function box(name, z) return substructure{ name = name, material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 }, origin = { 0, 0, z } } } end
local low, high = box("low", 0), box("high", 10*mm)
local fit = interface.contact{ name = "fit", between = { low:face "zmax", high:face "zmin" }, friction = 0.3, gap = -10*um }
problem{ name = "pressed_out", substructures = { low, high }, interfaces = { fit }, supports = { support.fixed{ name = "floor", on = low:face "zmin" } },
  steps = { step.static{ name = "press", increments = p.increments } },
  outputs = { output.history{ name = "u", on = high:face "zmax", quantity = "displacement" }, output.joint{ name = "fit", on = fit } } }:run{}
)";
  for (const char* solver : solvers)
    for (const char* increments : {"1", "2", "3", "10"}) {
      const DeckRun run = run_text(pressed_out, {{"increments", increments}}, 0, solver)[0];
      // In one system forces of nothing stand still at 1e-8 N, which is not to the tolerance of nothing.
      if (std::string(solver).find("assembled") == std::string::npos) {
        EXPECT_TRUE(run.result->converged) << solver << increments;
      }
      const std::vector<double>& z = run.column("u", "z");
      for (size_t i = 1; i < z.size(); ++i) EXPECT_NEAR(z[i], 10e-6, 1e-3 * 10e-6) << solver << increments << " " << i;
      EXPECT_NEAR(run.column("fit", "normal").back(), 0.0, 1e-3) << solver << increments;
    }
}

// A block beside which the base is bent: a bulge lifts it, and no force says where it comes to rest.
TEST(LoosePart, that_touches_nothing_in_the_end_is_told) {
  const std::string bent = R"(
local p = param{ press = 0, friction = 0, hold = 0 }
local alloy = material.elastic{ name = "alloy", young = 51*GPa, poisson = 0, density = 1000 }
local function box(name, origin, size, cells) return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = origin, size = size, cells = cells } } end
local base = box("base", { 0, 0, 0 }, { 6*mm, 8*mm, 6*mm }, { 3, 4, 3 })
local block = box("block", { 0, 2*mm, 6*mm }, { 4*mm, 8*mm, 6*mm }, { 2, 4, 3 })
local arm = box("arm", { -2*mm, -6*mm, 6*mm }, { 6*mm, 8*mm, 6*mm }, { 1, 1, 1 })
local seat = interface.contact{ name = "seat", between = { base:face "zmax", block:face "zmin" }, friction = p.friction }
local supports = { support.fixed{ name = "floor", on = base:face "zmin" } }
if p.hold == 1 then supports[2] = support.fixed{ name = "hold", on = block:face "ymax" } end
local loads = { load.pressure{ on = arm:face "xmax", history = 0.86*MPa } }
if p.press == 1 then loads[2] = load.pressure{ on = block:face "zmax", history = 0.5*MPa } end
problem{ name = "bent", substructures = { base, block, arm }, interfaces = { seat, interface.bonded{ name = "foot", between = { arm:face "zmin", base:face "zmax" } } },
  supports = supports, steps = { step.static{ name = "bend", loads = loads } } }:run{}
)";
  const auto told = [&](const Settings& settings, const char* solver) {
    const DeckRun run = run_text(bent, settings, 0, solver)[0];
    int n = 0;
    for (const std::string& warning : run.result->warnings)
      n += warning.find("at its end no force acts on substructure 'block': contact 'seat' is open by up to 1.") !=
           std::string::npos;
    return n;
  };
  for (const char* solver : solvers) {
    EXPECT_EQ(told({}, solver), 1) << solver;
    EXPECT_EQ(told({{"press", "1"}, {"friction", "0.3"}}, solver), 0) << solver;
    EXPECT_EQ(told({{"hold", "1"}}, solver), 0) << solver;
  }
}

// A block of 0.6 N, 0.01 mm above a table: a force beside which its contacts are stiff brings it down.
TEST(LoosePart, falls_across_a_gap_under_its_own_weight) {
  const std::string above = R"(
local p = param{ guided = 1, n = 2, increments = 1, mu = 0, pressure = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local base = substructure{ name = "table", material = steel, mesh = mesh.box{ origin = { 0, 0, -10*mm }, size = { 20*mm, 20*mm, 10*mm }, cells = { 2, 2, 2 } } }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { p.n, p.n, p.n } } }
local contact = interface.contact{ name = "contact", between = { block:face "zmin", base:face "zmax" }, gap = 0.01*mm, friction = p.mu }
local supports = { support.fixed{ name = "floor", on = base:face "zmin" } }
if p.guided == 1 then supports[2] = support.symmetry{ name = "guide", on = { block:face "xmin", block:face "ymin" } } end
local loads = { load.gravity{ z = -10 } }
if p.pressure > 0 then loads = { load.pressure{ on = block:face "zmax", history = p.pressure } } end
problem{ name = "above", substructures = { base, block }, interfaces = { contact }, supports = supports,
  steps = { step.static{ name = "fall", increments = p.increments, loads = loads } },
  outputs = { output.joint{ name = "contact", on = contact }, output.history{ name = "block", on = block:face "zmax", quantity = "displacement" } } }:run{}
)";
  for (const char* solver : {"latin{}", "latin{ static_steps = 'assembled' }", "monolithic"})
    for (const char* guided : {"0", "1"})
      for (const char* n : {"1", "2", "3"})
        for (const char* mu : {"0", "0.3"})
          for (const char* pressure : {"0", "1e4"})
            for (const char* increments : {"1", "3"}) {
              const DeckRun run = run_text(
                  above, {{"guided", guided}, {"n", n}, {"mu", mu}, {"pressure", pressure}, {"increments", increments}},
                  1, solver)[0];
              const std::string what = fmt::format("{} guided {} n {} mu {} pressure {} increments {}", solver, guided,
                                                   n, mu, pressure, increments);
              EXPECT_TRUE(run.result->converged) << what;
              const double load = pressure[0] == '0' ? 7800 * 8e-6 * 10.0 : 4.0;
              EXPECT_NEAR(run.column("contact", "normal").back(), -load, 1e-5 * load) << what;
              EXPECT_NEAR(run.column("block", "z").back(), -1e-5 - load / 4e-4 * 0.03 / 210e9, 2e-10) << what;
            }
}

}  // namespace
}  // namespace dygita::test::loose_parts_tests

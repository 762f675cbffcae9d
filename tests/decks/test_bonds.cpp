// Bonds between meshes that do not match, beside other interfaces of the same face: the points that they have, and what
// they hold.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "decks/engine.hpp"

namespace dygita::test::bonds_tests {
namespace {

// A leaf that is held on its back, a block bonded to the upper part of its face, and below that, across a gap, another
// block in contact with it, never loaded.
const std::string hinge = R"(
local p = param{ touches = 1, layers = 6, top = 20 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, low, high, cells)
  return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { low[1]*mm, low[2]*mm, low[3]*mm },
    size = { (high[1] - low[1])*mm, (high[2] - low[2])*mm, (high[3] - low[3])*mm }, cells = cells } }
end
local leaf = block("leaf", { 0, -30, 8 }, { 8, 30, 46 }, { 1, 5, p.layers })
local upper = block("upper", { -27, -30, 24 }, { 0, 30, 46 }, { 2, 4, 2 })
local parts, joints = { leaf, upper }, { interface.bonded{ name = "glue", between = { leaf:face "xmin", upper:face "xmax" } } }
local held = { leaf:face "xmax" }
if p.touches == 1 then
  local lower = block("lower", { -27, -30, 8 }, { 0, 30, p.top }, { 3, 5, 2 })
  parts[3], held[2] = lower, lower:face "xmin"
  joints[2] = interface.contact{ name = "touch", between = { leaf:face "xmin", lower:face "xmax" } }
end
problem{ name = "hinge", substructures = parts, interfaces = joints, supports = { support.fixed{ name = "wall", on = held } },
  steps = { step.static{ name = "pull", loads = { load.force{ on = upper:face "xmin", z = -1000 } } } },
  outputs = { output.history{ name = "u", on = upper:face "xmin", quantity = "displacement" } } }:run{}
)";

TEST(Bond, keeps_its_points_beside_a_contact_that_it_does_not_meet) {
  const auto deflection = [](const Settings& settings) { return run_text(hinge, settings)[0].column("u", "z").back(); };
  for (const char* layers : {"6", "3"}) {
    const double alone = deflection({{"layers", layers}, {"touches", "0"}});
    for (const char* top : {"20", "21", "23.5"})
      EXPECT_NEAR(deflection({{"layers", layers}, {"top", top}}), alone, 1e-3 * std::abs(alone))
          << layers << " " << top;
  }
}

// Two blocks side by side on a plate, not touching each other, each bonded to it, under mirror images of a load.
const std::string pair = R"(
local p = param{ order = 1, cells = 9, on_plate = 0 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, low, high, cells)
  return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { low[1]*mm, low[2]*mm, low[3]*mm },
    size = { (high[1] - low[1])*mm, (high[2] - low[2])*mm, (high[3] - low[3])*mm }, cells = cells } }
end
local plate = block("plate", { -48, -30, 0 }, { 48, 30, 8 }, { p.cells, 5, 1 })
local left = block("left", { -30, -30, 8 }, { -0.25, 30, 40 }, { 3, 4, 3 })
local right = block("right", { 0.25, -30, 8 }, { 30, 30, 40 }, { 3, 4, 3 })
local function glue(block)
  return interface.bonded{ name = block.name .. " glue", between = { plate:face "zmax", block:face "zmin" }, points = p.on_plate == 1 and "first" or nil }
end
local a, b = glue(left), glue(right)
problem{ name = "pair", substructures = { plate, left, right }, interfaces = p.order == 1 and { a, b } or { b, a },
  supports = { support.fixed{ name = "floor", on = plate:face "zmin" } },
  steps = { step.static{ name = "part", loads = { load.force{ on = left:face "zmax", x = 100 }, load.force{ on = right:face "zmax", x = -100 } } } },
  outputs = { output.history{ name = "left", on = left:face "zmax", quantity = "displacement" },
              output.history{ name = "right", on = right:face "zmax", quantity = "displacement" } } }:run{}
)";

TEST(Bonds, side_by_side_hold_alike_in_whatever_order_they_are_declared) {
  for (const char* cells : {"9", "7"})
    for (const char* order : {"1", "2"}) {
      const DeckRun run = run_text(pair, {{"cells", cells}, {"order", order}})[0];
      const double left = run.column("left", "x").back(), right = run.column("right", "x").back();
      EXPECT_NEAR(left, -right, 1e-6 * std::abs(left)) << cells << " " << order;
      EXPECT_LT(left, 0.4e-6);
    }
}

// The plate's cells are so large that one row of its nodes lies under each block, which the points at the rim of what
// is covered hold all the same, whichever face has them.
TEST(Bonds, on_large_cells_are_no_hinges_whichever_face_has_the_points) {
  const auto right = [](const Settings& settings) { return -run_text(pair, settings)[0].column("right", "x").back(); };
  const double fine = right({{"cells", "36"}});
  for (const char* on_plate : {"0", "1"})
    EXPECT_NEAR(right({{"cells", "6"}, {"on_plate", on_plate}}), fine, 0.1 * fine);
}

// Two cubes in a row that nothing holds, joined face to face, the second one thrown.
const std::string thrown = R"(
local p = param{ joint = 1, cells = 2, order = 1, how = 1, tuned = 0, pieces = 1, x = 0, y = 1, z = -5, dt = 0.5, base = 0, speed = 0 }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local function cube(name, n, x, v) return substructure{ name = name, material = m, velocity = v, place = { x, 0, 0 },
  mesh = mesh.box{ size = { 8*mm, 8*mm, 8*mm }, cells = { n, n, n }, order = p.order } } end
local a, b = cube("a", 2, 0, { 0, 0, 0 }), cube("b", p.cells, 8*mm, { p.x, p.y, p.z })
local sides = { a:face "xmax", b:face "xmin" }
local tie = p.joint == 1 and interface.bonded{ name = "tie", between = sides }
  or interface.plastic{ name = "tie", between = sides, yield = p.joint == 2 and 1e10 or 30*MPa, hardening = p.joint == 4 and 1e12 or 0 }
local fly = step.dynamic{ name = "fly", duration = 20*us, dt = p.dt*us,
  loads = p.speed ~= 0 and { load.velocity{ on = a:face "zmin", x = p.speed } } or {} }
problem{ name = "thrown", substructures = { a, b }, interfaces = { tie }, steps = { fly },
  supports = p.base == 1 and { support.fixed{ name = "base", on = a:face "zmin" } } or {},
  solver = solver.latin{ integration = p.how == 1 and "implicit" or "explicit", mass = p.tuned == 1 and "tuned" or "lumped", pieces = p.pieces, tolerance = 1e-9 },
  outputs = { output.energy{}, output.momentum{ name = "pa", of = a }, output.momentum{ name = "pb", of = b },
              output.resultant{ name = "through", on = tie }, output.joint{ name = "joint", on = tie } } }:run{}
)";

// The energy books of a flight: what was given, what the impact at its start took, what was left then, the largest that
// there is later.
struct Flight {
  double given, lost, left, most;
};

// Central differences exchange energy with what they themselves store.
double closes_within(const std::string& solver) { return solver == "explicit" ? 0.04 : 1e-6; }

Flight books_of(const DeckRun& run, const std::string& solver) {
  const std::vector<double>&kinetic = run.column("energy", "kinetic"), &strain = run.column("energy", "strain"),
        &scheme = run.column("energy", "scheme"), &balance = run.column("energy", "balance");
  Flight flight{kinetic[0] + scheme[0], scheme[0], kinetic[0] + strain[0], 0.0};
  for (size_t i = 0; i < kinetic.size(); ++i) {
    flight.most = std::max(flight.most, kinetic[i] + strain[i]);
    EXPECT_NEAR(balance[i], 0.0, closes_within(solver) * flight.given) << solver << i;
  }
  return flight;
}

constexpr double energy_given = 0.5 * 8000 * 512e-9 * 26;  // J, of v = (0, 1, -5)

// Everything that can join them, by every solver: energy is never more than there was, and momentum is handed on.
TEST(Thrown, parts_that_are_joined_gain_no_energy_and_keep_their_momentum) {
  const std::vector<Settings> joints = {{},
                                        {{"cells", "3"}},
                                        {{"joint", "2"}},
                                        {{"joint", "2"}, {"cells", "3"}},
                                        {{"pieces", "3"}, {"cells", "4"}},
                                        {{"how", "2"}},
                                        {{"how", "2"}, {"cells", "3"}},
                                        {{"how", "2"}, {"cells", "4"}, {"tuned", "1"}},
                                        {{"cells", "3"}, {"tuned", "1"}},
                                        {{"order", "2"}, {"cells", "3"}},
                                        {{"order", "2"}}};
  for (const char* solver : {"", "monolithic", "explicit"})
    for (const char* dt : {"0.1", "0.5"})
      for (Settings settings : joints) {
        const bool is_latin = std::string(solver).empty();
        std::string what = std::string(solver) + " " + dt;
        for (const auto& [name, value] : settings) what += " " + name + " " + value;
        const bool is_quadratic = what.find("order") != std::string::npos;
        if (!is_latin && (what.find("how") != std::string::npos || what.find("pieces") != std::string::npos)) continue;
        if (std::string(solver) == "explicit" && is_quadratic) continue;
        settings.emplace_back("dt", dt);
        testing::internal::CaptureStderr();
        const DeckRun run = run_text(thrown, settings, 1, solver)[0];
        EXPECT_NE(testing::internal::GetCapturedStderr().find("start with different velocities ('tie')"),
                  std::string::npos)
            << what;
        const Flight flight = books_of(run, solver);
        std::printf("%-45s lost %.3f %% at once, at most %.4f of what there was\n", what.c_str(),
                    100 * flight.lost / flight.given, flight.most / flight.given);
        EXPECT_NEAR(flight.given, energy_given, 1e-9 * energy_given) << what;
        EXPECT_GT(flight.lost, 0.01 * energy_given) << what;
        EXPECT_LT(flight.most, (1 + closes_within(solver)) * flight.left) << what;
        const std::vector<double>&a = run.column("pa", "z"), &b = run.column("pb", "z"),
              &f = run.column("through", "z");
        const double all = -5 * 8000 * 512e-9;
        EXPECT_NEAR(a.front() + b.front(), all, 1e-9 * -all) << what;
        EXPECT_NEAR(a.back() + b.back(), all, 1e-6 * -all) << what;
        double impulse = 0.0;
        for (const double force : f) impulse += force * std::stod(dt) * 1e-6;
        EXPECT_NEAR(a.back() - a.front(), impulse, 1e-5 * -all) << what;
      }
}

// Of two equal layers of nodes that meet as one, half of the relative energy goes: of cubes of two cells, an eighth.
TEST(Thrown, parts_lose_what_the_layer_of_nodes_between_them_had) {
  for (const char* solver : {"", "monolithic", "explicit"}) {
    const Flight flight = books_of(run_text(thrown, {}, 1, solver)[0], solver);
    EXPECT_NEAR(flight.lost, energy_given / 8, 1e-9 * energy_given) << solver;
  }
}

// A tie that yields at less than would stop the parts lets them go on: at rho c v/2 > R it opens at v - 2 R/(rho c)
// until the waves are back.
TEST(Thrown, parts_whose_tie_yields_open_at_the_rate_that_it_leaves) {
  const double impedance = std::sqrt(200e9 * 8000), rate = 10 - 2 * 30e6 / impedance;
  for (const char* solver : {"", "monolithic"})
    for (const char* dt : {"0.1", "0.4"}) {
      const DeckRun run =
          run_text(thrown, {{"joint", "3"}, {"x", "10"}, {"y", "0"}, {"z", "0"}, {"dt", dt}}, 1, solver)[0];
      const Flight flight = books_of(run, solver);
      EXPECT_NEAR(flight.lost, 0.0, 1e-12);
      EXPECT_LT(flight.most, (1 + 1e-9) * flight.given);
      const std::vector<double>& opening = run.column("joint", "opening");
      const double time = 2e-6;  // of 3.2 us there and back
      const auto n = static_cast<size_t>(std::lround(time / (std::stod(dt) * 1e-6)));
      const double middle = time - 0.5e-6 * std::stod(dt);
      EXPECT_NEAR(opening[n - 1], rate * middle, 0.03 * rate * middle) << solver << dt;
    }
}

// What moves or holds one side at once takes the other along, and what that takes is work of the load.
TEST(Thrown, parts_joined_to_what_a_support_or_a_load_moves_go_along) {
  for (const char* solver : {"", "monolithic", "explicit"}) {
    const DeckRun held = run_text(thrown, {{"base", "1"}}, 1, solver)[0];
    const Flight flight = books_of(held, solver);
    EXPECT_LT(flight.most, (1 + closes_within(solver)) * flight.left) << solver;
    const DeckRun moved = run_text(thrown, {{"speed", "3"}, {"y", "0"}, {"z", "0"}, {"cells", "3"}}, 1, solver)[0];
    const std::vector<double>&kinetic = moved.column("energy", "kinetic"), &loads = moved.column("energy", "loads");
    EXPECT_NEAR(loads[0], kinetic[0], 1e-9 * kinetic[0]) << solver;
    const std::vector<double>& balance = moved.column("energy", "balance");
    const double all = largest(loads);
    for (const double open : balance) EXPECT_NEAR(open, 0.0, closes_within(solver) * all) << solver;
  }
}

// Two halves of a bar, bonded across unlike meshes, and a block that lies on both without a load: a contact, which may
// open, takes no points off the bond where it meets its edge.
TEST(Bond, keeps_its_points_where_contacts_meet_its_edge) {
  const auto tip = [](const char* lies, const char* fine) {
    return run_text(R"(
local p = param{ lies = 1, fine = 3 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, x, z, size, cells) return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { x*mm, 0, z*mm }, size = size, cells = cells } } end
local left, right = block("left", 0, 0, { 20*mm, 10*mm, 10*mm }, { 4, 2, 2 }), block("right", 20, 0, { 20*mm, 10*mm, 10*mm }, { 4, p.fine, p.fine })
local top = block("top", 10, 10, { 20*mm, 10*mm, 5*mm }, { 4, 2, 1 })
local parts, joints = { left, right }, { interface.bonded{ name = "seam", between = { left:face "xmax", right:face "xmin" } } }
if p.lies == 1 then
  parts[3] = top
  for i, part in ipairs{ left, right } do joints[1 + i] = interface.contact{ name = "rest " .. i, between = { part:face "zmax", top:face "zmin" } } end
end
problem{ name = "bar", substructures = parts, interfaces = joints, supports = { support.fixed{ name = "wall", on = left:face "xmin" } },
  steps = { step.static{ name = "bend", loads = { load.force{ on = right:face "xmax", z = -2*kN } } } },
  outputs = { output.history{ name = "u", on = right:face "xmax", quantity = "displacement" } } }:run{}
)",
                    {{"lies", lies}, {"fine", fine}})[0]
        .column("u", "z")
        .back();
  };
  for (const char* fine : {"2", "3"})
    EXPECT_NEAR(tip("1", fine), tip("0", fine), 1e-5 * std::abs(tip("0", fine))) << fine;
}

// Insert, skin and core meet in a circle, of which the faces of each pair have polygons of their own; so do insert,
// skin and the pad that presses on both. A tie or a contact too many there would pull against the others.
const std::string around_an_insert = R"(
local p = param{ inside = 71*GPa, around = 520*MPa, friction = 0.2, more = 0 }
local cad = mesh.gmsh{ file = ")" + std::string(DYGITA_SOURCE_DIR) +
                                     R"(/tests/decks/round_insert.geo", unit = mm, order = 2 }
local function part(name, young, density)
  return substructure{ name = name, mesh = cad:volume(name), material = material.elastic{ name = name, young = young, poisson = 0.3, density = density } }
end
local insert, core, skin, pad = part("insert", p.inside, 2800), part("core", p.around, 60), part("skin", 52*GPa, 1600), part("pad", 71*GPa, 2800)
local top = pad:face{ normal = { 0, 0, 1 }, at = 6*mm }
local base = support.fixed{ name = "base", on = core:face{ normal = { 0, 0, -1 } } }
local weight = load.force{ on = top, z = -6*kN }
local press = step.static{ name = "press", loads = { weight } }
local glue = interface.bonded{ name = "glue", between = "all touching", of = { insert, core, skin } }
local joint = { interface.contact{ name = "on insert", between = "all touching", of = { insert, pad }, friction = p.friction },
                interface.contact{ name = "on skin", between = "all touching", of = { skin, pad }, friction = p.friction + p.more } }
problem{ name = "insert", substructures = { insert, core, skin, pad }, interfaces = { glue, joint }, supports = { base },
  steps = { press, step.dynamic{ name = "hit", after = press, duration = 0.1*ms, dt = 20*us,
    loads = { weight, load.base_acceleration{ on = base, direction = { 1, 0, 1 }, history = 10*g0 } } } },
  outputs = { output.footprint{ name = "glue", on = glue }, output.footprint{ name = "touch", on = joint } } }:run{}
)";

TEST(Bonds, around_a_round_insert_do_not_pull_against_each_other) {
  for (const auto& [inside, around] : {std::pair{"71e9", "520e6"}, std::pair{"520e6", "71e9"}})
    for (const auto& [friction, more] : {std::pair{"0.2", "0"}, std::pair{"0.2", "0.05"}, std::pair{"0", "0"}}) {
      const DeckRun run = run_text(around_an_insert,
                                   {{"inside", inside}, {"around", around}, {"friction", friction}, {"more", more}})[0];
      EXPECT_TRUE(run.result->converged) << inside << " " << friction << " " << more;
      const std::vector<double>& iterations = run.result->convergence.column("iterations");
      EXPECT_LE(largest({iterations.begin() + 1, iterations.end()}), 100.0) << inside << " " << friction << " " << more;
      EXPECT_LT(largest(run.column("glue", "pressure")), 300e6) << inside << " " << friction << " " << more;
      EXPECT_LT(largest(run.column("touch", "pressure")), 150e6) << inside << " " << friction << " " << more;
    }
}

// A post on a plate, in contact or bonded, and beside it gum or foil that is bonded to both and does not reach the line
// where they meet.
const std::string beside_a_foot =
    R"(
local p = param{ soft = 5*MPa, order = 1, bonded = 0, beside = 1, chamfer = 0.5, size = 10, thickness = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local gum = material.elastic{ name = "gum", young = p.soft, poisson = 0.3, density = 1200 }
local function block(name, low, high, cells)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { low[1]*mm, low[2]*mm, low[3]*mm },
    size = { (high[1] - low[1])*mm, (high[2] - low[2])*mm, (high[3] - low[3])*mm }, cells = cells } }
end
local plate, post = block("plate", { -30, -10, -10 }, { 30, 10, 0 }, { 30, 3, 2 }), block("post", { -1.5, -10, 0 }, { 1.5, 10, 20 }, { 2, 4, 8 })
local sides = { post:face "zmin", plate:face "zmax" }
local foot = p.bonded == 1 and interface.bonded{ name = "foot", between = sides } or interface.contact{ name = "foot", between = sides, friction = 0.2 }
local parts, joints = { plate, post }, { foot }
if p.beside == 1 then
  local cad = mesh.gmsh{ file = ")" +
    std::string(DYGITA_SOURCE_DIR) +
    R"(/tests/decks/beside_a_foot.geo", unit = mm, order = p.order, set = { c = p.chamfer, s = p.size, t = p.thickness } }
  for i, side in ipairs{ "left", "right" } do
    local b = substructure{ name = side, material = gum, mesh = cad:volume(side) }
    parts[2 + i] = b
    table.insert(joints, interface.bonded{ name = side .. " post", between = { b:face{ normal = { 3 - 2*i, 0, 0 }, at = -1.5*mm }, post:face(i == 1 and "xmin" or "xmax") } })
    table.insert(joints, interface.bonded{ name = side .. " plate", between = { b:face{ normal = { 0, 0, -1 } }, plate:face "zmax" } })
  end
end
problem{ name = "foot", substructures = parts, interfaces = joints, supports = { support.fixed{ name = "base", on = plate:face "zmin" } },
  steps = { step.static{ name = "press", loads = { load.force{ on = post:face "zmax", z = -400, x = 20 } } } },
  outputs = { output.history{ name = "u", on = post:face "zmax", quantity = "displacement" } } }:run{}
)";

TEST(Bonds, that_do_not_reach_a_line_take_nothing_off_it) {
  const auto lean = [](const Settings& settings) {
    return run_text(beside_a_foot, settings)[0].column("u", "x").back();
  };
  const double contact = lean({{"beside", "0"}}), bonded = lean({{"beside", "0"}, {"bonded", "1"}});
  for (const char* chamfer : {"0.5", "0.2"})
    for (const char* size : {"10", "4"})
      EXPECT_NEAR(lean({{"chamfer", chamfer}, {"size", size}}), contact, 0.03 * contact) << chamfer << " " << size;
  for (const char* chamfer : {"0.5", "0.3"})
    EXPECT_NEAR(lean({{"bonded", "1"},
                      {"thickness", "0.1"},
                      {"order", "2"},
                      {"size", "20"},
                      {"soft", "27e9"},
                      {"chamfer", chamfer}}),
                bonded, 0.1 * bonded)
        << chamfer;
}

}  // namespace
}  // namespace dygita::test::bonds_tests

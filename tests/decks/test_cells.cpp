// Every type of cells from end to end: loads, supports, outputs and waves, where the answer is known.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_prints.hpp"
#include "mesh/cell_types.hpp"

namespace dygita::test::cells_tests {
namespace {

bool is_of_order_two(const CellShape& cell) { return nodes_per_cell(cell.type) > cell.n_corners; }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

template <typename Check>
void for_each_cell(const std::string& deck, Check check, bool order_two_only = false) {
  for (const CellShape& cell : cell_shapes) {
    if (order_two_only && !is_of_order_two(cell)) continue;
    SCOPED_TRACE(cell.name);
    check(cell, run_text(replaced(deck, "CELL", std::string("\"") + cell.name + "\"")).at(0));
  }
}

// Two blocks on one another, bonded, on rollers: 20 x 16 x (12 + 8) mm, E 200 GPa, pressed with 100 MPa.
const std::string column = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local function block(name, from, height)
  return substructure{ name = name, material = steel,
    mesh = mesh.box{ origin = { 0, 0, from }, size = { 20*mm, 16*mm, height }, cells = { 2, 2, 2 }, cell = CELL } }
end
local lower, upper = block("lower", 0, 12*mm), block("upper", 12*mm, 8*mm)
local rollers = support.symmetry{ name = "rollers", on = { lower:face "xmin", upper:face "xmin", lower:face "ymin", upper:face "ymin" } }
local foot = support.symmetry{ name = "foot", on = lower:face "zmin" }
local bond = interface.bonded{ name = "bond", between = { lower:face "zmax", upper:face "zmin" } }
local press = step.static{ name = "press", loads = { load.pressure{ on = upper:face "zmax", history = 100*MPa } } }
problem{ name = "column", substructures = { lower, upper }, interfaces = { bond }, supports = { rollers, foot }, steps = { press },
         outputs = { output.history{ name = "top", on = upper:face "zmax", quantity = "displacement" }, output.resultant{ name = "ground", on = foot },
                     output.resultant{ name = "joint", on = bond } } }:run{}
)";

TEST(Cells, under_uniform_pressure_are_uniformly_pressed) {
  for_each_cell(column, [](const CellShape&, const DeckRun& run) {
    EXPECT_NEAR(run.column("top", "z").back(), -1e-5, 1e-5 * 1e-7);             // p L / E
    EXPECT_NEAR(run.column("top", "x").back(), 0.3e-5 * 10 / 20, 1e-5 * 1e-7);  // nu p / E at the face's middle
    EXPECT_NEAR(std::abs(run.column("ground", "normal").back()), 32e3, 32e3 * 1e-7);
    EXPECT_NEAR(run.column("joint", "normal").back(), -32e3, 32e3 * 1e-7);
    EXPECT_LT(run.figure("energy imbalance [%]"), 1e-6);
    EXPECT_LT(run.figure("error estimate, static, mesh [%]"), 1e-4);
  });
}

// No point of a wall opens under a uniform pressure, in either solver.
TEST(Cells, of_order_two_stand_on_a_wall_with_all_their_face) {
  const std::string on_wall =
      replaced(replaced(replaced(column, "support.symmetry{ name = \"foot\"", "support.wall{ name = \"foot\""),
                        "output.resultant{ name = \"ground\"", "output.joint{ name = \"ground\""),
               "steps = { press }", "steps = { press }, solver = SOLVER");
  for (const std::string solver :
       {"solver.latin{ integration = 'implicit', static_tolerance = 1e-10 }", "solver.monolithic{}"})
    for_each_cell(
        replaced(on_wall, "SOLVER", solver),
        [](const CellShape&, const DeckRun& run) {
          EXPECT_TRUE(run.result->converged);
          EXPECT_NEAR(run.column("top", "z").back(), -1e-5, 1e-5 * 1e-7);
          EXPECT_NEAR(run.column("ground", "normal").back(), -32e3, 32e3 * 1e-7);
          EXPECT_EQ(run.column("ground", "open_area").back(), 0.0);
          EXPECT_NEAR(run.column("ground", "slip_area").back() + run.column("ground", "stick_area").back(), 320e-6,
                      1e-12);
        },
        true);
}

// Thrown at a wall, a bar turns round: the wall gives it twice its momentum less what the impact dissipates.
TEST(Cells, of_order_two_bounce_off_a_wall_as_linear_ones_do) {
  const std::string thrown = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = steel, velocity = { 0, 0, -1 }, mesh = mesh.box{ size = { 10*mm, 10*mm, 50*mm }, cells = { 1, 1, 20 }, cell = CELL } }
local wall = support.wall{ name = "wall", on = bar:face "zmin" }
problem{ name = "thrown", substructures = { bar }, supports = { wall }, steps = { step.dynamic{ name = "flight", duration = 40*us, dt = 0.2*us } },
         solver = solver.latin{ integration = "implicit" }, outputs = { output.joint{ name = "hit", on = wall } } }:run{}
)";
  for_each_cell(
      thrown,
      [](const CellShape&, const DeckRun& run) {
        EXPECT_TRUE(run.result->converged);
        // rho c v A = 4 kN from the first instant until the wave is back, 2 L / c = 20 us.
        const std::vector<double>& force = run.column("hit", "normal");
        double sum = 0.0;
        for (const double f : force) sum += f * 0.2e-6;
        EXPECT_NEAR(force[force.size() / 4], -4000.0, 0.03 * 4000.0);
        EXPECT_NEAR(sum, -2 * 8000 * 5e-6, 0.04 * 0.08);
        EXPECT_EQ(force.back(), 0.0);
        EXPECT_LT(run.figure("energy created by the scheme [%]"), 0.1);
      },
      true);
}

TEST(Cells, weigh_what_their_volume_does) {
  const std::string heavy =
      replaced(column, "load.pressure{ on = upper:face \"zmax\", history = 100*MPa }", "load.gravity{ z = -1000*g0 }");
  for_each_cell(heavy, [](const CellShape&, const DeckRun& run) {
    const double weight = 8000 * 20e-3 * 16e-3 * 20e-3 * 9806.65;
    EXPECT_NEAR(std::abs(run.column("ground", "normal").back()), weight, 1e-7 * weight);
    EXPECT_NEAR(std::abs(run.column("joint", "normal").back()), 0.4 * weight, 0.03 * weight);
  });
}

// A bar that can move along its axis only, pushed at one end; waves leave by the other. c = 5 km/s.
const std::string bar = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = steel,
  mesh = mesh.box{ size = { 5*mm, 5*mm, 100*mm }, cells = { 1, 1, 20 }, cell = CELL } }
local sides = support.symmetry{ name = "sides", on = { bar:face "xmin", bar:face "xmax", bar:face "ymin", bar:face "ymax" } }
local open = support.absorbing{ name = "open", on = bar:face "zmin" }
local push = load.pressure{ on = bar:face "zmax", history = history.half_sine{ peak = 10*MPa, duration = 16*us } }
local shock = step.dynamic{ name = "shock", duration = 60*us, dt = 0.5*us, loads = { push } }
problem{ name = "bar", substructures = { bar }, supports = { sides, END }, steps = { shock }, solver = SOLVER,
         outputs = { output.energy{}, output.momentum{ name = "momentum" }, output.resultant{ name = "end", on = END },
                     output.history{ name = "tip", on = bar:face "zmax", quantity = "velocity" } } }:run{}
)";

std::string bar_with(const std::string& end, const std::string& solver) {
  return replaced(
      replaced(replaced(bar, "local open = support.absorbing{ name = \"open\", on = bar:face \"zmin\" }", end),
               "SOLVER", solver),
      "END", "open");
}

TEST(Cells, let_waves_leave_by_an_absorbing_support) {
  const std::string deck = bar_with("local open = support.absorbing{ name = \"open\", on = bar:face \"zmin\" }",
                                    "solver.latin{ integration = 'implicit' }");
  for_each_cell(deck, [](const CellShape& cell, const DeckRun& run) {
    const std::vector<double>&kinetic = run.column("energy", "kinetic"), &strain = run.column("energy", "strain");
    double most = 0.0;
    for (size_t i = 0; i < kinetic.size(); ++i) most = std::max(most, kinetic[i] + strain[i]);
    const double left = (kinetic.back() + strain.back()) / most;
    std::cout << cell.name << ": " << 100 * left << " % of the energy stays behind an absorbing support\n";
    EXPECT_LT(left, is_of_order_two(cell) ? 2e-5 : 2e-3);
    // Impulse of the push: 2 / pi p A T. The tip moves with p / (rho c).
    EXPECT_LT(*std::max_element(run.column("tip", "z").begin(), run.column("tip", "z").end()),
              is_of_order_two(cell) ? 0.01 : 0.05);
    EXPECT_NEAR(*std::min_element(run.column("tip", "z").begin(), run.column("tip", "z").end()), -10e6 / (8000 * 5000),
                0.02 * 0.25);
    EXPECT_LT(run.figure("energy imbalance [%]"), 1e-3);
  });
}

TEST(Cells, gain_the_momentum_that_a_push_gives_them) {
  const std::string deck = replaced(bar_with("local open = support.symmetry{ name = \"open\", on = bar:face \"xmin\" }",
                                             "solver.latin{ integration = 'implicit' }"),
                                    "on = { bar:face \"xmin\", ", "on = { ");
  for_each_cell(deck, [](const CellShape&, const DeckRun& run) {
    const double impulse = 2.0 / M_PI * 10e6 * 25e-6 * 16e-6;
    EXPECT_NEAR(run.column("momentum", "z").back(), -impulse, 1e-3 * impulse);
  });
}

TEST(Cells, move_alike_in_latin_cut_or_not_and_in_the_monolithic_solver) {
  const std::string end = "local open = support.fixed{ name = \"open\", on = bar:face \"zmin\" }";
  for_each_cell(
      bar_with(end, "solver.latin{ integration = 'implicit', tolerance = 1e-9 }"),
      [&](const CellShape& cell, const DeckRun& latin) {
        const std::string name = std::string("\"") + cell.name + "\"";
        for (const char* solver :
             {"solver.monolithic{}", "solver.latin{ integration = 'implicit', tolerance = 1e-9, pieces = 3 }"}) {
          const DeckRun other = run_text(replaced(bar_with(end, solver), "CELL", name)).at(0);
          EXPECT_LT(difference(other.column("tip", "z"), latin.column("tip", "z")), 1e-6) << solver;
          EXPECT_LT(difference(other.column("end", "z"), latin.column("end", "z")), 1e-6) << solver;
        }
      },
      true);
}

// The bar flies against a rigid wall, bounces, and must have no more energy than it came with.
TEST(Cells, never_gain_energy_when_they_bounce) {
  const std::string deck = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = steel, velocity = { 0, 0, -10 },
  mesh = mesh.box{ size = { 5*mm, 5*mm, 100*mm }, cells = { 1, 1, 20 }, cell = CELL } }
local sides = support.symmetry{ name = "sides", on = { bar:face "xmin", bar:face "ymin" } }
local wall = support.wall{ name = "wall", on = bar:face "zmin", gap = 0.1*mm }
local flight = step.dynamic{ name = "flight", duration = 120*us, dt = 0.5*us }
problem{ name = "bounce", substructures = { bar }, supports = { sides, wall }, steps = { flight },
         outputs = { output.energy{}, output.momentum{ name = "momentum" } } }:run{}
)";
  for (const char* cell : {"hex8", "hex27"}) {
    const DeckRun run = run_text(replaced(deck, "CELL", std::string("\"") + cell + "\"")).at(0);
    const std::vector<double>&kinetic = run.column("energy", "kinetic"), &strain = run.column("energy", "strain");
    const double start = 0.5 * 8000 * 25e-6 * 0.1 * 100;
    for (size_t i = 0; i < kinetic.size(); ++i) EXPECT_LT(kinetic[i] + strain[i], start * (1 + 1e-6)) << cell;
    // It comes with -0.2 N s and leaves with that less what the nodes that stop lose.
    EXPECT_GT(run.column("momentum", "z").back(), 0.94 * 0.2) << cell;
    EXPECT_LT(run.column("momentum", "z").back(), 0.2) << cell;
  }
}

// A cantilever of one cell through the thickness, ten times as long, against a beam with shear: W L^3 / 3 E I + W L / k
// G A.
TEST(Cells, of_order_two_bend_as_a_beam_does) {
  const std::string deck = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local beam = substructure{ name = "beam", material = steel,
  mesh = mesh.box{ size = { 100*mm, 10*mm, 10*mm }, cells = { 10, 1, 1 }, cell = CELL } }
local root = support.fixed{ name = "root", on = beam:face "xmin" }
local bend = step.static{ name = "bend", loads = { load.force{ on = beam:face "xmax", z = -1000 } } }
problem{ name = "beam", substructures = { beam }, supports = { root }, steps = { bend },
         outputs = { output.history{ name = "tip", on = beam:face "xmax", quantity = "displacement" } } }:run{}
)";
  for_each_cell(
      deck,
      [](const CellShape& cell, const DeckRun& run) {
        const double inertia = 1e-8 / 12, kappa = 10.0 / 12.0, shear = 200e9 / 2;
        const double exact = 1000 * 1e-3 / (3 * 200e9 * inertia) + 1000 * 0.1 / (kappa * shear * 1e-4);
        const double ratio = -run.column("tip", "z").back() / exact;
        std::cout << "cantilever of " << cell.name << ": " << ratio << " of the beam's deflection\n";
        EXPECT_NEAR(ratio, 1.0, 0.01);
      },
      true);
}

// A part turned into its place, and pushed there, does what it does in its own axes.
TEST(Placement, turns_a_part_and_what_is_on_it) {
  const std::string deck = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local beam = substructure{ name = "beam", material = steel, PLACE
  mesh = mesh.box{ size = { 40*mm, 10*mm, 10*mm }, cells = { 4, 1, 1 } } }
local root = support.fixed{ name = "root", on = beam:face "xmin" }
local push = step.static{ name = "push", loads = { load.pressure{ on = beam:face "ymax", history = 1*MPa } } }
problem{ name = "beam", substructures = { beam }, supports = { root }, steps = { push },
         outputs = { output.history{ name = "tip", on = beam:face "xmax", quantity = "displacement" } } }:run{}
)";
  const DeckRun plain = run_text(replaced(deck, "PLACE", "")).at(0);
  const double y = plain.column("tip", "y").back(), x = plain.column("tip", "x").back();
  // By 30 degrees about z through (1, 2, 0) m: place and directions turn.
  const DeckRun turned =
      run_text(replaced(deck, "PLACE",
                        "place = { translate = { 1, 0, 0 }, rotate = { axis = { 0, 0, 2 }, angle = 30*deg, "
                        "about = { 1, 2, 0 } } },"))
          .at(0);
  const double c = std::sqrt(3.0) / 2.0, s = 0.5;
  EXPECT_NEAR(turned.column("tip", "x").back(), c * x - s * y, 1e-9 * std::abs(y));
  EXPECT_NEAR(turned.column("tip", "y").back(), s * x + c * y, 1e-9 * std::abs(y));
  const Substructure& part = *turned.problem.substructures.at(0);
  const Vec3 corner = part.mesh->nodes.col(0) + part.place;  // of (0, 0, 0)
  EXPECT_LT((corner - Vec3(1 + 1 - c + 2 * s, 2 - s - 2 * c, 0)).norm(), 1e-12);
}

TEST(Placement, makes_a_circle_and_a_row_of_equal_parts) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local post = substructure{ name = "post", material = steel, place = { 50*mm, 0, 0 },
  mesh = mesh.box{ size = { 4*mm, 4*mm, 20*mm }, cells = { 1, 1, 4 } } }
local parts, feet, loads = {}, {}, {}
for _, list in ipairs{ pattern.circle{ n = 3, axis = { 0, 0, 1 }, of = post }, pattern.line{ n = 2, step = { 0, 0, 100*mm }, of = substructure{
    name = "row", material = steel, mesh = mesh.box{ size = { 4*mm, 4*mm, 20*mm }, cells = { 1, 1, 4 } } } } } do
  for _, part in ipairs(list) do
    parts[#parts + 1] = part
    feet[#feet + 1] = part:face "zmin"
    loads[#loads + 1] = load.pressure{ on = part:face "zmax", history = 10*MPa }
  end
end
local ground = support.fixed{ name = "ground", on = feet }
problem{ name = "posts", substructures = parts, supports = { ground }, steps = { step.static{ name = "push", loads = loads } },
         outputs = { output.resultant{ name = "all", on = ground },
                     output.history{ name = "second", on = parts[2]:face "zmax", quantity = "displacement" } } }:run{}
)")
                          .at(0);
  ASSERT_EQ(run.problem.substructures.size(), 5u);
  EXPECT_EQ(run.problem.substructures[1]->name, "post[2]");
  EXPECT_EQ(run.problem.substructures[4]->name, "row[2]");
  const auto corner = [&](int i) {
    const Substructure& part = *run.problem.substructures.at(static_cast<size_t>(i));
    return Vec3(part.mesh->nodes.col(0) + part.place);
  };
  EXPECT_LT((corner(0) - Vec3(0.05, 0, 0)).norm(), 1e-15);
  EXPECT_LT((corner(1) - 0.05 * Vec3(-0.5, std::sqrt(0.75), 0)).norm(), 1e-15);
  EXPECT_LT((corner(4) - Vec3(0, 0, 0.1)).norm(), 1e-15);
  EXPECT_NEAR(std::abs(run.column("all", "z").back()), 5 * 160.0, 1e-6);
  EXPECT_LT(run.column("second", "z").back(), 0.0);
}

}  // namespace
}  // namespace dygita::test::cells_tests

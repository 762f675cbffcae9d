// LATIN against the monolithic reference: same meshes, scheme and laws, nothing shared of the iteration.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/engine.hpp"

namespace dygita::test::reference_tests {
namespace {

constexpr double reference_tolerance = 1e-8;  // of LATIN
constexpr double agreement = 10 * reference_tolerance;

// The decks say `solver = pick` and have p.monolithic.
const std::string choice = R"(
local p = param{ monolithic = 0, tolerance = 1e-8, cut = 1, damping = 0 }
local pick = p.monolithic == 1 and solver.monolithic{ numerical_damping = p.damping }
  or solver.latin{ integration = 'implicit', tolerance = p.tolerance, static_tolerance = p.tolerance, max_iterations = 2000, numerical_damping = p.damping }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
)";

struct Pair {
  DeckRun latin, monolithic;
};

Pair run_both(const std::string& deck_text, Settings settings = {}) {
  Settings other = settings;
  other.emplace_back("monolithic", "1");
  Pair runs{run_text(choice + deck_text, settings).at(0), run_text(choice + deck_text, other).at(0)};
  EXPECT_TRUE(runs.latin.result->converged);
  EXPECT_TRUE(runs.monolithic.result->converged);
  EXPECT_LT(runs.monolithic.figure("energy imbalance [%]"), 1e-6);
  return runs;
}

// Largest difference of any of the columns over the largest value in all of them.
double differ(const Pair& runs, const std::string& output, const std::vector<std::string>& columns) {
  double scale = 0.0, most = 0.0;
  for (const std::string& column : columns) {
    const std::vector<double>&a = runs.latin.column(output, column), &b = runs.monolithic.column(output, column);
    if (a.size() != b.size()) throw std::runtime_error("series of different lengths");
    scale = std::max(scale, largest(a));
    for (size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  }
  EXPECT_GT(scale, 0.0) << output;
  std::cout << "  " << output << "." << columns.front() << " differs by " << most / scale << "\n";
  return most / scale;
}

const std::vector<std::string> xyz = {"x", "y", "z"};

TEST(Reference, agrees_on_two_blocks_in_frictional_contact_hit_obliquely) {
  const Pair runs = run_both(R"(
local low = substructure{ name = "low", material = steel, mesh = mesh.box{ size = { 4*mm, 4*mm, 4*mm }, cells = { 4, 4, 4 } } }
local top = substructure{ name = "top", material = steel, mesh = mesh.box{ origin = { 0, 0, 4*mm }, size = { 4*mm, 4*mm, 3*mm }, cells = { 4, 4, 3 } } }
local touch = interface.contact{ name = "touch", between = { low:face "zmax", top:face "zmin" }, friction = 0.3 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 12*us, dt = 0.1*us, loads = { load.traction{ on = top:face "zmax",
  x = history.half_sine{ peak = 60*MPa, duration = 4*us }, y = history.half_sine{ peak = 20*MPa, duration = 3*us },
  z = history.half_sine{ peak = -100*MPa, duration = 5*us } } } }
problem{ name = "blocks", substructures = { low, top }, interfaces = { touch }, supports = { base }, steps = { hit }, solver = pick,
  outputs = { output.history{ name = "motion", quantity = "velocity", on = top:face "xmax" },
    output.history{ name = "pressure", quantity = "pressure", on = touch }, output.joint{ name = "joint", on = touch },
    output.resultant{ name = "held", on = base }, output.energy{} } }:run{}
)");
  EXPECT_LT(differ(runs, "motion", xyz), agreement);
  EXPECT_LT(differ(runs, "joint", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "joint", {"slip"}), agreement);
  EXPECT_LT(differ(runs, "joint", {"friction_work"}), agreement);
  EXPECT_LT(differ(runs, "held", xyz), agreement);
  EXPECT_LT(differ(runs, "energy", {"kinetic", "strain", "loads", "friction"}), agreement);
  EXPECT_GT(largest(runs.latin.column("joint", "slip_area")), 0.0);
  EXPECT_GT(largest(runs.latin.column("joint", "stick_area")), 0.0);
  EXPECT_GT(largest(runs.latin.column("joint", "open_area")), 0.0);
}

TEST(Reference, agrees_on_a_block_thrown_at_a_wall) {
  const Pair runs = run_both(R"(
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.33, density = 2700, damping = { mass = 1e3, stiffness = 1e-9 } }
local block = substructure{ name = "block", material = alloy, velocity = { 4, 1, -6 },
  mesh = mesh.box{ size = { 5*mm, 4*mm, 6*mm }, cells = { 5, 4, 6 } } }
local wall = support.wall{ name = "wall", on = block:face "zmin", friction = 0.4, gap = 1*um }
local throw = step.dynamic{ name = "throw", duration = 10*us, dt = 0.1*us }
problem{ name = "thrown", substructures = { block }, supports = { wall }, steps = { throw }, solver = pick,
  outputs = { output.history{ name = "motion", quantity = "velocity", on = block:face "zmin" },
    output.history{ name = "top", quantity = "displacement", on = block:face "zmax" }, output.joint{ name = "sole", on = wall },
    output.energy{} } }:run{}
)",
                             {{"damping", "0.05"}});
  EXPECT_LT(differ(runs, "motion", xyz), agreement);
  EXPECT_LT(differ(runs, "top", xyz), agreement);
  EXPECT_LT(differ(runs, "sole", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "energy", {"kinetic", "strain", "friction", "damping", "scheme"}), agreement);
  EXPECT_GT(runs.latin.column("motion", "z").back(), 1.0);  // it has bounced
}

TEST(Reference, agrees_on_a_plastic_beam_that_hardens_unloads_and_yields_again) {
  const Pair runs = run_both(R"(
local left = substructure{ name = "left", material = steel, mesh = mesh.box{ size = { 4*mm, 2*mm, 20*mm }, cells = { 4, 2, 20 } } }
local right = substructure{ name = "right", material = steel, mesh = mesh.box{ origin = { 0, 0, 20*mm }, size = { 4*mm, 2*mm, 20*mm }, cells = { 4, 2, 20 } } }
local yields = interface.plastic{ name = "yields", between = { left:face "zmax", right:face "zmin" }, yield = 100*MPa, hardening = 20*MPa/um, compression = true }
local base = support.fixed{ name = "base", on = left:face "zmin" }
local pull = step.dynamic{ name = "pull", duration = 30*us, dt = 0.2*us,
  loads = { load.traction{ on = right:face "zmax", x = history.half_sine{ peak = 20*MPa, duration = 5*us },
    z = history.piecewise{ times = { 0, 3*us, 8*us, 11*us }, values = { 0, 200*MPa, -200*MPa, 0 } } } } }
problem{ name = "beam", substructures = { left, right }, interfaces = { yields }, supports = { base }, steps = { pull }, solver = pick,
  outputs = { output.joint{ name = "joint", on = yields }, output.history{ name = "end", quantity = "velocity", on = right:face "zmax" },
    output.energy{} } }:run{}
)");
  EXPECT_LT(differ(runs, "joint", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "joint", {"plastic_opening"}), agreement);
  EXPECT_LT(differ(runs, "joint", {"plastic_work"}), agreement);
  EXPECT_LT(differ(runs, "end", xyz), agreement);
  EXPECT_GT(largest(runs.latin.column("joint", "plastic_opening")), 0.0);
}

// A rod beside two sleeves between plates, tightened by shortening the rod's end, then shaken.
TEST(Reference, agrees_on_a_bolt_that_is_tightened_then_shocked) {
  const Pair runs = run_both(R"(
local function box(name, x, w, z, h, cells)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { x, 0, z }, size = { w, 2*mm, h }, cells = cells } }
end
local l = 10*mm
local rod, left, right = box("rod", 4*mm, 2*mm, 0, l, { 2, 2, 5 }), box("left", 0, 4*mm, 0, l, { 4, 2, 5 }), box("right", 6*mm, 4*mm, 0, l, { 4, 2, 5 })
local head, foot = box("head", 0, 10*mm, l, 4*mm, { 10, 2, 2 }), box("foot", 0, 10*mm, -4*mm, 4*mm, { 10, 2, 2 })
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", rod:face "zmin" } }
local shank  = interface.plastic{ name = "shank", between = { rod:face "zmax", head:face "zmin" }, yield = 500*MPa, hardening = 50*MPa/um }
local function seat(name, a, b) return interface.contact{ name = name, between = { a, b }, friction = 0.2 } end
local seats = { seat("left_foot", foot:face "zmax", left:face "zmin"), seat("left_head", left:face "zmax", head:face "zmin"),
  seat("right_foot", foot:face "zmax", right:face "zmin"), seat("right_head", right:face "zmax", head:face "zmin") }
local base = support.fixed{ name = "base", on = foot:face "zmin" }
local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = shank, by = 20*um } } }
local shock = step.dynamic{ name = "shock", after = tighten, duration = 20*us, dt = 0.2*us, loads = { load.traction{ on = head:face "zmax",
  z = history.half_sine{ peak = 150*MPa, duration = 8*us }, x = history.half_sine{ peak = 60*MPa, duration = 6*us } } } }
problem{ name = "bolt", substructures = { rod, left, right, head, foot }, interfaces = { thread, shank, table.unpack(seats) },
  supports = { base }, steps = { tighten, shock }, solver = pick,
  outputs = { output.joint{ name = "bolt", on = shank }, output.resultant{ name = "thread_force", on = thread }, output.joint{ name = "seats", on = seats },
    output.history{ name = "head_motion", quantity = "velocity", on = head:face "zmax" }, output.energy{} } }:run{}
)");
  EXPECT_LT(differ(runs, "bolt", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "bolt", {"plastic_opening"}), agreement);
  EXPECT_LT(differ(runs, "thread_force", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "seats", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "head_motion", xyz), agreement);
  EXPECT_LT(differ(runs, "energy", {"kinetic", "strain", "loads", "friction", "plastic"}), agreement);
  EXPECT_GT(largest(runs.latin.column("bolt", "plastic_opening")), 0.0);
  EXPECT_GT(largest(runs.latin.column("seats", "open_area")), 0.0);
}

// Bricks tied to each other, on a wall, their top driven: nodes of two to eight bodies, under ties, contact and
// prescribed motion at once.
TEST(Reference, agrees_on_a_cut_body_and_does_not_see_the_cuts) {
  const std::string deck_text = R"(
local n, bricks, ties, top, bottom, side, at = p.cut, {}, {}, {}, {}, {}, {}
local s, c = 6*mm / n, 6 // n
local function key(i, j, k) return i .. "." .. j .. "." .. k end
for i = 1, n do for j = 1, n do for k = 1, n do
  local part = substructure{ name = "brick" .. key(i, j, k), material = steel,
    mesh = mesh.box{ origin = { (i-1)*s, (j-1)*s, (k-1)*s }, size = { s, s, s }, cells = { c, c, c } } }
  bricks[#bricks + 1], at[key(i, j, k)] = part, part
end end end
local function tie(name, a, b) ties[#ties + 1] = interface.bonded{ name = name, between = { a, b } } end
for i = 1, n do for j = 1, n do for k = 1, n do
  local a = at[key(i, j, k)]
  if k == n then top[#top + 1] = a:face "zmax" end
  if k == 1 then bottom[#bottom + 1] = a:face "zmin" end
  if i == 1 then side[#side + 1] = a:face "xmin" end
  if i < n then tie("x" .. key(i, j, k), a:face "xmax", at[key(i+1, j, k)]:face "xmin") end
  if j < n then tie("y" .. key(i, j, k), a:face "ymax", at[key(i, j+1, k)]:face "ymin") end
  if k < n then tie("z" .. key(i, j, k), a:face "zmax", at[key(i, j, k+1)]:face "zmin") end
end end end
local wall = support.wall{ name = "wall", on = bottom, friction = 0.3 }
local mirror = support.symmetry{ name = "mirror", on = side }
local press = step.static{ name = "press", increments = 2, loads = { load.displacement{ on = top, z = -5*um } } }
local drive = step.dynamic{ name = "drive", after = press, duration = 6*us, dt = 0.2*us, loads = {
  load.displacement{ on = top, y = history.half_sine{ peak = 10*um, duration = 8*us }, z = history.half_sine{ peak = 20*um, duration = 6*us } } } }
problem{ name = "cut", substructures = bricks, interfaces = ties, supports = { wall, mirror }, steps = { press, drive }, solver = pick,
  outputs = { output.history{ name = "foot", quantity = "velocity", on = at[key(n, n, 1)]:where(function(x, y, z) return near(x, 6*mm) and near(y, 6*mm) and near(z, 0) end) },
    output.resultant{ name = "wall_force", on = wall }, output.resultant{ name = "mirror_force", on = mirror }, output.energy{} } }:run{}
)";
  // The corrected iteration stops sooner after the tolerance is reached: 1.5e-7 at 1e-8.
  const Pair whole = run_both(deck_text), cut = run_both(deck_text, {{"cut", "2"}, {"tolerance", "2e-9"}});
  for (const Pair* runs : {&whole, &cut}) {
    EXPECT_LT(differ(*runs, "foot", xyz), agreement);
    EXPECT_LT(differ(*runs, "wall_force", {"normal", "shear"}), agreement);
    EXPECT_LT(differ(*runs, "mirror_force", xyz), agreement);
    EXPECT_LT(differ(*runs, "energy", {"kinetic", "strain", "loads", "friction"}), agreement);
  }
  const Pair references{whole.monolithic, cut.monolithic};
  EXPECT_LT(differ(references, "foot", xyz), agreement);
  EXPECT_LT(differ(references, "wall_force", {"normal", "shear"}), agreement);
}

// Release, absorbing support, accelerated base, supports that change.
TEST(Reference, agrees_on_releases_and_changing_supports) {
  const Pair runs = run_both(R"(
local low = substructure{ name = "low", material = steel, mesh = mesh.box{ size = { 3*mm, 3*mm, 6*mm }, cells = { 3, 3, 6 } } }
local top = substructure{ name = "top", material = steel, mesh = mesh.box{ origin = { 0, 0, 6*mm }, size = { 3*mm, 3*mm, 6*mm }, cells = { 3, 3, 6 } } }
local joint = interface.bonded{ name = "joint", between = { low:face "zmax", top:face "zmin" } }
local base, out = support.fixed{ name = "base", on = low:face "zmin" }, support.absorbing{ name = "out", on = top:face "zmax" }
local hold = step.static{ name = "hold", increments = 2, supports = { base }, loads = { load.force{ on = top:face "zmax", z = 500, x = 100 } } }
local shake = step.dynamic{ name = "shake", after = hold, duration = 6*us, dt = 0.1*us, supports = { base, out },
  loads = { load.base_acceleration{ on = base, direction = { 1, 0, 2 }, history = history.half_sine{ peak = 1e6, duration = 4*us } },
    load.release{ on = joint, at = 3*us } } }
problem{ name = "release", substructures = { low, top }, interfaces = { joint }, supports = { base }, steps = { hold, shake }, solver = pick,
  outputs = { output.resultant{ name = "joint_force", on = joint }, output.resultant{ name = "base_force", on = base },
    output.history{ name = "low_motion", quantity = "velocity", on = low:face "zmax" },
    output.history{ name = "top_motion", quantity = "displacement", on = top:face "zmin" }, output.energy{} } }:run{}
)");
  EXPECT_LT(differ(runs, "joint_force", {"normal", "shear"}), agreement);
  EXPECT_LT(differ(runs, "base_force", xyz), agreement);
  EXPECT_LT(differ(runs, "low_motion", xyz), agreement);
  EXPECT_LT(differ(runs, "top_motion", xyz), agreement);
  EXPECT_LT(differ(runs, "energy", {"kinetic", "strain", "loads", "damping", "scheme"}), agreement);
  EXPECT_EQ(runs.monolithic.column("joint_force", "normal").back(), 0.0);
}

TEST(Reference, refuses_more_law_rows_than_its_dense_matrices_are_made_for) {
  try {
    run_text(choice + R"(
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { 50*mm, 50*mm, 1*mm }, cells = { 50, 50, 1 } } }
local wall = support.wall{ name = "wall", on = plate:face "zmin", friction = 0.3 }
problem{ name = "many", substructures = { plate }, supports = { wall }, steps = { step.dynamic{ name = "wait", duration = 1*us, dt = 1*us } },
  solver = pick }:run{}
)",
             {{"monolithic", "1"}});
    FAIL() << "7803 rows were taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("there are 7803, at most 6000 are allowed"), std::string::npos)
        << error.what();
  }
}

TEST(Reference, does_not_call_a_body_pulled_off_its_wall_in_equilibrium) {
  const std::string pulled = choice + R"(
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 4*mm, 4*mm, 4*mm }, cells = { 2, 2, 2 } } }
local wall = support.wall{ name = "wall", on = block:face "zmin" }
local pull = step.static{ name = "pull", loads = { load.force{ on = block:face "zmax", z = 100 } } }
problem{ name = "pulled", substructures = { block }, supports = { wall }, steps = { pull }, solver = pick }:run{}
)";
  // By rounding, and so by the kind of processor, it flies off or stands still.
  try {
    EXPECT_FALSE(run_text(pulled, {{"monolithic", "1"}}).at(0).result->converged);
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("no equilibrium"), std::string::npos) << error.what();
  }
}

// Tangents that are solved with the factor of another against a factor for each: bolts that are tightened one after the
// other, then a shock in which contacts open and slide.
TEST(Reference, with_kept_factors_is_what_a_factor_for_each_tangent_gives) {
  const auto run = [](const std::string& solver) {
    return run_file(deck("bolted_flanges.lua"), {{"size", "6*mm"}, {"duration", "80*us"}, {"ring", "0"}}, 1, solver)
        .at(0);
  };
  const DeckRun kept = run("monolithic"), plain = run("monolithic{ plain = true }");
  const Pair runs{plain, kept};
  EXPECT_TRUE(kept.result->converged);
  EXPECT_TRUE(plain.result->converged);
  EXPECT_LT(differ(runs, "bolt", {"normal"}), agreement);
  EXPECT_LT(differ(runs, "energy", {"kinetic", "strain", "loads", "friction"}), agreement);
}

}  // namespace
}  // namespace dygita::test::reference_tests

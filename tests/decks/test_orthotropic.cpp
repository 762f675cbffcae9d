// Materials with directions through the decks of a user: closed forms, the scene turned, the axes swapped.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/engine.hpp"

namespace dygita::test::orthotropic_tests {
namespace {

using std::numbers::pi;

const std::string ply = R"(
local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 9*GPa, nu12 = 0.3, nu13 = 0.25, nu23 = 0.45,
                                  g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600 }
local function corner(part, x, y, z) return part:where(function(a, b, c) return near(a, x) and near(b, y) and near(c, z) end) end
-- Held against rigid motions alone.
local function held(part, l, w)
  return { load.displacement{ on = corner(part, 0, 0, 0), x = 0, y = 0, z = 0 }, load.displacement{ on = corner(part, l, 0, 0), y = 0, z = 0 },
           load.displacement{ on = corner(part, 0, w, 0), z = 0 } }
end
)";

// Stress along x alone: strains by the turned compliance of lamination theory, shear too.
TEST(Orthotropic, a_lamina_pulled_off_its_axes_strains_and_shears_as_theory_says) {
  for (const char* solver : {"latin", "monolithic"})
    for (const double degrees : {0.0, 30.0, 90.0}) {
      SCOPED_TRACE(std::string(solver) + " " + std::to_string(degrees));
      const DeckRun run = run_text(ply + R"(
local p = param{ angle = 0 }
local c, s = math.cos(p.angle*deg), math.sin(p.angle*deg)
local strip = substructure{ name = "strip", material = ply, orientation = { { c, s, 0 }, { -s, c, 0 } },
                            mesh = mesh.box{ size = { 40*mm, 20*mm, 2*mm }, cells = { 4, 3, 1 } } }
local pull = step.static{ name = "pull", loads = { held(strip, 40*mm, 20*mm),
  load.traction{ on = strip:face "xmax", x = 100*MPa }, load.traction{ on = strip:face "xmin", x = -100*MPa } } }
problem{ name = "p", substructures = { strip }, steps = { pull }, outputs = {
  output.history{ name = "end", on = corner(strip, 40*mm, 20*mm, 2*mm), quantity = "displacement" },
  output.history{ name = "side", on = corner(strip, 0, 20*mm, 0), quantity = "displacement" },
  output.history{ name = "stress", on = corner(strip, 40*mm, 20*mm, 2*mm), quantity = "stress" } } }:run{}
)",
                                   {{"angle", std::to_string(degrees)}}, 1, solver)
                              .at(0);
      const double angle = degrees * pi / 180, c = std::cos(angle), s = std::sin(angle), p = 100e6;
      const double s11 = 1 / 140e9, s12 = -0.3 / 140e9, s22 = 1 / 10e9, s66 = 1 / 5e9;
      const double xx = p * (s11 * std::pow(c, 4) + (2 * s12 + s66) * s * s * c * c + s22 * std::pow(s, 4));
      const double yy = p * (s12 * (std::pow(s, 4) + std::pow(c, 4)) + (s11 + s22 - s66) * s * s * c * c);
      const double xy = p * ((2 * s11 - 2 * s12 - s66) * s * c * c * c - (2 * s22 - 2 * s12 - s66) * s * s * s * c);
      const double zz = p * (-0.25 / 140e9 * c * c - 0.45 / 10e9 * s * s);
      // y = 0 at the far corner of the bottom edge: the strip turns so that its edge along x stays there.
      const double close = 1e-7 * xx * 0.04;
      EXPECT_NEAR(run.column("side", "y").back(), yy * 0.02, close);
      EXPECT_NEAR(run.column("side", "x").back(), xy * 0.02, close);
      EXPECT_NEAR(run.column("end", "x").back(), xx * 0.04 + xy * 0.02, close);
      EXPECT_NEAR(run.column("end", "y").back(), yy * 0.02, close);
      EXPECT_NEAR(run.column("end", "z").back(), zz * 0.002, close);
      EXPECT_NEAR(run.column("stress", "xx").back(), p, 1e-6 * p);
      EXPECT_NEAR(run.column("stress", "xy").back(), 0.0, 1e-6 * p);
    }
}

// The constants of a steel, as nine: the same run in every solver and scheme.
TEST(Orthotropic, of_the_constants_of_a_steel_moves_as_that_steel) {
  const std::string scene = R"(
local p = param{ nine = 0, explicit = 0 }
local g = 200*GPa / 2.5
local steel = p.nine == 0 and material.elastic{ name = "steel", young = 200*GPa, poisson = 0.25, density = 8000, damping = 0.02*us } or
  material.orthotropic{ name = "steel", e1 = 200*GPa, e2 = 200*GPa, e3 = 200*GPa, nu12 = 0.25, nu13 = 0.25, nu23 = 0.25, g12 = g, g13 = g, g23 = g, density = 8000, damping = 0.02*us }
local lower = substructure{ name = "lower", material = steel, mesh = mesh.box{ size = { 10*mm, 12*mm, 20*mm }, cells = { 2, 2, 4 } },
                            integration = p.explicit == 1 and "explicit" or "implicit" }
local upper = substructure{ name = "upper", material = steel, mesh = mesh.box{ size = { 10*mm, 12*mm, 10*mm }, cells = { 2, 2, 2 }, origin = { 0, 0, 20*mm } },
                            integration = p.explicit == 1 and "explicit" or "implicit" }
local joint = interface.contact{ name = "joint", between = { lower:face "zmax", upper:face "zmin" }, friction = 0.2 }
local base = support.absorbing{ name = "base", on = lower:face "zmin" }
local floor = support.fixed{ name = "floor", on = lower:face "zmin" }
local press = step.static{ name = "press", supports = { floor }, loads = { load.pressure{ on = upper:face "zmax", history = 50*MPa } } }
local shock = step.dynamic{ name = "shock", after = press, duration = 10*us, dt = 0.25*us, supports = { base },
  loads = { load.pressure{ on = upper:face "zmax", history = 50*MPa }, load.pressure{ on = lower:face "zmin", history = 50*MPa },
            load.traction{ on = upper:face "zmax", x = 5*MPa, z = -20*MPa } } }
problem{ name = "p", substructures = { lower, upper }, interfaces = { joint }, steps = { press, shock },
  outputs = { output.history{ name = "top", on = upper:face "zmax", quantity = "velocity" }, output.resultant{ name = "force", on = joint },
              output.history{ name = "stress", on = lower:face "xmax", quantity = "von_mises" } } }:run{}
)";
  // Mass is lumped where two constants would have it tuned to the one speed of their shear waves; and the viscosity of
  // the classic code, which goes by the slowest wave of nine, is left out.
  struct Way {
    const char *solver, *is_explicit;
  };
  for (const auto& [solver, is_explicit] : {Way{"latin", "0"},
                                            {"latin{ mass = \"lumped\" }", "1"},
                                            {"monolithic", "0"},
                                            {"explicit{ integration = \"full\", bulk_viscosity = false }", "0"}}) {
    SCOPED_TRACE(std::string(solver) + is_explicit);
    const DeckRun two = run_text(scene, {{"explicit", is_explicit}}, 1, solver).at(0),
                  nine = run_text(scene, {{"explicit", is_explicit}, {"nine", "1"}}, 1, solver).at(0);
    for (const auto& [output, column] :
         {std::pair("top", "x"), {"top", "z"}, {"force", "normal"}, {"stress", "von_mises"}})
      EXPECT_LT(difference(two.column(output, column), nine.column(output, column)), 2e-5) << output << column;
    EXPECT_GT(largest(two.column("top", "z")), 0.1);
  }
}

// A bar that is stopped at one end pushes with rho c A v until the wave has come back: c = sqrt(E / rho) of the axis
// that lies along it, where nothing contracts.
TEST(Orthotropic, a_bar_stopped_at_its_end_pushes_by_the_wave_along_its_axis) {
  const std::string scene = R"(
local p = param{ axis = 1, explicit = 0 }
local fabric = material.orthotropic{ name = "fabric", e1 = 90*GPa, e2 = 40*GPa, e3 = 10*GPa, nu12 = 0, nu13 = 0, nu23 = 0, g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600 }
local along = ({ { { 0, 0, 1 }, { 1, 0, 0 } }, { { 1, 0, 0 }, { 0, 0, 1 } }, { { 1, 0, 0 }, { 0, -1, 0 } } })[p.axis]
local bar = substructure{ name = "bar", material = fabric, orientation = along, velocity = { 0, 0, -1 }, integration = p.explicit == 1 and "explicit" or "implicit",
                          mesh = mesh.box{ size = { 1*mm, 1*mm, 60*mm }, cells = { 1, 1, 60 } } }
local stop = support.fixed{ name = "stop", on = bar:face "zmin" }
local e = ({ 90*GPa, 40*GPa, 10*GPa })[p.axis]
local crossing = 60*mm / math.sqrt(e / 1600)
local hit = step.dynamic{ name = "hit", duration = 1.5 * crossing, dt = crossing / 120 }
problem{ name = "p", substructures = { bar }, supports = { stop }, steps = { hit }, outputs = { output.resultant{ name = "push", on = stop } } }:run{}
)";
  const double young[] = {90e9, 40e9, 10e9};
  for (const char* solver : {"latin", "explicit", "monolithic"})
    for (int axis = 1; axis <= 3; ++axis)
      for (const char* is_explicit : {"0", "1"}) {
        if (std::string(solver) != "latin" && *is_explicit == '1') continue;
        SCOPED_TRACE(std::string(solver) + std::to_string(axis) + is_explicit);
        const DeckRun run =
            run_text(scene, {{"axis", std::to_string(axis)}, {"explicit", is_explicit}}, 1, solver).at(0);
        const std::vector<double>& push = run.column("push", "z");
        double impulse = 0.0;
        for (const double f : push) impulse += std::abs(f) / static_cast<double>(push.size());
        EXPECT_NEAR(impulse, 1e-6 * std::sqrt(1600 * young[axis - 1]), 0.02 * impulse);
      }
}

// Waves leave through an absorbing end, whichever axis lies along the bar.
TEST(Orthotropic, waves_leave_through_an_absorbing_end) {
  const std::string scene = R"(
local p = param{ axis = 1, shear = 0 }
local fabric = material.orthotropic{ name = "fabric", e1 = 90*GPa, e2 = 40*GPa, e3 = 10*GPa, nu12 = 0, nu13 = 0, nu23 = 0, g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600 }
local along = ({ { { 0, 0, 1 }, { 1, 0, 0 } }, { { 1, 0, 0 }, { 0, 0, 1 } }, { { 1, 0, 0 }, { 0, -1, 0 } } })[p.axis]
local v = p.shear == 1 and { 1, 0, 0 } or { 0, 0, 1 }
local bar = substructure{ name = "bar", material = fabric, orientation = along, velocity = v, mesh = mesh.box{ size = { 1*mm, 1*mm, 30*mm }, cells = { 1, 1, 60 } } }
local out = support.absorbing{ name = "out", on = bar:face "zmax" }
local inside = bar:where(function(x, y, z) return z < 29.9*mm end)
local guide = p.shear == 1 and load.displacement{ on = inside, y = 0, z = 0 } or load.displacement{ on = inside, x = 0, y = 0 }
local modulus = p.shear == 1 and ({ 5*GPa, 5*GPa, 4*GPa })[p.axis] or ({ 90*GPa, 40*GPa, 10*GPa })[p.axis]
local crossing = 30*mm / math.sqrt(modulus / 1600)
local go = step.dynamic{ name = "go", duration = 3 * crossing, dt = crossing / 120, loads = { guide } }
problem{ name = "p", substructures = { bar }, supports = { out }, steps = { go }, outputs = {
  output.history{ name = "left", on = bar:face "zmin", quantity = "velocity" } } }:run{}
)";
  for (const char* shear : {"0", "1"})
    for (int axis = 1; axis <= 3; ++axis) {
      SCOPED_TRACE(std::to_string(axis) + shear);
      const DeckRun run = run_text(scene, {{"axis", std::to_string(axis)}, {"shear", shear}}, 1).at(0);
      const std::vector<double>& v = run.column("left", *shear == '1' ? "x" : "z");
      EXPECT_NEAR(v[v.size() / 6], 1.0, 0.05);
      EXPECT_NEAR(v.back(), 0.0, 0.05);
    }
}

// A strip of two layers of unlike axes, pulled along: stretch and curvature of lamination theory,
// [N; M] = [A B; B D] [e; k], exact where nothing contracts across.
TEST(Orthotropic, a_strip_of_two_layers_bends_as_lamination_theory_says) {
  const DeckRun run = run_text(R"(
local fabric = material.orthotropic{ name = "fabric", e1 = 100*GPa, e2 = 10*GPa, e3 = 10*GPa, nu12 = 0, nu13 = 0, nu23 = 0, g12 = 5*GPa, g13 = 5*GPa, g23 = 4*GPa, density = 1600 }
local function layer(name, z, thickness, axes)
  return substructure{ name = name, material = fabric, orientation = axes,
                       mesh = mesh.box{ size = { 60*mm, 2*mm, thickness }, cells = { 60, 1, 4 }, origin = { 0, 0, z } } }
end
local lower = layer("lower", 0, 1*mm, { { 1, 0, 0 }, { 0, 1, 0 } })
local upper = layer("upper", 1*mm, 2*mm, { { 0, 1, 0 }, { -1, 0, 0 } })
local glue = interface.bonded{ name = "glue", between = { lower:face "zmax", upper:face "zmin" } }
local clamp = support.fixed{ name = "clamp", on = { lower:face "xmin", upper:face "xmin" } }
local pull = step.static{ name = "pull", loads = { load.traction{ on = { lower:face "xmax", upper:face "xmax" }, x = 10*MPa } } }
local function at(x) return lower:where(function(a, b, c) return near(a, x) and near(c, 0) end) end
problem{ name = "p", substructures = { lower, upper }, interfaces = { glue }, supports = { clamp }, steps = { pull }, outputs = {
  output.history{ name = "a", on = at(20*mm), quantity = "displacement" }, output.history{ name = "b", on = at(30*mm), quantity = "displacement" },
  output.history{ name = "c", on = at(40*mm), quantity = "displacement" } } }:run{}
)",
                               {}, 1)
                          .at(0);
  // From the lower face, per width: E1 over 1 mm, E2 over the 2 mm above.
  const double a = 100e9 * 1e-3 + 10e9 * 2e-3, b = 100e9 * 0.5e-6 + 10e9 * 4e-6,
               d = 100e9 * 1e-9 / 3 + 10e9 * 26e-9 / 3;
  const double force = 10e6 * 3e-3, moment = force * 1.5e-3;
  const double stretch = (d * force - b * moment) / (a * d - b * b),
               curvature = (a * moment - b * force) / (a * d - b * b);
  const auto of = [&](const char* name, const char* axis) { return run.column(name, axis).back(); };
  EXPECT_NEAR((of("c", "x") - of("a", "x")) / 0.02, stretch, 1e-4 * std::abs(stretch));
  // Strain stretch + curvature z: the strip curves down where its upper side is stretched more.
  EXPECT_NEAR(-(of("a", "z") - 2 * of("b", "z") + of("c", "z")) / 1e-4, curvature, 1e-4 * std::abs(curvature));
}

// A thick ring of fibres around: Lekhnitskii's solution for pressure inside, nothing contracting.
TEST(Orthotropic, a_ring_with_its_fibres_around_widens_as_theory_says) {
  const DeckRun run = run_text(R"(
local file = mesh.gmsh{ file = ")" +
                                   std::string(DYGITA_SOURCE_DIR) + R"(/tests/decks/quarter_tube.geo" }
local fibre = material.orthotropic{ name = "fibre", e1 = 100*GPa, e2 = 5*GPa, e3 = 10*GPa, nu12 = 0, nu13 = 0, nu23 = 0, g12 = 5*GPa, g13 = 5*GPa, g23 = 4*GPa, density = 1600 }
local ring = substructure{ name = "ring", mesh = file:volume "ring", material = fibre, orientation = { axis = { 0, 0, 2 } } }
local planes = support.symmetry{ name = "planes", on = { ring:face "x0", ring:face "y0", ring:face "ends" } }
local inflate = step.static{ name = "inflate", loads = { load.pressure{ on = ring:face "bore", history = 10*MPa } } }
problem{ name = "p", substructures = { ring }, supports = { planes }, steps = { inflate }, outputs = {
  output.history{ name = "in", on = ring:where(function(x, y, z) return near(x, 20*mm) and near(y, 0) end), quantity = "displacement" },
  output.history{ name = "out", on = ring:where(function(x, y, z) return near(x, 0) and near(y, 30*mm) end), quantity = "displacement" } } }:run{}
)",
                               {}, 1)
                          .at(0);
  // Radial stress A r^(l-1) + B r^(-l-1), hoop stress l (A r^(l-1) - B r^(-l-1)), l^2 = E around / E outwards.
  const double l = std::sqrt(100.0 / 10.0), in = 0.02, out = 0.03, p = 10e6;
  const double coefficient =
      p / (std::pow(out, 2 * l) / std::pow(in, l + 1) - std::pow(in, l - 1));  // A; B = -A out^(2 l)
  const auto widening = [&](double r) {
    return r / 100e9 * l * coefficient * (std::pow(r, l - 1) + std::pow(out, 2 * l) * std::pow(r, -l - 1));
  };
  EXPECT_NEAR(run.column("in", "x").back(), widening(in), 0.01 * widening(in));
  EXPECT_NEAR(run.column("out", "y").back(), widening(out), 0.01 * widening(out));
}

// One scene and the same turned as a whole by `place`: the axes turn with the part, and so do all answers. Copies of a
// pattern share what they are made of; one whose axes lie otherwise does not.
TEST(Orthotropic, a_scene_turned_as_a_whole_has_its_answer_turned) {
  const std::string scene = ply + R"(
local p = param{ turned = 0, shared = 0 }
local place = p.turned == 1 and { rotate = { axis = { 0, 0, 1 }, angle = 90*deg } } or { 0, 0, 0 }
local box = mesh.box{ size = { 10*mm, 12*mm, 20*mm }, cells = { 2, 2, 4 } }
local axes = { { 1, 0.5, 0.3 }, { 0, 1, 1 } }
local one = substructure{ name = "one", material = ply, orientation = axes, mesh = box, place = place }
local base = support.fixed{ name = "base", on = one:face "zmin" }
local push = p.turned == 1 and { x = -3*MPa, y = 5*MPa, z = 8*MPa } or { x = 5*MPa, y = 3*MPa, z = 8*MPa }
local press = step.static{ name = "press", loads = { load.traction{ on = one:face "zmax", x = push.x, y = push.y, z = push.z } } }
local free = step.dynamic{ name = "free", after = press, duration = 10*us, dt = 0.2*us, loads = { load.traction{ on = one:face "zmax", z = 2*MPa } } }
local parts, supports = { one }, { base }
if p.shared == 1 then  -- equal meshes beside it, of the same and of other axes
  for i, other in ipairs{ axes, { { 0, 1, 0 }, { 0, 0, 1 } } } do
    local two = substructure{ name = "more" .. i, material = ply, orientation = other, mesh = box, place = { i * 50*mm, 0, 0 } }
    parts[#parts + 1], supports[#supports + 1] = two, support.fixed{ name = "base" .. i, on = two:face "zmin" }
  end
end
problem{ name = "p", substructures = parts, supports = supports, steps = { press, free }, outputs = {
  output.history{ name = "top", on = one:face "zmax", quantity = "displacement" } } }:run{}
)";
  for (const char* solver : {"latin", "monolithic", "explicit"}) {
    SCOPED_TRACE(solver);
    const DeckRun one = run_text(scene, {}, 1, solver).at(0),
                  turned = run_text(scene, {{"turned", "1"}}, 1, solver).at(0),
                  beside = run_text(scene, {{"shared", "1"}}, 1, solver).at(0);
    EXPECT_LT(difference(one.column("top", "x"), turned.column("top", "y")), 1e-6);
    EXPECT_LT(difference(one.column("top", "z"), turned.column("top", "z")), 1e-6);
    EXPECT_LT(difference(one.column("top", "x"), beside.column("top", "x")), 1e-6);
    EXPECT_GT(largest(one.column("top", "y")), 1e-7);
  }
}

// A body cut into pieces is the same body, its axes a function of the place.
TEST(Orthotropic, a_body_cut_into_pieces_keeps_its_axes) {
  const std::string scene = ply + R"(
local p = param{ pieces = 1 }
local part = substructure{ name = "part", material = ply, mesh = mesh.box{ size = { 30*mm, 10*mm, 10*mm }, cells = { 12, 4, 4 } },
                           orientation = function(x, y, z) local a = 60*deg * x / (30*mm); return { math.cos(a), math.sin(a), 0 }, { 0, 0, 1 } end,
                           integration = "implicit" }
local base = support.fixed{ name = "base", on = part:face "xmin" }
local hit = step.dynamic{ name = "hit", duration = 10*us, dt = 0.25*us, loads = { load.traction{ on = part:face "xmax", x = 10*MPa, y = 5*MPa } } }
problem{ name = "p", substructures = { part }, supports = { base }, steps = { hit }, solver = solver.latin{ pieces = p.pieces, tolerance = 1e-8 }, outputs = {
  output.history{ name = "end", on = part:face "xmax", quantity = "velocity" }, output.history{ name = "stress", on = part:face "zmax", quantity = "von_mises" } } }:run{}
)";
  const DeckRun whole = run_text(scene, {}, 1).at(0), cut = run_text(scene, {{"pieces", "3"}}, 1).at(0);
  for (const char* axis : {"x", "y"})
    EXPECT_LT(difference(whole.column("end", axis), cut.column("end", axis)), 1e-5) << axis;
  EXPECT_LT(difference(whole.column("stress", "von_mises"), cut.column("stress", "von_mises")), 1e-5);
}

}  // namespace
}  // namespace dygita::test::orthotropic_tests

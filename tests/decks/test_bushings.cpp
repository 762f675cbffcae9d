// Springs and dampers between faces in decks, with every solver: swings and static deflections by hand, preload,
// energies, releases, turned and swapped, meshes that do not match, superelements.
#include <gtest/gtest.h>

#include <any>
#include <cmath>

#include "base/error.hpp"
#include "decks/deck_prints.hpp"
#include "reduction/superelement.hpp"

namespace dygita::test::bushings_tests {
namespace {

// A cube of 7.8 g between two springs, on blocks that are fixed: it swings (what = 0), hangs in a field of acceleration
// (1), or is tightened from both sides and let go on one of them (2).
const std::string sandwich = R"(
local p = param{ turned = 0, swapped = 0, unlike = 0, loss = 0.1, vx = 0.3, vz = 1, what = 0, k = 5e9, kt = 2e9 }
local steel = material.elastic{ name = "steel", young = 2000*GPa, poisson = 0, density = 7800 }
local function turned(v)
  if p.turned == 0 then return v end
  local n, c, s = math.sqrt(14), math.cos(0.7), math.sin(0.7)
  local a = { 1/n, 2/n, 3/n }
  local d = a[1]*v[1] + a[2]*v[2] + a[3]*v[3]
  return { c*v[1] + s*(a[2]*v[3] - a[3]*v[2]) + (1 - c)*d*a[1], c*v[2] + s*(a[3]*v[1] - a[1]*v[3]) + (1 - c)*d*a[2], c*v[3] + s*(a[1]*v[2] - a[2]*v[1]) + (1 - c)*d*a[3] }
end
local function box(name, z, height, cells, velocity)
  return substructure{ name = name, material = steel, velocity = velocity, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, height }, cells = cells },
    place = p.turned == 1 and { rotate = { axis = { 1, 2, 3 }, angle = 0.7 } } or nil }
end
local low, high = box("low", -4*mm, 4*mm, { 2, 2, 1 }), box("high", 10*mm, 4*mm, { 2, 2, 1 })
local mid = box("mid", 0, 10*mm, p.unlike == 1 and { 3, 3, 2 } or { 2, 2, 2 }, p.what == 0 and turned{ p.vx, 0, p.vz } or nil)
local function bushing(name, a, b)
  return interface.bushing{ name = name, between = p.swapped == 1 and { b, a } or { a, b }, normal = p.k, tangential = p.kt, loss = p.loss, frequency = 2*kHz }
end
local lower, upper = bushing("lower", low:face "zmax", mid:face "zmin"), bushing("upper", mid:face "zmax", high:face "zmin")
local base = support.fixed{ name = "base", on = { low:face "zmin", high:face "zmax" } }
local steps
if p.what == 0 then
  steps = { step.dynamic{ name = "swing", duration = 1.2*ms, dt = 2*us } }
elseif p.what == 1 then
  local g = turned{ 5e4, 0, -1e5 }
  steps = { step.static{ name = "hang", increments = 2, loads = { load.gravity{ x = g[1], y = g[2], z = g[3] } } } }
else
  local tighten = step.static{ name = "tighten", loads = { load.preload{ on = { lower, upper }, force = 100 } } }
  local rest = step.dynamic{ name = "rest", after = tighten, duration = 0.1*ms, dt = 2*us }
  steps = { tighten, rest, step.dynamic{ name = "let go", after = rest, duration = 0.4*ms, dt = 2*us, loads = { load.release{ on = upper, at = 0.1*ms } } } }
end
problem{ name = "sandwich", substructures = { low, mid, high }, interfaces = { lower, upper }, supports = { base }, steps = steps,
  outputs = { output.joint{ name = "lower", on = lower }, output.joint{ name = "upper", on = upper },
    output.history{ name = "place", on = mid:face "zmax", quantity = "displacement" }, output.energy{} } }:run{}
)";

constexpr double mass = 7.8e-3, area = 1e-4, normal = 5e9, tangential = 2e9;

class EveryBushing : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Bushing, EveryBushing,
                         ::testing::Values("latin{ integration = 'implicit', tolerance = 1e-10 }",
                                           "latin{ integration = 'explicit' }", "monolithic",
                                           "explicit{ bulk_viscosity = false }"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase_if(name, [](char c) { return !std::isalpha(c); });
                           return name;
                         });

// x = v/w_d exp(-zeta w t) sin(w_d t), along the normal and along a tangent at once.
TEST_P(EveryBushing, swings_with_the_frequency_and_decrement_of_a_mass_on_springs) {
  const DeckRun run = run_text(sandwich, {}, 1, GetParam()).at(0);
  const auto expect_swing = [&](const std::string& column, double k, double velocity) {
    const double stiffness = 2 * area * k, omega = std::sqrt(stiffness / mass);
    const double zeta = 0.1 * stiffness / (2 * M_PI * 2e3) / (2 * mass * omega);
    const double swing = omega * std::sqrt(1 - zeta * zeta);
    const std::vector<double>&time = run.table("place").columns[0], &place = run.column("place", column);
    double error = 0.0;
    for (size_t i = 0; i < time.size(); ++i) {
      const double exact = velocity / swing * std::exp(-zeta * omega * time[i]) * std::sin(swing * time[i]);
      error = std::max(error, std::abs(place[i] - exact) * swing / velocity);
    }
    std::cout << "  " << column << " is off by " << error << "\n";
    EXPECT_LT(error, 2e-3) << column;
  };
  expect_swing("z", normal, 1.0);
  expect_swing("x", tangential, 0.3);
  const double moving = 0.5 * mass * (1 + 0.09);
  EXPECT_LT(largest(run.column("energy", "balance")), 1e-5 * moving);
  EXPECT_LT(largest(run.column("energy", "scheme")), 2e-3 * moving);
  // At the end: kinetic energy and what the springs have, less what is damped.
  const double z = run.column("place", "z").back(), x = run.column("place", "x").back();
  EXPECT_NEAR(run.column("energy", "stored").back(), area * (normal * z * z + tangential * x * x), 2e-3 * moving);
  EXPECT_NEAR(run.column("energy", "damping").back(),
              run.column("lower", "damping_work").back() + run.column("upper", "damping_work").back(), 5e-3 * moving);
  EXPECT_GT(run.column("energy", "damping").back(), 0.3 * moving);
}

TEST_P(EveryBushing, hangs_as_deep_as_its_weight_over_the_springs) {
  const DeckRun run = run_text(sandwich, {{"what", "1"}}, 1, GetParam()).at(0);
  const double z = 1e5 * mass / (2 * area * normal), x = 5e4 * mass / (2 * area * tangential);
  EXPECT_NEAR(run.column("lower", "opening").back(), -z, 1e-4 * z);
  EXPECT_NEAR(run.column("upper", "opening").back(), z, 1e-4 * z);
  EXPECT_NEAR(run.column("lower", "slip").back(), x, 1e-4 * x);
  EXPECT_NEAR(run.column("lower", "normal").back(), -0.5e5 * mass, 1e-4 * 1e5 * mass);
  EXPECT_NEAR(run.column("lower", "shear").back(), 0.25e5 * mass, 1e-4 * 1e5 * mass);
  const double stored = area * (normal * z * z + tangential * x * x);
  EXPECT_NEAR(run.column("energy", "stored").back(), stored, 2e-4 * stored);
  EXPECT_NEAR(run.column("upper", "stored_energy").back(), 0.5 * stored, 2e-4 * stored);
  EXPECT_LT(largest(run.column("energy", "balance")), 1e-6 * stored);
}

// Both are tightened to 100 N, which two springs of 5e5 N/m store; the rest moves nothing; a release loses what
// the spring had, and the cube swings on the other.
TEST_P(EveryBushing, is_tightened_rests_and_is_let_go) {
  const DeckRun run = run_text(sandwich, {{"what", "2"}, {"loss", "0"}}, 1, GetParam()).at(0);
  const Table& energy = run.table("energy");
  const double stored = 100.0 * 100.0 / (area * normal), size = stored;
  EXPECT_NEAR(run.column("lower", "normal").front(), 100.0, 1e-3);
  for (size_t i = 0; i < energy.columns[0].size(); ++i) {
    if (energy.step[i] == 2) break;
    if (energy.column("loads")[i] == 0.0) continue;  // before anything
    EXPECT_NEAR(energy.column("stored")[i], stored, 1e-5 * size);
    EXPECT_LT(energy.column("kinetic")[i], 1e-10 * size);
  }
  EXPECT_NEAR(energy.column("loads").back(), stored, 1e-3 * size);
  EXPECT_LT(largest(energy.column("balance")), 2e-4 * size);
  EXPECT_NEAR(energy.column("damping").back(), 0.5 * stored, 1e-3 * size);
  EXPECT_LT(largest(energy.column("scheme")), 1e-3 * size);
  EXPECT_EQ(run.column("upper", "normal").back(), 0.0);
  const double swinging = energy.column("kinetic").back() + energy.column("stored").back();
  EXPECT_NEAR(swinging, 0.5 * stored, 1e-3 * size);
  EXPECT_GT(largest(energy.column("kinetic")), 0.49 * stored);
}

TEST_P(EveryBushing, is_the_same_turned_swapped_and_between_unlike_meshes) {
  for (const char* what : {"0", "1"}) {
    const DeckRun run = run_text(sandwich, {{"what", what}}, 1, GetParam()).at(0);
    for (const char* way : {"turned", "swapped", "unlike"}) {
      const bool is_unlike = way[0] == 'u';
      // The explicit solver has no dampers between unlike meshes.
      if (is_unlike && what[0] == '0' && std::string(GetParam()).starts_with("explicit")) continue;
      const DeckRun other = run_text(sandwich, {{"what", what}, {way, "1"}}, 1, GetParam()).at(0);
      for (const char* column : {"opening", "slip", "stored_energy", "damping_work"}) {
        if (largest(run.column("lower", column)) == 0.0) continue;
        EXPECT_LT(difference(run.column("lower", column), other.column("lower", column)), is_unlike ? 2e-3 : 1e-6)
            << way << " " << column << " " << what;
      }
      EXPECT_LT(difference(run.column("lower", "normal"), other.column("lower", "normal")), is_unlike ? 2e-3 : 1e-6)
          << way << " " << what;
    }
  }
}

// Between meshes that do not match the explicit solver has the springs.
TEST(Bushings, of_unlike_meshes_swing_alike_with_the_explicit_solver) {
  const Settings alike = {{"loss", "0"}}, unlike = {{"loss", "0"}, {"unlike", "1"}};
  const std::string solver = "explicit{ bulk_viscosity = false }";
  const DeckRun one = run_text(sandwich, alike, 1, solver).at(0), other = run_text(sandwich, unlike, 1, solver).at(0);
  EXPECT_LT(difference(one.column("place", "z"), other.column("place", "z")), 2e-3);
  EXPECT_LT(difference(one.column("energy", "stored"), other.column("energy", "stored")), 4e-3);
}

// Their own stiffness bounds the explicit substep: it shortens with its root, and a step beyond the bound diverges.
TEST(Bushings, that_are_stiff_shorten_the_explicit_substep_as_they_must) {
  const auto swing = [&](const char* k, const std::string& safety) {
    return run_text(sandwich, {{"loss", "0"}, {"k", k}, {"kt", k}}, 1,
                    "explicit{ bulk_viscosity = false, safety = " + safety + " }")
        .at(0);
  };
  const double ratio = static_cast<double>(swing("1e17", "0.9").result->iterations) /
                       static_cast<double>(swing("1e15", "0.9").result->iterations);
  EXPECT_NEAR(ratio, 9.0, 1.0);  // ten, but for the cells beside the softer ones
  EXPECT_THROW(swing("1e17", "1.02"), NumericalError);
}

TEST(Bushings, go_to_the_matrices_of_a_superelement) {
  std::string deck = sandwich;
  const auto replace = [&](const std::string& what, const std::string& by) {
    deck.replace(deck.find(what), what.size(), by);
  };
  replace(
      "problem{",
      "problem{ name = 'half', substructures = { low, mid }, interfaces = { lower }, "
      "supports = { support.fixed{ name = 'foot', on = low:face 'zmin' } }, steps = { step.static{ name = 'rest' } },"
      "outputs = { output.superelement{ name = 'element', on = mid:face 'zmax', modes = 4 } } }:run{}\nproblem{");
  for (const char* unlike : {"0", "1"}) {
    const DeckRun run = run_text(deck, {{"what", "1"}, {"unlike", unlike}}, 1).at(0);
    const Superelement& element = *std::any_cast<const SuperelementPtr&>(run.result->findings.begin()->second.model);
    // Along the normal spring, cube and foot in series; the damper alone with the cube as a rigid body.
    const double k = 1 / (1 / (area * normal) + 14e-3 / (2e12 * area)), c = 0.1 * normal / (2 * M_PI * 2e3) * area;
    EXPECT_NEAR(element.stiffness(2, 2), k, 1e-6 * k);
    EXPECT_NEAR(element.damping(2, 2), c, 1e-4 * c);
  }
}

// A rigid block of 20 mm on a layer of 5e9 Pa/m twisted about y: k a^4/12 over all of its face, whichever face is fine.
TEST(Bushing, rocks_as_a_layer_does_whichever_face_is_fine) {
  const char* const rocking = R"(
local p = param{ block = 1, base = 1 }
local stiff = material.elastic{ name = "stiff", young = 1e12, poisson = 0.3, density = 4000 }
local base = substructure{ name = "base", material = stiff, mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { p.base, p.base, 1 } } }
local block = substructure{ name = "block", material = stiff, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { p.block, p.block, 4 }, origin = { 0, 0, 10*mm } } }
local layer = interface.bushing{ name = "layer", between = { base:face "zmax", block:face "zmin" }, normal = 5e9, tangential = 2.5e9 }
problem{ name = "rocking", substructures = { base, block }, interfaces = { layer }, supports = { support.fixed{ name = "ground", on = base:face "zmin" } },
  steps = { step.static{ name = "twisted", loads = { load.torque{ on = block:face "zmax", axis = { 0, 1, 0 }, history = 0.01 } } } },
  outputs = { output.history{ name = "top", on = block:face "zmax", quantity = "displacement", direction = { 1, 0, 0 } } } }:run{}
)";
  const double by_hand = 0.01 / (5e9 * std::pow(0.02, 4) / 12) * 0.02;
  const auto turned = [&](const char* block, const char* base, bool is_told) {
    testing::internal::CaptureStderr();
    const DeckRun run = run_text(rocking, {{"block", block}, {"base", base}}, 1).at(0);
    const bool said = testing::internal::GetCapturedStderr().find("resists rotation 3 times") != std::string::npos;
    EXPECT_EQ(said, is_told);
    return run.column("top", "displacement").back() / by_hand;
  };
  EXPECT_NEAR(turned("8", "8", false), 1 / (1 + 2.0 / 64), 0.01);
  EXPECT_NEAR(turned("8", "1", false), 1 / (1 + 2.0 / 64), 0.01);
  EXPECT_NEAR(turned("1", "8", false), 1 / (1 + 2.0 / 64), 0.01);
  EXPECT_NEAR(turned("1", "1", true), 1.0 / 3.0, 0.01);
}

// A mass on a spring of loss 0.06 has half of that at any amplitude; what the iterations leave shows at small ones.
TEST(Bushing, rings_down_with_half_its_loss_as_far_as_it_is_told) {
  const DeckRun run = run_text(R"(
local stiff = material.elastic{ name = "stiff", young = 1e12, poisson = 0.3, density = 4000 }
local base = substructure{ name = "base", material = stiff, integration = "implicit", mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 2, 2, 1 } } }
local mass = substructure{ name = "mass", material = stiff, integration = "implicit", mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 2, 2, 2 }, origin = { 0, 0, 10*mm } } }
local f = math.sqrt(2e6 / 0.032) / 2 / math.pi
local layer = interface.bushing{ name = "layer", between = { base:face "zmax", mass:face "zmin" }, normal = 5e9, tangential = 2.5e9, loss = 0.06, frequency = f }
local pull = step.static{ name = "pull", loads = { load.force{ on = mass:face "zmax", z = 100 } } }
local ring = step.dynamic{ name = "ring", after = pull, duration = 60*ms, dt = 20*us, loads = { load.force{ on = mass:face "zmax", z = 0 } } }
local u = output.history{ name = "u", on = mass:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
problem{ name = "ring", substructures = { base, mass }, interfaces = { layer }, supports = { support.fixed{ name = "ground", on = base:face "zmin" } }, steps = { pull, ring },
  outputs = { u, output.ringdown{ name = "down", of = u, band = { 0.7*f, 1.4*f } } } }:run{}
)",
                               {}, 1)
                          .at(0);
  const std::string line = run.findings("down").lines.at(0);
  std::cout << line << "\n";
  EXPECT_NE(line.find("2.99 % of critical damping at 2.76"), std::string::npos);
  EXPECT_NE(line.find("3 % of critical damping at 3.7"), std::string::npos);
  EXPECT_NE(line.find("uncertain, since iterations leave"), std::string::npos);
  const std::vector<double>&amplitude = run.column("down", "amplitude"), &damping = run.column("down", "damping");
  for (size_t i = 0; i < damping.size() && amplitude[i] > 0.013 * amplitude[0]; ++i)
    EXPECT_NEAR(damping[i], 0.03, 6e-4);
}

}  // namespace
}  // namespace dygita::test::bushings_tests

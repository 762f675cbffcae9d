// A torque on the end of a square bar: Saint-Venant's twist at rest, and the same motion from every solver.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::torque_tests {
namespace {

const std::string two_bars = R"(
local p = param{ dynamic = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local mesh = mesh.box{ size = { 8*mm, 8*mm, 32*mm }, cells = { 8, 8, 16 } }
local low = substructure{ name = "low", material = steel, mesh = mesh }
local high = substructure{ name = "high", material = steel, mesh = mesh, place = { 0, 0, 32*mm } }
local weld = interface.bonded{ name = "weld", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local function side(part, height)  -- in the middle of a face along the bar
  return part:where(function(x, y, z) return near(x, 8*mm) and near(y, 4*mm) and near(z, height) end)
end
local twist = load.torque{ on = high:face "zmax", axis = { 0, 0, 3 }, history = 12 }
local step = p.dynamic == 1 and step.dynamic{ name = "jerk", duration = 12*us, dt = 0.1*us, loads = { twist } }
  or step.static{ name = "twist", loads = { twist } }
problem{ name = "bar", substructures = { low, high }, interfaces = { weld }, supports = { base }, steps = { step },
  outputs = { output.history{ name = "lower", on = side(low, 16*mm), quantity = "displacement" },
              output.history{ name = "upper", on = side(high, 48*mm), quantity = "displacement" },
              output.history{ name = "end", on = high:face "zmax", quantity = "displacement" } } }:run{}
)";

// A block of 10 mm, pressed by 2 kN, is turned on a plate by less than friction holds; or spreads under the pressure.
TEST(Torque, uses_friction_and_what_spreads_does_not_slide_as_a_whole) {
  const auto used = [](const char* torque, const char* young) {
    const DeckRun run = run_text(R"(
local p = param{ torque = 0, young = 210 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local soft = material.elastic{ name = "soft", young = p.young*GPa, poisson = 0.3, density = 7800 }
local low = substructure{ name = "low", material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 }, origin = { -5*mm, -5*mm, 0 } } }
local high = substructure{ name = "high", material = soft, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 4, 4, 4 }, origin = { 0, 0, 10*mm } } }
local seat = interface.contact{ name = "seat", between = { low:face "zmax", high:face "zmin" }, friction = p.young < 100 and 0.01 or 0.2 }
local press = { load.pressure{ on = high:face "zmax", history = 20*MPa } }
if p.torque > 0 then press[2] = load.torque{ on = high:face "zmax", axis = { 0, 0, 1 }, history = p.torque } end
problem{ name = "turned", substructures = { low, high }, interfaces = { seat }, supports = { support.fixed{ name = "base", on = low:face "zmin" } },
  steps = { step.static{ name = "press", loads = press } } }:run{}
)",
                                 {{"torque", torque}, {"young", young}})
                            .at(0);
    return run.result->contacts.at(0).steps.back();
  };
  // Of an even pressure friction holds 0.2 * 2 kN * 0.3826 * 10 mm, with all of it at the corners 0.7071 * 10 mm: the
  // edges press harder.
  const ContactStep turned = used("0.8", "210");
  EXPECT_LT(turned.friction_used.value(), 0.8 / (0.2 * 2000.0 * 0.3826 * 10e-3));
  EXPECT_GT(turned.friction_used.value(), 0.8 / (0.2 * 2000.0 * 0.7071 * 10e-3));
  EXPECT_LT(turned.shear, 1.0);
  const ContactStep spreads = used("0", "2");
  EXPECT_GT(spreads.sliding.value(), 0.7);
  EXPECT_LT(spreads.friction_used.value(), 0.05);
}

DeckRun run_with(const std::string& solver, bool is_dynamic) {
  return run_text(two_bars, {{"dynamic", is_dynamic ? "1" : "0"}}, 0, solver).at(0);
}

TEST(Torque, twists_a_square_bar_as_saint_venant_says) {
  const DeckRun latin = run_with("latin{ integration = 'implicit', static_tolerance = 1e-9 }", false);
  const double lower = latin.column("lower", "y").back() / 4e-3, upper = latin.column("upper", "y").back() / 4e-3;
  const double shear_modulus = 210e9 / 2.6, constant = 0.140577 * std::pow(8e-3, 4);
  const double by_hand = 12.0 * 32e-3 / (shear_modulus * constant);
  std::cout << "  twist " << upper - lower << " rad, by hand " << by_hand << "\n";
  EXPECT_NEAR(upper - lower, by_hand, 0.02 * by_hand);
  EXPECT_LT(std::hypot(latin.column("end", "x").back(), latin.column("end", "y").back()), 1e-6 * upper * 4e-3);
  const DeckRun monolithic = run_with("monolithic{}", false);
  EXPECT_NEAR(monolithic.column("upper", "y").back(), latin.column("upper", "y").back(), 1e-7 * upper * 4e-3);
}

TEST(Torque, moves_the_bar_alike_in_every_solver) {
  const DeckRun latin = run_with("latin{ integration = 'implicit', tolerance = 1e-8 }", true),
                monolithic = run_with("monolithic{}", true), explicit_run = run_with("explicit{}", true);
  const std::vector<double>&a = latin.column("upper", "y"), &b = monolithic.column("upper", "y");
  ASSERT_EQ(a.size(), b.size());
  const double scale = largest(a);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-7 * scale);
  EXPECT_NEAR(explicit_run.column("upper", "y").back(), a.back(), 0.02 * scale);
}

}  // namespace
}  // namespace dygita::test::torque_tests

// Gaps that a function gives: crowned bars against Hertz, turned, between unlike meshes, with any solver; faces that
// are rough and crowned at once.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/engine.hpp"

namespace dygita::test::gap_functions_tests {
namespace {

// Two bars in plane strain, half of them, whose gap is that of two cylinders: x^2/2R.
const std::string crowned = R"(
local p = param{ turned = 0, unlike = 0, radius = 1, down = 8*um, rough = 0, n = 40 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local n = math.tointeger(p.n)
local place = p.turned == 1 and { rotate = { axis = { 0, 1, 0 }, angle = math.pi / 2 } } or nil
local function bar(name, z, cells)
  return substructure{ name = name, material = steel, place = place, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 0.5*mm, 15*mm }, cells = { cells, 1, cells } } }
end
local low, high = bar("low", -15*mm, n), bar("high", 0, p.unlike == 1 and 3 * n // 4 or n)
local function gap(x, y, z)
  local along = p.turned == 1 and -z or x
  return along^2 / (2 * p.radius)
end
local line = interface.contact{ name = "line", between = { low:face "zmax", high:face "zmin" }, gap = gap, friction = 0,
  compliance = p.rough == 1 and { normal = 1e18 } or nil }
local planes = { low:face "xmin", high:face "xmin", low:face "ymin", low:face "ymax", high:face "ymin", high:face "ymax" }
local supports = { support.symmetry{ name = "planes", on = planes }, support.fixed{ name = "floor", on = low:face "zmin" } }
local down = p.turned == 1 and load.displacement{ on = high:face "zmax", x = -p.down } or load.displacement{ on = high:face "zmax", z = -p.down }
problem{ name = "crowned", substructures = { low, high }, interfaces = { line }, supports = supports,
  steps = { step.static{ name = "press", loads = { down } } },
  outputs = { output.joint{ name = "joint", on = line }, output.footprint{ name = "foot", on = line, about = { 0, 0.25*mm, 0 } } } }:run{}
)";

struct Line {
  double force = 0.0, pressure = 0.0, half_width = 0.0;
};
Line line_of(const DeckRun& run, const char* across = "spread_x") {
  return {-2 * run.column("joint", "normal").back() / 0.5e-3, run.column("foot", "pressure").back(),
          2 * run.column("foot", across).back()};
}

void expect_hertz(const Line& line, double radius, double within) {
  const double modulus = 210e9 / (2 * (1 - 0.09));
  const double half_width = std::sqrt(4 * line.force * radius / (M_PI * modulus));
  const double pressure = std::sqrt(line.force * modulus / (M_PI * radius));
  std::cout << "  half-width " << line.half_width / half_width - 1 << ", pressure " << line.pressure / pressure - 1
            << " off Hertz, " << 1e3 * half_width << " mm\n";
  EXPECT_NEAR(line.half_width, half_width, within * half_width);
  EXPECT_NEAR(line.pressure, pressure, within * pressure);
}

class EveryCrowned : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(GapFunctions, EveryCrowned, ::testing::Values("latin{}", "monolithic"),
                         [](const auto& tested) { return std::string(tested.param).substr(0, 5); });

TEST_P(EveryCrowned, press_as_Hertz_has_it) {
  const DeckRun run = run_text(crowned, {}, 1, GetParam()).at(0);
  EXPECT_TRUE(run.result->converged);
  expect_hertz(line_of(run), 1.0, 0.02);
}

TEST(GapFunctions, are_turned_with_the_bars_and_meet_unlike_meshes) {
  const DeckRun run = run_text(crowned, {}, 1).at(0), turned = run_text(crowned, {{"turned", "1"}}, 1).at(0);
  const Line one = line_of(run), other = line_of(turned, "spread_z");
  EXPECT_NEAR(other.force, one.force, 1e-6 * one.force);
  EXPECT_NEAR(other.pressure, one.pressure, 1e-6 * one.pressure);
  expect_hertz(line_of(run_text(crowned, {{"unlike", "1"}}, 1).at(0)), 1.0, 0.04);
}

// An infinite stiffness is exact contact.
TEST(GapFunctions, go_with_rough_faces) {
  const Line exact = line_of(run_text(crowned, {}, 1).at(0)),
             stiff = line_of(run_text(crowned, {{"rough", "1"}}, 1).at(0));
  EXPECT_NEAR(stiff.force, exact.force, 1e-4 * exact.force);
  EXPECT_NEAR(stiff.pressure, exact.pressure, 1e-4 * exact.pressure);
}

}  // namespace
}  // namespace dygita::test::gap_functions_tests

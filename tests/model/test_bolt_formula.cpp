// The hand formula of a bolted joint against numbers worked out by hand, and its limit cases.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "model/bolt_formula.hpp"

namespace dygita {
namespace {

constexpr double pi = std::numbers::pi;

// M12 in steel, 28 mm of grip.
BoltDimensions m12() {
  BoltDimensions b;
  b.diameter = b.core = 12e-3;
  b.grip = 28e-3;
  b.head = 19e-3;
  b.hole = 13.5e-3;
  b.outer = 50e-3;
  b.young = b.plate_young = 210e9;
  return b;
}

TEST(BoltFormula, of_the_bolt_is_the_sum_of_its_lengths) {
  const double area = pi * 36e-6;
  EXPECT_NEAR(bolt_resilience(m12()).bolt, (28e-3 + 6e-3 + 6e-3 + 4.8e-3) / (210e9 * area), 1e-21);
  BoltDimensions threaded = m12();
  threaded.core = 10e-3;
  threaded.thread = 8e-3;
  const double core = pi * 25e-6;
  EXPECT_NEAR(bolt_resilience(threaded).bolt,
              (20e-3 / area + 8e-3 / core + 6e-3 / area + 6e-3 / core + 4.8e-3 / area) / 210e9, 1e-21);
  threaded.is_tapped = true;
  threaded.plate_young = 70e9;
  EXPECT_NEAR(bolt_resilience(threaded).bolt,
              (20e-3 / area + 8e-3 / core + 6e-3 / area + 6e-3 / core) / 210e9 + 0.33 * 12e-3 / (70e9 * area), 1e-21);
}

TEST(BoltFormula, of_wide_plates_is_two_cones) {
  // tan phi = 0.362 + 0.032 ln(28/38) + 0.153 ln(50/19) = 0.50027; the cones end at 19 + 28 tan phi = 33.008 mm.
  const BoltResilience r = bolt_resilience(m12());
  const double tangent = 0.362 + 0.032 * std::log(28.0 / 38.0) + 0.153 * std::log(50.0 / 19.0);
  EXPECT_NEAR(tangent, 0.50027, 5e-6);
  // Integral of dz / (E A(z)) over both cones.
  double integral = 0.0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double z = (i + 0.5) / n * 14e-3, d = 19e-3 + 2 * z * tangent;
    integral += 2 * 14e-3 / n / (210e9 * pi / 4 * (d * d - 13.5e-3 * 13.5e-3));
  }
  EXPECT_NEAR(r.plates, integral, 1e-6 * integral);
  EXPECT_NEAR(r.load_factor(), r.plates / (r.plates + r.bolt), 1e-15);
}

TEST(BoltFormula, of_narrow_plates_ends_in_a_sleeve) {
  BoltDimensions b = m12();
  b.outer = 19e-3;
  const double sleeve = 28e-3 / (210e9 * pi / 4 * (b.outer * b.outer - b.hole * b.hole));
  EXPECT_NEAR(bolt_resilience(b).plates, sleeve, 1e-12 * sleeve);
  // Just wider: no jump; wider still, less resilience.
  b.outer = 19.0001e-3;
  EXPECT_NEAR(bolt_resilience(b).plates, sleeve, 1e-4 * sleeve);
  double before = sleeve;
  for (const double outer : {21e-3, 24e-3, 28e-3, 40e-3}) {
    b.outer = outer;
    EXPECT_LT(bolt_resilience(b).plates, before) << outer;
    before = bolt_resilience(b).plates;
  }
}

TEST(BoltFormula, of_a_tapped_part_is_one_cone) {
  BoltDimensions b = m12();
  b.is_tapped = true;
  const double tangent = 0.348 + 0.013 * std::log(28.0 / 19.0) + 0.193 * std::log(50.0 / 19.0);
  double integral = 0.0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double z = (i + 0.5) / n * 28e-3, d = std::min(50e-3, 19e-3 + 2 * z * tangent);
    integral += 28e-3 / n / (210e9 * pi / 4 * (d * d - 13.5e-3 * 13.5e-3));
  }
  EXPECT_NEAR(bolt_resilience(b).plates, integral, 1e-5 * integral);
}

TEST(BoltFormula, refuses_what_is_no_bolt) {
  BoltDimensions b = m12();
  b.hole = 20e-3;
  EXPECT_THROW(bolt_resilience(b), ContractError);
}

}  // namespace
}  // namespace dygita

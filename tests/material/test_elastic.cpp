#include <gtest/gtest.h>

#include <numbers>

#include "base/error.hpp"
#include "material/elastic.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

// Values of a steel worked out by hand: E = 210 GPa, nu = 0.3, rho = 7800 kg/m^3.
Elastic steel() { return {"steel", 210e9, 0.3, 7800.0, {}}; }

TEST(Elastic, has_the_moduli_and_the_wave_speeds_of_a_steel) {
  EXPECT_NEAR(steel().shear_modulus(), 80.769230769e9, 1.0);
  EXPECT_NEAR(steel().p_wave_modulus(), 282.692307692e9, 1.0);
  EXPECT_NEAR(steel().p_wave_speed(), 6020.18, 0.01);
  EXPECT_NEAR(steel().s_wave_speed(), 3217.92, 0.01);
}

// Uniaxial tension: strain 1/E along, -nu/E across; shear: 1/G; all-round pressure: 1/K with K = E / (3 (1 - 2 nu)).
TEST(Elastic, has_the_hooke_matrix_whose_inverse_is_the_compliance_of_the_engineer) {
  const Elastic m = steel();
  const Eigen::Matrix<double, 6, 6> compliance = inverse(m.hooke());
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double expected = i != j  ? (i < 3 && j < 3 ? -0.3 / m.young() : 0.0)
                              : i < 3 ? 1 / m.young()
                                      : 2.6 / m.young();
      EXPECT_NEAR(compliance(i, j) * m.young(), expected * m.young(), 1e-13) << i << ", " << j;
    }
  EXPECT_EQ(m.hooke(), m.hooke().transpose());
}

TEST(Elastic, carries_waves_without_lateral_effect_at_zero_poisson_ratio) {
  const Elastic m{"foam", 900.0, 0.0, 1.0, {}};
  EXPECT_DOUBLE_EQ(m.p_wave_modulus(), 900.0);
  EXPECT_DOUBLE_EQ(m.p_wave_speed(), 30.0);
  EXPECT_DOUBLE_EQ(m.s_wave_speed(), std::sqrt(450.0));
}

TEST(Damping, has_the_ratios_it_was_asked_for) {
  const Damping one = damping_of(0.02, 1000.0);
  EXPECT_EQ(one.mass, 0.0);
  EXPECT_NEAR(one.stiffness, 0.02 / (std::numbers::pi * 1000.0), 1e-18);
  EXPECT_NEAR(one.ratio(1000.0), 0.02, 1e-15);
  EXPECT_NEAR(one.ratio(5000.0), 0.1, 1e-15);
  const Damping two = damping_of({0.02, 0.03}, {200.0, 2000.0});
  EXPECT_NEAR(two.ratio(200.0), 0.02, 1e-15);
  EXPECT_NEAR(two.ratio(2000.0), 0.03, 1e-15);
  EXPECT_LT(two.ratio(500.0), 0.02);
  const Damping swapped = damping_of({0.03, 0.02}, {2000.0, 200.0});
  EXPECT_NEAR(swapped.mass, two.mass, 1e-12);
  EXPECT_NEAR(swapped.stiffness, two.stiffness, 1e-18);
  EXPECT_THROW(damping_of({0.01, 0.09}, {1000.0, 2000.0}), InputError);
  EXPECT_THROW(damping_of({0.09, 0.01}, {1000.0, 2000.0}), InputError);
  EXPECT_THROW(damping_of({0.01, 0.01}, {1000.0, 1000.0}), InputError);
}

TEST(Damping, over_a_band_is_one_ratio_in_it_and_falls_beyond) {
  for (const double ratio : {0.001, 0.015, 0.05, 0.1})
    for (const double width : {1.5, 10.0, 100.0, 1000.0}) {
      const Damping damping = damping_over(ratio, {100.0, 100.0 * width});
      for (double f = 100.0; f <= 100.0 * width; f *= 1.01)
        ASSERT_NEAR(damping.ratio(f), ratio, 0.05 * ratio) << ratio << ", " << width << ", " << f;
      EXPECT_LT(damping.ratio(1.0), 0.1 * ratio);
      EXPECT_LT(damping.ratio(1e4 * width), 0.1 * ratio);
      // The modulus as given in the middle, less below, more above: one loss angle d at all frequencies is that of a
      // modulus that goes with the power 2 d/pi of the frequency.
      EXPECT_NEAR(damping.storage(100.0 * std::sqrt(width)), 1.0, 1e-12);
      const double growth = damping.storage(100.0 * width) / damping.storage(100.0);
      if (width > 5.0) {
        const double expected = std::pow(width, 4.0 / std::numbers::pi * std::asin(ratio));
        EXPECT_NEAR(growth, expected, 0.05 * expected) << ratio << ", " << width;
      }
      EXPECT_GT(damping.storage(100.0 * width), damping.storage(100.0));
      EXPECT_GT(damping.storage(0.0), 0.2);
    }
  EXPECT_TRUE(damping_over(0.0, {100.0, 1000.0}).branches.empty());
  EXPECT_THROW(damping_over(0.2, {1.0, 1e6}), InputError);
}

}  // namespace
}  // namespace dygita::test

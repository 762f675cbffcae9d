// Orthotropic materials against the closed forms of textbooks (Jones, Mechanics of Composite Materials).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "material/material.hpp"

namespace dygita::test {
namespace {

using std::numbers::pi;

// A ply of carbon fibres.
const MaterialNumbers ply = {{"e1", 140e9},  {"e2", 10e9}, {"e3", 9e9},  {"nu12", 0.3}, {"nu13", 0.25},
                             {"nu23", 0.45}, {"g12", 5e9}, {"g13", 4e9}, {"g23", 3e9},  {"density", 1600.0}};

Elastic make(const std::string& word, const MaterialNumbers& numbers) {
  for (const MaterialEntry& entry : material_table())
    if (entry.word == word) return entry.make(numbers);
  throw std::runtime_error("no material " + word);
}

Elastic changed(MaterialNumbers numbers, const std::string& name, double value) {
  numbers[name] = value;
  return make("orthotropic", numbers);
}

std::string refusal_of(const MaterialNumbers& numbers) {
  try {
    make("orthotropic", numbers);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Mat3 some_turn() { return Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix(); }

TEST(Orthotropic, has_the_compliance_of_its_engineering_constants) {
  const Mat6 s = make("orthotropic", ply).tensor().compliance();
  Mat6 expected = Mat6::Zero();
  expected.diagonal() << 1 / 140e9, 1 / 10e9, 1 / 9e9, 1 / 5e9, 1 / 3e9, 1 / 4e9;  // shear 12, 23, 31
  expected(0, 1) = expected(1, 0) = -0.3 / 140e9;
  expected(0, 2) = expected(2, 0) = -0.25 / 140e9;
  expected(1, 2) = expected(2, 1) = -0.45 / 10e9;
  EXPECT_LT((s - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.maxCoeff());
}

// 1/e = c^4/e1 + s^4/e2 + (1/g12 - 2 nu12/e1) s^2 c^2.
TEST(Orthotropic, has_the_modulus_of_a_bar_off_its_axes) {
  const ElasticTensor tensor = make("orthotropic", ply).tensor();
  for (const double degrees : {0.0, 10.0, 30.0, 45.0, 75.0, 90.0}) {
    const double angle = degrees * pi / 180, c = std::cos(angle), s = std::sin(angle);
    const double compliance = std::pow(c, 4) / 140e9 + std::pow(s, 4) / 10e9 + (1 / 5e9 - 0.6 / 140e9) * s * s * c * c;
    EXPECT_NEAR(tensor.young({c, s, 0}) * compliance, 1.0, 1e-12) << degrees;
  }
}

TEST(Orthotropic, turned_by_a_right_angle_has_its_constants_permuted) {
  Mat3 axes;  // axis 1 along y, 2 along z, 3 along x
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const MaterialNumbers permuted = {{"e1", 9e9},
                                    {"e2", 140e9},
                                    {"e3", 10e9},
                                    {"nu12", 0.25 * 9e9 / 140e9},
                                    {"nu13", 0.45 * 9e9 / 10e9},
                                    {"nu23", 0.3},
                                    {"g12", 4e9},
                                    {"g13", 3e9},
                                    {"g23", 5e9},
                                    {"density", 1600.0}};
  const Mat6 turned = make("orthotropic", ply).tensor().turned(axes).stiffness();
  EXPECT_LT((turned - make("orthotropic", permuted).hooke()).cwiseAbs().maxCoeff(), 1e-12 * turned.maxCoeff());
}

TEST(Orthotropic, of_the_constants_of_a_steel_is_that_steel) {
  const double g = 210e9 / 2.6;
  const Elastic one = make("orthotropic", {{"e1", 210e9},
                                           {"e2", 210e9},
                                           {"e3", 210e9},
                                           {"nu12", 0.3},
                                           {"nu13", 0.3},
                                           {"nu23", 0.3},
                                           {"g12", g},
                                           {"g13", g},
                                           {"g23", g},
                                           {"density", 7800.0}}),
                other = make("elastic", {{"young", 210e9}, {"poisson", 0.3}, {"density", 7800.0}});
  EXPECT_FALSE(one.is_isotropic());
  EXPECT_TRUE(other.is_isotropic());
  const double size = other.p_wave_modulus();
  EXPECT_LT((one.hooke() - other.hooke()).cwiseAbs().maxCoeff(), 1e-13 * size);
  EXPECT_LT((one.tensor().turned(some_turn()).stiffness() - other.hooke()).cwiseAbs().maxCoeff(), 1e-13 * size);
  EXPECT_NEAR(one.p_wave_speed(), other.p_wave_speed(), 1e-9 * other.p_wave_speed());
  EXPECT_NEAR(one.s_wave_speed(), other.s_wave_speed(), 1e-9 * other.p_wave_speed());
  const Vec3 normal = Vec3(1, -2, 2) / 3;
  EXPECT_LT((one.tensor().impedance(normal, 7800) - other.tensor().impedance(normal, 7800)).norm(),
            1e-13 * 7800 * 6020);
  EXPECT_NEAR(one.tensor().young(normal), 210e9, 1e-13 * size);
  EXPECT_NEAR(one.tensor().bulk_modulus(), 175e9, 1e-13 * size);
  EXPECT_NEAR(other.tensor().bulk_modulus(), 175e9, 1e-13 * size);
  Vec6 stress;
  stress << 1, -2, 3, 0.5, -1, 2;
  EXPECT_NEAR(one.tensor().energy_density(stress), other.tensor().energy_density(stress), 1e-22);
}

// Along an axis the three waves are those of its own stiffness and of two shear moduli; between axes 1 and 2 the wave
// that moves along 3 has the mean of the shear moduli 13 and 23.
TEST(Orthotropic, carries_waves_by_direction) {
  const Elastic m = make("orthotropic", ply);
  const Mat6 c = m.hooke();
  const Vec3 along_1 = m.wave_speeds(Vec3::UnitX()), along_3 = m.wave_speeds(Vec3::UnitZ());
  EXPECT_NEAR(along_1[0], std::sqrt(c(0, 0) / 1600), 1e-6);
  EXPECT_NEAR(along_1[1], std::sqrt(5e9 / 1600), 1e-6);
  EXPECT_NEAR(along_1[2], std::sqrt(4e9 / 1600), 1e-6);
  EXPECT_NEAR(along_3[0], std::sqrt(c(2, 2) / 1600), 1e-6);
  EXPECT_NEAR(along_3[1], std::sqrt(4e9 / 1600), 1e-6);
  EXPECT_NEAR(along_3[2], std::sqrt(3e9 / 1600), 1e-6);
  const Vec3 between = Vec3(1, 1, 0).normalized();
  EXPECT_NEAR(m.tensor().acoustic(between)(2, 2), 3.5e9, 1.0);
  EXPECT_EQ(m.p_wave_speed() >= along_1[0], true);
  EXPECT_LE(m.s_wave_speed(), std::sqrt(3e9 / 1600) * (1 + 1e-12));
}

// No direction of many has a wave beyond the two extremes.
TEST(Orthotropic, knows_its_fastest_and_its_slowest_wave) {
  for (const auto& [name, value] : {std::pair("g12", 5e9), std::pair("g12", 60e9), std::pair("g23", 0.5e9)}) {
    const Elastic m = changed(ply, name, value);
    double fastest = 0.0, slowest = 1e9;
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j <= 100; ++j) {
        const double a = i * pi / 100, z = j / 100.0, r = std::sqrt(1 - z * z);
        const Vec3 speeds = m.wave_speeds({r * std::cos(a), r * std::sin(a), z});
        fastest = std::max(fastest, speeds[0]);
        slowest = std::min(slowest, speeds[2]);
      }
    EXPECT_LE(fastest, m.p_wave_speed() * (1 + 1e-9)) << name << value;
    EXPECT_GE(slowest, m.s_wave_speed() * (1 - 1e-9)) << name << value;
    EXPECT_NEAR(fastest, m.p_wave_speed(), 1e-3 * fastest) << name << value;
    EXPECT_NEAR(slowest, m.s_wave_speed(), 1e-2 * slowest) << name << value;
  }
}

// rho c along each of the three motions.
TEST(Orthotropic, has_the_impedance_of_its_waves) {
  const Elastic m = make("orthotropic", ply);
  const Mat3 z = m.tensor().impedance(Vec3::UnitY(), 1600);
  EXPECT_NEAR(z(1, 1), std::sqrt(1600 * m.hooke()(1, 1)), 1e-3);
  EXPECT_NEAR(z(0, 0), std::sqrt(1600 * 5e9), 1e-3);
  EXPECT_NEAR(z(2, 2), std::sqrt(1600 * 3e9), 1e-3);
  const Mat3 turn = some_turn();
  const Mat3 turned = m.tensor().turned(turn).impedance(turn * Vec3::UnitY(), 1600);
  EXPECT_LT((turned - turn * z * turn.transpose()).norm(), 1e-12 * z.norm());
}

TEST(Orthotropic, has_a_key_of_what_its_matrices_are_made_of) {
  const Elastic m = make("orthotropic", ply);
  Elastic named = m;
  named.name = "other";
  EXPECT_EQ(m.key(), named.key());
  for (const char* name : {"e1", "e2", "e3", "nu12", "nu13", "nu23", "g12", "g13", "g23", "density"})
    EXPECT_NE(m.key(), changed(ply, name, 1.01 * ply.at(name)).key()) << name;
}

TEST(Orthotropic, is_refused_with_the_ratio_that_gives_energy_away) {
  const auto with = [](std::initializer_list<std::pair<const char*, double>> changes) {
    MaterialNumbers numbers = ply;
    for (const auto& [name, value] : changes) numbers[name] = value;
    return refusal_of(numbers);
  };
  EXPECT_EQ(with({}), "");
  EXPECT_EQ(with({{"nu12", 3.6}, {"nu13", 0.0}, {"nu23", 0.0}}), "");  // sqrt(140 / 10) = 3.74
  EXPECT_NE(with({{"nu12", 3.8}}).find("'nu12' = 3.8 is too large: |nu12| must be below sqrt(e1/e2) = 3.742"),
            std::string::npos);
  EXPECT_NE(with({{"nu13", -4.0}}).find("'nu13' = -4"), std::string::npos);
  EXPECT_NE(with({{"nu23", 1.1}}).find("'nu23' = 1.1"), std::string::npos);
  EXPECT_NE(with({{"nu12", 2.5}, {"nu13", 2.5}, {"nu23", 0.9}}).find("too large together"), std::string::npos);
}

}  // namespace
}  // namespace dygita::test

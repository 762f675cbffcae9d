// How near a stress comes to what a material bears, by criteria that are known by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "material/strength.hpp"

namespace dygita {
namespace {

const std::map<std::string, double> ply = {{"xt", 1500e6}, {"xc", 1200e6}, {"yt", 50e6},  {"yc", 200e6}, {"zt", 40e6},
                                           {"zc", 180e6},  {"s12", 70e6},  {"s13", 65e6}, {"s23", 60e6}};

Vec6 along(int component, double stress) {
  Vec6 s = Vec6::Zero();
  s[component] = stress;
  return s;
}

std::map<std::string, double> changed(std::map<std::string, double> given, const std::string& name, double value) {
  given[name] = value;
  return given;
}

// Along each axis alone, in each sense, the index is stress over strength, in both criteria.
TEST(Strength, along_one_axis_is_stress_over_strength) {
  const Strength wu(ply, Criterion::tsai_wu);
  const char* tension[3] = {"xt", "yt", "zt"};
  const char* compression[3] = {"xc", "yc", "zc"};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(wu.failure(along(i, 30e6)).index, 30e6 / ply.at(tension[i]), 1e-12);
    EXPECT_NEAR(wu.failure(along(i, -30e6)).index, 30e6 / ply.at(compression[i]), 1e-12);
  }
  for (const auto& [component, name] : {std::pair(3, "s12"), {4, "s23"}, {5, "s13"}})
    EXPECT_NEAR(wu.failure(along(component, -30e6)).index, 30e6 / ply.at(name), 1e-12);

  const Strength hashin(ply, Criterion::hashin);
  EXPECT_NEAR(hashin.failure(along(0, 30e6)).index, 30e6 / 1500e6, 1e-12);
  EXPECT_NEAR(hashin.failure(along(0, -30e6)).index, 30e6 / 1200e6, 1e-12);
  for (const int across : {1, 2}) {
    EXPECT_NEAR(hashin.failure(along(across, 30e6)).index, 30e6 / 50e6, 1e-12);
    EXPECT_NEAR(hashin.failure(along(across, -30e6)).index, 30e6 / 200e6, 1e-12);
    EXPECT_EQ(hashin.failure(along(across, -30e6)).mode, FailureMode::matrix_compression);
  }
  EXPECT_NEAR(hashin.failure(along(5, 30e6)).index, 30e6 / 70e6, 1e-12);  // alike across the fibres
}

// With equal strengths Tsai's and Wu's criterion is von Mises', pressure alone included.
TEST(Strength, of_equal_strengths_is_von_mises) {
  const double y = 300e6, s = y / std::sqrt(3.0);
  const Strength equal(
      {{"xt", y}, {"xc", y}, {"yt", y}, {"yc", y}, {"zt", y}, {"zc", y}, {"s12", s}, {"s13", s}, {"s23", s}},
      Criterion::tsai_wu);
  Vec6 stress;
  stress << 120e6, -40e6, 70e6, 30e6, -60e6, 20e6;
  const double mises =
      std::sqrt(0.5 * (160.0 * 160 + 110.0 * 110 + 50.0 * 50) + 3 * (30.0 * 30 + 60.0 * 60 + 20.0 * 20)) * 1e6;
  EXPECT_NEAR(equal.failure(stress).index, mises / y, 1e-12);
  EXPECT_NEAR(equal.failure(-stress).index, mises / y, 1e-12);
  stress << 1e9, 1e9, 1e9, 0, 0, 0;
  EXPECT_NEAR(equal.failure(stress).index, 0.0, 1e-6);
}

// The index grows with the load, and at its inverse the polynomial is one.
TEST(Strength, index_is_the_inverse_of_the_factor_to_failure) {
  Vec6 stress;
  stress << 300e6, -20e6, 10e6, 15e6, 5e6, -8e6;
  for (const Criterion criterion : {Criterion::tsai_wu, Criterion::hashin}) {
    const Strength strength(ply, criterion);
    const double index = strength.failure(stress).index;
    EXPECT_GT(index, 0.0);
    EXPECT_NEAR(strength.failure(3.0 * stress).index, 3.0 * index, 1e-12);
    EXPECT_NEAR(strength.failure(stress / index).index, 1.0, 1e-12);
  }
  const double f11 = 1 / (1500e6 * 1200e6), f22 = 1 / (50e6 * 200e6), f12 = 0.2 * std::sqrt(f11 * f22);
  const Strength coupled(changed(ply, "f12", 0.2), Criterion::tsai_wu);
  Vec6 two = Vec6::Zero();
  two[0] = 400e6, two[1] = 20e6;
  two /= coupled.failure(two).index;
  EXPECT_NEAR((1 / 1500e6 - 1 / 1200e6) * two[0] + (1 / 50e6 - 1 / 200e6) * two[1] + f11 * two[0] * two[0] +
                  f22 * two[1] * two[1] + 2 * f12 * two[0] * two[1],
              1.0, 1e-12);
}

TEST(Strength, refuses_what_is_missing_or_would_never_fail) {
  const auto refused = [](const std::map<std::string, double>& given, Criterion criterion, const std::string& words) {
    try {
      Strength made(given, criterion);
      FAIL() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  auto less = ply;
  less.erase("zc");
  refused(less, Criterion::tsai_wu, "'strength.zc' is missing");
  less.erase("zt"), less.erase("s13");
  EXPECT_NO_THROW(Strength(less, Criterion::hashin));
  refused(changed(changed(ply, "f12", -0.9), "f13", -0.9), Criterion::tsai_wu, "are too large together");
  refused(changed(ply, "yt", 130e6), Criterion::hashin, "more than twice 'strength.s23'");
}

}  // namespace
}  // namespace dygita

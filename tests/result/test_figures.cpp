// Figures of a run under the names that its record gives them.
#include <gtest/gtest.h>

#include "result/limits.hpp"
#include "result/recorded_figures.hpp"

namespace dygita {
namespace {

TEST(Figures, are_recorded_by_label_where_the_run_has_them) {
  Figures figures;
  EXPECT_TRUE(by_label(figures).empty());
  figures.energy_imbalance = 0.25;
  figures.substitutions = 12.0;
  figures.mesh_error = 0.0;
  const std::map<std::string, double> expected = {
      {"energy imbalance [%]", 0.25}, {"substitutions", 12.0}, {"error estimate, mesh [%]", 0.0}};
  EXPECT_EQ(by_label(figures), expected);
  EXPECT_STREQ(label(&Figures::energy_gain), "energy created by the scheme [%]");
}

TEST(Figures, of_outputs_carry_their_names) {
  Problem problem;
  RunResult result;
  const auto spectrum = std::make_shared<Output>();
  spectrum->name = "above";
  spectrum->specification = std::make_shared<Specification>(Specification{{10.0, 1000.0}, {1.0, 1.0}, "deck"});
  problem.outputs = {spectrum};
  result.tables[spectrum.get()] = {{"frequency", "maximax"}, {"Hz", "m/s^2"}, {{100.0, 200.0}, {0.1, 10.0}}, {}};
  result.bands[spectrum.get()] = {{"frequency", "mesh", "all"}, {"Hz", "dB", "dB"}, {{1, 2}, {1, 3}, {2, 5}}, {}};
  const std::map<std::string, double> figures = recorded_figures(problem, result);
  EXPECT_EQ(figures.size(), 4u);
  EXPECT_DOUBLE_EQ(figures.at("spectrum 'above', mean band, mesh [dB]"), 2.0);
  EXPECT_DOUBLE_EQ(figures.at("spectrum 'above', mean band, all [dB]"), 3.5);
  EXPECT_NEAR(figures.at("largest exceedance of the specification of 'above' [dB]"), 20.0, 1e-12);
  EXPECT_DOUBLE_EQ(figures.at("frequency of the largest exceedance of 'above' [Hz]"), 200.0);
}

TEST(Limits, of_what_a_penalty_holds_and_of_its_error_are_one) {
  EXPECT_DOUBLE_EQ(limit::penalty_energy_of(limit::penalty_error_of(limit::penalty_energy)), limit::penalty_energy);
}

}  // namespace
}  // namespace dygita

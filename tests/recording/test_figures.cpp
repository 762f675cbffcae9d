// Figures of a run under the names that its record gives them.
#include <gtest/gtest.h>

#include "recording/given_output.hpp"
#include "result/limits.hpp"
#include "result/recorded_figures.hpp"

namespace dygita::figures_tests {
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

TEST(Figures, of_outputs_stand_beside_those_of_the_run) {
  RunResult result;
  result.figures.energy_gain = 1.0;
  const OutputPtr loop = make_history("path", {}, "displacement");
  result.findings[loop.get()].figures["loop 'path', first stiffness [N/m]"] = 2.0;
  const std::map<std::string, double> expected = {{"energy created by the scheme [%]", 1.0},
                                                  {"loop 'path', first stiffness [N/m]", 2.0}};
  EXPECT_EQ(recorded_figures(result), expected);
}

TEST(Limits, of_what_a_penalty_holds_and_of_its_error_are_one) {
  EXPECT_DOUBLE_EQ(limit::penalty_energy_of(limit::penalty_error_of(limit::penalty_energy)), limit::penalty_energy);
}

}  // namespace
}  // namespace dygita::figures_tests

// What a run tells of its estimated errors.
#include <gtest/gtest.h>

#include <algorithm>

#include "run/error_lines.hpp"

namespace dygita::error_lines_tests {
namespace {

struct Shock {
  Problem problem;
  RunResult result;

  Shock(double iteration_error, int iterations) {
    Figures& figures = result.figures;
    figures.mean_frequency = 3e3;
    figures.iteration_error = iteration_error;
    figures.time_step_error = 20.0;
    figures.mesh_error = 30.0;
    StepSummary& step = result.steps.emplace_back();
    step.increments = 10;
    step.iterations = 10 * iterations;
  }
  bool tells_of_tolerance() const {
    const std::vector<std::string> lines = error_lines(problem, result);
    return std::any_of(lines.begin(), lines.end(),
                       [](const std::string& line) { return line.find("tolerance = 0.0001") != std::string::npos; });
  }
};

TEST(ErrorLines, name_a_looser_tolerance_where_many_iterations_leave_far_less_than_dt_and_mesh) {
  EXPECT_TRUE(Shock(3e-4, 100).tells_of_tolerance());
  EXPECT_FALSE(Shock(3e-4, 20).tells_of_tolerance());   // few iterations
  EXPECT_FALSE(Shock(2e-3, 100).tells_of_tolerance());  // it would leave 0.6 of 30 %
  Shock loose(3e-4, 100);
  loose.problem.solver.tolerance = 1e-4;
  EXPECT_FALSE(loose.tells_of_tolerance());
  Shock statics(3e-4, 100);
  statics.result.steps[0].is_static = true;
  EXPECT_FALSE(statics.tells_of_tolerance());
}

}  // namespace
}  // namespace dygita::error_lines_tests

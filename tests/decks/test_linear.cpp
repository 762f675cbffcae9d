// The linear comparison of the benchmarks against LATIN on a deck where all interfaces are bonded.
#include <gtest/gtest.h>

#include <fstream>

#include "bench/linear.hpp"
#include "decks/effectivity.hpp"
#include "reference/monolithic.hpp"

namespace dygita::test::linear_tests {
namespace {

// Four parts that meet in an edge, two materials, a symmetry support, traction and gravity; on a fixed base, or thrown.
const char* const four_blocks = R"(
local p = param{ thrown = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.33, density = 2700 }
local function block(name, i, j, material)
  return substructure{ name = name, material = material, velocity = { 0.5 * p.thrown, 0, 0 },
    mesh = mesh.box{ origin = { 3*mm*i, 0, 3*mm*j }, size = { 3*mm, 2*mm, 3*mm }, cells = { 3, 2, 3 } } }
end
local a, b, c, d = block("a", 0, 0, steel), block("b", 1, 0, alloy), block("c", 0, 1, steel), block("d", 1, 1, steel)
local function tie(name, one, two) return interface.bonded{ name = name, between = { one, two } } end
local ties = { tie("ab", a:face "xmax", b:face "xmin"), tie("cd", c:face "xmax", d:face "xmin"),
  tie("ac", a:face "zmax", c:face "zmin"), tie("bd", b:face "zmax", d:face "zmin") }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local plane = support.symmetry{ name = "plane", on = { b:face "ymin", d:face "ymin" } }
local hit = step.dynamic{ name = "hit", duration = 8*us, dt = 0.1*us, loads = { load.gravity{ z = 1e6 },
  load.traction{ on = d:face "zmax", x = history.half_sine{ peak = 40*MPa, duration = 3*us }, z = history.half_sine{ peak = -100*MPa, duration = 4*us } } } }
problem{ name = "four", substructures = { a, b, c, d }, interfaces = ties, supports = p.thrown == 1 and { plane } or { base, plane }, steps = { hit } }:run{}
)";

double difference(const Fields& latin, const bench::LinearAnalysis& linear) {
  double most = 0.0, scale = 0.0;
  const std::vector<Points>& last = latin.displacement.back();
  for (size_t part = 0; part < last.size(); ++part) {
    scale = std::max(scale, last[part].cwiseAbs().maxCoeff());
    most = std::max(most, (last[part] - linear.displacement(static_cast<int>(part))).cwiseAbs().maxCoeff());
  }
  return most / scale;
}

TEST(LinearComparison, moves_as_the_bonded_assembly_does) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dygita_test_linear.lua";
  std::ofstream(path) << four_blocks;
  for (const char* thrown : {"0", "1"}) {
    const EstimatedRun latin = run_estimated(path, {{"thrown", thrown}}, 1e-8);
    Problem problem = latin.problem;
    problem.monolithic = MonolithicSettings{};
    Recorder monolithic(problem);
    solve_monolithic(problem, monolithic);
    bench::LinearAnalysis linear(latin.problem);
    linear.factorise(1);
    for (const auto form : {bench::RightHandSide::stiffness_product, bench::RightHandSide::recurrence}) {
      const bench::LinearSeconds seconds = linear.run({form, 1, 1, 0});
      EXPECT_EQ(seconds.n_steps, 80);
      const double exact = difference(monolithic.fields, linear), iterated = difference(latin.fields, linear);
      std::cout << "  displacements differ by " << exact << " from the monolithic ones, " << iterated
                << " from LATIN's\n";
      EXPECT_LT(exact, 1e-10);
      EXPECT_LT(iterated, 1e-6);
    }
  }
  std::filesystem::remove(path);
}

TEST(LinearComparison, refuses_what_it_does_not_do) {
  const auto problem = [](const std::string& more, const std::string& supports) {
    return run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 )" +
                    more + R"( }
local a = substructure{ name = "a", material = steel, mesh = mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 1, 1, 1 } } }
local hit = step.dynamic{ name = "hit", duration = 1*us, dt = 0.5*us, loads = { load.force{ on = a:face "zmax", z = 1 } } }
problem{ name = "one", substructures = { a }, supports = { )" +
                    supports + R"( }, steps = { hit } }:run{}
)")
        .at(0)
        .problem;
  };
  EXPECT_NO_THROW(bench::LinearAnalysis(problem("", R"(support.fixed{ name = "s", on = a:face "zmin" })")));
  EXPECT_THROW(bench::LinearAnalysis(problem(", damping = { mass = 1e3 }", "")), InputError);
  EXPECT_THROW(bench::LinearAnalysis(problem("", R"(support.wall{ name = "s", on = a:face "zmin" })")), InputError);
  EXPECT_THROW(bench::LinearAnalysis(problem("", R"(support.absorbing{ name = "s", on = a:face "zmin" })")),
               InputError);
}

}  // namespace
}  // namespace dygita::test::linear_tests

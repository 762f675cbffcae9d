// Parametric studies: what starting from another case saves, the same answers, the table and the figure.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/log.hpp"
#include "decks/deck_prints.hpp"
#include "law/law.hpp"
#include "report/study_files.hpp"
#include "result/case_summary.hpp"

namespace dygita::test::studies_tests {
namespace {

// Of each case of a study by name; the runs that check a case cold follow it and are left out.
std::map<double, DeckRun> by_friction(const std::vector<DeckRun>& runs) {
  std::map<double, DeckRun> cases;
  for (const DeckRun& run : runs)
    cases.emplace(std::get<double>(run.problem.interfaces.front()->law->parameters().front().value), run);
  return cases;
}

TEST(StudyFriction, saves_half_of_the_iterations_and_gives_the_same_answers) {
  const PrintedRun warm = run_printing("study_friction.lua"),
                   cold = run_printing("study_friction.lua", {{"cold", "1"}});
  const double warm_iterations = warm.number("iterations of all cases"),
               cold_iterations = cold.number("iterations of all cases");
  EXPECT_LT(warm_iterations, 0.5 * cold_iterations);
  const auto warm_cases = by_friction(warm.runs), cold_cases = by_friction(cold.runs);
  ASSERT_EQ(warm_cases.size(), 10u);
  ASSERT_EQ(cold_cases.size(), 10u);
  for (const auto& [mu, run] : warm_cases) {
    EXPECT_TRUE(run.result->converged) << mu;
    const DeckRun& other = cold_cases.at(mu);
    EXPECT_LT(difference(other.column("joint", "shear"), run.column("joint", "shear")), 1e-5) << mu;
    EXPECT_LT(difference(other.column("joint", "slip"), run.column("joint", "slip")), 1e-5) << mu;
    EXPECT_LT(difference(other.column("joint", "friction_work"), run.column("joint", "friction_work")), 1e-5) << mu;
  }
  EXPECT_NEAR(warm_cases.begin()->second.column("joint", "friction_work").back(), 1.005e-3, 2e-6);
  EXPECT_NEAR(warm_cases.rbegin()->second.column("joint", "friction_work").back(), 5.23e-5, 2e-7);
}

TEST(StudyCrush, saves_some_iterations_in_a_dynamic_step) {
  const PrintedRun warm = run_printing("bench/study_crush.lua"),
                   cold = run_printing("bench/study_crush.lua", {{"cold", "1"}});
  EXPECT_LT(warm.number("iterations of all cases"), 0.9 * cold.number("iterations of all cases"));
}

const std::string three_cases = R"(
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0, density = 7800 }
local cube = substructure{ name = "cube", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 2 } } }
local moved = output.history{ name = "moved, here", on = cube:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
local last
for i = 1, 3 do
  last = problem{ name = "cube", substructures = { cube }, supports = { support.wall{ name = "wall", on = cube:face "zmin" },
      support.symmetry{ name = "sides", on = { cube:face "xmin", cube:face "ymin" } } },
    steps = { step.static{ name = "push", loads = { load.pressure{ on = cube:face "zmax", history = i*MPa } } } }, outputs = { moved },
  }:run{ case = "case " .. i, at = { pressure = i*MPa }, start_from = last, check_cold = i == 2 }
end
)";

TEST(Study, writes_a_table_and_a_figure_beside_its_cases) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("dygita_study_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "cases.lua") << three_cases;
  set_progress_enabled(false);
  DeckOptions options;
  options.path = folder / "cases.lua";
  options.out = folder / "out";
  run_deck(options, Engine{run_problem, check_report});
  std::ifstream csv(folder / "out" / "cube" / "study.csv");
  std::string header, row;
  std::getline(csv, header);
  EXPECT_EQ(
      header,
      "case,started_from,pressure,\"moved, here.displacement largest [m]\",iterations,mean_iterations,cold_iterations,"
      "cold_difference,converged,seconds [s]");
  std::vector<std::vector<std::string>> rows;
  while (std::getline(csv, row)) {
    rows.emplace_back();
    std::istringstream line(row);
    for (std::string cell; std::getline(line, cell, ',');) rows.back().push_back(cell);
  }
  ASSERT_EQ(rows.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i][0], "case " + std::to_string(i + 1));
    EXPECT_EQ(rows[i][1], i == 0 ? "" : "case " + std::to_string(i));
    const double n = static_cast<double>(i + 1);
    EXPECT_DOUBLE_EQ(std::stod(rows[i][2]), n * 1e6);
    EXPECT_NEAR(std::stod(rows[i][3]), n * 1e6 * 10e-3 / 200e9, 1e-9 * 10e-3);
    EXPECT_EQ(rows[i][6].empty(), i != 1);
  }
  std::ostringstream figure;
  figure << std::ifstream(folder / "out" / "cube" / "study.svg").rdbuf();
  EXPECT_EQ(figure.str().rfind("<svg", 0), 0u);
  EXPECT_NE(figure.str().find("moved, here.displacement largest"), std::string::npos);
  std::filesystem::remove_all(folder);
}

// Sheared beyond what friction holds, a case flies off; the ones after it are not dragged along.
TEST(StartFrom, a_case_that_has_not_converged_is_no_start) {
  const std::string deck = R"(
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = metal,
  mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 3, 3, 2 }, origin = { 0, 0, z } } } end
local low, up = block("low", 0), block("up", 10*mm)
local c = interface.contact{ name = "c", between = { low:face "zmax", up:face "zmin" }, friction = 0.2 }
local clamp = load.pressure{ on = up:face "zmax", history = 40*MPa }
local last
for i, shear in ipairs{ 1*kN, 4*kN, 1.5*kN } do
  local press = step.static{ name = "press", loads = { clamp } }
  local pull = step.static{ name = "pull", after = press, increments = 4, loads = { clamp, load.force{ on = up:face "zmax", x = shear } } }
  last = problem{ name = "p", substructures = { low, up }, interfaces = { c }, steps = { press, pull },
    supports = { support.fixed{ name = "base", on = low:face "zmin" } }, outputs = { output.joint{ name = "j", on = c } } }:run{ case = "c" .. i, start_from = last }
end
)";
  take_warnings();
  testing::internal::CaptureStderr();
  const std::vector<DeckRun> runs = run_text(deck);
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_TRUE(runs[0].result->converged);
  EXPECT_FALSE(runs[1].result->converged);
  EXPECT_TRUE(runs[2].result->converged);
  EXPECT_LT(runs[2].column("j", "slip").back(), 1e-5);
  EXPECT_NE(said.find("the initial case has not converged"), std::string::npos) << said;
}

TEST(StudyFigure, has_a_line_for_each_value_of_a_second_parameter_and_leaves_out_what_has_not_converged) {
  std::vector<StudyCase> cases;
  for (const double young : {1e9, 2e9})
    for (const double mu : {0.1, 0.2}) {
      StudyCase one;
      one.name = "c" + std::to_string(cases.size());
      one.at = {{"mu", mu}, {"young", young}};
      one.figures = {{"a.b largest", "N", young * mu}, {"noise largest", "m", 1e-18 * young * mu / 1e9}};
      cases.push_back(one);
    }
  std::string figure = study_svg("s", cases);
  EXPECT_NE(figure.find("young = 1e+09"), std::string::npos);
  EXPECT_NE(figure.find("young = 2e+09"), std::string::npos);
  EXPECT_EQ(figure.find("noise"), std::string::npos);
  cases[3].converged = false;
  cases[3].figures[0].value = 1e30;
  figure = study_svg("s", cases);
  EXPECT_EQ(figure.find("10³⁰"), std::string::npos);
}

TEST(CaseSummary, finds_what_differs_most) {
  DeckRun a = run_text(three_cases).front();
  RunResult b = *a.result;
  EXPECT_EQ(largest_difference(a.problem, *a.result, b).value, 0.0);
  b.tables.begin()->second.columns[1].back() *= 1.01;
  const Difference found = largest_difference(a.problem, *a.result, b);
  EXPECT_NEAR(found.value, 0.01, 1e-9);
  EXPECT_EQ(found.where, "moved, here.displacement");
  b.tables.begin()->second.columns[1].pop_back();
  b.tables.begin()->second.columns[0].pop_back();
  EXPECT_TRUE(std::isinf(largest_difference(a.problem, *a.result, b).value));
}

}  // namespace
}  // namespace dygita::test::studies_tests

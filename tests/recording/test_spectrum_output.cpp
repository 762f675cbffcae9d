// What output.srs makes of a history once a run has ended.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/log.hpp"
#include "recording/given_output.hpp"
#include "recording/recorder.hpp"

namespace dygita::spectrum_output_tests {
namespace {

// A ringing of 1 kHz recorded for 20 ms, and its spectrum about it, held against 10 m/s^2.
class SpectrumOutput : public ::testing::Test {
 protected:
  SpectrumOutput() {
    auto step = std::make_shared<Step>();
    step->name = "shock";
    step->duration = 20e-3;
    step->dt = 20e-6;
    problem.steps = {step};
    history = make_history("above", {}, "acceleration", Vec3::UnitZ());
    GivenArguments arguments = given_spectrum("srs", "spectrum", 500.0, 2000.0);
    arguments.outputs["of"] = history;
    arguments.specifications["specification"] =
        std::make_shared<Specification>(Specification{{100.0, 1e4}, {10.0, 10.0}, "deck"});
    spectrum = make_output(arguments);
    problem.outputs = {history, spectrum};
    Table& table = result.tables[history.get()] = empty_table(history->columns());
    for (int i = 0; i < step->n_increments(); ++i) {
      table.columns[0].push_back(i * step->dt);
      table.columns[1].push_back(std::sin(2.0 * std::numbers::pi * 1e3 * i * step->dt));
      table.step.push_back(0);
    }
    errors.velocity = 1e-3;
    errors.iteration = 0.01;
    errors.time_step = 0.02;
    errors.mesh = 0.1;
  }

  void conclude() {
    spectrum->conclude({problem, result, errors}, result.tables[spectrum.get()], findings());
    take_warnings();
  }
  bool warned_of(const std::string& text) {
    return std::any_of(findings().warnings.begin(), findings().warnings.end(),
                       [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
  }
  Findings& findings() { return result.findings[spectrum.get()]; }

  Problem problem;
  RunResult result;
  OutputPtr history, spectrum;
  ErrorEstimator::Estimate errors;
};

TEST_F(SpectrumOutput, has_a_spectrum_a_band_and_its_distance_from_the_specification) {
  conclude();
  const Table& table = result.tables.at(spectrum.get());
  ASSERT_EQ(table.n_rows(), 25);  // two octaves of 12
  const std::vector<double>& maximax = table.column("maximax");
  const double peak = *std::max_element(maximax.begin(), maximax.end());
  EXPECT_NEAR(peak, 10.0 * (1.0 - std::exp(-std::numbers::pi)), 0.5);  // Q 10 after 20 periods
  EXPECT_EQ(findings().band.n_rows(), 25);
  EXPECT_NEAR(findings().figures.at("largest exceedance of the specification of 'spectrum' [dB]"),
              20.0 * std::log10(peak / 10.0), 1e-12);
  EXPECT_NEAR(findings().figures.at("frequency of the largest exceedance of 'spectrum' [Hz]"), 1e3, 1.0);
  EXPECT_EQ(findings().figures.size(), 7u);
  EXPECT_EQ(findings().lines.size(), 2u);
}

// The ringing of unit amplitude goes on as it began: what is slower than it sees its last velocity as a step.
TEST_F(SpectrumOutput, tells_what_depends_on_the_end_of_its_record_and_warns_beyond_a_decibel) {
  conclude();
  const Table& band = findings().band;
  for (int i = 0; i < band.n_rows(); ++i) {
    double sum = 0.0;
    for (const char* part : {"iteration", "time_step", "mesh", "record"}) sum += std::pow(band.column(part)[i], 2);
    EXPECT_NEAR(band.column("all")[i], std::sqrt(sum), 1e-12);
  }
  EXPECT_TRUE(findings().warnings.empty());
  // Cut to two periods, an oscillator at 1 kHz has come to 1 - exp(-pi/5), and grows.
  Table& table = result.tables[history.get()];
  for (std::vector<double>& column : table.columns) column.resize(100);
  table.step.resize(100);
  conclude();
  EXPECT_TRUE(warned_of("spectrum 'spectrum' still grows when its record ends"));
  const std::vector<double>& record = findings().band.column("record");
  EXPECT_GT(*std::max_element(record.begin(), record.end()), 1.5);
  EXPECT_NEAR(findings().figures.at("spectrum 'spectrum', mean band, record [dB]"),
              std::accumulate(record.begin(), record.end(), 0.0) / 25.0, 1e-12);
  // A pass over the run keeps the warning.
  spectrum->settle(Table(result.tables.at(spectrum.get())), result.tables.at(spectrum.get()), findings());
  EXPECT_TRUE(warned_of("still grows"));
}

TEST_F(SpectrumOutput, warns_of_its_end_where_no_error_is_estimated_too) {
  Table& table = result.tables[history.get()];
  for (std::vector<double>& column : table.columns) column.resize(100);
  table.step.resize(100);
  problem.explicit_dynamics.emplace();
  conclude();
  EXPECT_TRUE(warned_of("still grows"));
}

// The step that a cut leaves belongs to what comes after the record.
TEST_F(SpectrumOutput, judges_the_response_during_the_record_where_asked) {
  GivenArguments arguments = given_spectrum("srs", "spectrum", 60.0, 200.0);
  arguments.outputs["of"] = history;
  arguments.specifications["specification"] =
      std::make_shared<Specification>(Specification{{10.0, 1e4}, {10.0, 10.0}, "deck"});
  Table& table = result.tables[history.get()];
  for (int i = 0; i < 1000; ++i) table.columns[1][static_cast<size_t>(i)] *= std::min(i / 500.0, 1.0);
  for (std::vector<double>& column : table.columns) column.resize(975);  // at the largest velocity
  table.step.resize(975);
  const auto level = [&](const char* column) { return result.tables.at(spectrum.get()).column(column).front(); };
  for (const char* judged : {"maximax", "primary"}) {
    arguments.words["judge"] = judged;
    spectrum = make_output(arguments);
    conclude();
    EXPECT_GT(level("maximax"), 1.5 * level("primary"));
    const Table& spectra = result.tables.at(spectrum.get());
    const std::vector<double>& values = spectra.column(judged);
    EXPECT_NEAR(findings().figures.at("largest exceedance of the specification of 'spectrum' [dB]"),
                20.0 * std::log10(*std::max_element(values.begin(), values.end()) / 10.0), 1e-9);
    EXPECT_EQ(warned_of("depends on where its record ends"), std::string(judged) == "maximax");
  }
}

TEST_F(SpectrumOutput, tells_the_mean_of_its_band_and_warns_beyond_a_factor_of_two) {
  conclude();
  double sum = 0.0;
  for (const double value : findings().band.column("all")) sum += value;
  const double mean = sum / 25.0;
  EXPECT_DOUBLE_EQ(findings().figures.at("spectrum 'spectrum', mean band, all [dB]"), mean);
  EXPECT_LT(mean, 6.0);
  EXPECT_TRUE(findings().warnings.empty());
  errors.velocity = 10.0;
  conclude();
  ASSERT_EQ(findings().warnings.size(), 1u);
  EXPECT_EQ(findings().warnings[0].find("spectrum 'spectrum' is uncertain by about"), 0u) << findings().warnings[0];
}

TEST_F(SpectrumOutput, has_no_band_where_the_solver_estimates_no_error_of_iteration) {
  problem.explicit_dynamics.emplace();
  conclude();
  EXPECT_EQ(findings().band.n_rows(), 0);
  EXPECT_EQ(findings().figures.size(), 2u);
}

TEST_F(SpectrumOutput, takes_what_it_has_moved_since_the_pass_before_for_its_band_of_iteration) {
  conclude();
  Table before = result.tables.at(spectrum.get());
  for (double& value : before.columns[1]) value *= std::pow(10.0, 0.1);  // 2 dB
  EXPECT_TRUE(spectrum->settles());
  EXPECT_NEAR(spectrum->settle(before, result.tables.at(spectrum.get()), findings()), 2.0, 1e-9);
  EXPECT_NEAR(findings().figures.at("spectrum 'spectrum', mean band, iteration [dB]"), 2.0, 1e-9);
}

TEST_F(SpectrumOutput, is_empty_where_nothing_moved) {
  result.tables[history.get()] = empty_table(history->columns());
  conclude();
  EXPECT_EQ(result.tables.at(spectrum.get()).n_rows(), 0);
  EXPECT_TRUE(findings().figures.empty());
}

TEST_F(SpectrumOutput, is_recorded_with_what_it_is_of_and_held_against) {
  conclude();
  const Notes notes = spectrum->record(result.tables.at(spectrum.get()), findings());
  std::vector<std::string> names;
  for (const Note& note : notes) names.push_back(note.name);
  EXPECT_EQ(names, (std::vector<std::string>{"of", "quantity", "q_factor", "band", "specification"}));
  EXPECT_EQ(std::get<std::string>(notes[0].value), "above");
  EXPECT_EQ(std::get<std::string>(notes[3].value), "spectrum_band.csv");
  const Notes& against = std::get<Notes>(notes[4].value);
  ASSERT_EQ(against.size(), 5u);
  EXPECT_EQ(against[3].name, "exceedance");
  EXPECT_EQ(against[4].name, "judged");
  const auto judged = std::get<std::vector<double>>(against[4].value);
  EXPECT_NEAR(judged[0], 50.0, 1e-9);
  EXPECT_NEAR(judged[1], 25e3, 1e-6);
}

// Half a millisecond tells nothing of 1 kHz, a quarter nothing of the whole spectrum.
TEST_F(SpectrumOutput, is_not_judged_where_its_record_is_too_short) {
  Table& table = result.tables[history.get()];
  for (std::vector<double>& column : table.columns) column.resize(25);
  table.step.resize(25);
  conclude();
  EXPECT_NEAR(findings().values.at("judged_from"), 2e3, 1e-6);
  EXPECT_NEAR(findings().values.at("exceedance_at"), 2e3, 1.0);
  table.columns[0].resize(12);
  table.columns[1].resize(12);
  table.step.resize(12);
  conclude();
  EXPECT_TRUE(findings().figures.find("largest exceedance of the specification of 'spectrum' [dB]") ==
              findings().figures.end());
  EXPECT_TRUE(std::isnan(findings().values.at("exceedance")));
  ASSERT_FALSE(findings().warnings.empty());
  EXPECT_NE(findings().warnings.back().find("is not compared with its specification"), std::string::npos);
}

}  // namespace
}  // namespace dygita::spectrum_output_tests

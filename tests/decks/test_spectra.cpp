// What a run says of its own spectra, and runs that stop when the spectra stand still.
#include <gtest/gtest.h>

#include <numbers>

#include "decks/apart.hpp"
#include "estimates/spectrum_band.hpp"

namespace dygita::test::spectra_tests {
namespace {

// The crush with spectra above and below the contact.
const std::vector<Place> above_and_below = {{"punch", "zmax"}, {"specimen", "zmax"}};

SpectraRun crush(const Settings& settings, double tolerance = 0.0) {
  return run_spectra(deck("crush.lua"), settings, above_and_below, 20e3, 300e3, tolerance);
}

// Most of the true difference lies within the band, and the band is no wild guess.
void expect_band(const BandWorth& worth, double least_covered, double largest_ratio) {
  EXPECT_GE(worth.covered, least_covered) << worth.band << " dB of band, " << worth.truth << " dB in truth";
  EXPECT_LT(worth.band, largest_ratio * worth.truth);
}

// A shock sampled at 100 kHz and what follows at 1 MHz: the spectrum is of both.
TEST(Spectrum, is_judged_to_half_of_the_coarsest_sampling_rate) {
  for (const char* later : {"1", "10", "40"}) {
    const DeckRun run = run_text(R"(
local p = param{ later = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 50*mm }, cells = { 1, 1, 5 } } }
local shock = step.dynamic{ name = "shock", duration = 1*ms, dt = 10*us, loads = { load.pressure{ on = bar:face "zmax", history = history.half_sine{ peak = 1*MPa, duration = 200*us } } } }
local ring = step.dynamic{ name = "ring", after = shock, duration = 400*us, dt = p.later*us }
local a = output.history{ name = "a", on = bar:face "zmin", quantity = "acceleration", direction = { 0, 0, 1 } }
problem{ name = "bar", substructures = { bar }, supports = {}, steps = { shock, ring }, outputs = { a, output.srs{ name = "s", of = a, from = 1*kHz, to = 10*kHz } } }:run{}
)",
                                 {{"later", later}})[0];
    const double coarsest = std::max(10.0, std::stod(later)) * 1e-6;
    EXPECT_NEAR(run.findings("s").values.at("judged_to"), 0.5 / coarsest, 1e-6 / coarsest) << later;
  }
}

TEST(SpectrumBand, holds_what_the_tolerance_leaves) {
  const SpectraRun loose = crush({}, 1e-3), tight = crush({}, 1e-9);
  for (size_t i = 0; i < 2; ++i) expect_band(band_worth(loose.spectra[i], tight.spectra[i], "iteration"), 0.9, 50.0);
}

TEST(SpectrumBand, holds_what_the_time_step_leaves) {
  const SpectraRun coarse = crush({{"dt", "0.6*us"}}, 1e-6), fine = crush({{"dt", "0.075*us"}}, 1e-6);
  for (size_t i = 0; i < 2; ++i) expect_band(band_worth(coarse.spectra[i], fine.spectra[i], "time_step"), 0.7, 50.0);
}

// As wide on average as what it stands for, but narrower at more frequencies than where the increments are implicit.
TEST(SpectrumBand, of_explicit_increments_is_as_wide_on_average_as_what_the_time_step_leaves) {
  const SpectraRun coarse = crush({{"dt", "0.6*us"}}), fine = crush({{"dt", "0.075*us"}});
  for (size_t i = 0; i < 2; ++i) {
    const BandWorth worth = band_worth(coarse.spectra[i], fine.spectra[i], "time_step");
    expect_band(worth, 0.55, 50.0);
    EXPECT_GT(worth.band, worth.truth);
  }
}

TEST(SpectrumBand, warns_where_little_is_known_and_only_there) {
  testing::internal::CaptureStderr();
  run_file(deck("bench/even_flanges.lua"), {{"duration", "50*us"}});
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("spectrum 'srs_below' is uncertain by about"), std::string::npos) << said;
  EXPECT_EQ(said.find("spectrum 'srs_above' is uncertain by about"), std::string::npos) << said;
}

// A lap that two plates are pressed together in: what a loose tolerance brings in has a common sign, increment after
// increment, and is missing in the balance.
TEST(SpectrumBand, of_the_iteration_holds_what_builds_up) {
  for (const char* number : {"14", "17", "18"})
    for (const double tolerance : {1e-3, 1e-4}) {
      const auto run = [&](double to) {
        return run_spectra(std::filesystem::path(DYGITA_SOURCE_DIR) / "tests/bench/scenes.lua",
                           {{"scene", number}, {"n", "1"}, {"finer", "1"}}, {}, 0.0, 0.0, to);
      };
      const SpectraRun loose = run(tolerance), tight = run(1e-7);
      double least = 1e300;
      for (size_t i = 0; i < loose.spectra.size(); ++i) {
        const BandWorth worth = band_worth(loose.spectra[i], tight.spectra[i], "iteration");
        std::cout << "  scene " << number << ", tolerance " << tolerance << ": " << worth.band << " / " << worth.truth
                  << " dB\n";
        least = std::min(least, worth.band / worth.truth);
      }
      EXPECT_GT(least, 1.0 / 3.0) << number;
    }
}

// A tab, a web, boards and caps of 1/350 to 1/14000 of the mass: what the tolerance leaves at them is little of all.
TEST(SpectrumBand, of_the_iteration_sees_light_parts_on_heavy_ones) {
  double logarithms = 0.0;
  int n = 0;
  for (const char* number : {"1", "2", "3", "4", "5", "6", "7", "8", "9"})
    for (const double tolerance : {1e-3, 1e-4}) {
      const auto run = [&](double to) {
        return run_spectra(std::filesystem::path(DYGITA_SOURCE_DIR) / "tests/bench/light_parts.lua",
                           {{"scene", number}}, {}, 0.0, 0.0, to);
      };
      const SpectraRun loose = run(tolerance), tight = run(1e-3 * tolerance);
      const BandWorth worth = band_worth(loose.spectra[0], tight.spectra[0], "iteration");
      std::cout << "  scene " << number << ", tolerance " << tolerance << ": " << worth.band << " / " << worth.truth
                << " dB\n";
      EXPECT_GT(worth.band, 0.1 * worth.truth) << number;
      logarithms += std::log(worth.band / worth.truth);
      ++n;
    }
  EXPECT_GT(std::exp(logarithms / n), 0.5);
  EXPECT_LT(std::exp(logarithms / n), 5.0);
}

TEST(SpectrumBand, of_the_iteration_has_what_the_balance_misses) {
  const Table spectrum{{"frequency", "maximax"}, {"Hz", "m/s^2"}, {{100.0, 200.0}, {2.0, 3.0}}, {}};
  ErrorEstimator::Estimate errors;
  errors.velocity = 1e-2, errors.imbalance = 0.05;
  const Table band = spectrum_band(spectrum, SrsQuantity::absolute_acceleration, errors);
  for (const double decibels : band.column("iteration")) EXPECT_NEAR(decibels, 20.0 * std::log10(1.05), 1e-12);
}

// A part's own motion is no more than the spectrum at a place on it.
TEST(SpectrumBand, of_the_iteration_has_what_is_left_at_the_part) {
  const Table spectrum{{"frequency", "maximax"}, {"Hz", "m/s^2"}, {{100.0, 200.0}, {2.0, 3e4}}, {}};
  ErrorEstimator::Estimate errors;
  errors.velocity = 1e-2, errors.imbalance = 1e-4, errors.seen = {0.05, 1.0};
  const Table band = spectrum_band(spectrum, SrsQuantity::absolute_acceleration, errors);
  EXPECT_NEAR(band.column("iteration")[0], 20.0 * std::log10(1.05), 1e-12);
  EXPECT_NEAR(band.column("iteration")[1], 20.0 * std::log10(1.0 + 0.05 * 2.0 * std::numbers::pi * 200.0 * 1.0 / 3e4),
              1e-12);
}

// A lag moves the frequencies of a spectrum with their square; to the rest an oscillator responds in its own octave
// most.
TEST(SpectrumBand, of_the_time_step_is_that_of_what_is_heard) {
  Table rising{{"frequency", "maximax"}, {"Hz", "m/s^2"}, {{}, {}}, {}};
  for (double f = 100.0; f < 7000.0; f *= 2.0)
    rising.columns[0].push_back(f), rising.columns[1].push_back(1e-4 * f * f);
  ErrorEstimator::Estimate errors;
  errors.velocity = 1e-2, errors.time_step = 0.3, errors.main_frequency = 800.0, errors.step_frequency = 0.001;
  const Table moved = spectrum_band(rising, SrsQuantity::absolute_acceleration, errors);
  for (size_t i = 1; i < 5; ++i)
    EXPECT_NEAR(moved.column("time_step")[i],
                40.0 * std::log10(1.0 + 0.001 * std::pow(rising.columns[0][i] / 800.0, 2)), 1e-9);
  errors.step_frequency = 0.0, errors.lags = {{400.0, 1e-3}};
  const Table heard = spectrum_band(rising, SrsQuantity::absolute_acceleration, errors);
  for (size_t i = 0; i < 7; ++i) {
    const double f = rising.columns[0][i], of_octave = 1e-3 * std::min(f / 400.0, 400.0 / f);
    EXPECT_NEAR(heard.column("time_step")[i],
                20.0 * std::log10(1.0 + 0.3 * 2.0 * std::numbers::pi * f * of_octave / rising.columns[1][i]), 1e-9);
  }
  errors.joints_change = true;
  const Table meet = spectrum_band(rising, SrsQuantity::absolute_acceleration, errors);
  EXPECT_NEAR(meet.column("time_step")[2],
              20.0 * std::log10(1.0 + 0.3 * 2.0 * std::numbers::pi * 400.0 * 3e-3 / rising.columns[1][2]), 1e-9);
}

// A spectrum that rises with the square of the frequency changes by twice the share by which the mesh moves it, and one
// that is level not at all; amplitudes are off by the square of what stresses are.
TEST(SpectrumBand, of_the_mesh_is_that_of_a_spectrum_moved_along_its_frequencies) {
  Table rising{{"frequency", "maximax"}, {"Hz", "m/s^2"}, {{}, {}}, {}}, level = rising;
  for (double f = 100.0; f < 7000.0; f *= 2.0) {
    rising.columns[0].push_back(f), rising.columns[1].push_back(1e-4 * f * f);
    level.columns[0].push_back(f), level.columns[1].push_back(2.0);
  }
  ErrorEstimator::Estimate errors;
  errors.mean_frequency = 800.0, errors.velocity = 1e-2, errors.mesh_dispersion = 0.004, errors.mesh_shift = 0.01,
  errors.mesh_frequency = 0.014;
  const Table moved = spectrum_band(rising, SrsQuantity::absolute_acceleration, errors);
  for (size_t i = 1; i < 5; ++i)
    EXPECT_NEAR(moved.column("mesh")[i], 40.0 * std::log10(1.01 + 0.004 * moved.column("frequency")[i] / 800.0), 1e-9);
  errors.mesh_amplitude = 0.2, errors.mesh = 0.5;
  const Table still = spectrum_band(level, SrsQuantity::absolute_acceleration, errors);
  for (size_t i = 0; i < 7; ++i) {
    const double w = 2.0 * std::numbers::pi * std::min(level.columns[0][i], 800.0);
    EXPECT_NEAR(still.column("mesh")[i], 20.0 * std::log10(1.0 + 0.04 * std::max(1.0, 0.3 * w * 1e-2 / 2.0)), 1e-9);
  }
  // Next to nothing of the motion: what amplitudes are off by arrives at its own frequencies, 800 Hz and less.
  Table faint = level;
  for (double& value : faint.columns[1]) value *= 1e-6;
  const Table of_faint = spectrum_band(faint, SrsQuantity::absolute_acceleration, errors);
  for (size_t i = 0; i < 7; ++i) {
    const double w = 2.0 * std::numbers::pi * std::min(faint.columns[0][i], 800.0);
    EXPECT_NEAR(of_faint.column("mesh")[i], 20.0 * std::log10(1.0 + 0.3 * w * 1e-2 * 0.04 / 2e-6), 1e-9);
  }
  // Where contacts change, a lag is an error of the motion, which all velocities have alike.
  errors.joints_change = true;
  const Table parts_meet = spectrum_band(level, SrsQuantity::absolute_acceleration, errors);
  const double error = std::sqrt(0.25 - 0.04 + 0.0016);
  for (size_t i = 0; i < 7; ++i) {
    const double w = 2.0 * std::numbers::pi * level.columns[0][i];
    EXPECT_NEAR(parts_meet.column("mesh")[i], 20.0 * std::log10(1.0 + 0.3 * w * 1e-2 * error / 2.0), 1e-9);
  }
}

SpectraRun scene(const char* number, const char* n, const char* finer) {
  return run_spectra(std::filesystem::path(DYGITA_SOURCE_DIR) / "tests/bench/scenes.lua",
                     {{"scene", number}, {"n", n}, {"finer", finer}}, {}, 0.0, 0.0);
}

// Bending, torsion and waves, cells of both orders, contacts that stay as they are, and a lap: against cells three
// times shorter. Where the frequencies' own error is told too large the band is too wide with it: standoffs and bars of
// one cell across.
TEST(SpectrumBand, of_the_mesh_is_near_the_truth) {
  for (const int number : {1, 3, 5, 7, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20}) {
    const std::string text = std::to_string(number);
    const SpectraRun run = scene(text.c_str(), "1", "1"), fine = scene(text.c_str(), "3", "1");
    double band = 0.0, truth = 0.0;
    for (size_t i = 0; i < run.spectra.size(); ++i) {
      const BandWorth worth = band_worth(run.spectra[i], fine.spectra[i], "mesh");
      band += worth.band, truth += 9.0 / 8.0 * worth.truth;
    }
    EXPECT_GT(band, 0.5 * truth) << number;
    EXPECT_LT(band, (number == 15 || number == 20 ? 4.0 : 2.5) * truth) << number;
  }
}

// A damped plate and a damped cantilever: lags of what has decayed are no part of the largest response.
TEST(SpectrumBand, of_the_time_step_forgets_what_has_decayed) {
  for (const char* number : {"34", "35"}) {
    const SpectraRun run = scene(number, "1", "1"), fine = scene(number, "1", "4");
    double band = 0.0, truth = 0.0;
    for (size_t i = 0; i < run.spectra.size(); ++i) {
      const BandWorth worth = band_worth(run.spectra[i], fine.spectra[i], "time_step");
      band += worth.band, truth += 16.0 / 15.0 * worth.truth;
    }
    EXPECT_GT(band, 0.5 * truth) << number;
    EXPECT_LT(band, 3.0 * truth) << number;
  }
}

// Scenes of which the motion holds one frequency or many; the trapezoidal rule lags by (w dt)^2/12, the mesh by what
// cells three times shorter show.
TEST(Frequency, is_estimated_within_two_of_the_truth) {
  for (const char* number : {"1", "3", "5", "7", "9", "10", "11", "12", "13"}) {
    const SpectraRun run = scene(number, "1", "1"), in_time = scene(number, "1", "4"),
                     in_space = scene(number, "3", "1");
    const Figures& figures = run.result->figures;
    const double mean = figures.mean_frequency.value(),
                 step = 16.0 / 15.0 * 100.0 * apart(run, in_time, mean, true).frequency,
                 mesh = 9.0 / 8.0 * 100.0 * apart(run, in_space, mean, false).frequency;
    EXPECT_GT(figures.step_frequency_error.value(), 0.5 * step) << number;
    EXPECT_LT(figures.step_frequency_error.value(), 2.0 * step) << number;
    EXPECT_GT(figures.mesh_frequency_error.value(), 0.5 * mesh) << number;
    // One cell of order two across, bent: what its surface says is meant for torsion, to which nothing else there sees.
    const bool has_one_cell_across = std::string(number) == "11";
    EXPECT_LT(figures.mesh_frequency_error.value(), (has_one_cell_across ? 3.0 : 2.0) * mesh) << number;
  }
}

TEST(SpectrumBand, is_the_wider_the_less_there_is) {
  const Table spectrum{{"frequency", "maximax"}, {"Hz", "m/s^2"}, {{100.0, 100.0}, {2.0, 0.5}}, {}};
  ErrorEstimator::Estimate errors;
  errors.iteration = 0.01, errors.time_step = 0.02, errors.mesh = 0.1, errors.velocity = 1e-2;
  errors.joints_change = true;
  const Table band = spectrum_band(spectrum, SrsQuantity::absolute_acceleration, errors);
  // 20 log10(1 + 0.3 * 2 pi 100 Hz * 0.01 m/s * 0.1 / 2 m/s^2)
  EXPECT_NEAR(band.column("mesh")[0], 20.0 * std::log10(1.0 + 0.3 * 2.0 * std::numbers::pi * 100.0 * 0.01 * 0.1 / 2.0),
              1e-9);
  EXPECT_GT(band.column("mesh")[1], 3.0 * band.column("mesh")[0]);
  EXPECT_NEAR(band.column("all")[0],
              std::hypot(band.column("iteration")[0], band.column("time_step")[0], band.column("mesh")[0]), 1e-12);
  // The same motion as pseudo-velocity has the same band where its level is that over the angular frequency.
  const Table slower{{"frequency", "maximax"}, {"Hz", "m/s"}, {{100.0}, {2.0 / (2.0 * std::numbers::pi * 100.0)}}, {}};
  EXPECT_NEAR(spectrum_band(slower, SrsQuantity::pseudo_velocity, errors).column("mesh")[0], band.column("mesh")[0],
              1e-12);
}

const char* const crush_with_spectra = R"(
local p = param{ spectra = 0.1, tolerance = 1e-6 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 20*mm }, cells = { 2, 2, 4 } } }
end
local low, up = block("low", 0), block("up", 20*mm)
local touch = interface.contact{ name = "touch", between = { low:face "zmax", up:face "zmin" }, friction = 0.3 }
local shot = step.dynamic{ name = "shot", duration = 40*us, dt = 0.5*us, loads = {
  load.pressure{ on = up:face "zmax", history = history.half_sine{ peak = 80*MPa, duration = 15*us } } } }
local a = output.history{ name = "a", on = low:face "zmin", quantity = "acceleration", direction = { 0, 0, 1 } }
local srs = output.srs{ name = "srs", of = a, from = 25*kHz, to = 200*kHz }
local solver = p.spectra > 0 and solver.latin{ tolerance = p.tolerance, spectra = p.spectra } or solver.latin{ tolerance = p.tolerance }
problem{ name = "hit", substructures = { low, up }, interfaces = { touch }, steps = { shot }, outputs = { a, srs }, solver = solver }:run{}
)";

// All that a deck places and directs, in a frame that is turned, tilted and moved by the parameters.
const char* const in_a_frame = R"(
local p = param{ turn = 0, tilt = 0, away = 0, duration = 1*ms }
local site = frame{ origin = { p.away, -p.away, 0 }, axis = { math.sin(p.tilt), 0, math.cos(p.tilt) }, x = { math.cos(p.tilt), 0, -math.sin(p.tilt) } }
local f = frame{ frame = site, origin = { 0.1, 0.05, 0 }, angle = p.turn }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local function slab(name, z)
  return substructure{ name = name, material = steel, frame = f, place = { 0, 0, z }, mesh = mesh.box{ size = { 40*mm, 20*mm, 10*mm }, cells = { 4, 2, 1 } } }
end
local low, high = slab("low", 0), slab("high", 10*mm)
local bond = interface.bonded{ name = "bond", between = { low, high } }
local bolt = bolt.hex{ name = "bolt", size = "M6", grip = 10*mm, material = steel, frame = f, place = { 20*mm, 10*mm, 10*mm } }
local head = bolt.head:face{ frame = f, normal = { 0, 0, 1 }, at = 15.6*mm }
local right = high:face{ frame = f, low = { 40*mm, 0, 10*mm }, high = { 40*mm, 20*mm, 20*mm } }
local tip = high:where{ frame = f, where = function(x, y, z) return near(x, 40*mm) and near(y, 0) end }
local base = support.fixed{ name = "base", on = low:face{ frame = f, normal = { -1, 0, 0 }, at = 0 } }
local ramp = history.ramp{ to = -20, duration = 1 }
local push = step.static{ name = "push", loads = { load.force{ on = right, x = 100, z = ramp, frame = f }, load.gravity{ x = 5, y = function(t) return 3*t end, frame = f },
  load.torque{ on = right, axis = { 1, 0, 0 }, through = { 40*mm, 0, 0 }, history = 0.1, frame = f }, load.traction{ on = right, y = 1*kPa, frame = f } } }
local steps = { push }
if p.duration > 0 then steps[2] = step.dynamic{ name = "shock", after = push, duration = p.duration, dt = 20*us, loads = {
  load.base_acceleration{ on = base, direction = { 0.2, 0, 1 }, frame = f, history = history.half_sine{ peak = 100*g0, duration = 0.2*ms } } } } end
local u = {}
for _, axis in ipairs{ "x", "y", "z" } do
  u[#u + 1] = output.history{ name = axis, on = tip, quantity = "displacement", frame = f, direction = { axis == "x" and 1 or 0, axis == "y" and 1 or 0, axis == "z" and 1 or 0 } }
end
local tip_spectra = output.srs{ name = "tip", on = right, frame = f, directions = { radial = { 1, 0, 0 }, axial = { 0, 0, 1 } }, from = 1*kHz,
  specification = { radial = { { 1000, 100*g0 }, { 1e4, 100*g0 } }, axial = { { 1000, 5000*g0 }, { 1e4, 5000*g0 } } }, margin = { axial = 3 } }
local global = output.srs{ name = "global", on = right, directions = "xz", from = 1*kHz }
local axes = output.srs{ name = "axes", on = right, frame = f, from = 1*kHz }
local result = problem{ name = "turned", substructures = { low, high }, interfaces = { bond }, supports = { base }, steps = steps, outputs = { u, tip_spectra, global, axes } }:run{}
print(("exceedance: %g dB"):format(result[tip_spectra.axial].exceedance), result[tip_spectra.histories.axial].max, result[global.z].maximax.max)
)";

TEST(Frame, moves_a_whole_scene_and_changes_nothing_in_it) {
  const char* const tight = "latin{ tolerance = 1e-9, static_tolerance = 1e-11 }";
  const DeckRun still = run_text(in_a_frame, {}, 1, tight).at(0);
  const DeckRun moved = run_text(in_a_frame, {{"turn", "0.7"}, {"tilt", "-0.4"}, {"away", "0.3"}}, 1, tight).at(0);
  const double most = largest(still.column("z", "displacement"));  // y moves by a thousandth of it
  for (const char* axis : {"x", "y", "z"}) {
    const std::vector<double>&at_rest = still.column(axis, "displacement"),
          &turned = moved.column(axis, "displacement");
    EXPECT_LT(difference(at_rest, turned) * largest(at_rest), 1e-6 * most) << axis;
  }
  for (const char* name : {"tip axial", "tip radial"})
    EXPECT_LT(largest_move(still.table(name), moved.table(name)), 1e-3) << name;
  EXPECT_EQ(largest_move(moved.table("axes z"), moved.table("tip axial")), 0.0);
  EXPECT_EQ(largest_move(moved.table("axes x"), moved.table("tip radial")), 0.0);
  // Along the axes of the deck it is another motion, and without a frame they are those of the part at rest.
  EXPECT_LT(largest_move(still.table("global z"), still.table("tip axial")), 1e-12);
  EXPECT_GT(largest_move(moved.table("global z"), moved.table("tip axial")), 0.5);
}

TEST(Spectrum, of_each_direction_has_a_specification_and_a_margin_of_its_own) {
  const DeckRun run = run_text(in_a_frame, {}, 1).at(0);
  const auto said = [&](const std::string& name) {
    std::string text;
    for (const std::string& line : run.findings(name).lines) text += line + "\n";
    return text;
  };
  EXPECT_NE(said("tip axial").find("asked 5000 g and 3 dB of margin"), std::string::npos) << said("tip axial");
  EXPECT_NE(said("tip radial").find("asked 100 g"), std::string::npos) << said("tip radial");
  EXPECT_EQ(said("tip radial").find("margin"), std::string::npos);
}

TEST(Spectrum, of_a_problem_without_motion_is_left_out_with_a_warning_and_reads_as_nan) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const DeckRun run = run_text(in_a_frame, {{"duration", "0"}}, 1).at(0);
  const std::string printed = testing::internal::GetCapturedStdout(), warned = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(run.result->converged);
  EXPECT_NE(warned.find("problem 'turned' has no dynamic step: its spectra are omitted and read as nan: 'tip axial', "
                        "'tip radial', 'global x', 'global z', 'axes x', 'axes y' and 1 more"),
            std::string::npos)
      << warned;
  EXPECT_EQ(run.problem.outputs.size(), 3u);  // the displacements
  EXPECT_NE(printed.find("exceedance: nan dB"), std::string::npos) << printed;
}

TEST(Passes, stop_where_the_spectra_stand_still) {
  const DeckRun tight = run_text(crush_with_spectra, {{"spectra", "0"}, {"tolerance", "1e-10"}}, 1).at(0);
  const DeckRun passes = run_text(crush_with_spectra, {{"spectra", "0.1"}, {"tolerance", "1e-8"}}, 1).at(0);
  EXPECT_TRUE(passes.result->converged);
  EXPECT_GE(passes.figure("passes over the run"), 2.0);
  EXPECT_LT(passes.figure("passes over the run"), 6.0);  // 1e-3 to 1e-8 would be six
  EXPECT_LT(passes.figure("spectra moved in the last pass [dB]"), 0.1);
  EXPECT_LT(largest_move(passes.table("srs"), tight.table("srs")), 0.1);
  // As the last tolerance gives in one run.
  const DeckRun strict = run_text(crush_with_spectra, {{"spectra", "1e-4"}, {"tolerance", "1e-6"}}, 1).at(0);
  const DeckRun at_once = run_text(crush_with_spectra, {{"spectra", "0"}, {"tolerance", "1e-6"}}, 1).at(0);
  EXPECT_LT(difference(at_once.column("a", "acceleration"), strict.column("a", "acceleration")), 1e-5);
  EXPECT_GT(strict.figure("iterations of all passes"), static_cast<double>(strict.result->iterations));
}

TEST(Passes, are_none_where_no_spectrum_is_asked_for) {
  std::string text = crush_with_spectra;
  text.replace(text.find("{ a, srs }"), 10, "{ a, output.energy{} }");
  const DeckRun run = run_text(text, {}, 1).at(0);
  EXPECT_FALSE(run.figures().contains("passes over the run"));
}
}  // namespace
}  // namespace dygita::test::spectra_tests

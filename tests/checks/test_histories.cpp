// Histories and the steps they act in: what is cut off, swallowed, held or never reached is said.
#include <cmath>
#include <numbers>

#include "checks/checked_assembly.hpp"
#include "model/load_content.hpp"
#include "signal/signal_file.hpp"

namespace dygita {

namespace {

// A problem whose shock (200 us in steps of 1 us) is driven by one history.
class Histories : public CheckedAssembly {
 protected:
  void push_with(const History& history, const std::string& word = "pressure") {
    GivenArguments arguments("load." + word, {"deck.lua", 40});
    arguments.on = {Face{upper, "zmax"}};
    arguments.values_of_time["history"] = {history, false};
    shock->loads = {make_load(arguments)};
  }
  // What follows on "step 'shock': load.pressure on face 'upper.zmax' "; other warnings do not count here.
  std::string doubt_of(const History& history) {
    push_with(history);
    take_warnings();
    EXPECT_EQ(complaint(), "");
    const std::string start = "deck.lua:40: problem 'bolted': step 'shock': load.pressure on face 'upper.zmax' ";
    std::string found;
    for (const std::string& warning : take_warnings())
      if (warning.starts_with(start)) found += (found.empty() ? "" : "; ") + warning.substr(start.size());
    return found;
  }
};

History record(std::vector<double> times, std::vector<double> values, const std::string& unit = "Pa") {
  return History::record({std::move(times), std::move(values), unit, unit, 1.0}, "shot.csv");
}

TEST_F(Histories, that_fit_their_step_are_not_doubted) {
  for (const History& history :
       {History::half_sine(5.0, 100e-6), History::haversine(5.0, 200e-6), History::pulse(5.0, 0.0, 50e-6, 0.0),
        History::constant(3.0), History::step(3.0, 20e-6),
        History::ramp(0.0, 3.0, 400e-6).scaled(0.0).plus(History::constant(1.0)), History::ramp(0.0, 3.0, 150e-6),
        History::function([](double t) { return 1e6 * t; }),
        History::function([](double t) { return std::sin(2.0 * std::numbers::pi * 1e4 * t); }),
        record({0.0, 50e-6, 100e-6}, {0.0, 5.0, 0.01}), record({0.0, 50e-6, 300e-6}, {0.0, 5.0, 4.0})})
    EXPECT_EQ(doubt_of(history), "") << history.description();
}

TEST_F(Histories, that_are_cut_off_by_the_end_of_the_step_are_named) {
  EXPECT_EQ(doubt_of(History::half_sine(5.0, 300e-6)),
            "lasts until 300 us and is cut off at the end of the step, 200 us, where it is 4.33 Pa");
  EXPECT_EQ(doubt_of(History::half_sine(5.0, 11e-3)),
            "reaches its largest value, 5 Pa, at 5.5 ms, after the end of the step at 200 us: within the step it is "
            "0.2854 Pa at most");
  EXPECT_EQ(doubt_of(History::half_sine(5.0, 100e-6).shifted(150e-6)),
            "lasts until 250 us and is cut off at the end of the step, 200 us, where it is 5 Pa");
  EXPECT_EQ(doubt_of(History::step(5.0, 1e-3)), "jumps at 1 ms, after the end of the step at 200 us");
}

TEST_F(Histories, that_the_next_step_goes_on_with_are_not_cut_off) {
  const History pulse = History::half_sine(5.0, 600e-6);  // largest at 300 us, the step ends at 200 us
  push_with(pulse);
  auto later = std::make_shared<Step>(*shock);
  later->name = "later";
  later->after = shock;
  later->duration = 500e-6;
  const auto warnings_of_both = [&](const History& continued) {
    push_with(continued);
    later->loads = shock->loads;
    push_with(pulse);
    problem.steps = {tighten, shock, later};
    take_warnings();
    EXPECT_EQ(complaint(), "");
    size_t n = 0;
    for (const std::string& warning : take_warnings())
      n += warning.find("reaches its largest value") != std::string::npos ||
           warning.find("cut off") != std::string::npos;
    return n;
  };
  EXPECT_EQ(warnings_of_both(pulse.shifted(-200e-6)), 0U);
  EXPECT_EQ(warnings_of_both(pulse), 2U);  // begins anew: its peak is lost in one, its end in the other
}

// Cut in two, each part alone would begin or end with a jump, which holds all frequencies.
TEST_F(Histories, over_several_steps_hold_the_frequencies_of_the_whole) {
  for (const History& pulse : {History::half_sine(5.0, 600e-6), History::function([](double t) {
                                 return t < 600e-6 ? std::sin(std::numbers::pi * t / 600e-6) : 0.0;
                               })}) {
    push_with(pulse);
    shock->duration = 800e-6;
    problem.steps = {tighten, shock};
    const double whole = load_frequency(problem, 1, *shock->loads.front());
    EXPECT_GT(whole, 500.0);
    EXPECT_LT(whole, 3e3);
    shock->duration = 200e-6;
    std::vector<StepPtr> steps = {tighten, shock};
    for (int i = 1; i < 4; ++i) {
      auto later = std::make_shared<Step>(*shock);
      later->after = steps.back();
      push_with(pulse.shifted(-200e-6 * i));
      later->loads = shock->loads;
      steps.push_back(later);
    }
    push_with(pulse);
    problem.steps = steps;
    for (size_t i = 1; i < 4; ++i)
      EXPECT_NEAR(load_frequency(problem, i, *problem.steps[i]->loads.front()), whole, 0.05 * whole) << i;
    EXPECT_EQ(load_frequency(problem, 4, *problem.steps[4]->loads.front()), 0.0);  // it is over
    problem.steps = {tighten, shock};
    EXPECT_GT(load_frequency(problem, 1, *shock->loads.front()), 2.0 * whole);  // cut off indeed
  }
}

TEST_F(Histories, that_a_time_step_swallows_are_named) {
  EXPECT_EQ(doubt_of(History::half_sine(5.0, 0.5e-6)),
            "lasts 0.5 us, shorter than 'dt' = 1 us: only its impulse is kept");
}

TEST_F(Histories, from_files_are_named_where_they_are_held_beyond_their_ends) {
  EXPECT_EQ(doubt_of(record({0.0, 50e-6, 100e-6}, {0.0, 5.0, 2.0})),
            "has a record that ends at 100 us with 2 Pa, 40 % of its largest value, held until the end of the step at "
            "200 us");
  EXPECT_EQ(doubt_of(record({20e-6, 50e-6, 100e-6}, {1.0, 5.0, 0.0})),
            "has a record that begins at 20 us with 1 Pa, 20 % of its largest value, applied from 0 on");
  EXPECT_EQ(doubt_of(record({0.0, 50e-6, 100e-6}, {-1.0, 5.0, 0.0})),
            "has a record that begins at 0 ms with -1 Pa, 20 % of its largest value, applied suddenly");
  EXPECT_EQ(doubt_of(record({-20e-6, 50e-6, 100e-6}, {0.0, 5.0, 0.0})),
            "has a record that begins at -20 us: values before 0 are not applied; :shifted(2e-05) includes them");
  EXPECT_EQ(doubt_of(record({0.0, 50e-6, 100e-6}, {0.0, 5.0, 2.0}).scaled(-3.0)),
            "has a record that ends at 100 us with -6 Pa, 40 % of its largest value, held until the end of the step at "
            "200 us");
}

TEST_F(Histories, without_a_peak_in_the_step_are_named) {
  const auto wave = [](double frequency) {
    return History::function([=](double t) { return 5.0 * std::sin(2.0 * std::numbers::pi * frequency * t); });
  };
  EXPECT_EQ(
      doubt_of(wave(1000.0)),
      "has no peak within the step: it still rises at its end, 200 us, where it is 4.755 Pa; is a frequency in kHz, "
      "or an angle in degrees?");
  EXPECT_EQ(doubt_of(wave(1300.0)), "");
  EXPECT_EQ(doubt_of(History::function([](double) { return 0.0; })), "is zero throughout the step");
  EXPECT_EQ(doubt_of(History::function([](double t) { return t < 0.5 ? 3.0 : 0.0; })),
            "is 3 Pa throughout the step: does it depend on t, and is t in seconds?");
}

TEST_F(Histories, from_files_without_a_unit_are_doubted_unless_a_factor_gives_it) {
  const History plain = record({0.0, 50e-6, 100e-6}, {0.0, 5.0, 0.0}, "");
  EXPECT_EQ(
      doubt_of(plain),
      "takes Pa, and the file of its history gives no unit: its values are taken as Pa; history.file{ ..., unit = 1 "
      "} says so, another value converts them");
  EXPECT_EQ(doubt_of(plain.scaled(1e3)), "");
}

TEST_F(Histories, in_milliseconds_are_over_at_once_in_a_static_step) {
  shock->is_static = true;
  shock->increments = 4;
  EXPECT_EQ(doubt_of(History::half_sine(5.0, 1e-3)),
            "ends after 1 ms, within the first increment: time runs from 0 to 1 s in a static step");
  EXPECT_EQ(doubt_of(History::piecewise({0.0, 0.5, 1.0}, {0.0, 1.0, -1.0})), "");
  EXPECT_EQ(doubt_of(History::piecewise({0.0, 5.0, 10.0}, {0.0, 1.0, 0.0})),
            "reaches its largest value, 1 Pa, at 5 s, after the end of the step at 1 s: within the step it is 0.2 Pa "
            "at most");
}

TEST_F(Histories, in_another_unit_than_their_load_are_refused) {
  push_with(record({0.0, 50e-6}, {0.0, 5.0}, "m/s^2"));
  EXPECT_EQ(
      complaint(),
      "deck.lua:40: problem 'bolted': step 'shock': load.pressure on face 'upper.zmax' takes Pa, and the file of its "
      "history is in m/s^2\n    scale the signal by a number, as in 7.2*signal for a mass of 7.2 kg, to change its "
      "unit");
  push_with(record({0.0, 50e-6}, {0.0, 5.0}, "m/s^2").scaled(7.2));
  EXPECT_EQ(complaint(), "");
  push_with(record({0.0, 50e-6}, {0.0, 5.0}, "Pa"));
  EXPECT_EQ(complaint(), "");
}

using Damped = CheckedAssembly;

std::string damping_doubt() {
  for (const std::string& warning : take_warnings())
    if (warning.find("damping of material") != std::string::npos) return warning;
  return "";
}

TEST_F(Damped, beyond_a_fifth_of_critical_within_the_band_is_named) {
  lower->material.name = "steel";
  shock->loads.clear();
  lower->material.damping.stiffness = 0.01;  // meant as a ratio
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(
      damping_doubt(),
      "deck.lua:1: problem 'bolted': damping of material 'steel' is 1.57e+04 % of critical at 5 kHz, the lowest of "
      "step 'shock': such motion decays within a period; 'damping' is in seconds, 'damping_ratio' "
      "with 'damping_frequency' takes the ratio");
  lower->material.damping = damping_of(0.02, 1e4);
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(damping_doubt(), "");
}

}  // namespace

}  // namespace dygita

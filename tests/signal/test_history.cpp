// Load histories: their integrals against quadrature, their limits, their files, their wrong arguments.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/history.hpp"
#include "signal/signal_file.hpp"

namespace dygita {
namespace {

// Midpoint rule on so many parts that kinks and jumps do not show.
double quadrature(const History& history, double t0, double t1) {
  constexpr int n = 200000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += history.value(t0 + (t1 - t0) * (i + 0.5) / n);
  return sum * (t1 - t0) / n;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

class HistoryFile : public ::testing::Test {
 protected:
  HistoryFile()
      : path_(std::filesystem::temp_directory_path() / ("dygita_test_history_" + std::to_string(getpid()) + ".csv")) {}
  ~HistoryFile() override { std::filesystem::remove(path_); }
  History read(const std::string& text) {
    std::ofstream(path_) << text;
    return History::from_file(path_.string());
  }
  std::string message(const std::string& text) {
    const std::string all = message_of([&] { read(text); });
    return all.starts_with(path_.string()) ? all.substr(path_.string().size()) : all;
  }
  std::filesystem::path path_;
};

TEST(History, integrates_as_a_fine_quadrature_does) {
  const std::vector<History> histories = {
      History::constant(3.0),
      History::step(2.0, 0.3),
      History::ramp(1.0, -2.0, 0.8),
      History::half_sine(5.0, 0.7),
      History::haversine(4.0, 0.9),
      History::pulse(3.0, 0.2, 0.3, 0.4),
      History::pulse(3.0, 0.0, 0.3, 0.0),
      History::piecewise({-0.2, 0.1, 0.5, 0.6}, {1.0, 4.0, -2.0, 0.5}),
  };
  for (const History& history : histories) {
    for (const auto& [t0, t1] :
         {std::pair{-0.5, 1.5}, {0.0, 0.25}, {0.33, 0.77}, {0.65, 0.95}, {1.2, 3.0}, {-2.0, -0.1}}) {
      EXPECT_NEAR(history.integral(t0, t1), quadrature(history, t0, t1), 3e-5) << history.description() << " " << t0;
    }
  }
}

TEST(History, adds_up_over_neighbouring_intervals) {
  for (const History& history : {History::half_sine(1.0, 1.0), History::haversine(1.0, 1.0),
                                 History::pulse(1.0, 0.1, 0.2, 0.3), History::step(1.0, 0.5)}) {
    double sum = 0.0;
    for (int i = -10; i < 120; ++i) sum += history.integral(i / 100.0, (i + 1) / 100.0);
    EXPECT_NEAR(sum, history.integral(-0.1, 1.2), 1e-14) << history.description();
  }
}

TEST(History, has_the_impulse_of_its_closed_form) {
  EXPECT_DOUBLE_EQ(History::half_sine(1e8, 4e-5).integral(0.0, 1.0), 2.0 / std::numbers::pi * 1e8 * 4e-5);
  EXPECT_DOUBLE_EQ(History::haversine(1e8, 4e-5).integral(0.0, 1.0), 0.5 * 1e8 * 4e-5);
  EXPECT_DOUBLE_EQ(History::pulse(6.0, 1.0, 2.0, 3.0).integral(-1.0, 9.0), 24.0);
  EXPECT_DOUBLE_EQ(History::step(2.0, 0.5).integral(0.0, 2.0), 3.0);
}

TEST(History, keeps_its_digits_over_a_very_short_interval) {
  const History history = History::half_sine(2.0, 1.0);
  EXPECT_NEAR(history.integral(0.25, 0.25 + 1e-9) / 1e-9, history.value(0.25), 1e-6);
  EXPECT_EQ(history.integral(0.25, 0.25), 0.0);
}

TEST(History, takes_the_stated_values_at_and_outside_its_ends) {
  EXPECT_EQ(History::step(2.0, 0.5).value(0.5), 2.0);
  EXPECT_EQ(History::step(2.0, 0.5).value(std::nextafter(0.5, 0.0)), 0.0);
  EXPECT_EQ(History::ramp(1.0, 3.0, 2.0).value(-1.0), 1.0);
  EXPECT_EQ(History::ramp(1.0, 3.0, 2.0).value(1.0), 2.0);
  EXPECT_EQ(History::ramp(1.0, 3.0, 2.0).value(9.0), 3.0);
  EXPECT_EQ(History::half_sine(2.0, 1.0).value(0.5), 2.0);
  EXPECT_EQ(History::half_sine(2.0, 1.0).value(1.0), 0.0);
  EXPECT_EQ(History::haversine(2.0, 1.0).value(0.5), 2.0);
  EXPECT_EQ(History::haversine(2.0, 1.0).value(-0.5), 0.0);
  EXPECT_EQ(History::pulse(2.0, 0.0, 1.0, 0.0).value(0.0), 2.0);
  EXPECT_EQ(History::pulse(2.0, 0.0, 1.0, 0.0).value(-1e-300), 0.0);
  EXPECT_EQ(History::pulse(2.0, 0.0, 1.0, 0.0).value(1.0), 0.0);
  EXPECT_EQ(History::piecewise({1.0}, {7.0}).value(-3.0), 7.0);
}

TEST(History, of_a_function_is_exact_for_cubics_and_close_for_a_sine) {
  const History cubic = History::function([](double t) { return 4.0 * t * t * t - t; });
  EXPECT_NEAR(cubic.integral(1.0, 3.0), 76.0, 1e-12);
  const History sine = History::function([](double t) { return std::sin(t); });
  EXPECT_NEAR(sine.integral(0.0, 1.0), 1.0 - std::cos(1.0), 1e-6);
  EXPECT_FALSE(cubic.is_constant());
}

TEST(History, of_a_function_that_is_not_a_number_is_an_error_that_says_when) {
  const History history = History::function([](double t) { return t < 1.0 ? 0.0 : std::nan(""); });
  EXPECT_EQ(history.value(0.5), 0.0);
  EXPECT_EQ(message_of([&] { history.value(2.0); }), "history: the function's value at t = 2 s is nan");
}

TEST(History, knows_when_it_is_constant_and_describes_itself) {
  EXPECT_TRUE(History().is_constant());
  EXPECT_EQ(History().value(3.0), 0.0);
  EXPECT_TRUE(History::constant(4.0).is_constant());
  EXPECT_FALSE(History::step(4.0, 1.0).is_constant());
  EXPECT_FALSE(History::half_sine(4.0, 1.0).is_constant());
  EXPECT_EQ(History::half_sine(1e8, 4e-5).description(), "half_sine(peak 100000000, duration 4e-05)");
  EXPECT_EQ(History::ramp(0.0, 2.5, 1e-3).description(), "ramp(from 0, to 2.5, duration 0.001)");
}

TEST(History, refuses_what_has_no_meaning) {
  EXPECT_EQ(message_of([] { History::half_sine(1.0, 0.0); }), "history.half_sine: 'duration' = 0 s must be above 0");
  EXPECT_EQ(message_of([] { History::pulse(1.0, -1.0, 1.0, 1.0); }), "history.pulse: 'rise' = -1 s must be 0 or more");
  EXPECT_EQ(message_of([] {
              History::piecewise({0.0, 1.0, 1.0}, {0.0, 1.0, 2.0});
            }),
            "history.piecewise: 'times' must increase: number 3 is 1 s, after 1 s");
  EXPECT_THROW(History::pulse(1.0, 0.0, 0.0, 0.0), InputError);
  EXPECT_THROW(History::ramp(0.0, 1.0, -1.0), InputError);
  EXPECT_THROW(History::haversine(std::nan(""), 1.0), InputError);
  EXPECT_THROW(History::constant(INFINITY), InputError);
  EXPECT_THROW(History::step(1.0, std::nan("")), InputError);
  EXPECT_THROW(History::piecewise({}, {}), InputError);
  EXPECT_THROW(History::piecewise({0.0, 1.0}, {0.0}), InputError);
  EXPECT_THROW(History::constant(1.0).integral(1.0, 0.0), ContractError);
}

TEST_F(HistoryFile, is_read_with_commas_blanks_titles_and_comments) {
  const History history =
      read("\xEF\xBB\xBFtime [s], pressure [Pa]\r\n# measured\r\n\r\n0, 1\r\n  0.5\t+3e0\r\n1; -1\r\n");
  EXPECT_EQ(history.value(0.25), 2.0);
  EXPECT_EQ(history.value(2.0), -1.0);
  EXPECT_NEAR(history.integral(0.0, 1.0), 1.5, 1e-15);
  EXPECT_NE(history.description().find("3 points"), std::string::npos);
}

TEST_F(HistoryFile, is_read_in_the_units_of_its_titles) {
  const double g = 9.80665;
  for (const char* titles :
       {"time [ms],acceleration [g]", "time (ms); acceleration (g)", "Time [ms] Acceleration X [g]",
        "\"t (ms)\",\"a (gn)\"", "# t [ms], a [g]", "t,a\n[ms],[g]", "t a\nms g"}) {
    const History history = read(std::string(titles) + "\n0 0\n2 10\n4 -20\n");
    EXPECT_NEAR(history.value(2e-3), 10.0 * g, 1e-12) << titles;
    EXPECT_EQ(history.unit(), "m/s^2") << titles;
    const Profile profile = history.profile().value();
    EXPECT_NEAR(profile.low, -20.0 * g, 1e-12);
    EXPECT_NEAR(profile.largest(), 20.0 * g, 1e-12);
    EXPECT_DOUBLE_EQ(profile.peak, 4e-3);
    EXPECT_TRUE(profile.is_record);
  }
  EXPECT_DOUBLE_EQ(read("t [\xC2\xB5s], F [kN]\n0,0\n1,2\n").value(1e-6), 2000.0);
  EXPECT_DOUBLE_EQ(read("t [s], p [N/mm\xC2\xB2]\n0,0\n1,2\n").value(1.0), 2e6);
  EXPECT_EQ(read("# measured by (Bob) on [Friday]\nt, v\n0,0\n1,2\n").value(1.0), 2.0);
  EXPECT_EQ(read("t, v\n0,0\n1,2\n").unit(), "");
}

TEST_F(HistoryFile, has_decimal_commas_where_commas_do_not_separate_columns) {
  for (const char* text :
       {"Zeit [s];Beschleunigung [g]\n0,0;0,0\n0,5;1,5e1\n1;30\n", "Zeit [s]\ta [g]\n0\t0\n0,5\t15\n1,0\t30\n",
        "t [s] a [g]\r\n0 0\r\n 0,5  15,0\r\n1 30\r\n", "t [s],a [g]\n\"0,0\",\"0,0\"\n\"0,5\",\"15,0\"\n1,30\n",
        "t [s],a [g]\n0,0\n0.5,15\n1,30\n"}) {
    const History history = read(text);
    EXPECT_NEAR(history.value(0.5), 15.0 * 9.80665, 1e-12) << text;
    EXPECT_NEAR(history.value(0.75), 22.5 * 9.80665, 1e-12) << text;
  }
  EXPECT_EQ(message("t;a\n0,5;1\n1.5;2\n"), ":3: '1.5' has a decimal point, and a number in line 2 a decimal comma");
  EXPECT_EQ(message("t;a\n0;1.234,5\n"), ":2: '1.234,5' is not a finite number: do not separate thousands");
}

TEST_F(HistoryFile, whose_commas_may_separate_columns_or_decimals_is_refused) {
  const std::string doubt = "': commas may separate columns or decimals, which is ambiguous\n";
  for (const char* text : {"0,0,00\n1,0,26\n", "t,a\n0,0,00\n1,0,26\n"})
    EXPECT_TRUE(message(text).find("'0,0,00" + doubt) != std::string::npos) << message(text);
  EXPECT_TRUE(message("0,000,0,000\n0,001,3,141\n").starts_with(":1: '0,000,0,000" + doubt));
  EXPECT_EQ(message("0,0\n1,0,26\n"), ":2: 3 columns but two are expected: time (s) and value");
  // Titles or a point tell.
  EXPECT_EQ(message("t,a,b\n0,0,1\n1,0,26\n"),
            ":2: 3 columns but two are expected: time (s) and value\n    'column' takes one: a, b");
  EXPECT_EQ(message("0,0,0\n0.1,0,26\n"), ":1: 3 columns but two are expected: time (s) and value");
}

TEST_F(HistoryFile, is_read_in_units_however_its_titles_give_them) {
  for (const char* titles :
       {"time {ms};acceleration {g}", "time, ms;acceleration, g", "time, ms, acceleration, g", "\"time, ms\",\"a, g\"",
        "Zeit in ms;Beschleunigung in g", "t;a\nms;g", "ms;g", "t;a\n(ms);(g)", "# t [ms]; a [g]\nt;a"}) {
    const History history = read(std::string(titles) + "\n0;0\n2;10\n");
    EXPECT_NEAR(history.value(2e-3), 10.0 * 9.80665, 1e-12) << titles;
    EXPECT_FALSE(history.factor_without_unit()) << titles;
  }
  const History plain = read("t;a\n0;0\n2;10\n");
  EXPECT_EQ(plain.factor_without_unit(), 1.0);
  EXPECT_EQ(plain.shifted(1.0).scaled(-3.0).plus(History::constant(1.0)).factor_without_unit(), -3.0);
  EXPECT_FALSE(History::half_sine(1.0, 1.0).factor_without_unit());
}

TEST_F(HistoryFile, of_several_columns_is_read_by_title) {
  std::ofstream(path_) << "t [ms];step;a x [g];F [kN];remark\n0;shock;0;1;first\n2;shock;10;3;\n";
  const SampledSignal g = read_signal(path_.string(), "a x"), force = read_signal(path_.string(), "F");
  EXPECT_NEAR(g.values[1], 98.0665, 1e-9);
  EXPECT_NEAR(force.values[1], 3000.0, 1e-9);
  EXPECT_EQ(force.times, (std::vector<double>{0.0, 2e-3}));
  EXPECT_NE(message_of([&] { read_signal(path_.string(), "a y"); }).find("no column 'a y'\n    did you mean 'a x'?"),
            std::string::npos);
  EXPECT_EQ(message_of([&] { read_signal(path_.string(), "step"); }),
            path_.string() + ":2: 'shock' is not a finite number");
}

TEST_F(HistoryFile, in_characters_of_typography_or_in_UTF_16_is_named) {
  EXPECT_EQ(message("t;a\n0;\xE2\x80\x9C"
                    "1\xE2\x80\x9D\n"),
            ":2: '\xE2\x80\x9C"
            "1\xE2\x80\x9D' is not a finite number: it has typographic quotes, use straight quotes or none");
  EXPECT_EQ(message("t;a\n0;\xE2\x88\x92"
                    "1\n"),
            ":2: '\xE2\x88\x92"
            "1' is not a finite number: its minus sign is not the plain '-'");
  for (const std::string& start : {std::string("\xFF\xFE", 2), std::string("\xFE\xFF", 2), std::string("0\0;\0", 4)})
    EXPECT_NE(message(start + "0;1\n1;2\n").find("is text in UTF-16\n    save it as UTF-8"), std::string::npos);
}

TEST_F(HistoryFile, in_a_unit_that_is_not_known_is_refused) {
  EXPECT_TRUE(message("time [ms], acceleration [furlong]\n0,1\n")
                  .starts_with(":1: 'furlong' is not a known unit, in the title 'acceleration'\n    known: s, ms"));
  EXPECT_EQ(message("time [Hz], a [g]\n0,1\n"),
            ":1: column 'time' is in 'Hz', where a time is expected\n    known: s, ms, us, ns, sec, msec, usec, min");
  EXPECT_EQ(message("time acceleration [g]\n0 1\n"),
            ":1: 1 title with units where there are two columns: separate them by a comma");
  EXPECT_EQ(message("t,a\n[ms],[furlong]\n0,1\n"), ":2: '[ms]' is not a finite number");
}

TEST_F(HistoryFile, with_a_unit_outside_of_brackets_is_doubted) {
  take_warnings();
  EXPECT_EQ(read("time_ms,acc_g\n0,0\n1,2\n").value(1.0), 2.0);
  const std::vector<std::string> warnings = take_warnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find(":1: column 'time_ms' is read in SI: put a unit in brackets, [ms]"), std::string::npos);
}

// The rule for a function is made for a time step: over a thousand of them it misses most of a pulse.
TEST(RunningIntegral, of_a_function_is_taken_step_by_step) {
  const History pulse = History::half_sine(1000.0, 0.5e-3);
  const History same = History::function([&](double t) { return pulse.value(t); });
  RunningIntegral exact(pulse), taken(same);
  for (const int n : {500, 1, 50, 0, 499}) EXPECT_NEAR(taken.over(n, 10e-6), exact.over(n, 10e-6), 1e-9) << n;
  EXPECT_NEAR(taken.over(500, 10e-6), 2.0 / std::numbers::pi * 0.5, 1e-9);
  EXPECT_NEAR(taken.over(25, 20e-6), exact.over(25, 20e-6), 1e-9);
  EXPECT_GT(std::abs(same.integral(0.0, 5e-3) - 2.0 / std::numbers::pi * 0.5), 0.01);
}

TEST(ComposedHistory, is_what_its_terms_are) {
  const History sine = History::half_sine(3.0, 0.4), ramp = History::ramp(0.0, 2.0, 0.5);
  const History wave = History::function([](double t) { return std::cos(t); });
  const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-13); };
  for (const double t : {-0.1, 0.0, 0.13, 0.2, 0.45, 0.9}) {
    near(sine.scaled(-2.0).value(t), -2.0 * sine.value(t));
    near(sine.plus(ramp).plus(wave).value(t), sine.value(t) + ramp.value(t) + std::cos(t));
    near(sine.shifted(0.1).value(t), sine.value(t - 0.1));
    near(ramp.stretched(4.0).value(t), ramp.value(t / 4.0));
    near(sine.scaled(-2.0).integral(t, t + 0.2), -2.0 * sine.integral(t, t + 0.2));
    near(sine.plus(ramp).integral(t, t + 0.2), sine.integral(t, t + 0.2) + ramp.integral(t, t + 0.2));
    near(sine.shifted(0.1).integral(t, t + 0.2), sine.integral(t - 0.1, t + 0.1));
    near(ramp.stretched(4.0).integral(t, t + 0.2), 4.0 * ramp.integral(t / 4.0, t / 4.0 + 0.05));
  }
  EXPECT_EQ(sine.scaled(2.0).description(), "2 * half_sine(peak 3, duration 0.4)");
  EXPECT_TRUE(History::constant(1.0).plus(History::constant(2.0)).is_constant());
  EXPECT_THROW(sine.scaled(NAN), InputError);
  EXPECT_THROW(sine.stretched(0.0), InputError);
  EXPECT_THROW(sine.shifted(INFINITY), InputError);
}

TEST(ComposedHistory, tells_its_course) {
  const Profile pulse = History::haversine(-5.0, 0.2).scaled(-2.0).shifted(0.3).profile().value();
  EXPECT_DOUBLE_EQ(pulse.begin, 0.3);
  EXPECT_DOUBLE_EQ(pulse.end, 0.5);
  EXPECT_DOUBLE_EQ(pulse.peak, 0.4);
  EXPECT_DOUBLE_EQ(pulse.high, 10.0);
  EXPECT_DOUBLE_EQ(pulse.low, 0.0);
  const Profile two = History::half_sine(3.0, 0.2).plus(History::half_sine(-4.0, 0.2).shifted(0.5)).profile().value();
  EXPECT_DOUBLE_EQ(two.end, 0.7);
  EXPECT_NEAR(two.peak, 0.6, 1e-12);
  EXPECT_NEAR(two.high, 3.0, 1e-12);
  EXPECT_NEAR(two.low, -4.0, 1e-12);
  EXPECT_FALSE(History::half_sine(1.0, 1.0).plus(History::function([](double t) { return t; })).profile());
}

TEST(ComposedHistory, that_is_doubled_again_and_again_answers_at_once) {
  History h = History::half_sine(1.0, 1.0);
  for (int i = 0; i < 60; ++i) h = h.plus(h);
  EXPECT_EQ(h.value(0.5), std::ldexp(1.0, 60));
  EXPECT_NEAR(h.integral(0.0, 1.0), std::ldexp(2.0 / std::numbers::pi, 60), 1e4);
  EXPECT_EQ(h.profile().value().high, std::ldexp(1.0, 60));
  EXPECT_FALSE(h.is_constant());
  EXPECT_LT(h.description().size(), 1000u);
  History sum = History::constant(0.0);
  for (int i = 0; i < 2000; ++i) sum = sum.plus(History::half_sine(1.0, 1.0).shifted(1e-3 * i));
  EXPECT_NEAR(sum.profile().value().end, 2.999, 1e-12);
  EXPECT_NEAR(sum.profile().value().high, 2000.0 / std::numbers::pi, 1.0);  // one whole half sine under 1000 of them
}

TEST(ComposedHistory, of_too_many_terms_is_refused) {
  History h = History::half_sine(1.0, 1.0);
  const auto more_and_more = [&] {
    for (int i = 0; i < 60; ++i) h = h.plus(h.shifted(1e-6));
  };
  EXPECT_EQ(message_of(more_and_more), "a history of 1.31e+05 terms: 100000 are allowed");
  History deep = History::constant(1.0);
  EXPECT_EQ(message_of([&] {
              for (int i = 0; i < 20000; ++i) deep = deep.plus(History::constant(1.0));
            }),
            "a history nested 10001 deep: 10000 levels are allowed");
}

TEST_F(HistoryFile, that_is_wrong_is_named_with_its_line) {
  EXPECT_EQ(message("0 1\n1 2\n1 3\n"), ":3: time 1 s does not come after 1 s: times must increase");
  EXPECT_EQ(message("t v\n0 1\n1 x\n"), ":3: 'x' is not a finite number");
  EXPECT_EQ(message("t v\nagain titles\n"), ":2: 'again' is not a finite number");
  EXPECT_EQ(message("0 1\n1 nan\n"), ":2: 'nan' is not a finite number");
  EXPECT_EQ(message("t [ms], a [kN]\n0,1\n1,1e306\n"), ":3: '1e306' is not a finite number in SI");
  EXPECT_EQ(message("0,5 1,5 3\n"), ":1: 3 columns but two are expected: time (s) and value");
  EXPECT_EQ(message("7\n"), ":1: 1 number but two are expected: time (s) and value");
  EXPECT_NE(message("time value\n").find("has no points"), std::string::npos);
  EXPECT_EQ(message_of([] { History::from_file("no/such/file.csv"); }),
            "cannot read the signal file 'no/such/file.csv'");
  EXPECT_THROW(History::from_file(std::filesystem::temp_directory_path().string()), InputError);
}

}  // namespace
}  // namespace dygita

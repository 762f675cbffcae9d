// Specifications of spectra: interpolation, files and their faults, how far a spectrum is above.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/specification.hpp"

namespace dygita {
namespace {

const Specification plateau{{100.0, 1000.0, 10000.0}, {200.0, 2000.0, 2000.0}, "deck"};

class SpecificationFile : public ::testing::Test {
 protected:
  SpecificationFile()
      : path_(std::filesystem::temp_directory_path() / ("dygita_specification_" + std::to_string(getpid()) + ".csv")) {}
  ~SpecificationFile() override { std::filesystem::remove(path_); }

  Specification read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_specification(path_.string());
  }
  std::string fault(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      const std::string message = error.what();
      return message.substr(0, path_.string().size()) == path_.string() ? message.substr(path_.string().size())
                                                                        : message;
    }
    return "none";
  }

  std::filesystem::path path_;
};

TEST(Specification, is_straight_in_log_log) {
  EXPECT_DOUBLE_EQ(plateau.level_at(100.0), 200.0);
  EXPECT_NEAR(plateau.level_at(500.0), 1000.0, 1e-9);  // 6 dB an octave
  EXPECT_NEAR(plateau.level_at(3000.0), 2000.0, 1e-9);
  EXPECT_NEAR(plateau.level_at(10000.0), 2000.0, 1e-9);
  EXPECT_TRUE(std::isnan(plateau.level_at(99.0)));
  EXPECT_TRUE(std::isnan(plateau.level_at(10100.0)));
}

TEST(Specification, is_judged_only_where_the_record_allows_it) {
  const Specification flat{{10.0, 1e5}, {10.0, 10.0}, "deck"};
  const std::vector<double> frequency = {50, 100, 1000, 60000}, value = {1e4, 20, 5, 1e5};
  EXPECT_EQ(largest_exceedance(flat, frequency, value).frequency, 60000);
  const FrequencyRange record = reliable_range(0.01, 1e-5);
  EXPECT_DOUBLE_EQ(record.from, 100.0);
  EXPECT_DOUBLE_EQ(record.to, 5e4);
  const Exceedance judged = largest_exceedance(flat, frequency, value, record);
  EXPECT_EQ(judged.frequency, 100);
  EXPECT_NEAR(judged.decibels, 20 * std::log10(2.0), 1e-12);
  EXPECT_FALSE(largest_exceedance(flat, frequency, value, reliable_range(0.0, 1e-5)).is_known);
}

TEST(Specification, tells_the_largest_exceedance_and_where) {
  const Exceedance above = largest_exceedance(plateau, {50.0, 500.0, 2000.0}, {1e9, 1000.0, 4000.0});
  EXPECT_TRUE(above.is_known);
  EXPECT_NEAR(above.decibels, 20.0 * std::log10(2.0), 1e-12);
  EXPECT_EQ(above.frequency, 2000.0);
  const Exceedance below = largest_exceedance(plateau, {500.0, 2000.0}, {500.0, 1000.0 / 2});
  EXPECT_NEAR(below.decibels, -20.0 * std::log10(2.0), 1e-12);
  EXPECT_EQ(below.frequency, 500.0);
  EXPECT_FALSE(largest_exceedance(plateau, {50.0, 20000.0}, {1.0, 1.0}).is_known);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(largest_exceedance(plateau, {500.0, 600.0}, {nan, 0.0}).is_known);
}

TEST_F(SpecificationFile, takes_commas_semicolons_blanks_and_a_header_with_a_unit) {
  for (const char* text : {"100,200\n1000,2000\n", "frequency [Hz],level [m/s^2]\n100,200\n1000,2000\n",
                           "# a test\n\n100;200\n1000;2000\n", "100 200\n1000\t2000\n"}) {
    const Specification s = read(text);
    EXPECT_EQ(s.frequency, (std::vector<double>{100.0, 1000.0})) << text;
    EXPECT_EQ(s.level, (std::vector<double>{200.0, 2000.0})) << text;
  }
  for (const char* titles :
       {"frequency [Hz],level [g]", "frequency (Hz),level (g)", "f (Hz); SRS maximax (g)", "# f [Hz], a [g]"}) {
    const Specification s = read(std::string(titles) + "\n100,20\n1000,500\n");
    EXPECT_NEAR(s.level[1], 500 * 9.80665, 1e-9) << titles;
    EXPECT_EQ(s.frequency[1], 1000.0);
    EXPECT_EQ(s.unit.substr(0, 1), "g");
  }
  EXPECT_NEAR(read("frequency (kHz),level (m/s2)\n0.1,20\n1,500\n").frequency[0], 100.0, 1e-12);
}

TEST_F(SpecificationFile, takes_decimal_commas_and_a_line_of_units) {
  for (const char* text : {"Frequenz [Hz];Pegel [g]\n100,5;20,25\n1000;500\n", "f\tl\nHz\tg\n100,5\t20,25\n1000\t500\n",
                           "f in Hz; level, g\n100.5;20.25\n1000;500\n"}) {
    const Specification s = read(text);
    EXPECT_EQ(s.frequency[0], 100.5) << text;
    EXPECT_NEAR(s.level[0], 20.25 * 9.80665, 1e-9) << text;
    EXPECT_EQ(s.unit, "g") << text;
  }
}

TEST_F(SpecificationFile, without_a_unit_is_warned_of) {
  take_warnings();
  read("frequency [Hz], level [m/s^2]\n100,20\n1000,500\n");
  read("# frequency [Hz], level [g]\n100,20\n1000,500\n");
  EXPECT_TRUE(take_warnings().empty());
  for (const char* text : {"100,20\n1000,500\n", "frequency [kHz],level\n1,20\n10,500\n"}) {
    EXPECT_EQ(read(text).level[0], 20.0);
    const std::vector<std::string> warnings = take_warnings();
    ASSERT_EQ(warnings.size(), 1u) << text;
    EXPECT_NE(warnings[0].find("gives no unit: its levels are assumed to be in m/s^2"), std::string::npos)
        << warnings[0];
  }
}

TEST_F(SpecificationFile, says_where_it_is_wrong) {
  EXPECT_EQ(fault("100,200\n"), ": a specification has at least two points (frequency, level), got 1");
  EXPECT_EQ(fault("100,200\n90,200\n"), ":2: the frequency 90 Hz comes after 100 Hz: frequencies must increase");
  EXPECT_EQ(fault("100,200\n1000,-5\n"), ":2: the level -5 is not above zero");
  EXPECT_EQ(fault("f,l\n0,200\n1000,5\n"), ":2: the frequency 0 Hz is not above zero");
  EXPECT_EQ(fault("f,l\n100,200\nabc,5\n"), ":3: 'abc,5' is not a frequency (Hz) and a level");
  EXPECT_EQ(fault("f (Hz),level (Pa)\n100,200\n").substr(0, 54),
            ":1: column 'level' is in 'Pa', where m/s^2 is expected");
  EXPECT_TRUE(fault("f (Hz),level (dB)\n100,200\n").starts_with(":1: 'dB' is not a known unit, in the title 'level'"));
  EXPECT_EQ(fault("100,2oo\n1000,200\n"), ":1: '100,2oo' is not a frequency (Hz) and a level");
  EXPECT_EQ(fault("f,l,m\n100,200,3\n"), ":2: '100,200,3' is not a frequency (Hz) and a level");
  EXPECT_TRUE(fault("f,l\n100,200,3\n").starts_with(":2: '100,200,3': commas may separate columns or decimals"));
  EXPECT_EQ(fault("f (Hz),level (g)\n100,200\n1000,1e308\n"), ":3: the level inf is not above zero and finite");
  EXPECT_THROW(read_specification("nowhere.csv"), InputError);
}

}  // namespace
}  // namespace dygita

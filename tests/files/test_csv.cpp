// Tables as text, names as files.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "files/csv.hpp"
#include "files/files.hpp"

namespace dygita {
namespace {

TEST(Csv, has_a_title_with_units_and_the_step_as_second_column) {
  Table table;
  table.names = {"time", "normal", "ratio"};
  table.units = {"s", "N", ""};
  table.columns = {{0.0, 1e-6, 0.1 + 0.2}, {-1234.56789012, -0.0, 1e300}, {1.0, std::nan(""), 1.0 / 3.0}};
  table.step = {0, 1, 1};
  EXPECT_EQ(csv_text(table, {"tighten", "shock"}),
            "time [s],step,normal [N],ratio\n"
            "0,tighten,-1234.56789,1\n"
            "1e-06,shock,0,nan\n"
            "0.3,shock,1e+300,0.333333333\n");
}

TEST(Csv, tells_the_times_of_short_steps_after_a_long_while) {
  const double dt = 10e-9;
  Table table;
  table.names = {"time", "force"};
  table.units = {"s", "N"};
  table.columns = {{1.0 + dt, 1.0 + 1.5 * dt, 1.0 + 2.0 * dt}, {1.0, 2.0, 1.0 / 3.0}};
  const std::string text = csv_text(table, {});
  EXPECT_EQ(text, "time [s],force [N]\n1.00000001,1\n1.000000015,2\n1.00000002,0.333333333\n");
  std::istringstream stream(text);
  const Table read = parse_csv(stream, {});
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(read.columns[0][i], table.columns[0][i], 1e-6 * dt);
  EXPECT_EQ(as_written(table).columns, read.columns);
}

TEST(Csv, of_a_spectrum_has_no_step) {
  Table table;
  table.names = {"frequency", "maximax"};
  table.units = {"Hz", "m/s^2"};
  table.columns = {{100.0}, {9.80665}};
  EXPECT_EQ(csv_text(table, {}), "frequency [Hz],maximax [m/s^2]\n100,9.80665\n");
}

TEST(Csv, marks_rows_that_have_not_converged_in_its_last_column) {
  Table table;
  table.names = {"time", "normal"};
  table.units = {"s", "N"};
  table.columns = {{0.0, 1e-6}, {1.0, 2.0}};
  table.step = {0, 0};
  table.converged = {1.0, 0.0};
  const std::string text = csv_text(table, {"push"});
  EXPECT_EQ(text, "time [s],step,normal [N],converged\n0,push,1,1\n1e-06,push,2,0\n");
  std::istringstream stream(text);
  const Table read = parse_csv(stream, {"push"});
  EXPECT_EQ(read.names, table.names);
  EXPECT_EQ(read.converged, table.converged);
  EXPECT_EQ(read.column("converged"), table.converged);
  table.converged.pop_back();
  EXPECT_THROW(csv_text(table, {"push"}), ContractError);
}

TEST(Table, is_marked_where_its_rows_do_not_tell_themselves) {
  Table table;
  table.names = {"frequency"};
  table.units = {"Hz"};
  table.columns = {{1.0, 2.0}};
  EXPECT_FALSE(table.has_column("converged"));
  table.mark(false);
  EXPECT_EQ(table.column("converged"), (std::vector<double>{0.0, 0.0}));
  table.mark(true);
  EXPECT_EQ(table.converged, (std::vector<double>{0.0, 0.0}));
}

TEST(Csv, quotes_texts_that_would_break_a_line) {
  Table table;
  table.names = {"time"};
  table.units = {"s"};
  table.columns = {{0.5}};
  table.step = {0};
  EXPECT_EQ(csv_text(table, {"hold, then \"pull\""}), "time [s],step\n0.5,\"hold, then \"\"pull\"\"\"\n");
}

TEST(Csv, of_columns_that_do_not_match_is_a_broken_contract) {
  Table table;
  table.names = {"time", "x"};
  table.units = {"s", "m"};
  table.columns = {{0.0, 1.0}, {0.0}};
  EXPECT_THROW(csv_text(table, {}), ContractError);
  table.columns = {{0.0}, {0.0}};
  table.step = {1};
  EXPECT_THROW(csv_text(table, {"only"}), ContractError);
}

TEST(FileName, keeps_what_a_problem_may_be_called_and_disarms_the_rest) {
  EXPECT_EQ(file_name_of("crush mu=0.3"), "crush mu=0.3");
  EXPECT_EQ(file_name_of("pièce"), "pièce");
  EXPECT_EQ(file_name_of("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(file_name_of(".."), "_.");
  EXPECT_EQ(file_name_of("a\\b\nc"), "a_b_c");
  EXPECT_EQ(file_name_of(""), "unnamed");
}

TEST(Csv, takes_marks_without_values_for_a_column) {
  std::istringstream stream("converged,step\n0,push\n1,push\n");
  const Table read = parse_csv(stream, {"push"});
  EXPECT_TRUE(read.converged.empty());
  EXPECT_EQ(read.n_rows(), 2);
  EXPECT_EQ(read.column("converged"), (std::vector<double>{0.0, 1.0}));
}

TEST(Csv, refuses_two_columns_of_one_name) {
  std::istringstream stream("time [s],converged,converged\n");
  try {
    parse_csv(stream, {"push"});
    FAIL() << "which of the two is meant?";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "line 1: two columns are called 'converged'");
  }
}

TEST(Table, answers_a_column_by_name_and_names_the_known_ones) {
  Table table;
  table.names = {"time", "normal"};
  table.units = {"s", "N"};
  table.columns = {{0.0, 1.0}, {5.0, 6.0}};
  EXPECT_EQ(table.column("normal"), (std::vector<double>{5.0, 6.0}));
  EXPECT_EQ(table.n_rows(), 2);
  try {
    table.column("norml");
    FAIL() << "no error";
  } catch (const ContractError& error) {
    EXPECT_NE(std::string(error.what()).find("normal"), std::string::npos);
  }
}

}  // namespace
}  // namespace dygita

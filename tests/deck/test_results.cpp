// How a deck reads results.
#include <gtest/gtest.h>

#include "deck/fake_engine.hpp"

namespace dygita::test::results_tests {

namespace {

// A static step of one increment, then four steps of 1 us: time stands still in the first row.
Table bolt_table() {
  Table table;
  table.names = {"time", "normal", "slip"};
  table.units = {"s", "N", "m"};
  table.columns = {{0, 0.5e-6, 1.5e-6, 2.5e-6, 3.5e-6}, {-1000, -900, -1100, -950, -970}, {0, 1e-6, 2e-6, 3e-6, 4e-6}};
  table.step = {0, 1, 1, 1, 1};
  return table;
}

Table spread_table() {
  Table table;
  table.names = {"time", "displacement"};
  table.units = {"s", "m"};
  table.columns = {{0, 0, 1e-6, 2e-6, 3e-6, 4e-6}, {0, 1e-6, 3e-6, 7e-6, 5e-6, 4e-6}};
  table.step = {0, 0, 1, 1, 1, 1};
  return table;
}

Table path_table() {
  Table table;
  table.names = {"time", "x", "y", "z"};
  table.units = {"s", "m", "m", "m"};
  table.columns = {{0, 1e-6}, {3, -5}, {4, 0}, {0, 0}};
  table.step = {0, 1};
  return table;
}

Table spectrum_table() {
  Table table;
  table.names = {"frequency", "maximax", "positive", "negative", "primary", "residual"};
  table.units = {"Hz", "m/s^2", "m/s^2", "m/s^2", "m/s^2", "m/s^2"};
  table.columns = {{100, 200, 400}, {1, 2, 4}, {1, 2, 3}, {-1, -2, -4}, {1, 1, 1}, {0, 0, 0}};
  return table;
}

const char* const declared = R"(
local corner = low:where(function(x, y, z) return near(z, 10*mm) and near(x, 0) and near(y, 0) end)
local spread = output.history{ name = "spread", on = corner, quantity = "displacement", direction = { 2, 0, 0 } }
local path = output.history{ name = "path", on = corner, quantity = "displacement" }
local a = output.history{ name = "a", on = corner, quantity = "acceleration", direction = { 0, 0, 1 } }
local srs = output.srs{ name = "srs", of = a }
local vtk = output.vtk{}
local p = problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { base },
                   steps = { hold, ring }, outputs = { joint, spread, path, a, srs, vtk } }
local result = p:run{}
)";

std::string message_when(const std::string& text) {
  FakeEngine fake;
  fake.tables = {{"bolt", bolt_table()}, {"spread", spread_table()}, {"path", path_table()}, {"srs", spectrum_table()}};
  try {
    run_text(std::string(two_blocks) + declared + text, fake);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find(": ") + 2);
  }
  return "";
}

TEST(Results, have_columns_by_name) {
  EXPECT_EQ(message_when(R"(
    local normal = result[joint].normal
    assert(normal.max == -900 and normal.min == -1100 and normal.first == -1000 and normal.last == -970)
    assert(#normal == 5 and normal[1] == -1000 and normal[5] == -970 and normal[2.0] == -900)
    assert(near(result[joint].slip.max, 4e-6) and #result[joint] == 5)
    local n = 0
    for i, value in ipairs(normal) do n = n + 1; assert(value == normal[i]) end
    assert(n == 5)
  )"),
            "");
}

TEST(Results, of_one_column_answer_as_that_series) {
  EXPECT_EQ(message_when(R"(
    local s = result[spread]
    assert(s.max / um == 7 and s.last / um == 4 and s.first == 0 and s.min == 0)
    assert(#s == 6 and s[3] == 3*um and s.displacement[3] == 3*um)
    assert(s:at(2*us) == 7*um and s:at(hold) == 1*um and s:at(ring) == 4*um)
    assert(#s.time == 6 and s.time.last == 4e-6)
  )"),
            "");
}

TEST(Results, of_a_vector_have_a_largest_modulus) {
  EXPECT_EQ(message_when("assert(result[path].max == 5 and result[path].x.max == 3 and result[path].x.min == -5)"), "");
  EXPECT_EQ(message_when("local l = result[path].last"),
            "output.history 'path' has no 'last'\n    known: max, time, x, y, z");
  EXPECT_EQ(message_when("local l = result[path]:at(0)"),
            "output.history 'path' has several columns\n    known: x, y, z");
}

TEST(Results, are_linear_between_rows) {
  EXPECT_EQ(message_when(R"(
    assert(near(result[spread]:at(1.5*us) / um, 5) and near(result[spread]:at(3.25*us) / um, 4.75))
    assert(near(result[spread]:at(0) / um, 1), "the last of the rows at time 0")
    assert(result[spread]:at(4*us) == 4*um)
    assert(near(result[srs].maximax:at(300), 3))
  )"),
            "");
}

TEST(Results, that_are_means_over_a_step_reach_half_a_step_further) {
  EXPECT_EQ(message_when("assert(result[joint].normal:at(4*us) == -970)"), "");
  EXPECT_EQ(message_when("local x = result[joint].normal:at(5*us)"),
            "series 'bolt.normal' goes from time 0 to 3.5e-06 s, 5e-06 is outside");
}

TEST(Results, are_read_at_the_end_of_a_step) {
  EXPECT_EQ(message_when("assert(result[joint].normal:at(hold) == -1000 and result[joint].normal:at(ring) == -970)"),
            "");
  EXPECT_EQ(message_when("local other = step.static{ name = 'other' }\nlocal x = result[joint].normal:at(other)"),
            "step 'other' is not in 'steps' of problem 'p'");
  EXPECT_EQ(message_when("local x = result[joint].normal:at('ring')"), "series:at takes a time or a step, got string");
  EXPECT_EQ(message_when("local x = result[joint].normal.at(ring)"),
            "at is called with a colon: series:at(t) or series:at(step)");
}

TEST(Results, of_spectra_go_with_frequency) {
  EXPECT_EQ(message_when("assert(result[srs].frequency.last == 400 and result[srs].negative.min == -4)"), "");
  EXPECT_EQ(message_when("local x = result[srs].maximax:at(ring)"), "series 'srs.maximax' has no steps");
}

TEST(Results, have_figures_of_the_run) {
  EXPECT_EQ(message_when(R"(
    assert(result.iterations == 42 and math.type(result.iterations) == "integer" and ("%d"):format(result.iterations) == "42")
    assert(result.mean_iterations == 3.5 and result.converged == true)
  )"),
            "");
}

TEST(Results, that_are_not_there_are_errors) {
  EXPECT_EQ(message_when("local x = result[joint].norml"),
            "output.joint 'bolt' has no 'norml'\n    did you mean 'normal'? known: normal, slip, time");
  EXPECT_EQ(message_when("local x = result[joint].normal.maximum"),
            "series 'bolt.normal' has no 'maximum'\n    known: at, first, last, max, min, time");
  EXPECT_EQ(message_when("local x = result[joint].normal[7]"), "series 'bolt.normal' has rows 1 to 5, not 7");
  EXPECT_EQ(message_when("local x = result[spread].peak"),
            "series 'spread.displacement' has no 'peak'\n    known: at, first, last, max, min, time");
  EXPECT_EQ(message_when("local x = result[vtk]"),
            "output.vtk provides no data to the deck\n    its frames are ParaView files");
  EXPECT_EQ(message_when("local x = result[a].max"), "the run produced nothing for output 'a'");
  EXPECT_EQ(message_when("local x = result.bolt"),
            "a result has no 'bolt'\n    index it by the output itself, not by its name: result[bolt], without quotes");
  EXPECT_EQ(message_when("local x = result.bold"),
            "a result has no 'bold'\n    known: converged, iterations, mean_iterations");
  EXPECT_EQ(message_when("local x = result[glue]"),
            "result[interface 'glue']: index a result by an output, as in result[bolt], or by a substructure");
  EXPECT_EQ(message_when("local n = #low"), "substructure 'low' has no length");
}

TEST(Results, do_not_change) {
  EXPECT_EQ(message_when("result.converged = true"),
            "result 'p' does not change once declared ('converged' was assigned)\n    declare another one");
}

}  // namespace

}  // namespace dygita::test::results_tests

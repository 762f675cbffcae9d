// Spectra of a run: fields on faces, attenuation through a joint.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_prints.hpp"

namespace dygita::test::spectrum_fields_tests {
namespace {

const std::string two_blocks = R"(
local metal = material.elastic{ name = "metal", young = 210*GPa, poisson = 0, density = 7800 }
local function block(name, z) return substructure{ name = name, material = metal,
  mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 2, 2, 4 }, origin = { 0, 0, z } } } end
local a, b = block("a", 0), block("b", 20*mm)
local joint = interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 }
local top  = output.history{ name = "top", on = b:face "zmax", quantity = "acceleration" }
local side = output.history{ name = "side", on = a:face "xmax", quantity = "acceleration" }
local node = output.history{ name = "node", on = a:where(function(x, y, z) return near(x, 20*mm) and near(y, 20*mm) and near(z, 20*mm) end),
  quantity = "acceleration", direction = { 0, 0, 1 } }
local band = { from = 5*kHz, to = 80*kHz }
problem{ name = "two_blocks", substructures = { a, b }, interfaces = { joint },
  supports = { support.fixed{ name = "base", on = a:face "zmin" } },
  steps = { step.dynamic{ name = "shock", duration = 200*us, dt = 1*us,
    loads = { load.pressure{ on = b:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = 20*us } } } } },
  outputs = { top, side, node,
    output.srs{ name = "one", of = node, from = band.from, to = band.to, per_octave = 3 },
    output.srs_field{ name = "along", on = { a:face "xmax", b:face "xmax" }, direction = { 0, 0, 2 }, from = band.from, to = band.to },
    output.srs_field{ name = "any", on = a:face "xmax", from = band.from, to = band.to },
    output.attenuation{ name = "octaves", entering = top, leaving = side, from = band.from, to = band.to },
    output.attenuation{ name = "same", entering = side, leaving = side, from = band.from, to = band.to, bands = 3 },
    output.attenuation{ name = "narrow", entering = side, leaving = side, from = 10*kHz, to = 14*kHz } } }:run{}
)";

const DeckRun& blocks() {
  static const DeckRun run = run_text(two_blocks).front();
  return run;
}

TEST(SpectrumField, has_at_a_node_the_spectrum_of_that_nodes_history) {
  const DeckRun& run = blocks();
  const std::vector<Frame>& frames = run.findings("along").frames;
  const Table& one = run.table("one");
  ASSERT_EQ(static_cast<int>(frames.size()), one.n_rows());
  ASSERT_EQ(frames[0].interfaces.size(), 2u);
  const InterfaceFrame& face = frames[0].interfaces[0];
  int corner = -1;
  for (int i = 0; i < face.points.cols(); ++i)
    if ((face.points.col(i) - Vec3(20e-3, 20e-3, 20e-3)).norm() < 1e-9) corner = i;
  ASSERT_GE(corner, 0);
  const char* names[] = {"maximax", "positive", "negative", "primary", "residual"};
  for (size_t f = 0; f < frames.size(); ++f) {
    EXPECT_DOUBLE_EQ(frames[f].label_time, one.columns[0][f]);
    for (size_t k = 0; k < 5; ++k) {
      const NamedField& field = frames[f].interfaces[0].fields[k];
      EXPECT_EQ(field.name, names[k]);
      EXPECT_NEAR(field.values(0, corner) / one.column(names[k])[f], 1.0, 1e-5)
          << names[k];  // kept in single precision
    }
  }
}

TEST(SpectrumField, has_a_table_of_the_highest_and_the_mean_over_its_nodes) {
  const DeckRun& run = blocks();
  const std::vector<Frame>& frames = run.findings("along").frames;
  for (size_t f = 0; f < frames.size(); ++f) {
    double highest = 0.0, sum = 0.0, n = 0.0;
    for (const InterfaceFrame& face : frames[f].interfaces) {
      highest = std::max(highest, face.fields[0].values.maxCoeff());
      sum += face.fields[0].values.sum();
      n += static_cast<double>(face.points.cols());
    }
    EXPECT_DOUBLE_EQ(run.column("along", "highest")[f], highest);
    EXPECT_DOUBLE_EQ(run.column("along", "mean")[f], sum / n);
    EXPECT_GE(highest, sum / n);
  }
}

TEST(SpectrumField, without_a_direction_takes_the_strongest_axis) {
  const DeckRun& run = blocks();
  const std::vector<Frame>&along = run.findings("along").frames, &any = run.findings("any").frames;
  for (size_t f = 0; f < any.size(); ++f) {
    const auto difference = any[f].interfaces[0].fields[0].values - along[f].interfaces[0].fields[0].values;
    EXPECT_GE(difference.minCoeff(), 0.0);
  }
}

TEST(Attenuation, of_a_place_against_itself_is_nothing) {
  const Table& same = blocks().table("same");
  ASSERT_EQ(same.n_rows(), 12);  // four octaves in thirds
  for (const double ratio : same.column("ratio_z")) EXPECT_DOUBLE_EQ(ratio, 0.0);
  EXPECT_NEAR(same.columns[0][0], 5e3 * std::exp2(1.0 / 6.0), 1e-6);
}

TEST(Attenuation, over_less_than_a_band_has_one) {
  const Table& narrow = blocks().table("narrow");
  ASSERT_EQ(narrow.n_rows(), 1);
  EXPECT_NEAR(narrow.columns[0][0], std::sqrt(10e3 * 14e3), 1e-6);
}

TEST(Attenuation, says_nothing_of_an_axis_along_which_nothing_enters) {
  const Table& octaves = blocks().table("octaves");
  ASSERT_EQ(octaves.n_rows(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(std::isnan(octaves.column("ratio_x")[i]));
    EXPECT_NEAR(octaves.column("ratio_z")[i],
                20.0 * std::log10(octaves.column("leaving_z")[i] / octaves.column("entering_z")[i]), 1e-12);
  }
}

// From a to d: through an isolator, or around by a bolted joint and a bond; e is connected to nothing.
TEST(Attenuation, is_compared_with_the_rule_of_thumb_of_its_way) {
  const auto rule_of = [](const Settings& settings) {
    return run_text(R"(
local p = param{ around = 1, joints = 0, apart = 0 }
local metal = material.elastic{ name = "metal", young = 210*GPa, poisson = 0, density = 7800 }
local function block(name, x, z) return substructure{ name = name, material = metal,
  mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 1, 1, 1 }, origin = { x, 0, z } } } end
local a, b, c, d, e = block("a", 0, 0), block("b", 20*mm, 0), block("c", 20*mm, 20*mm), block("d", 0, 20*mm), block("e", 90*mm, 0)
local soft = interface.bushing{ name = "soft", between = { a:face "zmax", d:face "zmin" }, normal = 1e10, tangential = 1e10 }
local lap = interface.contact{ name = "lap", between = { a:face "xmax", b:face "xmin" }, friction = 0.2 }
local glue = interface.bonded{ name = "glue", between = { b:face "zmax", c:face "zmin" } }
local bolt = interface.bonded{ name = "bolt", between = { c:face "xmin", d:face "xmax" } }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = bolt, force = 10 } } }
local shock = step.dynamic{ name = "shock", after = tighten, duration = 200*us, dt = 1*us,
  loads = { load.pressure{ on = b:face "xmax", history = history.half_sine{ peak = 1*MPa, duration = 20*us } } } }
local function on(name, part) return output.history{ name = name, on = part:face "ymax", quantity = "acceleration" } end
local first, last = on("first", a), on("last", p.apart == 1 and e or d)
local made = output.attenuation{ name = "made", entering = first, leaving = last, from = 10*kHz, to = 80*kHz, joints = p.joints > 0 and math.tointeger(p.joints) or nil }
local interfaces = { soft }
if p.around == 1 then interfaces = { soft, lap, glue, bolt } end
problem{ name = "blocks", substructures = { a, b, c, d, e }, interfaces = interfaces, supports = { support.fixed{ name = "base", on = { a:face "zmin", b:face "zmin" } } },
  steps = p.around == 1 and { tighten, shock } or { shock }, outputs = { first, last, made } }:run{}
)",
                    settings, 1)
        .at(0)
        .findings("made")
        .values;
  };
  const std::map<std::string, double> around = rule_of({});
  EXPECT_EQ(around.at("joints"), 2.0);
  EXPECT_EQ(around.at("bonds"), 1.0);
  EXPECT_EQ(around.at("isolators"), 0.0);
  EXPECT_NEAR(around.at("distance"), 0.02, 1e-12);
  EXPECT_NEAR(around.at("rule"), -(13 * 0.02 + 2 * 3 + 2), 1e-12);
  EXPECT_NEAR(rule_of({{"joints", "3"}}).at("rule"), -(13 * 0.02 + 3 * 3), 1e-12);
  EXPECT_TRUE(std::isnan(rule_of({{"apart", "1"}}).at("rule")));
}

TEST(BoardShock, is_what_a_clamped_beam_makes_of_the_record) {
  const PrintedRun run = run_printing("verification/board_shock.lua");
  EXPECT_NEAR(run.number("first mode (Hz)"), 1570.2, 0.02 * 1570.2);
  EXPECT_NEAR(run.number("largest acceleration of the middle (g)"), 2618.0, 0.1 * 2618.0);
  EXPECT_LT(run.number("spectrum of the middle beside the beam's (dB)"), 0.5);
}

TEST(SpectrumThroughJoint, passes_what_presses_the_joint_and_takes_from_what_shears_it) {
  const PrintedRun closed = run_printing("spectrum_through_joint.lua");
  const double x = closed.number("mean x"), z = closed.number("mean z");
  EXPECT_NEAR(x, -6.0, 0.15);
  EXPECT_NEAR(z, 0.2, 0.15);
  EXPECT_NEAR(closed.number("before"), 30.97, 0.02);
  EXPECT_NEAR(closed.number("after"), 30.57, 0.05);
  const PrintedRun slippery = run_printing("spectrum_through_joint.lua", {{"mu", "0.05"}});
  EXPECT_NEAR(slippery.number("mean x"), -20.3, 0.15);
  EXPECT_GT(slippery.number("work of friction"), 2.0 * closed.number("work of friction"));
}

}  // namespace
}  // namespace dygita::test::spectrum_fields_tests

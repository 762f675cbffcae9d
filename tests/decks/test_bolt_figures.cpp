// What is said of bolts that are hardly tightened.
#include <gtest/gtest.h>

#include "decks/engine.hpp"
#include "files/bolt_table.hpp"

namespace dygita::test::bolt_figures_tests {
namespace {

// A rod of 100 mm^2 under a cover, tightened to a force and pulled.
const std::string rod = R"(
local p = param{ force = 8000, pull = 100 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local base = substructure{ name = "base", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 4 } } }
local head = substructure{ name = "head", material = steel, mesh = mesh.box{ origin = { 0, 0, 20*mm }, size = { 20*mm, 10*mm, 5*mm }, cells = { 2, 1, 1 } } }
local sleeve = substructure{ name = "sleeve", material = steel, mesh = mesh.box{ origin = { 10*mm, 0, 0 }, size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 4 } } }
local bolt = interface.bonded{ name = "bolt", between = { base:face "zmax", head:face "zmin" } }
local seat = interface.contact{ name = "seat", between = { sleeve:face "zmax", head:face "zmin" }, friction = 0.2 }
local floor = support.fixed{ name = "floor", on = { base:face "zmin", sleeve:face "zmin" } }
local guide = support.symmetry{ name = "guide", on = { head:face "xmin", head:face "xmax" } }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = bolt, force = p.force } } }
local pull = step.static{ name = "pull", after = tighten, loads = { load.force{ on = head:face "zmax", z = p.pull } } }
problem{ name = "rod", substructures = { base, head, sleeve }, interfaces = { bolt, seat }, supports = { floor, guide }, steps = { tighten, pull } }:run{}
)";

TEST(BoltFigures, have_no_loss_where_the_bolt_was_hardly_tightened) {
  testing::internal::CaptureStderr();
  const DeckRun run = run_text(rod, {{"force", "8"}, {"pull", "1000"}}).at(0);
  const std::string said = testing::internal::GetCapturedStderr();
  const BoltSummary& bolt = run.result->bolts.at(0);
  EXPECT_NEAR(bolt.tightened, 8.0, 1e-3);
  EXPECT_GT(bolt.last, 400.0);
  EXPECT_FALSE(bolt.loss().has_value());
  // At the check, by the stress; after the run, by what went through.
  EXPECT_NE(
      said.find("load.preload asks for 8 N through interface.bonded 'bolt', a mean stress of 0.08 MPa: was a unit "
                "forgotten, as in 8*kN?"),
      std::string::npos)
      << said;
  EXPECT_NE(said.find("bolt 'bolt' is tightened to 8 N, and up to "), std::string::npos) << said;
  std::string table;
  for (const std::string& line : bolt_lines(run.problem, *run.result)) table += line + "\n";
  EXPECT_EQ(table.find(" %"), std::string::npos) << table;
  EXPECT_EQ(bolts_csv(run.problem, *run.result).find("-1"), std::string::npos);
}

TEST(BoltFigures, have_the_loss_of_a_bolt_that_holds_more_than_its_load) {
  testing::internal::CaptureStderr();
  const DeckRun run = run_text(rod, {{"force", "8000"}, {"pull", "1000"}}).at(0);
  const std::string said = testing::internal::GetCapturedStderr();  // that base and sleeve touch, nothing of the bolt
  EXPECT_EQ(said.find("bolt 'bolt'"), std::string::npos) << said;
  EXPECT_EQ(said.find("load.preload"), std::string::npos) << said;
  const BoltSummary& bolt = run.result->bolts.at(0);
  ASSERT_TRUE(bolt.loss().has_value());
  EXPECT_NEAR(*bolt.loss(), 1.0 - bolt.last / 8000.0, 1e-9);
  EXPECT_LT(std::abs(*bolt.loss()), 0.1);
}

std::string said_of(const std::string& deck, const std::string& force) {
  testing::internal::CaptureStderr();
  run_text(deck, {{"force", force}});
  return testing::internal::GetCapturedStderr();
}

TEST(BoltFigures, say_what_no_bolt_bears) {
  const std::string beyond = "bolt 'bolt' is tightened to 1.25e+05 N, 1250 MPa on its 100 mm^2, and ";
  EXPECT_EQ(said_of(rod, "115000").find("is tightened to"), std::string::npos);
  const std::string said = said_of(rod, "125000");
  EXPECT_NE(said.find(beyond + "no bolt bears more than 1200 MPa"), std::string::npos) << said;
}

TEST(BoltFigures, say_what_the_parts_of_a_bolt_do_not_bear) {
  std::string weak = rod;
  const std::string of_head = "name = \"head\", material = steel";
  weak.replace(weak.find(of_head), of_head.size(), "name = \"head\", material = weak");
  weak =
      "local weak = material.elastic{ name = 'weak', young = 200*GPa, poisson = 0, density = 8000, yield = 640*MPa "
      "}\n" +
      weak;
  EXPECT_EQ(said_of(weak, "63000").find("is tightened to"), std::string::npos);
  const std::string said = said_of(weak, "65000");
  EXPECT_NE(said.find("bolt 'bolt' is tightened to 6.5e+04 N, 650 MPa on its 100 mm^2, and its parts yield at 640 MPa"),
            std::string::npos)
      << said;
}

TEST(BoltFigures, have_no_loss_where_a_bolt_was_loosened) {
  BoltSummary bolt;
  EXPECT_FALSE(bolt.loss().has_value());
  bolt.after_static = {1000.0, 1e-9};
  bolt.tightened = 1e-9;
  bolt.last = -5.0;
  EXPECT_FALSE(bolt.loss().has_value());
}

}  // namespace
}  // namespace dygita::test::bolt_figures_tests

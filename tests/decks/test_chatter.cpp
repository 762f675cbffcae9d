// A block driven over a rough floor without damping: its contact opens and closes from step to step.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "decks/engine.hpp"

namespace dygita::test::chatter_tests {
namespace {

// Pressed by 2000 N and pushed from behind: free of friction it would go (push - mu press) area / mass.
DeckRun driven(const Settings& settings, const std::string& solver = "") {
  return run_text(R"(
local p = param{ mu = 0.2, explicit = 1, damped = 0, plate = 0, ms = 0.4 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local how = p.explicit == 1 and "explicit" or "implicit"
local block = substructure{ name = "block", integration = how, material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 8, 8, 4 } } }
local floor = p.plate == 0 and support.wall{ name = "seat", on = block:face "zmin", friction = p.mu }
local plate = p.plate == 1 and substructure{ name = "plate", integration = how, material = steel,
  mesh = mesh.box{ origin = { -10*mm, -10*mm, -10*mm }, size = { 60*mm, 40*mm, 10*mm }, cells = { 12, 8, 2 } } }
local seat = plate and interface.contact{ name = "seat", between = { block:face "zmin", plate:face "zmax" }, friction = p.mu }
local press = load.pressure{ on = block:face "zmax", history = 5*MPa }
local settle = step.static{ name = "settle", loads = { press } }
local guide = support.symmetry{ name = "guide", on = block:face "ymin" }
local go = step.dynamic{ name = "go", after = settle, duration = p.ms*ms, dt = 1*us, loads = { press, load.traction{ on = block:face "xmin", x = 4.8*MPa } } }
problem{ name = "driven", substructures = plate and { block, plate } or { block }, interfaces = seat and { seat } or {},
  supports = plate and { guide, support.fixed{ name = "base", on = plate:face "zmin" } } or { guide, floor },
  steps = { settle, go }, solver = solver.latin{ numerical_damping = p.damped },
  outputs = { output.joint{ name = "j", on = seat or floor }, output.history{ name = "sole", on = block:face "zmin", quantity = "displacement" } } }:run{}
)",
                  settings, 1, solver)
      .at(0);
}

bool is_told(const DeckRun& run) {
  const std::vector<std::string>& all = run.result->warnings;
  return std::any_of(all.begin(), all.end(), [](const std::string& warning) {
    return warning.find("contact 'seat' chatters") != std::string::npos;
  });
}

double rigid_way(double mu, double t) { return 0.5 * (2.4e6 - mu * 5e6) / (7800 * 0.01) * t * t; }

// Whether a point is closed at the instants that are looked at must not tell how far it slides.
TEST(Chatter, slip_is_how_far_the_sides_have_moved) {
  const Settings scenes[] = {{}, {{"plate", "1"}}, {{"explicit", "0"}}, {{"mu", "0"}}, {{"mu", "0"}, {"plate", "1"}}};
  for (size_t i = 0; i < std::size(scenes); ++i) {
    SCOPED_TRACE(i);
    const DeckRun run = driven(scenes[i]);
    const double mu = i < 3 ? 0.2 : 0.0, way = run.column("sole", "x").back();
    EXPECT_NEAR(way, rigid_way(mu, 0.4e-3), 0.01 * way);
    EXPECT_NEAR(run.column("j", "slip").back(), way, 0.01 * way);
    if (mu > 0.0) EXPECT_NEAR(*run.result->contacts.at(0).steps.back().slip, way, 0.01 * way);
  }
}

TEST(Chatter, is_told_once_with_its_cure) {
  EXPECT_TRUE(is_told(driven({{"ms", "0.2"}})));
  EXPECT_FALSE(is_told(driven({{"ms", "0.2"}, {"explicit", "0"}, {"damped", "0.3"}})));
}

}  // namespace
}  // namespace dygita::test::chatter_tests

// A foot on a plate, facets of any size on facets of any other, anywhere and at any angle: what the interface's points
// make of it is the mesh's own answer, whichever face has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::overlaps_tests {
namespace {

// Pressed, then pushed sideways: in four increments, or by a half-sine.
const std::string foot_on_plate = R"(
local p = param{ plate = 4, foot = 3, side = 0, bonded = 0, x = 4, y = 4, turn = 0, shock = 0, swapped = 0, scene = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.33, density = 2700 }
local function turned(x, y, angle)
  local c, s = math.cos(p.scene*deg), math.sin(p.scene*deg)
  return { translate = { (c*x - s*y)*mm, (s*x + c*y)*mm, 0 }, rotate = { axis = { 0, 0, 1 }, angle = (angle + p.scene)*deg } }
end
local function block(name, of, size, n, place)
  local h = 0.5*size*mm
  return substructure{ name = name, material = of, place = place,
    mesh = mesh.box{ origin = { -h, -h, name == "foot" and 12*mm or 0 }, size = { size*mm, size*mm, 12*mm }, cells = { n, n, math.max(3, name == "foot" and n or n//2) } } }
end
local plate = block("plate", steel, 20, p.plate, turned(0, 0, 0))
local foot = block("foot", alloy, 12, p.foot, turned(p.x - 4, p.y - 4, p.turn))
local on = { plate = p.side == 1, foot = p.side == 2 }
local between = p.swapped == 1 and { foot:face "zmin", plate:face "zmax" } or { plate:face "zmax", foot:face "zmin" }
local points = (on.plate and "first") or (on.foot and "second") or nil
local seat = p.bonded == 1 and interface.bonded{ name = "seat", between = between, points = points }
             or interface.contact{ name = "seat", between = between, points = points, friction = 0.3 }
local c, s = math.cos(p.scene*deg), math.sin(p.scene*deg)
local function pushed(history) return load.traction{ on = foot:face "zmax", x = c*history, y = s*history } end
local hold = load.pressure{ on = foot:face "zmax", history = 2*MPa }
local press = step.static{ name = "press", loads = { hold } }
local push = p.shock == 1 and step.dynamic{ name = "push", after = press, duration = 100*us, dt = 1*us, loads = { hold, pushed(history.half_sine{ peak = 1*MPa, duration = 50*us }) } }
             or step.static{ name = "push", after = press, increments = 4, loads = { hold, pushed(0.1*MPa) } }
problem{ name = "foot_on_plate", substructures = { plate, foot }, interfaces = { seat }, supports = { support.fixed{ name = "ground", on = plate:face "zmin" } },
  steps = { press, push }, solver = solver.latin{ integration = "implicit" },
  outputs = { output.history{ name = "top", on = foot:face "zmax", quantity = "displacement", direction = { c, s, 0 } }, output.joint{ name = "seat", on = seat } } }:run{}
)";

struct Answer {
  double shift, force;  // m, largest; N, largest
};

Answer answer_of(const Settings& settings) {
  const DeckRun run = run_text(foot_on_plate, settings, 1).at(0);
  EXPECT_TRUE(run.result->converged);
  const auto largest = [](const std::vector<double>& values) {
    return std::abs(
        *std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  };
  const std::vector<double>& top = run.column("top", "displacement");
  // After the first increment, which presses.
  return {largest({top.begin() + 2, top.end()}) - (run.problem.steps[1]->is_static ? top[1] : 0.0),
          largest(run.column("seat", "normal"))};
}

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

// In the middle; a third over the edge, where contact is left on a strip of 4 mm; at an angle over a corner.
struct Place {
  Settings settings;
  double within;  // of the refined answer, with cells of 1 to 2 mm
};
const Place places[] = {{{}, 0.02}, {{{"x", "12"}}, 0.09}, {{{"x", "7"}, {"y", "6.5"}, {"turn", "25"}}, 0.02}};

TEST(Overlaps, have_an_answer_that_no_choice_of_side_changes) {
  for (const char* bonded : {"0", "1"})
    for (const char* plate : {"2", "3", "4", "5", "8"})
      for (const char* foot : {"2", "3", "6", "12"}) {
        const Settings here{{"bonded", bonded}, {"plate", plate}, {"foot", foot}};
        SCOPED_TRACE(testing::Message() << bonded << ' ' << plate << ' ' << foot);
        const double on_plate = answer_of(with(here, {{"side", "1"}})).shift,
                     on_foot = answer_of(with(here, {{"side", "2"}})).shift;
        EXPECT_NEAR(on_plate, on_foot, 0.07 * on_foot);
      }
}

TEST(Overlaps, have_the_refined_answer) {
  for (const auto& [place, within] : places)
    for (const char* bonded : {"0", "1"}) {
      const double refined = answer_of(with(place, {{"bonded", bonded}, {"plate", "20"}, {"foot", "12"}})).shift;
      for (const auto& [plate, foot] : {std::pair{"16", "9"}, {"10", "12"}, {"12", "12"}})
        for (const char* side : {"0", "1", "2"}) {
          SCOPED_TRACE(testing::Message()
                       << bonded << ' ' << place.size() << ' ' << plate << ' ' << foot << ' ' << side);
          const Settings here{{"bonded", bonded}, {"plate", plate}, {"foot", foot}, {"side", side}};
          EXPECT_NEAR(answer_of(with(place, here)).shift, refined, within * refined);
        }
    }
}

TEST(Overlaps, have_the_refined_answer_in_a_shock) {
  const Settings shock{{"shock", "1"}};
  const Answer refined = answer_of(with(shock, {{"plate", "20"}, {"foot", "12"}}));
  for (const auto& [plate, foot] : {std::pair{"4", "6"}, {"8", "6"}, {"5", "12"}}) {
    SCOPED_TRACE(testing::Message() << plate << ' ' << foot);
    const Answer coarse = answer_of(with(shock, {{"plate", plate}, {"foot", foot}}));
    EXPECT_NEAR(coarse.shift, refined.shift, 0.05 * refined.shift);
    EXPECT_NEAR(coarse.force, refined.force, 0.1 * refined.force);  // what is missing is the plate's mesh
  }
}

TEST(Overlaps, do_not_know_in_which_order_faces_are_named_nor_where_the_scene_stands) {
  for (const auto& [place, within] : places)
    for (const char* bonded : {"0", "1"}) {
      const Settings here = with(place, {{"bonded", bonded}, {"plate", "5"}, {"foot", "4"}});
      const Answer plain = answer_of(here);
      EXPECT_NEAR(answer_of(with(here, {{"swapped", "1"}})).shift, plain.shift, 1e-6 * plain.shift);
      for (const char* scene : {"90", "37"})
        EXPECT_NEAR(answer_of(with(here, {{"scene", scene}})).shift, plain.shift, 2e-5 * plain.shift) << scene;
    }
}

}  // namespace
}  // namespace dygita::test::overlaps_tests

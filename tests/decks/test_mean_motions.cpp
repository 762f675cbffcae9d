// Mean motions of a face, of any cells: what holds, joins or loads a face by them bends it as theory has it.
#include <gtest/gtest.h>

#include <iostream>

#include "decks/engine.hpp"
#include "reduction/superelement.hpp"

namespace dygita::test::mean_motions_tests {
namespace {

// A cantilever of 100 x 20 x 6 mm, one cell high, with 5 N at its tip: held by the mean motion of its root; or cut in
// the middle and joined there by mean motions.
const char* const cantilever = R"(
local p = param{ cell = 0, across = 2, cut = 0 }
local alu = material.elastic{ name = "alu", young = 70*GPa, poisson = 0, density = 2800 }
local cell = ({ [0] = "hex8", "hex20", "hex27", "prism15", "prism18", "tet10" })[p.cell]
local function beam(name, x, length)
  return substructure{ name = name, material = alu, place = { x, 0, 0 }, mesh = mesh.box{
    size = { length, 20*mm, 6*mm }, cells = { p.cut == 1 and 5 or 10, p.across, 1 }, cell = cell, order = p.cell > 0 and 2 or 1 } }
end
local root, interfaces, supports = beam("root", 0, p.cut == 1 and 50*mm or 100*mm), {}, {}
local parts, tip = { root }, root
if p.cut == 1 then
  tip = beam("tip", 50*mm, 50*mm)
  parts[2] = tip
  interfaces[1] = interface.bonded{ name = "joint", between = { root:face "xmax", tip:face "xmin" }, motion = "mean" }
  supports[1] = support.fixed{ name = "ground", on = root:face "xmin" }
else
  supports[1] = support.spring{ name = "ground", on = root:face "xmin", x = 1e12, y = 1e12, z = 1e12, about_x = 1e9, about_y = 1e9, about_z = 1e9 }
end
problem{ name = "cantilever", substructures = parts, interfaces = interfaces, supports = supports,
  steps = { step.static{ name = "bent", loads = { load.force{ on = tip:face "xmax", z = 5 } } } },
  outputs = { output.history{ name = "tip", on = tip:face "xmax", quantity = "displacement", direction = { 0, 0, 1 } } } }:run{}
)";

constexpr double by_theory = 5 * 0.1 * 0.1 * 0.1 / 3 / (70e9 * 0.02 * 0.006 * 0.006 * 0.006 / 12);  // m

TEST(MeanMotion, of_a_face_of_any_cells_holds_and_joins_a_beam_as_theory_has_it) {
  for (const char* cut : {"0", "1"})
    for (const char* across : {"1", "2"})
      for (int cell = 0; cell < 6; ++cell) {
        const DeckRun run =
            run_text(cantilever, {{"cell", std::to_string(cell)}, {"across", across}, {"cut", cut}}, 1).at(0);
        const double tip = run.column("tip", "displacement").back();
        std::cout << "cut " << cut << ", " << across << " across, cells " << cell << ": " << tip / by_theory << "\n";
        EXPECT_NEAR(tip / by_theory, 1.0, 0.002);
      }
}

// The stiffness of its end against a rotation, with the other end still: 4 E I/L, less what shear gives.
TEST(MeanMotion, of_ports_gives_a_superelement_the_stiffness_of_a_beam) {
  const char* const element = R"(
local p = param{ order = 1 }
local alu = material.elastic{ name = "alu", young = 70*GPa, poisson = 0, density = 2800 }
local beam = substructure{ name = "beam", material = alu, mesh = mesh.box{ size = { 100*mm, 20*mm, 6*mm }, cells = { 20, 2, 1 }, order = p.order } }
problem{ name = "beam", substructures = { beam }, steps = { step.static{ name = "rest" } },
  outputs = { output.superelement{ name = "element", on = { beam:face "xmin", beam:face "xmax" }, motion = "mean", modes = 2 } } }:run{}
)";
  constexpr double bending = 70e9 * 0.02 * 0.006 * 0.006 * 0.006 / 12, length = 0.1, shear = 35e9 * 0.02 * 0.006 / 1.2;
  constexpr double phi = 12 * bending / (shear * length * length);
  for (const char* order : {"1", "2"}) {
    const DeckRun run = run_text(element, {{"order", order}}, 1).at(0);
    const Superelement& of = *std::any_cast<const SuperelementPtr&>(run.result->findings.begin()->second.model);
    std::cout << "order " << order << ": " << of.stiffness(4, 4) * length / bending << " E I/L\n";
    EXPECT_NEAR(of.stiffness(4, 4) * length / bending, (4 + phi) / (1 + phi), 0.02);
  }
}

}  // namespace
}  // namespace dygita::test::mean_motions_tests

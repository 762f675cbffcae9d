// Meshes of other programs from end to end: every shape of cell under a uniform pressure, by the names of the file.
#include <gtest/gtest.h>

#include "decks/engine.hpp"
#include "foreign/abaqus_blocks.hpp"
#include "foreign/written_file.hpp"

namespace dygita::test::written_elsewhere_tests {
namespace {

const std::string steel =
    "*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n*MATERIAL, NAME=STEEL\n*ELASTIC\n200000., 0.3\n*DENSITY\n8.E-9\n";

// On rollers at x = 0, y = 0 and z = 0, pressed with 100 MPa from above: uniformly, whatever the cells look like.
std::string pressed(const std::string& file) {
  return "local file = mesh.abaqus{ file = \"" + file + R"(", units = "mm t s" }
local block = substructure{ name = "block", mesh = file:part "E", material = file:material "STEEL" }
local x0 = support.held{ name = "x0", on = block:region "X0", x = true }
local y0 = support.held{ name = "y0", on = block:region "Y0", y = true }
local z0 = support.symmetry{ name = "z0", on = block:face "Z0" }
local press = step.static{ name = "press", loads = { load.pressure{ on = block:face "TOP", history = 100*MPa } } }
problem{ name = "block", substructures = { block }, supports = { x0, y0, z0 }, steps = { press },
         outputs = { output.history{ name = "top", on = block:face "TOP", quantity = "displacement" },
                     output.history{ name = "corner", on = block:where(function(x, y, z) return near(x, 30*mm) and near(y, 30*mm) and near(z, 30*mm) end), quantity = "displacement" },
                     output.history{ name = "stress", on = block:face "X0", quantity = "von_mises" } } }:run{}
)";
}

TEST(WrittenElsewhere, cells_of_every_shape_are_uniformly_pressed) {
  for (const AbaqusShape& shape : abaqus_shapes()) {
    SCOPED_TRACE(shape.type);
    const WrittenFile inp(AbaqusBlock(shape, 3).text() + steel, "block.inp");
    const DeckRun run = run_text(pressed(inp.path())).at(0);
    EXPECT_NEAR(run.column("top", "z").back(), -1.5e-5, 1.5e-5 * 1e-7);    // p L / E
    EXPECT_NEAR(run.column("corner", "x").back(), 4.5e-6, 4.5e-6 * 1e-7);  // nu p L / E
    EXPECT_NEAR(run.column("corner", "y").back(), 4.5e-6, 4.5e-6 * 1e-7);
    EXPECT_NEAR(run.column("stress", "von_mises").back(), 100e6, 1e2);
  }
}

}  // namespace
}  // namespace dygita::test::written_elsewhere_tests

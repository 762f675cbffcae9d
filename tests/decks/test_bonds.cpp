// Bonds between meshes that do not match, beside other interfaces of the same face: the points that they have, and what
// they hold.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::bonds_tests {
namespace {

// A leaf that is held on its back, a block bonded to the upper part of its face, and below that, across a gap, another
// block in contact with it, never loaded.
const std::string hinge = R"(
local p = param{ touches = 1, layers = 6, top = 20 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, low, high, cells)
  return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { low[1]*mm, low[2]*mm, low[3]*mm },
    size = { (high[1] - low[1])*mm, (high[2] - low[2])*mm, (high[3] - low[3])*mm }, cells = cells } }
end
local leaf = block("leaf", { 0, -30, 8 }, { 8, 30, 46 }, { 1, 5, p.layers })
local upper = block("upper", { -27, -30, 24 }, { 0, 30, 46 }, { 2, 4, 2 })
local parts, joints = { leaf, upper }, { interface.bonded{ name = "glue", between = { leaf:face "xmin", upper:face "xmax" } } }
local held = { leaf:face "xmax" }
if p.touches == 1 then
  local lower = block("lower", { -27, -30, 8 }, { 0, 30, p.top }, { 3, 5, 2 })
  parts[3], held[2] = lower, lower:face "xmin"
  joints[2] = interface.contact{ name = "touch", between = { leaf:face "xmin", lower:face "xmax" } }
end
problem{ name = "hinge", substructures = parts, interfaces = joints, supports = { support.fixed{ name = "wall", on = held } },
  steps = { step.static{ name = "pull", loads = { load.force{ on = upper:face "xmin", z = -1000 } } } },
  outputs = { output.history{ name = "u", on = upper:face "xmin", quantity = "displacement" } } }:run{}
)";

TEST(Bond, keeps_its_points_beside_a_contact_that_it_does_not_meet) {
  const auto deflection = [](const Settings& settings) { return run_text(hinge, settings)[0].column("u", "z").back(); };
  for (const char* layers : {"6", "3"}) {
    const double alone = deflection({{"layers", layers}, {"touches", "0"}});
    for (const char* top : {"20", "21", "23.5"})
      EXPECT_NEAR(deflection({{"layers", layers}, {"top", top}}), alone, 1e-3 * std::abs(alone))
          << layers << " " << top;
  }
}

// Two blocks side by side on a plate, not touching each other, each bonded to it, under mirror images of a load.
const std::string pair = R"(
local p = param{ order = 1, cells = 9, on_plate = 0 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, low, high, cells)
  return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { low[1]*mm, low[2]*mm, low[3]*mm },
    size = { (high[1] - low[1])*mm, (high[2] - low[2])*mm, (high[3] - low[3])*mm }, cells = cells } }
end
local plate = block("plate", { -48, -30, 0 }, { 48, 30, 8 }, { p.cells, 5, 1 })
local left = block("left", { -30, -30, 8 }, { -0.25, 30, 40 }, { 3, 4, 3 })
local right = block("right", { 0.25, -30, 8 }, { 30, 30, 40 }, { 3, 4, 3 })
local function glue(block)
  return interface.bonded{ name = block.name .. " glue", between = { plate:face "zmax", block:face "zmin" }, points = p.on_plate == 1 and "first" or nil }
end
local a, b = glue(left), glue(right)
problem{ name = "pair", substructures = { plate, left, right }, interfaces = p.order == 1 and { a, b } or { b, a },
  supports = { support.fixed{ name = "floor", on = plate:face "zmin" } },
  steps = { step.static{ name = "part", loads = { load.force{ on = left:face "zmax", x = 100 }, load.force{ on = right:face "zmax", x = -100 } } } },
  outputs = { output.history{ name = "left", on = left:face "zmax", quantity = "displacement" },
              output.history{ name = "right", on = right:face "zmax", quantity = "displacement" } } }:run{}
)";

TEST(Bonds, side_by_side_hold_alike_in_whatever_order_they_are_declared) {
  for (const char* cells : {"9", "7"})
    for (const char* order : {"1", "2"}) {
      const DeckRun run = run_text(pair, {{"cells", cells}, {"order", order}})[0];
      const double left = run.column("left", "x").back(), right = run.column("right", "x").back();
      EXPECT_NEAR(left, -right, 1e-6 * std::abs(left)) << cells << " " << order;
      EXPECT_LT(left, 0.4e-6);
    }
}

// The plate's cells are so large that one row of its nodes lies under each block: the points are the block's. Asked for
// on the plate they are in a row, and that is said.
TEST(Bonds, on_large_cells_are_no_hinges_or_are_said_to_be) {
  const auto right = [](const Settings& settings) { return -run_text(pair, settings)[0].column("right", "x").back(); };
  const double fine = right({{"cells", "36"}});
  testing::internal::CaptureStderr();
  EXPECT_NEAR(right({{"cells", "6"}}), fine, 0.3 * fine);
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("in a row"), std::string::npos);
  testing::internal::CaptureStderr();
  EXPECT_GT(right({{"cells", "6"}, {"on_plate", "1"}}), 3.0 * fine);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("in a row, so that it gives way like a hinge"),
            std::string::npos);
}

}  // namespace
}  // namespace dygita::test::bonds_tests

// Measured faces through decks.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/log.hpp"
#include "decks/engine.hpp"

namespace dygita::test::scan_tests {
namespace {

// Two blocks, pressed together over a gap that a file or a function says; the scan lies in a plane turned by 90
// degrees.
std::string blocks(const std::string& gap) {
  return R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local lower = substructure{ name = "lower", material = steel, mesh = mesh.box{ size = { 10*mm, 8*mm, 5*mm }, cells = { 5, 4, 2 } } }
local upper = substructure{ name = "upper", material = steel, mesh = mesh.box{ size = { 10*mm, 8*mm, 5*mm }, cells = { 5, 4, 2 }, origin = { 0, 0, 5*mm } } }
)" + gap +
         R"(
local joint = interface.contact{ name = "joint", between = { lower:face "zmax", upper:face "zmin" }, gap = gap }
local base = support.fixed{ name = "base", on = lower:face "zmin" }
local press = step.static{ name = "press", increments = 3, loads = { load.displacement{ on = upper:face "zmax", x = 0, y = 0, z = -4*um } } }
problem{ name = "p", substructures = { lower, upper }, interfaces = { joint }, supports = { base }, steps = { press },
  outputs = { output.resultant{ name = "force", on = joint }, output.history{ name = "side", on = upper:face "xmax", quantity = "displacement" } } }:run{}
)";
}

TEST(Scan, is_the_function_that_it_was_taken_from) {
  const auto path = std::filesystem::temp_directory_path() / ("dygita_lap_" + std::to_string(getpid()) + ".csv");
  {
    std::ofstream file(path);
    file << "y [mm], minus x [mm], height [um]\n";
    for (double x = 0; x <= 10; x += 0.5)
      for (double y = 0; y <= 8; y += 0.5) file << y << ", " << -x << ", " << -(0.3 * x + 0.1 * y) << "\n";
  }
  // A plane, which smoothing leaves as it is.
  const DeckRun measured =
                    run_text(
                        blocks("local turned = frame{ origin = { 0, 0, 0 }, axis = { 0, 0, 1 }, x = { 0, 1, 0 } }\n"
                               "local scan = field.file{ file = \"" +
                               path.string() +
                               "\", frame = turned }\nlocal gap = function(x, y, z) return -scan(x, y, z) end"),
                        {}, 1)
                        .at(0),
                known =
                    run_text(blocks("local gap = function(x, y, z) return 0.3e-3 * x + 0.1e-3 * y end"), {}, 1).at(0);
  std::filesystem::remove(path);
  ASSERT_LT(known.column("force", "normal").back(), -100.0);
  EXPECT_NEAR(measured.column("force", "normal").back(), known.column("force", "normal").back(),
              1e-6 * std::abs(known.column("force", "normal").back()));
  EXPECT_NEAR(measured.column("side", "x").back(), known.column("side", "x").back(), 1e-13);
}

// A small block on the middle of a larger one; the scan is of the place where they meet, by the names of either face.
TEST(Scan, need_only_reach_where_the_faces_meet) {
  const auto path = std::filesystem::temp_directory_path() / ("dygita_small_" + std::to_string(getpid()) + ".csv");
  const auto run = [&](const std::string& gap, const std::string& between, double last) {
    std::ofstream file(path);
    file << "x [mm], y [mm], height [um]\n";
    for (double x = 10; x <= last; x += 0.5)
      for (double y = 12; y <= 20; y += 0.5) file << x << ", " << y << ", " << -(0.3 * x + 0.1 * y) << "\n";
    file.close();
    return run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local lower = substructure{ name = "lower", material = steel, mesh = mesh.box{ size = { 30*mm, 32*mm, 5*mm }, cells = { 7, 7, 2 } } }
local upper = substructure{ name = "upper", material = steel, mesh = mesh.box{ size = { 10*mm, 8*mm, 5*mm }, cells = { 5, 4, 2 }, origin = { 10*mm, 12*mm, 5*mm } } }
local scan = field.file{ file = ")" +
                        path.string() +
                        R"(" }
local joint = interface.contact{ name = "joint", between = )" +
                        between + ", gap = " + gap + R"( }
local base = support.fixed{ name = "base", on = lower:face "zmin" }
local press = step.static{ name = "press", increments = 3, loads = { load.displacement{ on = upper:face "zmax", x = 0, y = 0, z = -20*um } } }
problem{ name = "p", substructures = { lower, upper }, interfaces = { joint }, supports = { base }, steps = { press }, outputs = { output.resultant{ name = "force", on = joint } } }:run{}
)",
                    {}, 1)
        .at(0)
        .column("force", "normal")
        .back();
  };
  const std::string scanned = "function(x, y, z) return -scan(x, y, z) end";
  const double known =
      run("function(x, y, z) return 0.3e-3 * x + 0.1e-3 * y end", R"({ lower:face "zmax", upper:face "zmin" })", 20);
  ASSERT_LT(known, -100.0);
  for (const char* between :
       {R"({ lower:face "zmax", upper:face "zmin" })", R"({ upper:face "zmin", lower:face "zmax" })"})
    EXPECT_NEAR(std::abs(run(scanned, between, 20)), std::abs(known), 1e-6 * std::abs(known));
  for (const auto& [last, expected] :
       {std::pair(15.0, "interface 'joint': the scan in 'gap' has no point near ("), std::pair(9.0, "the scan '")})
    try {
      run(scanned, R"({ lower:face "zmax", upper:face "zmin" })", last);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  std::filesystem::remove(path);
}

TEST(Scan, is_doubted_by_line_where_a_height_stands_alone_and_refused_where_a_place_has_two) {
  const auto path = std::filesystem::temp_directory_path() / ("dygita_spike_" + std::to_string(getpid()) + ".csv");
  const auto run = [&](const std::string& last) {
    std::ofstream file(path);
    file << "x [mm], y [mm], height [um]\n";
    for (int x = 0; x <= 10; ++x)
      for (int y = 0; y <= 8; ++y) file << x << ", " << y << ", " << (x == 6 && y == 2 ? 247.0 : -0.5 * x) << "\n";
    file << last;
    file.close();
    run_text(blocks("local scan = field.file{ file = \"" + path.string() +
                    "\" }\nlocal gap = function(x, y, z) return 1*mm - scan(x, y, z) end"),
             {}, 1);
  };
  take_warnings();
  testing::internal::CaptureStderr();
  run("");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("the height in line 58, 247 um at (6, 2) mm, is 250 um off the plane"), std::string::npos)
      << said;
  try {
    run("3, 4, -1\n");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(":101: the height at (3, 4) mm is -1 um here and -1.5 um in line 33"),
              std::string::npos)
        << error.what();
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace dygita::test::scan_tests

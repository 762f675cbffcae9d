// Layups in one cell, against classical lamination theory: coupled ones too.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "decks/engine.hpp"

namespace dygita::test::laminate_tests {
namespace {

constexpr double e1 = 140e9, e2 = 10e9, nu12 = 0.3, g12 = 5e9;  // Pa

const std::string plies = R"(
local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 9*GPa, nu12 = 0.3, nu13 = 0.25, nu23 = 0.45,
                                  g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600,
  strength = { xt = 1500*MPa, xc = 1200*MPa, yt = 50*MPa, yc = 200*MPa, zt = 50*MPa, zc = 200*MPa, s12 = 70*MPa, s13 = 70*MPa, s23 = 60*MPa } }
local function stack(angles, thickness)
  local list = {}
  for i, angle in ipairs(angles) do list[i] = { material = ply, thickness = thickness / #angles, angle = angle * deg } end
  return material.laminate{ name = "stack", plies = list }
end
local stacks = { { 0, 90 }, { 30, -30 }, { 0, 45, -45, 90 }, { 0, 90, 90, 0 }, { 20, 20, 70 } }
local function corner(part, x, y, z) return part:where(function(a, b, c) return near(a, x) and near(b, y) and near(c, z) end) end
local function held(part, l, w)
  return { load.displacement{ on = corner(part, 0, 0, 0), x = 0, y = 0, z = 0 }, load.displacement{ on = corner(part, l, 0, 0), y = 0, z = 0 },
           load.displacement{ on = corner(part, 0, w, 0), z = 0 } }
end
)";
const std::vector<std::vector<double>> stacks = {{0, 90}, {30, -30}, {0, 45, -45, 90}, {0, 90, 90, 0}, {20, 20, 70}};

// Reduced stiffness of a ply at an angle: stresses xx yy xy of strains in the plane.
Mat3 reduced(double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const double nu21 = nu12 * e2 / e1, k = 1 - nu12 * nu21;
  Mat3 q;
  q << e1 / k, nu12 * e2 / k, 0, nu12 * e2 / k, e2 / k, 0, 0, 0, g12;
  Mat3 to_own;  // engineering strains
  to_own << c * c, s * s, s * c, s * s, c * c, -s * c, -2 * s * c, 2 * s * c, c * c - s * s;
  return to_own.transpose() * q * to_own;
}

struct Plate {
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();  // A B; B D
  Plate(const std::vector<double>& angles, double h) {
    const double t = h / static_cast<double>(angles.size());
    for (size_t i = 0; i < angles.size(); ++i) {
      const double low = -h / 2 + t * static_cast<double>(i), high = low + t;
      const Mat3 q = reduced(angles[i]);
      stiffness.topLeftCorner<3, 3>() += q * t;
      stiffness.topRightCorner<3, 3>() += q * (high * high - low * low) / 2;
      stiffness.bottomLeftCorner<3, 3>() += q * (high * high - low * low) / 2;
      stiffness.bottomRightCorner<3, 3>() += q * (std::pow(high, 3) - std::pow(low, 3)) / 3;
    }
  }
  // Strains of the middle and curvatures of forces and moments per length.
  Eigen::Matrix<double, 6, 1> strains(double nx, double mx) const {
    Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
    load[0] = nx, load[3] = mx;
    return stiffness.fullPivLu().solve(load);
  }
};

constexpr double l = 40e-3, w = 20e-3, h = 2e-3;  // m

// A strip under a stress along x at its ends, or a moment about y.
DeckRun strip(int stack, const std::string& load, int order, const char* solver) {
  return run_text(plies + R"(
local p = param{ stack = 1, order = 1 }
local l, w, h = 40*mm, 20*mm, 2*mm
local strip = substructure{ name = "strip", material = stack(stacks[p.stack], h), mesh = mesh.box{ size = { l, w, h }, cells = { 8, 4, 1 }, order = p.order } }
local ends = { strip:face "xmin", strip:face "xmax" }
local pull = step.static{ name = "pull", loads = { held(strip, l, w), )" +
                      load + R"( } }
local outputs = {}
local function at(name, x, y, z) outputs[#outputs + 1] = output.history{ name = name, on = corner(strip, x, y, z), quantity = "displacement" } end
at("000", 0, 0, 0); at("l00", l, 0, 0); at("0w0", 0, w, 0); at("lw0", l, w, 0); at("m00", l/2, 0, 0); at("00h", 0, 0, h); at("l0h", l, 0, h); at("0wh", 0, w, h)
for ply = 1, #stacks[p.stack] do
  outputs[#outputs + 1] = output.history{ name = "ply" .. ply, on = corner(strip, l/2, w/2, h), ply = ply, quantity = "material_stress" }
end
problem{ name = "p", substructures = { strip }, steps = { pull }, outputs = outputs }:run{}
)",
                  {{"stack", std::to_string(stack + 1)}, {"order", std::to_string(order)}}, 1, solver)
      .at(0);
}

// What does not depend on where the strip lies, and the stress of each ply along its axes, in the middle.
void compare(const DeckRun& run, const std::vector<double>& angles, const Eigen::Matrix<double, 6, 1>& strains,
             double share) {
  const auto u = [&](const char* at, const char* axis) { return run.column(at, axis).back(); };
  const Vec3 low = strains.head<3>() - h / 2 * strains.tail<3>(), high = strains.head<3>() + h / 2 * strains.tail<3>();
  const double strain =
      share * strains.head<3>().cwiseAbs().maxCoeff() + share * h * strains.tail<3>().cwiseAbs().maxCoeff();
  EXPECT_NEAR((u("l00", "x") - u("000", "x")) / l, low[0], strain);
  EXPECT_NEAR((u("0w0", "y") - u("000", "y")) / w, low[1], strain);
  EXPECT_NEAR((u("l00", "y") - u("000", "y")) / l + (u("0w0", "x") - u("000", "x")) / w, low[2], strain);
  EXPECT_NEAR((u("l0h", "x") - u("00h", "x")) / l, high[0], strain);
  EXPECT_NEAR((u("0wh", "y") - u("00h", "y")) / w, high[1], strain);
  EXPECT_NEAR((u("l0h", "y") - u("00h", "y")) / l + (u("0wh", "x") - u("00h", "x")) / w, high[2], strain);
  const Vec3 curvature = strains.tail<3>();
  EXPECT_NEAR((u("m00", "z") - 0.5 * (u("000", "z") + u("l00", "z"))) * 8 / (l * l), curvature[0], strain / h);
  EXPECT_NEAR((u("l00", "z") + u("0w0", "z") - u("000", "z") - u("lw0", "z")) * 2 / (l * w), curvature[2], strain / h);
  const auto n = static_cast<double>(angles.size());
  for (size_t i = 0; i < angles.size(); ++i) {
    const double middle = h * ((static_cast<double>(i) + 0.5) / n - 0.5), angle = angles[i] * std::numbers::pi / 180,
                 c = std::cos(angle), s = std::sin(angle);
    const Vec3 of_ply = reduced(angles[i]) * (strains.head<3>() + middle * curvature);
    const std::string name = "ply" + std::to_string(i + 1);
    const double close = 2 * share * e1 * (strain / share);
    EXPECT_NEAR(run.column(name, "s11").back(), c * c * of_ply[0] + s * s * of_ply[1] + 2 * s * c * of_ply[2], close);
    EXPECT_NEAR(run.column(name, "s22").back(), s * s * of_ply[0] + c * c * of_ply[1] - 2 * s * c * of_ply[2], close);
    EXPECT_NEAR(run.column(name, "s12").back(), s * c * (of_ply[1] - of_ply[0]) + (c * c - s * s) * of_ply[2], close);
    EXPECT_NEAR(run.column(name, "s33").back(), 0.0, close);
  }
}

TEST(Laminate, pulled_stretches_bends_and_twists_as_lamination_theory_says) {
  for (size_t stack = 0; stack < stacks.size(); ++stack) {
    SCOPED_TRACE(stack);
    const char* solver = stack == 1 ? "monolithic" : "latin";
    const DeckRun run =
        strip(static_cast<int>(stack),
              "load.traction{ on = ends[2], x = 100*MPa }, load.traction{ on = ends[1], x = -100*MPa }", 1, solver);
    compare(run, stacks[stack], Plate(stacks[stack], h).strains(100e6 * h, 0.0), 1e-6);
  }
  // [0/90] under tension curves towards the stiff side; by how much is known.
  EXPECT_GT(std::abs(Plate(stacks[0], h).strains(100e6 * h, 0.0)[3]), 0.1);
}

TEST(Laminate, bent_curves_and_stretches_as_lamination_theory_says) {
  for (size_t stack = 0; stack < stacks.size(); ++stack) {
    SCOPED_TRACE(stack);
    const DeckRun run = strip(static_cast<int>(stack),
                              "load.torque{ on = ends[2], axis = { 0, 1, 0 }, history = 0.5 }, load.torque{ on = "
                              "ends[1], axis = { 0, 1, 0 }, history = -0.5 }",
                              1, "latin");
    compare(run, stacks[stack], Plate(stacks[stack], h).strains(0.0, 0.5 / w), 1e-6);
  }
}

// A cantilever of two sheets of aluminium on foam, 20 mm wide, under 22 N/m at its end.
DeckRun sandwich(double length, bool is_one_cell) {
  return run_text(R"(
local p = param{ length = 200, one = 1 }
local al = material.elastic{ name = "al", young = 70*GPa, poisson = 0.3, density = 2700 }
local foam = material.elastic{ name = "foam", young = 65*MPa, poisson = 0.3, density = 80 }
local l, parts, joints, supports, loads, z = p.length*mm, {}, {}, {}, {}, 0
local function add(material, t, n)
  parts[#parts + 1] = substructure{ name = "layer" .. #parts, material = material, mesh = mesh.box{ origin = { 0, 0, z }, size = { l, 20*mm, t }, cells = { 40, 2, n } } }
  z = z + t
end
if p.one == 1 then
  add(material.laminate{ name = "sandwich", plies = { { material = al, thickness = 1*mm }, { material = foam, thickness = 20*mm }, { material = al, thickness = 1*mm } } }, 22*mm, 1)
else
  add(al, 1*mm, 1) add(foam, 20*mm, 4) add(al, 1*mm, 1)
  for i = 1, 2 do joints[i] = interface.bonded{ name = "glue" .. i, between = { parts[i]:face "zmax", parts[i + 1]:face "zmin" } } end
end
for i, part in ipairs(parts) do
  supports[i] = support.fixed{ name = "root" .. i, on = part:face "xmin" }
  loads[i] = load.traction{ on = part:face "xmax", z = 1*kPa }
end
problem{ name = "p", substructures = parts, interfaces = joints, supports = supports, steps = { step.static{ name = "pull", loads = loads } },
  outputs = { output.history{ name = "tip", on = parts[1]:face "xmax", quantity = "displacement" } } }:run{}
)",
                  {{"length", std::to_string(length)}, {"one", is_one_cell ? "1" : "0"}}, 1)
      .at(0);
}

// D = E t d^2 / 2, shear G d^2 / c; one cell has G h^2 / c.
TEST(Laminate, of_a_thick_core_in_one_cell_is_told_to_be_too_stiff) {
  const auto said_of = [](double length, bool is_one_cell) {
    testing::internal::CaptureStderr();
    sandwich(length, is_one_cell);
    return testing::internal::GetCapturedStderr();
  };
  const std::string said = said_of(200, true);
  EXPECT_NE(
      said.find("substructure 'layer0': layup 'sandwich' is one cell across, which makes it up to 7.7 % too stiff "
                "where it bends over its 200 mm: shear across the plies is 88 % of the deflection"),
      std::string::npos)
      << said;
  EXPECT_EQ(said_of(200, false).find("too stiff"), std::string::npos);
  EXPECT_EQ(said_of(1000, true).find("too stiff"), std::string::npos);
  // What is told is so: against a core of its own.
  const double one = sandwich(200, true).column("tip", "z").back(),
               own = sandwich(200, false).column("tip", "z").back();
  EXPECT_GT(own / one, 1.03);
  EXPECT_LT(own / one, 1.08);
}

}  // namespace
}  // namespace dygita::test::laminate_tests

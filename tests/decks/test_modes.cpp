// Natural modes of assemblies against closed forms, against themselves turned and cut, and what they add up to.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "decks/engine.hpp"
#include "reduction/normal_modes.hpp"

namespace dygita::test::modes_tests {
namespace {

DeckRun modes_of(const std::string& text, const Settings& settings = {}) { return run_text(text, settings, 1).at(0); }

double value_of(const DeckRun& run, const std::string& name) { return run.findings("m").values.at(name); }

std::vector<double> frequencies(const DeckRun& run) { return run.column("m", "frequency"); }

void expect_same_frequencies(const DeckRun& a, const DeckRun& b, double share) {
  const std::vector<double> f = frequencies(a), g = frequencies(b);
  ASSERT_EQ(f.size(), g.size());
  for (size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], g[i], share * f[i]) << i;
}

// Timoshenko's beam of length 1, as a system of first order of deflection, turn, moment and shear, harmonic: the
// determinant that is zero at its natural frequencies.
struct Timoshenko {
  double side, young = 210e9, density = 7850.0;  // square, Poisson's ratio 0: shear factor 5/6

  double determinant(double frequency, bool is_clamped) const {
    const double area = side * side, second = std::pow(side, 4) / 12, omega = 2 * std::numbers::pi * frequency,
                 shear = 5.0 / 6.0 * 0.5 * young * area, bending = young * second;
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a(0, 1) = 1.0;
    a(0, 3) = 1.0 / shear;
    a(1, 2) = 1.0 / bending;
    a(2, 1) = -density * second * omega * omega;
    a(2, 3) = -1.0;
    a(3, 0) = -density * area * omega * omega;
    // The exponential by powers of a short piece.
    constexpr int halvings = 10;
    const Eigen::Matrix4d piece = a / std::pow(2.0, halvings);
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity(), whole = term;
    for (int k = 1; k < 12; ++k) whole += term = term * piece / k;
    for (int k = 0; k < halvings; ++k) whole = whole * whole;
    return is_clamped ? whole.block<2, 2>(2, 2).determinant() : whole.block<2, 2>(2, 0).determinant();
  }

  std::vector<double> bending_frequencies(int n, bool is_clamped) const {
    std::vector<double> found;
    for (double f = 5.0; static_cast<int>(found.size()) < n; f += 1.0) {
      double low = f, high = f + 1.0;
      if (determinant(low, is_clamped) * determinant(high, is_clamped) > 0.0) continue;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (determinant(low, is_clamped) * determinant(middle, is_clamped) > 0.0 ? low : high) = middle;
      }
      found.push_back(low);
    }
    return found;
  }
};

std::string beam(const std::string& supports) {
  return R"(
local p = param{ n = 10, across = 2, order = 2, turn = 0, pieces = 1, modes = 16 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7850 }
local bar = substructure{ name = "bar", material = steel, place = { rotate = { axis = { 1, 2, 3 }, angle = p.turn } },
  mesh = mesh.box{ size = { 1, 0.08, 0.08 }, cells = { math.tointeger(p.n), math.tointeger(p.across), math.tointeger(p.across) }, order = math.tointeger(p.order) } }
problem{ name = "beam", substructures = { bar }, )" +
         supports + R"( steps = { step.static{ name = "rest" } },
  solver = solver.latin{ pieces = p.pieces > 1 and math.tointeger(p.pieces) or nil },
  outputs = { output.modes{ name = "m", n = math.tointeger(p.modes) } } }:run{}
)";
}
const std::string clamp = R"(supports = { support.fixed{ name = "wall", on = bar:face "xmin" } },)";

TEST(Modes, of_a_free_beam_are_six_at_rest_and_Timoshenkos_in_pairs) {
  const std::vector<double> exact = Timoshenko{0.08}.bending_frequencies(2, false);
  const DeckRun coarse = modes_of(beam("")), fine = modes_of(beam(""), {{"n", "20"}});
  EXPECT_EQ(value_of(fine, "free_motions"), 6);
  const std::vector<double> f = frequencies(fine), g = frequencies(coarse);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(f[i], 0.0) << i;
  for (int mode = 0; mode < 2; ++mode)
    for (int twin = 0; twin < 2; ++twin) {
      const double of_fine = f[6 + 2 * mode + twin], of_coarse = g[6 + 2 * mode + twin];
      std::cout << "free beam, bending " << mode + 1 << ": " << of_coarse << " " << of_fine << " Hz, exact "
                << exact[mode] << "\n";
      EXPECT_NEAR(of_fine, exact[mode], 5e-4 * exact[mode]) << mode;
      EXPECT_LT(std::abs(of_fine - exact[mode]), std::abs(of_coarse - exact[mode]) + 2e-4 * exact[mode]);
    }
  EXPECT_NEAR(f[6], f[7], 1e-8 * f[6]);
  EXPECT_NEAR(f[8], f[9], 1e-8 * f[8]);
}

TEST(Modes, of_a_clamped_beam_are_Timoshenkos_and_have_its_mass) {
  const std::vector<double> exact = Timoshenko{0.08}.bending_frequencies(3, true);
  const DeckRun run = modes_of(beam(clamp), {{"n", "20"}});
  EXPECT_EQ(value_of(run, "free_motions"), 0);
  const std::vector<double> f = frequencies(run);
  for (int mode = 0; mode < 2; ++mode)
    for (int twin = 0; twin < 2; ++twin)
      EXPECT_NEAR(f[2 * mode + twin], exact[mode], 5e-4 * exact[mode]) << mode << " " << f[2 * mode + twin];
  // Along the axis a quarter of a wave, with 8 / pi^2 of the mass.
  const double wave = std::sqrt(210e9 / 7850), mass = 7850 * 0.08 * 0.08;
  const std::vector<double>& along = run.column("m", "effective_x");
  const size_t axial = std::max_element(along.begin(), along.end()) - along.begin();
  EXPECT_NEAR(f[axial], 0.25 * wave, 1e-4 * 0.25 * wave);
  EXPECT_NEAR(along[axial], 8 / std::pow(std::numbers::pi, 2) * mass, 1e-3 * mass);
  // It moves as the sine of a quarter of a wave: half of the mass where the end moves by one.
  EXPECT_NEAR(run.column("m", "generalised_mass")[axial], 0.5 * mass, 1e-3 * mass);
  EXPECT_NEAR(run.column("m", "participation_x")[axial], 4 / std::numbers::pi, 1e-3);
  // Euler and Bernoulli's first mode has 0.6131 of the mass; shear and rotary inertia move it by less than a hundredth.
  // Of the two of one frequency the first is told along y, the other along z.
  EXPECT_NEAR(run.column("m", "effective_y")[0], 0.6131 * mass, 0.01 * mass);
  EXPECT_NEAR(run.column("m", "effective_z")[1], 0.6131 * mass, 0.01 * mass);
  EXPECT_LT(run.column("m", "effective_z")[0] + run.column("m", "effective_y")[1], 1e-9 * mass);
}

TEST(Modes, warn_of_lumped_masses_where_they_are_lumped) {
  const auto said = [](const char* order) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    modes_of(beam(clamp), {{"across", "1"}, {"order", order}, {"modes", "1"}});
    return testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  };
  EXPECT_NE(said("1").find("moment of inertia of the material"), std::string::npos);
  EXPECT_EQ(said("2").find("moment of inertia of the material"), std::string::npos);
}

TEST(Modes, of_lumped_cells_converge_with_the_square_of_their_size) {
  const double exact = Timoshenko{0.08}.bending_frequencies(1, true)[0];
  double before = 0.0;
  for (const int n : {12, 24, 48}) {
    const Settings cells = {
        {"n", std::to_string(n)}, {"across", std::to_string(n / 6)}, {"order", "1"}, {"modes", "2"}};
    const double error = frequencies(modes_of(beam(clamp), cells))[0] / exact - 1.0;
    std::cout << n << " cells of order one: " << 100 * error << " %\n";
    if (before != 0.0) {
      EXPECT_LT(std::abs(error), 0.35 * std::abs(before));
    }
    before = error;
  }
  EXPECT_LT(std::abs(before), 5e-3);
}

TEST(Modes, do_not_depend_on_how_the_beam_lies_or_is_cut) {
  for (const std::string& supports : {std::string(), clamp}) {
    const DeckRun one = modes_of(beam(supports));
    expect_same_frequencies(one, modes_of(beam(supports), {{"turn", "0.7"}}), 1e-9);
    expect_same_frequencies(one, modes_of(beam(supports), {{"pieces", "3"}}), 1e-12);
  }
}

std::string small_box(const std::string& supports, const std::string& output) {
  return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7850 }
local box = substructure{ name = "box", material = steel, place = { 3, -2, 1 }, mesh = mesh.box{ size = { 30*mm, 20*mm, 10*mm }, cells = { 2, 2, 2 } } }
problem{ name = "small", substructures = { box }, )" +
         supports + " steps = { step.static{ name = \"rest\" } }, outputs = { output.modes{ name = \"m\", " + output +
         " } } }:run{}\n";
}

TEST(Modes, all_of_a_free_body_have_all_of_its_mass_and_inertia) {
  const DeckRun run = modes_of(small_box("", "n = 81"));
  EXPECT_EQ(run.table("m").n_rows(), 81);
  const double mass = 7850 * 30e-3 * 20e-3 * 10e-3;
  EXPECT_NEAR(value_of(run, "mass"), mass, 1e-12 * mass);
  // Lumped in three layers along y: shares 1/4, 1/2, 1/4 of the mass.
  EXPECT_NEAR(value_of(run, "inertia_x"), 0.5 * mass * (10e-3 * 10e-3 + 5e-3 * 5e-3), 1e-9 * mass);
  for (const char* direction : {"x", "y", "z", "about_x", "about_y", "about_z"})
    EXPECT_NEAR(value_of(run, std::string("share_") + direction), 1.0, 1e-9) << direction;
  // The six at rest have it all.
  for (int m = 6; m < 81; ++m) EXPECT_LT(run.column("m", "effective_x")[m], 1e-12 * mass) << m;
  EXPECT_NEAR(run.column("m", "effective_x")[0], mass, 1e-9 * mass);
  EXPECT_NEAR(run.column("m", "effective_y")[1], mass, 1e-9 * mass);
}

TEST(Modes, all_of_a_held_body_have_the_mass_that_is_not_held) {
  const DeckRun run =
      modes_of(small_box("supports = { support.fixed{ name = \"s\", on = box:face \"xmin\" } },", "n = 54"));
  EXPECT_EQ(value_of(run, "free_motions"), 0);
  for (const char* direction : {"x", "y", "z"})
    EXPECT_NEAR(value_of(run, std::string("share_") + direction), 0.75, 1e-9) << direction;
}

TEST(Modes, up_to_a_frequency_are_all_there_are) {
  const DeckRun all = modes_of(small_box("", "n = 81"));
  const double limit = 0.5 * (frequencies(all)[20] + frequencies(all)[21]);
  const DeckRun some = modes_of(small_box("", "up_to = " + std::to_string(limit)));
  ASSERT_EQ(some.table("m").n_rows(), 21);
  for (size_t i = 0; i < 21; ++i) EXPECT_NEAR(frequencies(some)[i], frequencies(all)[i], 1e-9 * frequencies(all)[20]);
}

// Two stiff masses on light springs in a row, kept to one direction by planes of symmetry.
TEST(Modes, of_two_masses_on_springs_are_the_known_ones) {
  const DeckRun run = modes_of(R"(
local stiff = material.elastic{ name = "stiff", young = 2000*GPa, poisson = 0, density = 80000, damping = { mass = 3, stiffness = 2e-6 } }
local light = material.elastic{ name = "light", young = 2*MPa, poisson = 0, density = 10 }
local function box(name, x, length, material)
  return substructure{ name = name, material = material, mesh = mesh.box{ origin = { x, 0, 0 }, size = { length, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
end
local k_1, m_1 = box("k_1", 0, 10*mm, light), box("m_1", 10*mm, 20*mm, stiff)
local k_2, m_2 = box("k_2", 30*mm, 20*mm, light), box("m_2", 50*mm, 10*mm, stiff)
local parts = { k_1, m_1, k_2, m_2 }
local ties, sides = {}, {}
for i = 1, 3 do ties[i] = interface.bonded{ name = "tie " .. i, between = { parts[i]:face "xmax", parts[i + 1]:face "xmin" } } end
for i, part in ipairs(parts) do
  sides[#sides + 1] = support.symmetry{ name = "y " .. i, on = { part:face "ymin", part:face "ymax" } }
  sides[#sides + 1] = support.symmetry{ name = "z " .. i, on = { part:face "zmin", part:face "zmax" } }
end
sides[#sides + 1] = support.fixed{ name = "ground", on = k_1:face "xmin" }
problem{ name = "chain", substructures = parts, interfaces = ties, supports = sides, steps = { step.static{ name = "rest" } },
  outputs = { output.modes{ name = "m", n = 2 } } }:run{}
)");
  // Half of a spring's mass is at each of its ends.
  const double k_1 = 2e6 * 1e-4 / 10e-3, k_2 = 2e6 * 1e-4 / 20e-3, m_1 = 1e-4 * (80000 * 20e-3 + 10 * 15e-3),
               m_2 = 1e-4 * (80000 * 10e-3 + 10 * 10e-3);
  Eigen::Matrix2d k, m;
  k << k_1 + k_2, -k_2, -k_2, k_2;
  m << m_1, 0, 0, m_2;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> exact(k, m);
  for (int i = 0; i < 2; ++i) {
    const double omega = std::sqrt(exact.eigenvalues()[i]), momentum = exact.eigenvectors().col(i).dot(m.diagonal());
    EXPECT_NEAR(frequencies(run)[i], omega / (2 * std::numbers::pi), 1e-5 * frequencies(run)[i]) << i;
    EXPECT_NEAR(run.column("m", "effective_x")[i], momentum * momentum, 1e-4 * (m_1 + m_2)) << i;
    // Stiff bodies store nothing, so that of their damping the mass's share alone acts.
    EXPECT_NEAR(run.column("m", "damping")[i], 3 / (2 * omega), 3e-4 * 3 / (2 * omega)) << i;
  }
}

TEST(Modes, have_the_damping_ratio_of_their_material) {
  const DeckRun run = modes_of(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7850, damping = { mass = 40, stiffness = 3e-8 } }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 60*mm, 10*mm, 10*mm }, cells = { 6, 2, 2 } } }
problem{ name = "damped", substructures = { box }, steps = { step.static{ name = "rest" } }, outputs = { output.modes{ name = "m", n = 12 } } }:run{}
)");
  for (size_t i = 0; i < 12; ++i) {
    const double omega = 2 * std::numbers::pi * frequencies(run)[i], ratio = run.column("m", "damping")[i];
    if (i < 6)
      EXPECT_TRUE(std::isnan(ratio)) << i;
    else
      EXPECT_NEAR(ratio, 40 / (2 * omega) + 3e-8 * omega / 2, 1e-7 * ratio) << i;
  }
}

// A mass between a light spring and a damper: zeta = c / (2 m omega).
TEST(Modes, have_the_damping_of_a_damper) {
  const DeckRun run = modes_of(R"(
local stiff = material.elastic{ name = "stiff", young = 2000*GPa, poisson = 0, density = 80000 }
local light = material.elastic{ name = "light", young = 2*MPa, poisson = 0, density = 10 }
local function box(name, x, length, material)
  return substructure{ name = name, material = material, mesh = mesh.box{ origin = { x, 0, 0 }, size = { length, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
end
local spring, body, post = box("spring", 0, 10*mm, light), box("body", 10*mm, 20*mm, stiff), box("post", 30*mm, 10*mm, stiff)
local parts, sides = { spring, body, post }, {}
for i, part in ipairs(parts) do
  sides[#sides + 1] = support.symmetry{ name = "y " .. i, on = { part:face "ymin", part:face "ymax" } }
  sides[#sides + 1] = support.symmetry{ name = "z " .. i, on = { part:face "zmin", part:face "zmax" } }
end
sides[#sides + 1] = support.fixed{ name = "ground", on = { spring:face "xmin", post:face "xmax" } }
problem{ name = "damper", substructures = parts, supports = sides, steps = { step.static{ name = "rest" } }, interfaces = {
    interface.bonded{ name = "tie", between = { spring:face "xmax", body:face "xmin" } },
    interface.viscous{ name = "damper", between = { body:face "xmax", post:face "xmin" }, normal = 1e4 } },
  outputs = { output.modes{ name = "m", n = 1 } } }:run{}
)");
  const double k = 2e6 * 1e-4 / 10e-3, m = 1e-4 * (80000 * 20e-3 + 10 * 5e-3), omega = std::sqrt(k / m),
               ratio = 1e4 * 1e-4 / (2 * m * omega);
  EXPECT_NEAR(frequencies(run)[0], omega / (2 * std::numbers::pi), 1e-5 * frequencies(run)[0]);
  EXPECT_NEAR(run.column("m", "damping")[0], ratio, 1e-4 * ratio);
}

// Two blocks, one on the other, of meshes that match or not, free in space.
std::string blocks(const std::string& joint, const std::string& more = "steps = { step.static{ name = 'rest' } },",
                   const std::string& output = "n = 20") {
  return R"(
local p = param{ turn = 0, unlike = 0 }
local alu = material.elastic{ name = "alu", young = 70*GPa, poisson = 0.3, density = 2700 }
local turned = { rotate = { axis = { 1, 2, 3 }, angle = p.turn } }
local lower = substructure{ name = "lower", material = alu, place = turned, mesh = mesh.box{ size = { 40*mm, 20*mm, 10*mm }, cells = { 8, 4, 2 } } }
local upper = substructure{ name = "upper", material = alu, place = turned, mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 40*mm, 20*mm, 10*mm },
  cells = p.unlike == 1 and { 6, 3, 2 } or { 8, 4, 2 } } }
local joint = interface.)" +
         joint + R"(
problem{ name = "blocks", substructures = { lower, upper }, interfaces = { joint }, )" +
         more + " outputs = { output.modes{ name = \"m\", " + output + " } } }:run{}\n";
}
const std::string faces = "name = 'joint', between = { lower:face 'zmax', upper:face 'zmin' }";

TEST(Modes, of_one_body_of_two_are_those_of_one) {
  const DeckRun two = modes_of(blocks("bonded{ " + faces + " }"));
  const DeckRun one = modes_of(R"(
local alu = material.elastic{ name = "alu", young = 70*GPa, poisson = 0.3, density = 2700 }
local block = substructure{ name = "block", material = alu, mesh = mesh.box{ size = { 40*mm, 20*mm, 20*mm }, cells = { 8, 4, 4 } } }
problem{ name = "block", substructures = { block }, steps = { step.static{ name = "rest" } }, outputs = { output.modes{ name = "m", n = 20 } } }:run{}
)");
  expect_same_frequencies(one, two, 1e-9);
}

TEST(Modes, of_faces_that_do_not_match_are_free_to_move_as_a_whole_however_they_lie) {
  const std::string text = blocks("bonded{ " + faces + " }");
  const DeckRun flat = modes_of(text, {{"unlike", "1"}}), turned = modes_of(text, {{"unlike", "1"}, {"turn", "0.7"}});
  EXPECT_EQ(value_of(flat, "free_motions"), 6);
  EXPECT_EQ(value_of(turned, "free_motions"), 6);
  expect_same_frequencies(flat, turned, 1e-9);
  const DeckRun alike = modes_of(text);
  for (size_t i = 6; i < 12; ++i)
    EXPECT_NEAR(frequencies(flat)[i], frequencies(alike)[i], 0.02 * frequencies(alike)[i]) << i;
}

// A rigid body has no stiffness by which the assembly could be held while its modes are sought. One of a hundred tons
// at the end of a beam is a clamp.
TEST(Modes, of_a_free_beam_with_a_rigid_body_are_those_of_a_clamped_one_where_that_is_heavy) {
  const std::string text = R"(
local p = param{ turn = 0, mass = 1e5, rigid = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7850 }
local axis, v = { 1/14^0.5, 2/14^0.5, 3/14^0.5 }, { 0, 0.04, 0.04 }
local c, s = math.cos(p.turn), math.sin(p.turn)
local along = axis[1]*v[1] + axis[2]*v[2] + axis[3]*v[3]
local centre = {}
for i = 1, 3 do
  local j, k = i % 3 + 1, (i + 1) % 3 + 1
  centre[i] = c*v[i] + s*(axis[j]*v[k] - axis[k]*v[j]) + (1 - c)*along*axis[i]
end
local bar = substructure{ name = "bar", material = steel, place = { rotate = { axis = axis, angle = p.turn } },
  mesh = mesh.box{ size = { 1, 0.08, 0.08 }, cells = { 20, 2, 2 }, order = 2 } }
local block = mass.point{ name = "block", on = bar:face "xmin", mass = p.mass, inertia = { p.mass, p.mass, p.mass }, at = centre,
  motion = p.rigid == 1 and "rigid" or "mean" }
problem{ name = "beam", substructures = { bar, block }, steps = { step.static{ name = "rest" } }, outputs = { output.modes{ name = "m", n = 12 } } }:run{}
)";
  const std::vector<double> exact = Timoshenko{0.08}.bending_frequencies(2, true);
  for (const std::string rigid : {"0", "1"})
    for (const std::string mass : {"1e5", "10"}) {
      SCOPED_TRACE(rigid + mass);
      const Settings settings = {{"rigid", rigid}, {"mass", mass}};
      const DeckRun run = modes_of(text, settings);
      ASSERT_EQ(value_of(run, "free_motions"), 6);
      for (const std::string turn : {"0.4", "1.3"}) {
        Settings turned = settings;
        turned.emplace_back("turn", turn);
        expect_same_frequencies(run, modes_of(text, turned), 1e-8);
      }
      for (int mode = 0; mode < 2 && mass == "1e5"; ++mode)
        EXPECT_NEAR(frequencies(run)[6 + 2 * mode], exact[mode], 2e-3 * exact[mode]) << mode;
    }
}

// Of sums over faces that do not match, rows of which planes of symmetry hold nearly all nodes are rounding.
TEST(Modes, of_unlike_blocks_on_planes_of_symmetry_have_the_motions_along_these_at_rest) {
  const std::string text = R"(
local p = param{ planes = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local one = substructure{ name = "one", material = steel, mesh = mesh.box{ size = { 0.1, 0.06, 0.02 }, cells = { 4, 4, 2 } } }
local two = substructure{ name = "two", material = steel, mesh = mesh.box{ origin = { 0.1, 0, 0 }, size = { 0.05, 0.06, 0.02 }, cells = { 3, 5, 2 } } }
local glue = interface.bonded{ name = "glue", between = { one:face "xmax", two:face "xmin" } }
local z = support.symmetry{ name = "z", on = { one:face "zmin", two:face "zmin" } }
local y = support.symmetry{ name = "y", on = { one:face "ymin", two:face "ymin" } }
problem{ name = "blocks", substructures = { one, two }, interfaces = { glue }, supports = { z, p.planes == 2 and y or nil }, steps = { step.static{ name = "rest" } },
  outputs = { output.modes{ name = "m", n = 8 } } }:run{}
)";
  for (const auto& [planes, n_free] : {std::pair{"1", 3}, {"2", 1}}) {
    const DeckRun run = modes_of(text, {{"planes", planes}});
    EXPECT_EQ(value_of(run, "free_motions"), n_free);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(frequencies(run).at(static_cast<size_t>(i)) < 1.0, i < n_free) << i;
  }
}

TEST(Modes, of_two_bodies_apart_are_twelve_at_rest) {
  const DeckRun apart = modes_of(blocks("contact{ " + faces + ", gap = 10*um }"));
  EXPECT_EQ(value_of(apart, "free_motions"), 12);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(frequencies(apart)[i], 0.0) << i;
  // Equal bodies have equal frequencies, all of them twice.
  for (int i = 12; i < 20; i += 2) {
    EXPECT_GT(frequencies(apart)[i], 1000.0);
    EXPECT_NEAR(frequencies(apart)[i], frequencies(apart)[i + 1], 1e-9 * frequencies(apart)[i]);
  }
}

TEST(Modes, without_a_static_step_are_those_of_the_unloaded_assembly) {
  const std::string motion = "steps = { step.dynamic{ name = 'go', duration = 1*us, dt = 1*us } },";
  const DeckRun tied = modes_of(blocks("bonded{ " + faces + " }", motion)),
                rested = modes_of(blocks("bonded{ " + faces + " }"));
  expect_same_frequencies(rested, tied, 1e-12);
  EXPECT_EQ(value_of(modes_of(blocks("contact{ " + faces + " }", motion)), "free_motions"), 12);
}

// The upper block pressed onto the lower one, which is held.
std::string pressed(const std::string& joint, const std::string& output, const std::string& push = "") {
  return blocks(joint,
                "supports = { support.fixed{ name = 'base', on = lower:face 'zmin' } }, steps = { step.static{ name = "
                "'press', increments = 2, loads = { load.pressure{ on = upper:face 'zmax', history = 10*MPa }" +
                    push + " } } },",
                output);
}
// Moved along so far that all of the joint slides.
const std::string pushed = ", load.displacement{ on = upper:face 'ymin', x = 0, y = 50*um }";

const NormalModes& of(const DeckRun& run) { return *std::any_cast<const NormalModesPtr&>(run.findings("m").model); }

TEST(Modes, of_a_joint_that_sticks_are_those_of_a_bonded_one) {
  const DeckRun stuck = modes_of(pressed("contact{ " + faces + ", friction = 1000 }", "n = 10, sliding = 'free'")),
                bonded = modes_of(pressed("bonded{ " + faces + " }", "n = 10"));
  EXPECT_EQ(of(stuck).n_tied, 45);
  expect_same_frequencies(bonded, stuck, 1e-9);
}

TEST(Modes, of_a_joint_that_slides_are_free_along_it_or_tied_as_asked) {
  const std::string rubbing = "contact{ " + faces + ", friction = 0.1 }";
  const DeckRun free = modes_of(pressed(rubbing, "n = 10, sliding = 'free'", pushed)),
                tied = modes_of(pressed(rubbing, "n = 10, sliding = 'tied'", pushed));
  ASSERT_EQ(of(free).n_open + of(tied).n_open, 0);
  EXPECT_EQ(of(free).n_normal, 45);
  EXPECT_EQ(of(tied).n_tied, 45);
  const DeckRun smooth = modes_of(pressed("contact{ " + faces + " }", "n = 10")),
                bonded = modes_of(pressed("bonded{ " + faces + " }", "n = 10"));
  ASSERT_EQ(of(smooth).n_normal, 45);
  // Along the plane and about its normal.
  EXPECT_EQ(value_of(free, "free_motions"), 3);
  expect_same_frequencies(smooth, free, 1e-9);
  expect_same_frequencies(bonded, tied, 1e-9);
}

TEST(Modes, are_not_made_where_there_are_fewer) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const DeckRun run =
      modes_of(small_box("supports = { support.fixed{ name = \"s\", on = box:face \"xmin\" } },", "n = 55"));
  const std::string said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_EQ(run.table("m").n_rows(), 0);
  EXPECT_NE(said.find("output.modes 'm': 55 modes are asked for, and the assembly has 54 unknowns"), std::string::npos)
      << said;
  EXPECT_NE(said.find("modes 'm': NOT MADE"), std::string::npos) << said;
}

}  // namespace
}  // namespace dygita::test::modes_tests

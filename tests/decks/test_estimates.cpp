// A run's own estimates of its errors, held against its true ones; and what it says where the physics asks for more
// than dt, mesh or tolerance can give.
#include <gtest/gtest.h>

#include "decks/spectra.hpp"
#include "result/limits.hpp"

namespace dygita::test::estimates_tests {
namespace {

class Pulse : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
    path_ = std::filesystem::temp_directory_path() / ("dygita_test_pulse_" + name + ".lua");
    std::ofstream(path_) << pulse;
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_;
};

void expect_effective(double estimated, double truth) {
  EXPECT_GT(estimated, 0.5 * truth);
  EXPECT_LT(estimated, 3.0 * truth);
}

TEST_F(Pulse, knows_what_its_tolerance_leaves) {
  const EstimatedRun converged = run_estimated(path_, {}, 1e-11);
  for (const double tolerance : {1e-2, 1e-4}) {
    const EstimatedRun run = run_estimated(path_, {}, tolerance);
    expect_effective(run.figures.iteration_error.value(), true_error(run, converged));
  }
}

TEST_F(Pulse, knows_what_its_time_step_leaves) {
  for (const char* steps : {"96", "384"}) {
    const EstimatedRun run = run_estimated(path_, {{"steps", steps}});
    const EstimatedRun fine = run_estimated(path_, {{"steps", std::to_string(8 * std::stoi(steps))}});
    expect_effective(run.figures.time_step_error.value(), true_error(run, fine));
  }
}

TEST_F(Pulse, knows_what_its_mesh_leaves) {
  for (const int n : {20, 60}) {
    const Settings settings = {{"n", std::to_string(n)}, {"steps", "960"}};
    const EstimatedRun run = run_estimated(path_, settings);
    const EstimatedRun fine = run_estimated(path_, {{"n", std::to_string(8 * n)}, {"steps", "960"}});
    expect_effective(run.figures.mesh_error.value(), true_error(run, fine, n / 2, 4 * n));
  }
}

// A static step without loads, after a shock: it unloads what is left of the waves, so that nothing is strained at its
// end.
const std::string unloaded = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local function block(i)
  return substructure{ name = "block " .. i, material = steel, mesh = mesh.box{ origin = { (i - 1) * 10*mm, 0, 0 }, size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 } } }
end
local a, b = block(1), block(2)
local hit = step.dynamic{ name = "hit", duration = 30*us, dt = 0.5*us,
  loads = { load.traction{ on = b:face "xmax", x = history.half_sine{ peak = 100*MPa, duration = 8*us } } } }
problem{ name = "rest", substructures = { a, b },
  interfaces = { interface.bonded{ name = "glue", between = { a:face "xmax", b:face "xmin" } } },
  supports = { support.fixed{ name = "foot", on = a:face "xmin" } },
  steps = { hit, step.static{ name = "rest", after = hit } }, outputs = { output.energy{} } }:run{}
)";

TEST(Unloading, has_an_iteration_error_held_against_what_it_unloads) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dygita_test_unloading.lua";
  std::ofstream(path) << unloaded;
  const DeckRun run = run_file(path).front();
  std::filesystem::remove(path);
  EXPECT_LT(run.figure("error estimate, static, iteration [%]"), 0.01);
}

// A bar shaken across at its foot, of tetrahedra that lock or of hexahedra that do not: how it bends is little beside
// how it is carried along.
const std::string shaken = R"(
local p = param{ hexahedra = 1, n = 10, across = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local cells = p.hexahedra == 1 and mesh.box{ size = { 5*mm, 5*mm, 50*mm }, cells = { p.across, p.across, p.n } }
  or mesh.gmsh{ file = "BAR", set = { n = p.n, cells = 0 } }:volume "bar"
local bar = substructure{ name = "bar", material = steel, mesh = cells }
local foot = support.fixed{ name = "foot", on = bar:face "zmin" }
local shake = step.dynamic{ name = "shake", duration = 1.92*ms, dt = 10*us, loads = {
  load.base_acceleration{ on = foot, direction = { 1, 0, 0 }, history = history.half_sine{ peak = 500*g0, duration = 0.5*ms } } } }
local top = output.history{ name = "top", on = bar:face "zmax", quantity = "acceleration", direction = { 1, 0, 0 } }
local below = output.history{ name = "below", on = bar:face "zmin", quantity = "acceleration", direction = { 1, 0, 0 } }
problem{ name = "shaken", substructures = { bar }, supports = { foot }, steps = { shake }, outputs = { top, below,
  output.srs{ name = "top_srs", of = top, from = 600, to = 6*kHz }, output.srs{ name = "below_srs", of = below, from = 600, to = 6*kHz } } }:run{}
)";

class ShakenBar : public Pulse {
 protected:
  void SetUp() override {
    Pulse::SetUp();
    std::string text = shaken;
    text.replace(text.find("BAR"), 3, (std::filesystem::path(DYGITA_SOURCE_DIR) / "meshes/bar.geo").string());
    std::ofstream(path_) << text;
  }

  // Kinetic energy of the error of a coarse mesh's velocities, at its own nodes, over that of the motion against the
  // foot:
  // %, at the worst instants.
  static double true_error_of(const EstimatedRun& coarse, const EstimatedRun& fine) {
    const Substructure &a = *coarse.problem.substructures[0], &b = *fine.problem.substructures[0];
    const Vec mass = make_bodies(coarse.problem, make_surfaces(coarse.problem))[0].matrices->mass();
    std::vector<int> same;
    for (int i = 0; i < a.mesh->n_nodes(); ++i) {
      Eigen::Index at = 0;
      EXPECT_LT((b.mesh->nodes.colwise() - a.mesh->nodes.col(i)).colwise().norm().minCoeff(&at), 1e-9);
      same.push_back(static_cast<int>(at));
    }
    double worst = 0.0, moved = 0.0;
    for (size_t t = 0; t < fine.fields.velocity.size(); ++t) {
      const Points &v = coarse.fields.velocity[t][0], &exact = fine.fields.velocity[t][0];
      double error = 0.0, now = 0.0;
      for (int i = 0; i < a.mesh->n_nodes(); ++i) {
        error += mass[i] * (v.col(i) - exact.col(same[i])).squaredNorm();
        now += mass[i] * (exact.col(same[i]) - exact.col(0)).squaredNorm();  // node 0 is of the foot
      }
      worst = std::max(worst, error);
      moved = std::max(moved, now);
    }
    return 100.0 * std::sqrt(worst / moved);
  }
};

TEST_F(ShakenBar, of_tetrahedra_that_lock_is_told_to_be_poor_and_of_hexahedra_to_be_good) {
  const EstimatedRun fine = run_estimated(path_, {{"n", "40"}, {"across", "2"}});
  const EstimatedRun good = run_estimated(path_, {{"n", "20"}});
  const EstimatedRun poor = run_estimated(path_, {{"n", "20"}, {"hexahedra", "0"}});
  for (const EstimatedRun* run : {&good, &poor})
    std::cout << "mesh error: estimated " << run->figures.mesh_error.value() << " %, true " << true_error_of(*run, fine)
              << " %\n";
  expect_effective(poor.figures.mesh_error.value(), true_error_of(poor, fine));
  EXPECT_GT(poor.figures.mesh_error.value(), limit::discretisation_error);
  EXPECT_LT(good.figures.mesh_error.value(), limit::discretisation_error);
}

// Several explicit increments make a time step of the deck: what carries the bar along is taken off at its end.
TEST_F(ShakenBar, is_judged_alike_with_explicit_increments) {
  const EstimatedRun trapezoidal = run_estimated(path_, {});
  const EstimatedRun substeps = run_estimated(path_, {}, 0.0, false, IntegrationChoice::explicitly);
  const double expected = trapezoidal.figures.mesh_error.value();
  EXPECT_NEAR(substeps.figures.mesh_error.value(), expected, 0.1 * expected);
  EXPECT_LT(substeps.figures.time_step_error.value(), 0.5 * trapezoidal.figures.time_step_error.value());
}

TEST_F(ShakenBar, of_poor_cells_has_bands_that_are_said_not_to_hold) {
  const auto said_with = [&](const char* hexahedra) {
    testing::internal::CaptureStderr();
    run_file(path_, {{"n", "20"}, {"hexahedra", hexahedra}});
    return testing::internal::GetCapturedStderr();
  };
  const std::string held = "spectra may be off by far more than their bands";
  EXPECT_NE(said_with("0").find(held), std::string::npos);
  EXPECT_EQ(said_with("1").find(held), std::string::npos);
}

TEST_F(ShakenBar, has_no_band_for_the_motion_of_its_foot) {
  const SpectraRun run = run_spectra(path_, {}, {}, 0.0, 0.0);
  for (const OutputPtr& output : run.problem.outputs) {
    const Findings& findings = run.result->findings_of(*output);
    if (output->name == "below_srs") {
      EXPECT_EQ(findings.band.n_rows(), 0);
    }
    if (output->name == "top_srs") {
      EXPECT_GT(findings.band.n_rows(), 0);
    }
  }
}

// What one sees of an impact does not depend on the train one sits in.
TEST_F(Pulse, is_estimated_alike_in_any_frame) {
  std::string text = impact;
  for (const auto& [from, to] :
       {std::pair{"\"left\", 0, 100", "\"left\", 0, 1100"}, {"\"right\", L, -100", "\"right\", L, 900"}}) {
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), std::string(from).size(), to);
  }
  std::ofstream(path_) << impact;
  const EstimatedRun rest = run_estimated(path_, {});
  std::ofstream(path_) << text;
  const EstimatedRun moving = run_estimated(path_, {});
  for (const Figure figure : {&Figures::iteration_error, &Figures::time_step_error, &Figures::mesh_error})
    // A thousandth of a percent is the rounding of a train ten times as fast as the impact.
    EXPECT_NEAR((moving.figures.*figure).value(), (rest.figures.*figure).value(),
                1e-3 + 0.02 * (rest.figures.*figure).value())
        << label(figure);
}

// A square bar, few cells across: the cells have the stress of a round one.
const std::string twisted = R"(
local p = param{ n = 2, motion = 0, order = 1 }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 8000 }
local bar = substructure{ name = "bar", material = m, mesh = mesh.box{ size = { 60*mm, 8*mm, 8*mm }, cells = { 12, p.n, p.n }, order = p.order } }
local foot = support.fixed{ name = "foot", on = bar:face "xmin" }
local function twist(history) return { load.torque{ on = bar:face "xmax", axis = { 1, 0, 0 }, history = history } } end
local go = p.motion == 0 and step.static{ name = "twist", loads = twist(10) }
  or step.dynamic{ name = "twist", duration = 400*us, dt = 1*us, loads = twist(history.haversine{ peak = 10, duration = 40*us }) }
problem{ name = "twisted", substructures = { bar }, supports = { foot }, steps = { go }, outputs = { output.energy{} } }:run{}
)";

// With c = 0.1406 of its side to the fourth, and a sixth for what does not warp, the stiffness of one and two cells is
// 18.6 % too large: the error in energy norm is the root of 1 - 6 c.
TEST_F(Pulse, knows_that_a_square_bar_of_few_cells_does_not_warp) {
  std::ofstream(path_) << twisted;
  const double truth = 100.0 * std::sqrt(1.0 - 6 * 0.1406);
  for (const char* n : {"1", "2"}) {
    const double estimated = run_file(path_, {{"n", n}}).front().figure("error estimate, static, mesh [%]");
    EXPECT_GT(estimated, 0.5 * truth) << n;
    EXPECT_LT(estimated, 2.0 * truth) << n;
  }
  EXPECT_LT(run_file(path_, {{"n", "4"}}).front().figure("error estimate, static, mesh [%]"), 0.8 * truth);
  // One cell of order two does not warp, either: its shapes lack what a quarter turn and a reflection leave of it.
  const double one = run_file(path_, {{"n", "1"}, {"order", "2"}}).front().figure("error estimate, static, mesh [%]");
  EXPECT_GT(one, 0.5 * truth);
  EXPECT_LT(one, 2.0 * truth);
}

// Lumped masses have 1 + 2/n^2 times its inertia, which slows it down by more than the stiffness makes up for.
TEST_F(Pulse, knows_the_frequency_of_a_square_bar_of_few_cells) {
  std::ofstream(path_) << twisted;
  for (const int n : {1, 2}) {
    const double truth = 100.0 * (1.0 - std::sqrt(1.0 / (6 * 0.1406) / (1.0 + 2.0 / (n * n))));
    const DeckRun run = run_file(path_, {{"n", std::to_string(n)}, {"motion", "1"}}).front();
    const double estimated = run.figure("error estimate, frequency, mesh [%]");
    EXPECT_GT(estimated, 0.5 * truth) << n;
    EXPECT_LT(estimated, 2.0 * truth) << n;
    EXPECT_GT(run.figure("error estimate, mesh [%]"), limit::discretisation_error);
  }
}

// A cantilever let go: after forty periods nothing is left of its phase, and its frequency is off by little.
TEST_F(Pulse, tells_the_frequency_of_a_ring_down_from_its_phase) {
  std::ofstream(path_) << R"(
local m = material.elastic{ name = "m", young = 210*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", material = m, mesh = mesh.box{ size = { 100*mm, 5*mm, 5*mm }, cells = { 20, 1, 1 } } }
local foot = support.fixed{ name = "foot", on = bar:face "xmin" }
local function pull(force) return { load.force{ on = bar:face "xmax", z = force } } end
local pulled = step.static{ name = "pulled", loads = pull(10) }
local free = step.dynamic{ name = "free", after = pulled, duration = 100*ms, dt = 100*us, loads = pull(0) }
problem{ name = "ring-down", substructures = { bar }, supports = { foot }, steps = { pulled, free }, outputs = { output.energy{} },
  solver = solver.latin{ integration = "implicit" } }:run{}
)";
  const DeckRun run = run_file(path_).front();
  const double frequency = 3.516 / (2 * 3.14159265) * 0.005 / std::sqrt(12.0) / 0.01 * std::sqrt(210e9 / 7800),
               truth = 100.0 * std::pow(2 * 3.14159265 * frequency * 100e-6, 2) / 12.0;
  const double estimated = run.figure("error estimate, frequency, time step [%]");
  EXPECT_GT(estimated, 0.5 * truth);
  EXPECT_LT(estimated, 2.0 * truth);
  EXPECT_GT(run.figure("error estimate, time step [%]"), limit::discretisation_error);
}

// A bar that is pulled, and beside it what flies towards it: across `gap`, 100 m/s.
const std::string flown_at = R"(
local p = param{ flies = 1, gap = 50*mm }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 100*mm }, cells = { 2, 2, 20 } } }
local foot = support.fixed{ name = "foot", on = bar:face "zmin" }
local parts, interfaces = { bar }, {}
if p.flies == 1 then
  parts[2] = substructure{ name = "cube", material = steel, velocity = { 0, 0, -100 },
    mesh = mesh.box{ origin = { 0, 0, 100*mm + p.gap }, size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
  interfaces[1] = interface.contact{ name = "touch", between = { bar:face "zmax", parts[2]:face "zmin" }, gap = "geometry", within = 60*mm }
end
local hit = step.dynamic{ name = "hit", duration = 100*us, dt = 0.5*us,
  loads = { load.traction{ on = bar:face "xmax", z = history.half_sine{ peak = 10*MPa, duration = 20*us } } } }
problem{ name = "flown at", substructures = parts, interfaces = interfaces, supports = { foot }, steps = { hit } }:run{}
)";

// What flies by has an energy that is no part of the shock, until it touches.
TEST_F(Pulse, is_held_against_the_energy_of_what_touches_alone) {
  std::ofstream(path_) << flown_at;
  for (const IntegrationChoice integration : {IntegrationChoice::implicitly, IntegrationChoice::explicitly}) {
    const auto estimates = [&](const char* gap, const char* flies) {
      const Figures figures = run_estimated(path_, {{"gap", gap}, {"flies", flies}}, 0.0, false, integration).figures;
      return std::pair(figures.time_step_error.value(), figures.mesh_error.value());
    };
    const auto [step, mesh] = estimates("50*mm", "0");
    const auto [step_beside, mesh_beside] = estimates("50*mm", "1");
    // The mass of explicit cells is another where a law acts.
    EXPECT_NEAR(step_beside, step, 0.02 * step);
    EXPECT_NEAR(mesh_beside, mesh, 0.02 * mesh);
    // The front of an impact is sharper than the pulse, and that is seen since it is all of the energy.
    const auto [step_hit, mesh_hit] = estimates("1*mm", "1");
    EXPECT_GT(step_hit, 2.0 * step);
    EXPECT_GT(mesh_hit, 2.0 * mesh);
  }
}

// A free block, pushed along an axis at its foot: it flies; or along another at its top: it spins as well.
const std::string pushed = R"(
local p = param{ n = 3, finer = 1, spins = 0, peak = 10, pulse = 200, modes = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local a = substructure{ name = "a", material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { p.n, p.n, p.n } } }
local push = history.half_sine{ peak = p.peak*MPa, duration = p.pulse*us }
local shock = step.dynamic{ name = "shock", duration = 960*us, dt = 2*us / p.finer, loads = {
  p.spins == 1 and load.traction{ on = a:face "zmax", x = push } or load.pressure{ on = a:face "zmin", history = push } } }
if p.modes == 1 then
  problem{ name = "block", substructures = { a }, steps = { step.static{ name = "rests" } }, outputs = { output.modes{ name = "natural", n = 7 } } }:run{}
else
  problem{ name = "block", substructures = { a }, steps = { shock } }:run{}
end
)";

// What is off is the ringing, next to which a soft pulse strains the block a hundred times as much.
TEST_F(Pulse, of_a_block_that_flies_is_held_against_what_strains_it) {
  std::ofstream(path_) << pushed;
  const EstimatedRun run = run_estimated(path_, {}), fine = run_estimated(path_, {{"finer", "16"}});
  std::cout << "time step error of a block that flies: estimated " << run.figures.time_step_error.value() << " %, true "
            << true_error(run, fine) << " %\n";
  EXPECT_GT(run.figures.time_step_error.value(), 0.5 * true_error(run, fine));
  EXPECT_LT(run.figures.time_step_error.value(), limit::discretisation_error);
  EXPECT_LT(run.figures.mesh_error.value(), limit::discretisation_error);
  // The pulse's own frequency is 2.5 kHz, the lowest of the block 66 kHz.
  EXPECT_GT(run.figures.mean_frequency.value(), 2.5e3);
  EXPECT_LT(run.figures.mean_frequency.value(), 25e3);
}

// Spinning has no frequency, however fast it is: the mesh is told by the block's own.
TEST_F(Pulse, of_a_block_that_spins_is_of_its_own_frequencies) {
  std::ofstream(path_) << pushed;
  const auto lowest = [&](const char* n) {
    return run_file(path_, {{"n", n}, {"modes", "1"}}).front().table("natural").column("frequency").back();
  };
  const double coarse = lowest("3"), truth = 100.0 * 9.0 / 8.0 * (1.0 - coarse / lowest("9"));
  for (const char* peak : {"0.2", "10"})
    for (const IntegrationChoice integration : {IntegrationChoice::implicitly, IntegrationChoice::explicitly}) {
      const Figures figures =
          run_estimated(path_, {{"spins", "1"}, {"peak", peak}, {"pulse", "40"}}, 0.0, false, integration).figures;
      EXPECT_GT(figures.mesh_frequency_error.value(), 0.5 * truth) << peak;
      EXPECT_LT(figures.mesh_frequency_error.value(), 2.0 * truth) << peak;
      EXPECT_GT(figures.mean_frequency.value(), 12.5e3) << peak;
      EXPECT_LT(figures.mean_frequency.value(), coarse) << peak;
    }
}

// A block on springs to the ground, which a push makes swing along them: rigid but for 1e-4 of the energy.
DeckRun swinging(const char* settings) {
  return std::move(run_text(std::string(settings) + R"(
local aluminium = material.elastic{ name = "aluminium", young = 70*GPa, poisson = 0.3, density = 2700 }
local block = substructure{ name = "block", material = aluminium,
  mesh = mesh.box{ size = { 100*mm, 80*mm, 60*mm }, cells = { 3, 3, 3 } } }
local parts, interfaces, supports = { block }, {}, {}
if mount == "spring" then
  supports[1] = support.spring{ name = "mount", on = block:face "zmin", x = k, y = k, z = k,
    about_x = k / 100, about_y = k / 100, about_z = k / 100 }
elseif mount == "bushing" then
  local floor = substructure{ name = "floor", material = aluminium,
    mesh = mesh.box{ origin = { 0, 0, -20*mm }, size = { 100*mm, 80*mm, 20*mm }, cells = { 3, 3, 2 } } }
  parts[2], supports[1] = floor, support.fixed{ name = "under", on = floor:face "zmin" }
  interfaces[1] = interface.bushing{ name = "mount", between = { floor:face "zmax", block:face "zmin" },
    normal = k / 0.008, tangential = k / 0.008 }
end
local push = step.dynamic{ name = "push", duration = duration, dt = duration / 400, loads = {
  load.pressure{ on = block:face "zmax", history = history.half_sine{ peak = 0.1*MPa, duration = duration / 20 } } } }
problem{ name = "swinging", substructures = parts, interfaces = interfaces, supports = supports, steps = { push },
  outputs = { output.energy{} } }:run{}
)",
                            {}, 1)
                       .front());
}

// Its frequency is that of the springs, the time step turns that, and the mesh has nothing to do with it.
TEST(Swinging, on_springs_is_told_the_errors_of_its_own_frequency) {
  const double truth = std::sqrt(1e6 / (2700 * 0.1 * 0.08 * 0.06)) / (2 * std::numbers::pi);
  for (const std::string mount : {"spring", "bushing"}) {
    SCOPED_TRACE(mount);
    const std::map<std::string, double> figures =
        swinging(("local mount, k, duration = '" + mount + "', 1e6, 40*ms").c_str()).figures();
    EXPECT_NEAR(figures.at("mean frequency of the motion [Hz]"), truth, 0.06 * truth);
    EXPECT_LT(figures.at("error estimate, frequency, mesh [%]"), 0.01);
    EXPECT_LT(figures.at("error estimate, amplitude, mesh [%]"), 0.5);
    const double turned = 2 * std::numbers::pi * truth * 1e-4;
    EXPECT_NEAR(figures.at("error estimate, frequency, time step [%]"), 100 * turned * turned / 12,
                0.15 * 100 * turned * turned / 12);
    EXPECT_GT(figures.at("error estimate, time step [%]"), 100 * 400 * std::pow(turned, 3) / 12);
  }
}

// Cords that hang a free assembly hold nothing within a shock of theirs.
TEST(Swinging, on_cords_is_told_what_it_is_on_cords_that_hold_nothing) {
  const std::map<std::string, double> free = swinging("local mount, k, duration = 'spring', 1e-6, 0.4*ms").figures(),
                                      hung = swinging("local mount, k, duration = 'spring', 100, 0.4*ms").figures();
  EXPECT_GT(free.at("error estimate, frequency, mesh [%]"), 0.5);
  EXPECT_NEAR(hung.at("error estimate, frequency, mesh [%]"), free.at("error estimate, frequency, mesh [%]"),
              0.01 * free.at("error estimate, frequency, mesh [%]"));
  EXPECT_NEAR(hung.at("error estimate, time step [%]"), free.at("error estimate, time step [%]"),
              0.01 * free.at("error estimate, time step [%]"));
  EXPECT_NEAR(hung.at("mean frequency of the motion [Hz]"), free.at("mean frequency of the motion [Hz]"),
              0.01 * free.at("mean frequency of the motion [Hz]"));
}

// A bar under a half-sine; what the run warned of.
std::string warnings(const Settings& settings) {
  testing::internal::CaptureStderr();
  run_text(R"(
local p = param{ n = 50, dt = 0.1*us, pulse = 10*us, tolerance = 1e-6 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function bar(name, from)
  return substructure{ name = name, material = steel,
    mesh = mesh.box{ origin = { 0, 0, from }, size = { 5*mm, 5*mm, 50*mm }, cells = { 1, 1, p.n } } }
end
local a, b = bar("a", 0), bar("b", 50*mm)
local touch = interface.contact{ name = "touch", between = { a:face "zmax", b:face "zmin" }, friction = 0.3 }
local hit = step.dynamic{ name = "hit", duration = 30*us, dt = p.dt, loads = {
  load.pressure{ on = b:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = p.pulse } } } }
problem{ name = "bar", substructures = { a, b }, interfaces = { touch }, steps = { hit },
         solver = solver.latin{ integration = 'implicit', tolerance = p.tolerance } }:run{}
)",
           settings, 1);
  return testing::internal::GetCapturedStderr();
}

TEST(Warnings, are_none_where_mesh_step_and_tolerance_carry_the_load) { EXPECT_EQ(warnings({}), ""); }

TEST(Warnings, name_a_time_step_too_large_for_the_load_and_the_one_that_would_do) {
  const std::string said = warnings({{"dt", "5*us"}});
  EXPECT_NE(said.find("95 % of the energy of load.pressure on face 'b.zmax' lies below"), std::string::npos) << said;
  EXPECT_NE(said.find("time steps per period there: 10 are wanted, dt = "), std::string::npos) << said;
}

TEST(Warnings, name_a_mesh_too_coarse_for_the_wavelength) {
  const std::string said = warnings({{"n", "3"}, {"pulse", "1*us"}, {"dt", "0.01*us"}});
  EXPECT_NE(said.find("the cells of substructure 'a', 5 mm along their shortest edge"), std::string::npos) << said;
  EXPECT_NE(said.find("the mesh leaves an error of about"), std::string::npos) << said;
}

// The errors of a loose tolerance have a common sign in a mode: the balance shows it before the band does.
TEST(Warnings, doubt_spectra_that_gather_the_errors_of_a_loose_tolerance) {
  const auto said_at = [](const std::string& tolerance) {
    testing::internal::CaptureStderr();
    run_file(std::filesystem::path(DYGITA_SOURCE_DIR) / "decks" / "bolted_flanges.lua",
             {{"size", "9*mm"}, {"ring", "0"}}, 1, "latin{ tolerance = " + tolerance + " }");
    return testing::internal::GetCapturedStderr();
  };
  const std::string doubted = "take 1e-06 and 1e-08; where they feed a lightly damped mode, spectra are off by more";
  EXPECT_NE(said_at("1e-2").find(doubted), std::string::npos);  // open by 0.13 %
  EXPECT_EQ(said_at("1e-4").find(doubted), std::string::npos);
}

TEST(Warnings, name_a_part_whose_modes_twist_too_slowly) {
  testing::internal::CaptureStderr();
  run_text(R"(
local steel = material.elastic{ name = "steel", young = 209*GPa, poisson = 0.3, density = 7850 }
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { 300*mm, 30*mm, 1*mm }, cells = { 15, 1, 1 } } }
problem{ name = "torsion", substructures = { plate }, supports = { support.fixed{ name = "clamp", on = plate:face "xmin" } },
  steps = { step.static{ name = "s" } }, outputs = { output.superelement{ name = "e", on = plate:face "xmax", modes = 4 } } }:run{}
)",
           {}, 1);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("the masses of substructure 'plate' at its nodes have 3 times the moment of inertia"),
            std::string::npos)
      << said;
}

TEST(Warnings, name_a_tolerance_too_loose_and_one_that_would_do) {
  const std::string said = warnings({{"tolerance", "0.05"}});
  EXPECT_NE(said.find("the tolerance 0.05 leaves an error of about"), std::string::npos) << said;
  EXPECT_NE(said.find("would leave 0.1 %"), std::string::npos) << said;
}

}  // namespace
}  // namespace dygita::test::estimates_tests

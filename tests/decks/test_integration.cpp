// Substructures integrated explicitly, beside implicit ones and alone: the same solution, balances, cuts, stability.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/deck_prints.hpp"

namespace dygita::test::integration_tests {
namespace {

// A stack in a corner of two rough walls: rubbing, tied and yielding planes, a side that lets waves out, a driven top.
const std::string stack = R"(
local p = param{ dt = 0.05, low = 0, middle = 0, high = 0, mu = 0.3, pieces = 1, n = 3,
                 alpha = 0, beta = 0, duration = 6, driven = 0, press = 0, tuned = 0, parts = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = (p.alpha > 0 or p.beta > 0) and { mass = p.alpha, stiffness = p.beta } or nil }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.3, density = 2700 }
local function box(name, z, of, how) return substructure{ name = name, material = of, integration = how == 1 and "explicit" or "implicit",
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 6*mm, 6*mm, 4*mm }, cells = { p.n, p.n, p.n } } } end
local low, middle, high, cap = box("low", 0, soft, p.low), box("middle", 4*mm, steel, p.middle), box("high", 8*mm, soft, p.high), box("cap", 12*mm, steel, p.high)
local rubbing = interface.contact{ name = "rubbing", between = { low:face "zmax", middle:face "zmin" }, friction = p.mu }
local tied = interface.bonded{ name = "tied", between = { middle:face "zmax", high:face "zmin" } }
local yields = interface.plastic{ name = "yields", between = { high:face "zmax", cap:face "zmin" }, yield = 30*MPa, hardening = 2e6*MPa/mm, compression = true }
local floor = support.wall{ name = "floor", on = low:face "zmin", friction = p.mu }
local side = support.wall{ name = "side", on = { low:face "xmin", middle:face "xmin" }, friction = 0.5 * p.mu }
local out = support.absorbing{ name = "out", on = middle:face "ymax" }
local top = load.traction{ on = cap:face "zmax", x = history.half_sine{ peak = 20*MPa, duration = 3*us }, z = history.half_sine{ peak = -120*MPa, duration = 4*us } }
if p.driven == 1 then top = load.velocity{ on = cap:face "zmax", z = history.haversine{ peak = -2, duration = 4*us } } end
local steps = {}
if p.press == 1 then steps[1] = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = cap:face "zmax", history = 20*MPa } } } end
local loads = { top }
if p.press == 1 then loads[2] = load.pressure{ on = cap:face "zmax", history = 20*MPa } end
for i = 1, p.parts do
  steps[#steps + 1] = step.dynamic{ name = "hit " .. i, after = steps[#steps], duration = p.duration/p.parts*us, dt = p.dt*us, loads = i == 1 and loads or {} }
end
problem{ name = "stack", substructures = { low, middle, high, cap }, interfaces = { rubbing, tied, yields },
  supports = { floor, side, out }, steps = steps, solver = solver.latin{ tolerance = 1e-9, pieces = p.pieces, mass = p.tuned == 1 and "tuned" or "lumped" },
  outputs = { output.history{ name = "corner", on = low:where(function(x, y, z) return near(x, 6*mm) and near(y, 6*mm) and near(z, 4*mm) end), quantity = "displacement" },
    output.joint{ name = "rubbing", on = rubbing }, output.joint{ name = "yields", on = yields }, output.joint{ name = "tied", on = tied },
    output.joint{ name = "floor", on = floor }, output.energy{} } }:run{}
)";

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

const Settings all_explicit = {{"low", "1"}, {"middle", "1"}, {"high", "1"}};
const Settings mixed = {{"low", "1"}, {"high", "1"}};

double imbalance(const DeckRun& run) {
  const std::vector<double>& balance = run.column("energy", "balance");
  return largest(balance) / largest(run.column("energy", "loads"));
}

TEST(Integration, explicit_implicit_and_mixed_become_the_same_as_dt_goes_to_zero) {
  for (const char* drive : {"0", "1"}) {
    const DeckRun finest = run_text(stack, {{"dt", "0.00625"}, {"driven", drive}}).at(0);
    const auto last = [](const DeckRun& run, const char* output, const char* column) {
      return run.column(output, column).back();
    };
    for (const Settings& how : {Settings{}, mixed, all_explicit}) {
      double before = 0.0;
      for (const char* dt : {"0.1", "0.05", "0.025"}) {
        const DeckRun run = run_text(stack, with(how, {{"dt", dt}, {"driven", drive}})).at(0);
        EXPECT_TRUE(run.result->converged);
        const double exact = last(finest, "corner", "x"), error = std::abs(last(run, "corner", "x") / exact - 1.0);
        const double of_joint =
            std::abs(last(run, "yields", "plastic_opening") / last(finest, "yields", "plastic_opening") - 1.0);
        std::cout << how.size() << " explicit, driven " << drive << ", dt " << dt << " us: corner off by "
                  << 100 * error << " %, plastic opening by " << 100 * of_joint << " %, " << run.result->mean_iterations
                  << " iterations\n";
        before = error;
      }
      EXPECT_LT(before, 0.01);
    }
  }
}

TEST(Integration, explicit_pieces_close_the_balance_to_rounding_and_friction_feeds_in_nothing) {
  for (const Settings& more :
       {Settings{}, Settings{{"alpha", "2e4"}}, Settings{{"beta", "1e-8"}}, Settings{{"driven", "1"}},
        Settings{{"dt", "0.4"}}, Settings{{"press", "1"}, {"mu", "0"}}}) {
    const DeckRun run = run_text(stack, with(all_explicit, more)).at(0);
    EXPECT_TRUE(run.result->converged);
    std::cout << "imbalance " << imbalance(run) << ", fed in " << run.figure("energy created by the scheme [%]")
              << " %\n";
    EXPECT_LT(imbalance(run), more.size() == 2 ? 1e-9 : 1e-12);
  }
}

TEST(Integration, tuned_masses_close_the_balance_too) {
  for (const Settings& more :
       {Settings{}, Settings{{"alpha", "2e4"}}, Settings{{"alpha", "2e4"}, {"beta", "1e-8"}, {"dt", "0.4"}},
        Settings{{"driven", "1"}}, Settings{{"dt", "0.4"}}, Settings{{"press", "1"}, {"mu", "0"}},
        Settings{{"pieces", "3"}}}) {
    const DeckRun run = run_text(stack, with(with(all_explicit, {{"tuned", "1"}, {"mu", "0"}}), more)).at(0);
    EXPECT_TRUE(run.result->converged);
    std::cout << "imbalance " << imbalance(run) << ", fed in " << run.figure("energy created by the scheme [%]")
              << " %\n";
    EXPECT_LT(imbalance(run), more.size() == 2 ? 1e-9 : 1e-12);
  }
  EXPECT_LT(imbalance(run_text(stack, with(mixed, {{"tuned", "1"}, {"mu", "0"}})).at(0)), 1e-8);
}

// The second step starts with velocities of which momenta have to be found. Its forces are of the stiffness in double
// precision, those of the first in single: what that leaves, friction and impacts make some ten times larger here.
TEST(Integration, a_step_with_tuned_masses_goes_on_where_another_ended) {
  const Settings tuned = with(all_explicit, {{"tuned", "1"}, {"duration", "10"}, {"n", "4"}});
  const DeckRun whole = run_text(stack, tuned).at(0), parts = run_text(stack, with(tuned, {{"parts", "2"}})).at(0);
  for (const char* axis : {"x", "y", "z"})
    EXPECT_LT(std::abs(whole.column("corner", axis).back() - parts.column("corner", axis).back()),
              1e-5 * largest(whole.column("corner", axis)))
        << axis;
  EXPECT_LT(imbalance(parts), 1e-12);
}

// What pulls at the copies of a node on a cut is added up before the mass spreads it, momenta at a step's start too.
// What is left is the single precision of C.
TEST(Integration, tuned_masses_do_not_feel_a_cut) {
  const Settings tuned = with(all_explicit, {{"tuned", "1"}, {"n", "5"}, {"duration", "8"}});
  for (const Settings& more : {Settings{}, Settings{{"alpha", "2e4"}, {"beta", "1e-8"}}, Settings{{"driven", "1"}},
                               Settings{{"parts", "2"}}}) {
    const DeckRun whole = run_text(stack, with(tuned, more)).at(0);
    for (const char* pieces : {"2", "4"}) {
      const DeckRun cut = run_text(stack, with(with(tuned, more), {{"pieces", pieces}})).at(0);
      ASSERT_EQ(cut.result->steps.back().substeps, whole.result->steps.back().substeps);
      double most = 0.0;
      for (const char* axis : {"x", "y", "z"})
        most = std::max(most, difference(whole.column("corner", axis), cut.column("corner", axis)));
      std::cout << (more.empty() ? "" : more[0].first) << " " << pieces << " pieces: off by " << most << ", imbalance "
                << imbalance(cut) << "\n";
      EXPECT_LT(most, 3e-6);
      EXPECT_LT(imbalance(cut), 1e-12);
    }
  }
}

TEST(Integration, tuned_masses_halve_the_error_of_a_pulse) {
  const auto force = [](const char* n, const char* dt, const char* tuned) {
    const DeckRun run = run_file(deck("verification/pulse.lua"), {{"n", n}, {"dt", dt}, {"tuned", tuned}}).at(0);
    return run.column("ab", "normal");
  };
  const std::vector<double> fine = force("16", "0.08*us", "1");
  const auto error = [&](const char* tuned) {
    const std::vector<double> coarse = force("8", "0.16*us", tuned);
    double apart = 0.0, size = 0.0;
    for (size_t i = 0; i < coarse.size(); ++i) {
      const double mean = 0.5 * (fine.at(2 * i) + fine.at(2 * i + 1));  // forces are means over a dt
      apart += std::pow(coarse[i] - mean, 2);
      size += mean * mean;
    }
    return std::sqrt(apart / size);
  };
  const double lumped = error("0"), tuned = error("1");
  std::cout << "  force between the blocks, off by " << 100 * lumped << " % with lumped masses, " << 100 * tuned
            << " % with tuned ones\n";
  EXPECT_LT(tuned, 0.6 * lumped);
  EXPECT_LT(tuned, 0.03);
}

// Contact nodes without mass, which only implicit substructures have, against what they would have to gain in explicit
// ones: the same pulse with cells of a third of the size.
TEST(Integration, contact_nodes_without_mass_gain_nothing_where_blocks_rub) {
  const auto force = [](const char* n, const char* dt, const char* solver) {
    return run_file(deck("verification/pulse.lua"), {{"n", n}, {"dt", dt}}, 1, solver).at(0).column("ab", "normal");
  };
  const std::vector<double> fine = force("24", "0.04*us", "latin{ integration = 'explicit', mass = 'tuned' }");
  const auto error = [&](const std::string& solver) {
    const std::vector<double> coarse = force("8", "0.08*us", ("latin{ " + solver + " }").c_str());
    double apart = 0.0, size = 0.0;
    for (size_t i = 0; i < coarse.size(); ++i) {
      const double mean = 0.5 * (fine.at(2 * i) + fine.at(2 * i + 1));
      apart += std::pow(coarse[i] - mean, 2);
      size += mean * mean;
    }
    return 100.0 * std::sqrt(apart / size);
  };
  for (const std::string mass : {"lumped", "tuned"}) {
    const double of_explicit = error("integration = 'explicit', mass = '" + mass + "'");
    const double with = error("integration = 'implicit', mass = '" + mass + "'");
    const double without = error("integration = 'implicit', massless_contact = true, mass = '" + mass + "'");
    std::cout << "  " << mass << ": explicit " << of_explicit << " %, implicit " << with
              << " %, without mass at contacts " << without << " %\n";
    EXPECT_GT(without, with);
  }
}

// Damped, a step that goes on starts with the force that the velocities then have.
TEST(Integration, stiffness_damping_becomes_that_of_implicit_substructures_as_dt_goes_to_zero) {
  const Settings damped = {{"beta", "2e-8"}, {"alpha", "1e4"}, {"driven", "1"}};
  const DeckRun finest = run_text(stack, with(damped, {{"dt", "0.00625"}})).at(0);
  const DeckRun undamped = run_text(stack, with(all_explicit, {{"dt", "0.025"}, {"driven", "1"}})).at(0);
  const auto error = [&](const DeckRun& run) {
    return std::abs(run.column("energy", "damping").back() / finest.column("energy", "damping").back() - 1.0);
  };
  EXPECT_GT(error(undamped), 0.1);
  for (const Settings& how : {mixed, all_explicit}) {
    double before = 1.0;
    for (const char* dt : {"0.1", "0.05", "0.025"}) {
      const DeckRun run = run_text(stack, with(with(how, damped), {{"dt", dt}})).at(0);
      std::cout << "  " << how.size() << " explicit, dt " << dt << " us: damping off by " << 100 * error(run)
                << " %, imbalance " << imbalance(run) << "\n";
      EXPECT_LT(error(run), before);
      EXPECT_LT(imbalance(run), how.size() == 3 ? 1e-12 : 1e-8);
      before = error(run);
    }
    EXPECT_LT(before, 0.01);
  }
  const Settings long_enough = with(with(all_explicit, damped), {{"driven", "0"}, {"duration", "10"}});
  const DeckRun whole = run_text(stack, long_enough).at(0);
  const DeckRun parts = run_text(stack, with(long_enough, {{"parts", "2"}})).at(0);
  EXPECT_NEAR(parts.column("energy", "damping").back(), whole.column("energy", "damping").back(),
              1e-6 * whole.column("energy", "damping").back());
}

TEST(Integration, a_mixed_pair_conserves_as_the_implicit_one_does) {
  for (const Settings& how : {mixed, Settings{{"middle", "1"}}}) {
    const DeckRun run = run_text(stack, how).at(0);
    EXPECT_TRUE(run.result->converged);
    std::cout << "imbalance " << imbalance(run) << "\n";
    EXPECT_LT(imbalance(run), 1e-8);
  }
}

TEST(Integration, a_cut_explicit_body_is_the_uncut_one) {
  // Where laws with friction share a node, how they share the force is not unique. Pieces round their own shares of the
  // stiffness to single precision.
  const DeckRun whole = run_text(stack, with(all_explicit, {{"mu", "0"}})).at(0);
  const DeckRun cut = run_text(stack, with(all_explicit, {{"mu", "0"}, {"pieces", "3"}})).at(0);
  for (const char* axis : {"x", "y", "z"})
    EXPECT_LT(difference(whole.column("corner", axis), cut.column("corner", axis)), 1e-7) << axis;
  EXPECT_LT(difference(whole.column("tied", "normal"), cut.column("tied", "normal")), 1e-7);
  EXPECT_LT(difference(whole.column("yields", "plastic_opening"), cut.column("yields", "plastic_opening")), 1e-7);
  EXPECT_LT(difference(whole.column("rubbing", "normal"), cut.column("rubbing", "normal")), 1e-7);
}

TEST(Integration, any_number_of_threads_gives_the_same_bits) {
  const DeckRun one = run_text(stack, with(all_explicit, {{"pieces", "3"}, {"n", "8"}, {"duration", "1"}}), 1).at(0);
  const DeckRun two = run_text(stack, with(all_explicit, {{"pieces", "3"}, {"n", "8"}, {"duration", "1"}}), 2).at(0);
  for (const char* column : {"kinetic", "strain", "friction", "balance"})
    EXPECT_EQ(one.column("energy", column), two.column("energy", column)) << column;
  EXPECT_EQ(one.column("rubbing", "shear"), two.column("rubbing", "shear"));
}

TEST(Integration, a_time_step_of_the_deck_may_take_many_increments) {
  const DeckRun fine = run_text(stack, with(all_explicit, {{"dt", "0.1"}})).at(0);
  const DeckRun coarse = run_text(stack, with(all_explicit, {{"dt", "1"}})).at(0);
  ASSERT_EQ(coarse.result->steps.at(0).increments, 6);
  EXPECT_GT(coarse.result->steps.at(0).substeps, 3);
  EXPECT_NEAR(coarse.column("corner", "x").back(), fine.column("corner", "x").back(),
              0.01 * largest(fine.column("corner", "x")));
  // Forces are means over a dt.
  const std::vector<double>& force = fine.column("floor", "normal");
  double mean = 0.0;
  for (int i = 20; i < 30; ++i) mean += force[i] / 10.0;
  EXPECT_NEAR(coarse.column("floor", "normal")[2], mean, 0.02 * largest(force));
}

const std::string sliding = R"(
local p = param{ n = 2, how = 2 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, velocity = { 10, 3, 0 }, integration = ({ "implicit", "explicit", "automatic" })[p.how],
  mesh = mesh.box{ size = { 10*mm, 10*mm, 5*mm }, cells = { 2*p.n, 2*p.n, p.n } } }
local ice = support.wall{ name = "ice", on = block:face "zmin" }
problem{ name = "sliding", substructures = { block }, supports = { ice }, steps = { step.dynamic{ name = "slide", duration = 1*ms, dt = 1*us } },
  outputs = { output.history{ name = "place", on = block:where(function(x, y, z) return near(x, 0) and near(y, 0) and near(z, 0) end), quantity = "displacement" }, output.energy{} } }:run{}
)";

TEST(Integration, a_block_that_slides_is_held_back_by_nothing) {
  for (const char* n : {"2", "4"}) {
    const DeckRun run = run_text(sliding, {{"n", n}}).at(0);
    EXPECT_NEAR(run.column("place", "x").back(), 0.01, 1e-13);
    EXPECT_NEAR(run.column("place", "y").back(), 0.003, 1e-13);
    EXPECT_EQ(run.result->iterations, run.result->steps[0].substeps * 1000L);
  }
}

// An implicit block beside an explicit one, no interface anywhere: each moves as if the other were not there.
TEST(Integration, what_no_interface_touches_is_solved_beside_explicit_parts) {
  const std::string deck = R"(
local p = param{ beside = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z, how) return substructure{ name = name, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 3, 3, 3 } }, material = steel, place = { 0, 0, z }, integration = how } end
local own, other = block("own", 0, "implicit"), block("other", 100*mm, "explicit")
local base = support.fixed{ name = "base", on = own:face "zmin" }
local push = step.dynamic{ name = "push", duration = 40*us, dt = 0.4*us, loads = { load.pressure{ on = own:face "zmax", history = history.half_sine{ peak = 20*MPa, duration = 15*us } } } }
problem{ name = "apart", substructures = p.beside == 1 and { own, other } or { own }, supports = { base }, steps = { push },
         outputs = { output.history{ name = "top", on = own:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } } } }:run{}
)";
  const DeckRun alone = run_text(deck).at(0), beside = run_text(deck, {{"beside", "1"}}).at(0);
  const std::vector<double>&u = alone.column("top", "displacement"), &v = beside.column("top", "displacement");
  ASSERT_EQ(u.size(), v.size());
  const double most = -*std::min_element(u.begin(), u.end());
  ASSERT_GT(most, 1e-7);
  for (const auto& step : beside.result->steps) EXPECT_EQ(step.substeps, 1);  // of the same increments
  for (size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(v[i], u[i], 1e-9 * most) << i;
}

std::string complaint(const std::string& text, const Settings& settings, const std::string& solver) {
  try {
    run_text(text, settings, 1, solver);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Integration, what_cannot_be_explicit_says_why) {
  EXPECT_NE(complaint(sliding, {}, "latin{ numerical_damping = 0.1 }").find("numerical_damping"), std::string::npos);
  EXPECT_NE(complaint(sliding, {}, "latin{ massless_contact = true }").find("massless"), std::string::npos);
  EXPECT_EQ(complaint(sliding, {{"how", "3"}}, "latin{ massless_contact = true }"), "");
}

}  // namespace
}  // namespace dygita::test::integration_tests

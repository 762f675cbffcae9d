// A body cut into bonded pieces is the uncut body; the answer does not depend on window, form or threads.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/engine.hpp"

namespace dygita::test::cutting_tests {
namespace {

// A 6 x 6 x 8 block on a rigid wall with friction, hit obliquely on top; cut into nx x ny x nz bonded bricks.
const std::string cut_block = R"(
local p = param{ nx = 1, ny = 1, nz = 1, friction = 0.3, window = 1, plain = 0, tolerance = 1e-9, contact = 0, shock = 40 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local size, cells = { 6*mm, 6*mm, 8*mm }, { 6, 6, 8 }
local n = { p.nx, p.ny, p.nz }
local bricks, faces, top, bottom, ties = {}, {}, {}, {}, {}
local function key(i, j, k) return i .. "." .. j .. "." .. k end
for i = 1, n[1] do for j = 1, n[2] do for k = 1, n[3] do
  local c = { cells[1] // n[1], cells[2] // n[2], cells[3] // n[3] }
  local s = { size[1] / n[1], size[2] / n[2], size[3] / n[3] }
  local part = substructure{ name = "brick" .. key(i, j, k), material = steel,
    mesh = mesh.box{ origin = { (i-1)*s[1], (j-1)*s[2], (k-1)*s[3] }, size = s, cells = c } }
  bricks[#bricks + 1] = part
  faces[key(i, j, k)] = part
end end end
for i = 1, n[1] do for j = 1, n[2] do for k = 1, n[3] do
  local a = faces[key(i, j, k)]
  if k == n[3] then top[#top + 1] = a:face "zmax" end
  if k == 1 then bottom[#bottom + 1] = a:face "zmin" end
  if i < n[1] then ties[#ties + 1] = interface.bonded{ name = "x" .. key(i, j, k), between = { a:face "xmax", faces[key(i+1, j, k)]:face "xmin" } } end
  if j < n[2] then ties[#ties + 1] = interface.bonded{ name = "y" .. key(i, j, k), between = { a:face "ymax", faces[key(i, j+1, k)]:face "ymin" } } end
  if k < n[3] then
    local face = { a:face "zmax", faces[key(i, j, k+1)]:face "zmin" }
    if p.contact == 1 then ties[#ties + 1] = interface.contact{ name = "z" .. key(i, j, k), between = face, friction = p.friction }
    else ties[#ties + 1] = interface.bonded{ name = "z" .. key(i, j, k), between = face } end
  end
end end end
local wall = support.wall{ name = "wall", on = bottom, friction = p.friction }
local hit = step.dynamic{ name = "hit", duration = 8*us, dt = 0.2*us, loads = {
  load.traction{ on = top, x = history.half_sine{ peak = p.shock*MPa, duration = 3*us }, z = history.half_sine{ peak = -100*MPa, duration = 4*us } } } }
local corner = output.history{ name = "corner", quantity = "velocity",
  on = faces[key(n[1], n[2], n[3])]:where(function(x, y, z) return near(x, 6*mm) and near(y, 6*mm) and near(z, 8*mm) end) }
local foot = output.joint{ name = "foot", on = wall }
problem{ name = "block", substructures = bricks, interfaces = ties, supports = { wall }, steps = { hit },
  solver = solver.latin{ integration = 'implicit', tolerance = p.tolerance, window = p.window == 0 and "whole" or p.window, plain = p.plain == 1, max_iterations = 2000 },
  outputs = { corner, foot, output.energy{} } }:run{}
)";

DeckRun block(const Settings& settings, int threads = 0) { return run_text(cut_block, settings, threads).at(0); }

TEST(Cutting, a_cut_and_bonded_body_is_the_uncut_one) {
  const DeckRun whole = block({});
  EXPECT_TRUE(whole.result->converged);
  for (const Settings& cut : {Settings{{"nz", "2"}}, Settings{{"nx", "2"}, {"ny", "2"}, {"nz", "2"}},
                              Settings{{"nx", "3"}, {"ny", "2"}, {"nz", "4"}}}) {
    const DeckRun pieces = block(cut);
    EXPECT_TRUE(pieces.result->converged);
    for (const char* axis : {"x", "y", "z"})
      EXPECT_LT(difference(whole.column("corner", axis), pieces.column("corner", axis)), 1e-6) << axis;
    EXPECT_LT(difference(whole.column("foot", "normal"), pieces.column("foot", "normal")), 1e-6);
    EXPECT_LT(difference(whole.column("foot", "shear"), pieces.column("foot", "shear")), 1e-6);
    std::cout << pieces.problem.substructures.size() << " pieces: " << pieces.result->mean_iterations
              << " iterations per step, corner x differs by "
              << difference(whole.column("corner", "x"), pieces.column("corner", "x")) << "\n";
  }
}

TEST(Cutting, tells_parts_that_are_too_small_for_the_pieces_asked_for) {
  testing::internal::CaptureStderr();
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function bar(name, z, n) return substructure{ name = name, material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 40*mm }, cells = { 2, 2, n }, origin = { 0, 0, z } } } end
local long, short = bar("long", 0, 8), bar("short", 40*mm, 4)
local tie = interface.bonded{ name = "tie", between = { long:face "zmax", short:face "zmin" } }
problem{ name = "bars", solver = solver.latin{ integration = "implicit", pieces = 4 }, substructures = { long, short }, interfaces = { tie },
  steps = { step.dynamic{ name = "rest", duration = 2*us, dt = 1*us, loads = { load.pressure{ on = short:face "zmax", history = 1*MPa } } } } }:run{}
)")
                          .at(0);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("solver.latin{ pieces = 4 } leaves 'short' in 2: a piece has 8 cells or more"), std::string::npos)
      << told;
  EXPECT_EQ(told.find("'long' in"), std::string::npos) << told;
}

TEST(Cutting, pieces_across_a_contact_plane_give_the_same_contact) {
  const DeckRun slabs = block({{"nz", "2"}, {"contact", "1"}});
  const DeckRun pieces = block({{"nx", "2"}, {"ny", "3"}, {"nz", "2"}, {"contact", "1"}});
  EXPECT_TRUE(pieces.result->converged);
  EXPECT_LT(difference(slabs.column("corner", "z"), pieces.column("corner", "z")), 1e-6);
  EXPECT_LT(difference(slabs.column("corner", "x"), pieces.column("corner", "x")), 1e-6);
}

TEST(Window, any_window_gives_the_answer_of_any_other) {
  const DeckRun one = block({{"nz", "2"}});
  for (const char* window : {"4", "7", "20", "0"}) {  // 0: the whole interval, as the paper has it
    const DeckRun many = block({{"nz", "2"}, {"window", window}});
    EXPECT_TRUE(many.result->converged) << window;
    EXPECT_LT(difference(one.column("corner", "x"), many.column("corner", "x")), 1e-6) << window;
    EXPECT_LT(difference(one.column("foot", "normal"), many.column("foot", "normal")), 1e-6) << window;
  }
}

// The paper's own way, on the paper's second example: 2.4 transits of a bar in one window.
TEST(Window, the_whole_interval_gives_the_yielding_beam_too) {
  std::ifstream file(deck("plastic_beam.lua"));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  text.replace(
      text.find("steps = { pull },"), 17,
      "steps = { pull }, solver = solver.latin{ integration = 'implicit', window = 'whole', tolerance = 1e-5 },");
  const DeckRun whole = run_text(text).at(0),
                steps = run_file(deck("plastic_beam.lua"), {}, 0, "latin{ integration = 'implicit' }").at(0);
  EXPECT_TRUE(whole.result->converged);
  EXPECT_LT(difference(steps.column("through", "normal"), whole.column("through", "normal")), 1e-4);
  EXPECT_LT(difference(steps.column("yielding", "plastic_opening"), whole.column("yielding", "plastic_opening")), 1e-4);
  std::cout << whole.result->mean_iterations << " sweeps of 240 steps, step by step " << steps.result->mean_iterations
            << " iterations\n";
}

// Over so many crossings the iteration sends the fields away.
TEST(Window, that_finds_no_answer_stops_and_says_so) {
  const std::string text = R"(
    local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
    local below = substructure{ name = "below", material = steel, mesh = mesh.box{ size = { 240*mm, 20*mm, 10*mm }, cells = { 12, 2, 2 } } }
    local above = substructure{ name = "above", material = steel, mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 240*mm, 20*mm, 10*mm }, cells = { 12, 2, 2 } } }
    local lap = interface.contact{ name = "lap", between = { below:face "zmax", above:face "zmin" }, friction = 0.5 }
    local held = support.fixed{ name = "held", on = { below:face "xmin", above:face "xmin" } }
    local push = step.dynamic{ name = "push", duration = 2*ms, dt = 20*us, loads = { load.pressure{ on = above:face "zmax", history = 1*MPa } } }
    problem{ name = "long", substructures = { below, above }, interfaces = { lap }, supports = { held }, steps = { push },
      outputs = { output.history{ name = "tip", on = above:face "xmax", quantity = "displacement" } },
      solver = solver.latin{ integration = "implicit", window = "whole", max_iterations = 60 } }:run{}
  )";
  try {
    run_text(text);
    ADD_FAILURE() << "an answer";
  } catch (const NumericalError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("step 'push', time steps 1 to 100, which 'window' iterates together: the iteration has"),
              std::string::npos)
        << what;
    EXPECT_NE(what.find("omit 'window'"), std::string::npos) << what;
  }
  EXPECT_TRUE(run_text(text, {}, 0, "latin{ integration = 'implicit' }").at(0).result->converged);
}

// The interface fields are the solution: a case that starts from them is solved before it begins.
TEST(StartFrom, an_equal_case_needs_one_iteration_a_step_and_another_case_gives_its_own_answer) {
  std::string text = cut_block;
  text.replace(text.find("problem{ name"), 7,
               "local function block(friction) wall = support.wall{ name = 'wall', on = bottom, friction = friction "
               "}\n  foot = output.joint{ name = 'foot', on = wall }\n  return problem");
  text.replace(text.find("local wall = "), 6, "local wall; ");
  text.replace(text.find("local foot = "), 6, "local foot; ");
  text.replace(
      text.find(":run{}"), 6,
      " end\nlocal first = block(0.3):run{ case = 'first' }\nblock(0.3):run{ case = 'again', start_from = first }\n"
      "block(0.6):run{ case = 'rougher', start_from = first }\nblock(0.6):run{ case = 'cold' }");
  const std::vector<DeckRun> runs = run_text(text, {{"nx", "2"}, {"nz", "2"}});
  const DeckRun &first = runs.at(0), &again = runs.at(1), &rougher = runs.at(2), &cold = runs.at(3);
  EXPECT_EQ(again.result->mean_iterations, 1.0);
  EXPECT_LT(difference(first.column("corner", "x"), again.column("corner", "x")), 1e-7);
  EXPECT_LT(difference(cold.column("corner", "x"), rougher.column("corner", "x")), 1e-6);
  EXPECT_GT(difference(cold.column("corner", "x"), first.column("corner", "x")), 1e-3);
  std::cout << "cold " << cold.result->mean_iterations << ", started from another friction "
            << rougher.result->mean_iterations << " iterations per step\n";
}

TEST(Forms, the_condensed_form_equals_full_solves) {
  const DeckRun condensed = block({{"nx", "2"}, {"nz", "2"}, {"contact", "1"}});
  const DeckRun plain = block({{"nx", "2"}, {"nz", "2"}, {"contact", "1"}, {"plain", "1"}});
  EXPECT_LT(difference(condensed.column("corner", "x"), plain.column("corner", "x")), 1e-8);
  EXPECT_LT(difference(condensed.column("foot", "normal"), plain.column("foot", "normal")), 1e-8);
  EXPECT_LE(condensed.result->iterations, plain.result->iterations);  // which have no rough operator
}

TEST(Threads, any_number_of_threads_gives_the_same_bits) {
  const Settings cut{{"nx", "2"}, {"ny", "2"}, {"nz", "2"}};
  const DeckRun one = block(cut, 1), two = block(cut, 2), three = block(cut, 3);
  EXPECT_EQ(one.column("corner", "x"), two.column("corner", "x"));
  EXPECT_EQ(one.column("foot", "normal"), two.column("foot", "normal"));
  EXPECT_EQ(one.column("foot", "normal"), three.column("foot", "normal"));
  EXPECT_EQ(one.column("energy", "balance"), two.column("energy", "balance"));
}

}  // namespace
}  // namespace dygita::test::cutting_tests

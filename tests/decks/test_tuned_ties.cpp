// A tuned mass goes through ties whose nodes meet, bonded and cyclic: where places are alike, so are their motions.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_prints.hpp"

namespace dygita::test::tuned_ties_tests {
namespace {

// A sector of a ring, its bottom held or free, blown up or pushed down: all places around are alike. split: in so many
// parts; way: cut by cyclic ties or held by symmetry, or (2) all of the ring.
const std::string sector = R"(
local p = param{ way = 0, split = 1, pieces = 1, tuned = 1, explicit = 1, push = 0, fine = 1, shift = 0, steps = 1 }
local n, k, around = 8, math.tointeger(p.split), 45
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local f = math.tointeger(p.fine)
local wedge = mesh.gmsh{ file = ")" +
                           std::string(DYGITA_SOURCE_DIR) +
                           R"(/meshes/wedge.geo", set = { inner = 30*mm, outer = 50*mm, low = 0, high = 10*mm,
  from = 0, to = around / k, n_radial = 4 * f, n_around = (k == 1 and 6 or 4) * f, n_high = 2 * f } }:volume "wedge"
local parts, joints, supports, outputs, inner, bottom, top = {}, {}, {}, {}, {}, {}, {}
local last = p.way == 2 and n * k or k
for i = 1, last do
  local part = substructure{ name = "part " .. i, material = steel, mesh = wedge, place = { rotate = { axis = { 0, 0, 1 }, angle = ((i - 1) * around / k + p.shift) * deg } } }
  parts[i], inner[i], bottom[i], top[i] = part, part:face "inner", part:face "bottom", part:face "top"
end
for i = 1, p.way == 2 and last or last - 1 do
  table.insert(joints, interface.bonded{ name = "joint " .. i, between = { parts[i]:face "left", parts[i % last + 1]:face "right" } })
end
if p.way == 0 then table.insert(joints, interface.cyclic{ name = "cut", between = { parts[k]:face "left", parts[1]:face "right" }, axis = { 0, 0, 1 }, n = n }) end
if p.way == 1 then supports = { support.symmetry{ name = "left", on = parts[k]:face "left" }, support.symmetry{ name = "right", on = parts[1]:face "right" } } end
if p.push == 1 then table.insert(supports, support.fixed{ name = "table", on = bottom }) end
for i = 1, last do
  for _, s in ipairs{ 0, 0.5, 1 } do
    local a = ((i - 1 + s) * around / k + p.shift) * math.pi / 180
    local at = parts[i]:where(function(x, y, z) return near(z, 10*mm) and near(x, 50*mm * math.cos(a)) and near(y, 50*mm * math.sin(a)) end)
    table.insert(outputs, output.history{ name = ("u %d %g"):format(i, s), on = at, quantity = "displacement",
      direction = p.push == 1 and { 0, 0, 1 } or { math.cos(a), math.sin(a), 0 } })
  end
end
table.insert(outputs, output.energy{})
if p.way == 2 or k > 1 then table.insert(outputs, output.resultant{ name = "joint", on = joints[1] }) end
local pulse = history.half_sine{ peak = 100*MPa, duration = 5*us }
local loads = { p.push == 1 and load.traction{ on = top, z = pulse } or load.pressure{ on = inner, history = pulse } }
local steps = {}
for i = 1, p.steps do
  steps[i] = step.dynamic{ name = "step " .. i, after = steps[i - 1], duration = 60 / p.steps * us, dt = 0.5 / p.fine * us, loads = i == 1 and loads or {} }
end
problem{ name = "sector", substructures = parts, interfaces = joints, supports = supports, outputs = outputs, steps = steps,
  solver = solver.latin{ integration = p.explicit == 1 and "explicit" or "implicit", mass = p.tuned == 1 and "tuned" or "lumped", pieces = p.pieces } }:run{}
)";

const char* const anywhere = "u 1 0.5";

// Of the motion at every place from that at the first, of the largest.
double unlike(const DeckRun& run, int parts) {
  const std::vector<double>& first = run.column("u 1 0", "displacement");
  double most = 0.0;
  for (int i = 1; i <= parts; ++i)
    for (const char* s : {"0", "0.5", "1"})
      most = std::max(most, difference(first, run.column(fmt::format("u {} {}", i, s), "displacement")));
  return most;
}

double imbalance(const DeckRun& run) {
  return largest(run.column("energy", "balance")) / largest(run.column("energy", "loads"));
}

TEST(TunedTies, places_that_are_alike_move_alike) {
  for (const char* push : {"0", "1"})
    for (const Settings& how :
         {Settings{}, Settings{{"split", "2"}}, Settings{{"split", "2"}, {"pieces", "3"}}, Settings{{"split", "3"}},
          Settings{{"way", "2"}}, Settings{{"way", "2"}, {"shift", "13"}}, Settings{{"split", "2"}, {"steps", "2"}}}) {
      Settings settings = how;
      settings.push_back({"push", push});
      const DeckRun run = run_text(sector, settings).at(0);
      const int parts = how.empty() ? 1 : how[0].first == "way" ? 8 : std::stoi(how[0].second);
      std::cout << "push " << push << (how.empty() ? "" : ", " + how[0].first + " " + how[0].second) << ": unlike by "
                << unlike(run, parts) << ", imbalance " << imbalance(run) << "\n";
      EXPECT_LT(unlike(run, parts), 1e-5);
      EXPECT_LT(imbalance(run), 1e-7);  // cyclic ties take turns
    }
}

TEST(TunedTies, a_sector_moves_as_its_ring_and_as_one_between_planes_of_symmetry) {
  for (const char* push : {"0", "1"}) {
    const DeckRun cyclic = run_text(sector, {{"push", push}}).at(0),
                  symmetric = run_text(sector, {{"push", push}, {"way", "1"}}).at(0),
                  ring = run_text(sector, {{"push", push}, {"way", "2"}}).at(0);
    EXPECT_EQ(ring.result->steps[0].substeps, cyclic.result->steps[0].substeps);
    EXPECT_LT(difference(cyclic.column(anywhere, "displacement"), symmetric.column(anywhere, "displacement")), 1e-5)
        << push;
    EXPECT_LT(difference(cyclic.column(anywhere, "displacement"), ring.column(anywhere, "displacement")), 1e-5) << push;
  }
}

TEST(TunedTies, forces_of_the_joints_are_those_of_implicit_parts) {
  const auto force = [](const char* is_explicit, const char* tuned, const char* fine) {
    return run_text(sector, {{"way", "2"}, {"explicit", is_explicit}, {"tuned", tuned}, {"fine", fine}})
        .at(0)
        .column("joint", "normal");
  };
  const std::vector<double> coarse = force("1", "1", "1");
  const double peak = largest(coarse), implicit = largest(force("0", "0", "1"));
  std::cout << "force of a joint " << peak << ", of implicit ones " << implicit << " N\n";
  EXPECT_NEAR(peak, implicit, 0.03 * implicit);
}

// Against cells a quarter of the size: closer than lumped masses at every place.
TEST(TunedTies, are_closer_to_finer_cells_than_lumped_masses) {
  const auto motion = [](const char* tuned, const char* fine) {
    return run_text(sector, {{"split", "2"}, {"tuned", tuned}, {"fine", fine}}).at(0).column(anywhere, "displacement");
  };
  const std::vector<double> finer = motion("1", "4");
  const auto error = [&](const std::vector<double>& coarse) {
    double square = 0.0, all = 0.0;
    for (size_t i = 0; i < coarse.size(); ++i) {
      square += std::pow(coarse[i] - finer.at(4 * i), 2);
      all += std::pow(finer.at(4 * i), 2);
    }
    return std::sqrt(square / all);
  };
  const double tuned = error(motion("1", "1")), lumped = error(motion("0", "1"));
  std::cout << "off by " << 100 * tuned << " % (tuned), " << 100 * lumped << " % (lumped)\n";
  EXPECT_LT(tuned, 0.6 * lumped);
}

}  // namespace
}  // namespace dygita::test::tuned_ties_tests

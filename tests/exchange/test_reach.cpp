// What one of several ranks builds of the points of a step, against building all of them and leaving what it solves.
#include <gtest/gtest.h>

#include "exchange/near_points.hpp"
#include "step/blocks.hpp"

namespace dygita::reach_tests {
namespace {

constexpr int n_ranks = 3;

// Four cubes around an edge, tied and in contact, one with another mesh on top, one on a wall: nodes under several
// laws, groups of many pieces, points that share nodes.
Problem pile() {
  Problem problem;
  const BlockPtr a = cube("a", 0, 0, 0, 4), b = cube("b", 1, 0, 0, 4), c = cube("c", 0, 0, 1, 4),
                 d = cube("d", 1, 0, 1, 4), e = cube("e", 1, 0, 2, 3), f = cube("f", 2, 0, 0, 4);
  problem.substructures = {a, b, c, d, e, f};
  problem.interfaces = {interface("ab", face(a, "xmax"), face(b, "xmin"), bonded()),
                        interface("ac", face(a, "zmax"), face(c, "zmin"), contact(0.2)),
                        interface("bd", face(b, "zmax"), face(d, "zmin"), contact(0.2)),
                        interface("cd", face(c, "xmax"), face(d, "xmin"), bonded()),
                        interface("de", face(d, "zmax"), face(e, "zmin"), contact(0.0)),
                        interface("bf", face(b, "xmax"), face(f, "xmin"), plastic(400e6))};
  const auto wall = support("wall", {face(a, "zmin")}, {{"friction", 0.1}, {"gap", 0.0}});
  problem.steps = {dynamic_step("test", 1, 0.5e-6, {})};
  problem.supports = {wall};
  problem.solver.pieces = 3;
  return problem;
}

// Pieces in turn to three ranks, of which this one is the first.
std::shared_ptr<Cut> shared_cut(const Problem& problem, const std::vector<Surface>& surfaces, int turn) {
  auto cut = std::make_shared<Cut>(*make_cut(problem, surfaces));
  for (int i = 0; i < cut->n_pieces(); ++i) cut->give(i, (i + turn) % n_ranks);
  return cut;
}

std::vector<double> numbers_of(const Cut& cut, const Exchange& exchange, const Point& point) {
  std::vector<double> all(point.frame.data(), point.frame.data() + 9);
  all.push_back(point.area);
  for (int d = 0; d < 3; ++d) all.push_back(point.has_law[d] + 2 * point.is_active[d]);
  for (const bool is_so : {point.is_direct, point.is_everywhere, point.is_wall}) all.push_back(is_so);
  for (const Member& m : point.members) all.insert(all.end(), {1.0 * m.surface, 1.0 * m.point, m.share});
  for (int p = point.first_port; p < point.end_port; ++p) {
    const Port& port = exchange.ports[p];
    all.insert(all.end(), {1.0 * port.piece, 1.0 * port.piece_node, 1.0 * port.is_owner, port.area,
                           1.0 * (p < point.first_port_2)});
    for (int d = 0; d < 3; ++d) {
      all.push_back(port.is_held[d]);
      all.push_back(cut.is_here(port.piece) ? port.unknown[d] : -2);  // others' are heard
    }
  }
  for (int t = point.first_tie; t < point.end_tie; ++t) {
    const Tie& tie = exchange.ties[t];
    all.insert(all.end(), {1.0 * tie.port_1 - point.first_port, 1.0 * tie.port_2 - point.first_port, 1.0 * tie.surface,
                           1.0 * tie.surface_point});
  }
  if (point.first_tie < point.end_tie) {
    const Mat& split = exchange.splits.of(point);
    all.insert(all.end(), split.data(), split.data() + split.size());
  }
  return all;
}

void expect_same(const Cut& cut, const Exchange& one, const Exchange& other) {
  ASSERT_EQ(one.points.size(), other.points.size());
  ASSERT_EQ(one.ports.size(), other.ports.size());
  ASSERT_EQ(one.ties.size(), other.ties.size());
  for (size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(one.points[i].law, other.points[i].law);
    EXPECT_EQ(numbers_of(cut, one, one.points[i]), numbers_of(cut, other, other.points[i])) << "point " << i;
  }
  for (int piece = 0; piece < cut.n_pieces(); ++piece) {
    if (!cut.is_here(piece)) continue;
    EXPECT_EQ(one.n_unknowns[piece], other.n_unknowns[piece]);
  }
}

class OfARank : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(OfARank, is_built_as_what_it_solves_of_the_whole) {
  const auto [turn, integration, everywhere] = GetParam();
  const Problem problem = pile();
  const std::vector<Surface> surfaces = make_surfaces(problem);
  const std::shared_ptr<Cut> cut = shared_cut(problem, surfaces, turn);
  const Step& step = *problem.steps[0];
  const Conditions conditions = make_conditions(problem, step, initial_state(problem, surfaces, *cut));
  std::vector<char> explicit_pieces, of_all(surfaces.size(), 0);
  for (int i = 0; i < cut->n_pieces() && integration > 0; ++i)
    explicit_pieces.push_back(integration == 1 || cut->piece(i).part % 2 == 1);
  if (everywhere >= 0) of_all[everywhere] = 1;
  Exchange whole = make_exchange(problem, step, *cut, surfaces, conditions, explicit_pieces);
  const size_t n_all = whole.points.size();
  for (Point& point : whole.points) point.is_everywhere = point.law && point.members.front().surface == everywhere;
  keep_near(*cut, whole);
  whole.splits = TieSplits(whole.points, whole.ties, surfaces);
  const Reach reach(problem, step, *cut, surfaces, explicit_pieces, of_all);
  expect_same(*cut, make_exchange(problem, step, *cut, surfaces, conditions, explicit_pieces, reach), whole);
  EXPECT_LT(whole.points.size(), n_all);
}

// Explicit: no substructure, all, every second one. Everywhere: none, a bolt, a face that does not match.
INSTANTIATE_TEST_SUITE_P(Exchange, OfARank,
                         testing::Combine(testing::Values(0, 1, 2), testing::Values(0, 1, 2),
                                          testing::Values(-1, 5, 4)));

TEST(Reach, of_one_process_is_everything) {
  EXPECT_TRUE(Reach().is_all());
  EXPECT_TRUE(Reach().has(0, 0));
  EXPECT_FALSE(Reach().is_everywhere(0));
}

}  // namespace
}  // namespace dygita::reach_tests

// Forces of a group of ties, from the table that groups share.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <numeric>

#include "exchange/exchange.hpp"

namespace dygita::test {
namespace {

// Four bodies that meet at an edge, tied in a ring, twice; then two bodies that are tied at a node.
struct Groups {
  std::vector<Surface> surfaces;
  std::vector<Point> points;
  std::vector<Tie> ties;

  void add(int n_ports, const std::vector<std::pair<int, int>>& pairs, const std::vector<double>& areas) {
    Point point;
    point.first_port = points.empty() ? 0 : points.back().end_port;
    point.first_port_2 = point.end_port = point.first_port + n_ports;
    point.first_tie = static_cast<int>(ties.size());
    for (size_t t = 0; t < pairs.size(); ++t) {
      Surface& surface = surfaces.emplace_back();
      surface.facing.areas = Vec::Constant(1, areas[t]);
      ties.push_back({static_cast<int>(points.size()), point.first_port + pairs[t].first,
                      point.first_port + pairs[t].second, static_cast<int>(surfaces.size()) - 1, 0});
    }
    point.end_tie = static_cast<int>(ties.size());
    points.push_back(point);
  }
};

TEST(TieSplits, are_the_least_norm_weighted_with_areas) {
  Groups groups;
  const std::vector<std::pair<int, int>> ring{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  groups.add(4, ring, {1e-6, 2e-6, 3e-6, 1e-6});
  groups.add(4, ring, {1e-6, 1e-6, 1e-6, 5e-7});
  groups.add(4, ring, {1e-6, 2e-6, 3e-6, 1e-6});
  groups.add(2, {{0, 1}}, {4e-6});
  groups.add(2, {{1, 0}}, {4e-6});
  const TieSplits splits(groups.points, groups.ties, groups.surfaces);
  EXPECT_EQ(&splits.of(groups.points[0]), &splits.of(groups.points[2]));
  EXPECT_NE(&splits.of(groups.points[0]), &splits.of(groups.points[1]));
  EXPECT_NE(&splits.of(groups.points[3]), &splits.of(groups.points[4]));
  for (const Point& point : groups.points) {
    const int n_ports = point.end_port - point.first_port, n_ties = point.end_tie - point.first_tie;
    Vec net = Vec::LinSpaced(n_ports, -1.0, 2.5);
    net[0] -= net.sum();
    Mat incidence = Mat::Zero(n_ports, n_ties);
    Vec area(n_ties);
    for (int t = 0; t < n_ties; ++t) {
      const Tie& tie = groups.ties[static_cast<size_t>(point.first_tie + t)];
      area[t] = groups.surfaces[static_cast<size_t>(tie.surface)].facing.areas[0];
      incidence(tie.port_1 - point.first_port, t) = 1.0;
      incidence(tie.port_2 - point.first_port, t) = -1.0;
    }
    const Vec forces = splits.of(point) * net;
    EXPECT_LT((incidence * forces - net).norm(), 1e-13);
    const Vec root = area.cwiseSqrt();
    const Vec plain =
        root.cwiseProduct(Vec((incidence * root.asDiagonal()).completeOrthogonalDecomposition().solve(net)));
    EXPECT_LT((forces - plain).norm(), 1e-13 * plain.norm());
  }
}

}  // namespace
}  // namespace dygita::test

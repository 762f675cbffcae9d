#include <cmath>
#include <map>

#include "exchange/exchange.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

Mat split_of(std::span<const Tie> ties, int first_port, int n_ports, const std::vector<Surface>& surfaces) {
  const auto n_ties = static_cast<Eigen::Index>(ties.size());
  if (n_ties == 1) return Mat::Identity(n_ports, n_ports).row(ties[0].port_1 - first_port);
  Mat incidence = Mat::Zero(n_ports, n_ties);
  Vec root_area(n_ties);
  for (Eigen::Index t = 0; t < n_ties; ++t) {
    const Tie& tie = ties[static_cast<size_t>(t)];
    root_area[t] = std::sqrt(surfaces[tie.surface].facing.areas[tie.surface_point]);
    incidence(tie.port_1 - first_port, t) = root_area[t];
    incidence(tie.port_2 - first_port, t) = -root_area[t];
  }
  return root_area.asDiagonal() * pseudo_inverse(incidence);
}

}  // namespace

TieSplits::TieSplits(const std::vector<Point>& points, const std::vector<Tie>& ties,
                     const std::vector<Surface>& surfaces)
    : of_tie_(ties.size(), -1) {
  std::map<std::vector<double>, int> known;
  std::vector<double> key;
  for (const Point& point : points) {
    if (point.first_tie == point.end_tie) continue;
    const std::span<const Tie> own(ties.data() + point.first_tie, ties.data() + point.end_tie);
    const int n_ports = point.end_port - point.first_port;
    key.assign(1, n_ports);
    for (const Tie& tie : own)
      for (const double part :
           {static_cast<double>(tie.port_1 - point.first_port), static_cast<double>(tie.port_2 - point.first_port),
            own.size() == 1 ? 0.0 : surfaces[tie.surface].facing.areas[tie.surface_point]})
        key.push_back(part);
    const auto [at, is_new] = known.try_emplace(key, static_cast<int>(splits_.size()));
    if (is_new) splits_.push_back(split_of(own, point.first_port, n_ports, surfaces));
    of_tie_[point.first_tie] = at->second;
  }
}

}  // namespace dygita

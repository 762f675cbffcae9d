#include "solution/loose_motions.hpp"

#include <map>

#include "base/union_find.hpp"
#include "law/law.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

using Gram = Eigen::Matrix<double, 6, 6>;

// What the sum of squares leaves free, one column a motion.
Mat null_space(const Gram& gram) {
  constexpr double nothing = 1e-8;
  const EigenPairs eigen = symmetric_eigen(gram);
  Eigen::Index n = 0;
  while (n < 6 && eigen.values[n] <= nothing * std::max(eigen.values[5], std::numeric_limits<double>::min())) ++n;
  return eigen.vectors.leftCols(n);
}

}  // namespace

LooseMotions::LooseMotions(const StepModel& model) : model_(&model), frame_(extent_of(model.problem->substructures)) {
  const Problem& problem = *model.problem;
  for (size_t part = 0; part < problem.substructures.size(); ++part) {
    Gram& gram = held_.emplace_back(Gram::Zero());
    const Substructure& body = *problem.substructures[part];
    for (const auto& [node, held] : model.conditions.held[part])
      for (int j = 0; j < held.n; ++j) {
        const RigidMotion row = frame_.row(RigidFrame::place_of_node(body, node), held.directions.col(j));
        gram += row * row.transpose();
      }
  }
}

LooseMotions::Motions LooseMotions::motions_of(const Point& point, const Port& port) const {
  const Substructure& body = *model_->problem->substructures[static_cast<size_t>(port.part)];
  Motions motions;
  for (int d = 0; d < 3; ++d) motions.row(d) = frame_.row(body, port, point.frame.col(d));
  return motions;
}

std::vector<Vec3> LooseMotions::find(const Increment& increment) const {
  constexpr double nothing = 1e-9;  // of the largest motion
  const Exchange& exchange = model_->exchange;
  const int ground = static_cast<int>(held_.size());
  UnionFind linked(ground + 1);
  const auto part_of = [&](int p) { return exchange.ports[static_cast<size_t>(p)].part; };
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    for (int p = point.first_port + 1; p < point.first_port_2; ++p) linked.join(part_of(p), part_of(point.first_port));
    for (int p = point.first_port_2 + 1; p < point.end_port; ++p) linked.join(part_of(p), part_of(point.first_port_2));
    if (point.law && (point.law->is_tie() || increment.carries(static_cast<int>(i))))
      linked.join(part_of(point.first_port), point.is_wall ? ground : part_of(point.first_port_2));
  }
  struct Group {
    Gram held = Gram::Zero(), square = Gram::Zero();
    RigidMotion moved = RigidMotion::Zero();
    RigidMotion motion = RigidMotion::Zero();
  };
  std::map<int, Group> groups;
  for (int part = 0; part < ground; ++part) groups[linked.root(part)].held += held_[static_cast<size_t>(part)];
  groups.erase(linked.root(ground));
  std::erase_if(groups, [](const auto& group) { return null_space(group.second.held).cols() == 0; });
  if (groups.empty()) return {};
  const auto for_each_loose_port = [&](auto&& visit) {
    for (const Point& point : exchange.points)
      for (int p = point.first_port; p < point.end_port; ++p)
        if (const auto group = groups.find(linked.root(part_of(p))); group != groups.end())
          visit(point, p, group->second);
  };
  double largest = 0.0;
  for (const Point& point : exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p)
      for (int d = 0; d < 3; ++d)
        if (exchange.ports[static_cast<size_t>(p)].unknown[d] >= 0)
          largest = std::max(largest, std::abs(increment.moved(p, d)));
  for_each_loose_port([&](const Point& point, int p, Group& group) {
    const Port& port = exchange.ports[static_cast<size_t>(p)];
    const Motions motions = motions_of(point, port);
    for (int d = 0; d < 3; ++d) {
      if (port.unknown[d] < 0) continue;
      const RigidMotion row = motions.row(d);
      group.square += row * row.transpose();
      group.moved += increment.moved(p, d) * row;
    }
  });
  // Of the motions that supports leave, the nearest to how the ports move.
  for (auto& [at, group] : groups) {
    const Mat free = null_space(group.held);
    const Mat square = free.transpose() * group.square * free;
    group.motion = free * (pseudo_inverse(square) * (free.transpose() * group.moved));
  }
  std::vector<Vec3> found(exchange.ports.size(), Vec3::Zero());
  double largest_found = 0.0;
  for_each_loose_port([&](const Point& point, int p, const Group& group) {
    Vec3& own = found[static_cast<size_t>(p)];
    own = motions_of(point, exchange.ports[static_cast<size_t>(p)]) * group.motion;
    largest_found = std::max(largest_found, own.cwiseAbs().maxCoeff());
  });
  if (largest_found <= nothing * largest) found.clear();
  return found;
}

}  // namespace dygita

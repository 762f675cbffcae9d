#include "solution/loose_motions.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "law/law.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

// What the sum of squares leaves free, one column a motion.
Mat null_space(const Eigen::Matrix<double, 6, 6>& gram) {
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
    Mat6& gram = held_.emplace_back(Mat6::Zero());
    const Substructure& body = *problem.substructures[part];
    for (const auto& [node, held] : model.conditions.held[part])
      for (int j = 0; j < held.n; ++j) {
        const RigidMotion row = frame_.row(RigidFrame::place_of_node(body, node), held.directions.col(j));
        gram += row * row.transpose();
      }
  }
  UnionFind linked = linked_parts([](int) { return false; });
  may_be_ = !loose_groups(linked).empty();
}

// Parts by what moves as one, after them the ground.
UnionFind LooseMotions::linked_parts(const std::function<bool(int point)>& carries) const {
  const Exchange& exchange = model_->exchange;
  const int ground = static_cast<int>(held_.size());
  UnionFind linked(ground + 1);
  const auto part_of = [&](int p) { return exchange.ports[static_cast<size_t>(p)].part; };
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    for (int p = point.first_port + 1; p < point.first_port_2; ++p) linked.join(part_of(p), part_of(point.first_port));
    for (int p = point.first_port_2 + 1; p < point.end_port; ++p) linked.join(part_of(p), part_of(point.first_port_2));
    if (point.law && (point.law->is_tie() || carries(static_cast<int>(i))))
      linked.join(part_of(point.first_port), point.is_wall ? ground : part_of(point.first_port_2));
  }
  return linked;
}

LooseMotions::Groups LooseMotions::loose_groups(UnionFind& linked) const {
  Groups groups;
  const int ground = static_cast<int>(held_.size());
  for (int part = 0; part < ground; ++part) groups[linked.root(part)].held += held_[static_cast<size_t>(part)];
  groups.erase(linked.root(ground));
  for (auto& [at, group] : groups) group.free = null_space(group.held);
  std::erase_if(groups, [](const auto& group) { return group.second.free.cols() == 0; });
  return groups;
}

// Of what was to be taken back as much as leaves no side inside another one: the nearest by the squares at the ports
// (Hildreth 1957, one contact after the other).
void LooseMotions::keep_apart(const Increment& increment, UnionFind& linked, double precision, Groups& groups) const {
  constexpr int most_sweeps = 5000, some_sweeps = 100;
  struct Contact {
    double gap, pressed = 0.0, inverse = 0.0;
    struct End {
      Group* group;
      Vec closing, answer;  // of the group's free motions; how these give way
    };
    std::vector<End> ends;
  };
  const Exchange& exchange = model_->exchange;
  std::vector<Contact> contacts;
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    if (!point.law) continue;
    // Apart by more than the sweeps leave: a force would answer to what is left of a penetration.
    Contact contact{increment.gap(static_cast<int>(i)) - 2.0 * precision, 0.0, 0.0, {}};
    if (!std::isfinite(contact.gap)) continue;
    for (const auto& [p, sign] : {std::pair{point.first_port, -1.0}, {point.first_port_2, 1.0}}) {
      if (p == point.end_port) continue;  // a wall
      const Port& port = exchange.ports[static_cast<size_t>(p)];
      const auto group = groups.find(linked.root(port.part));
      if (group == groups.end()) continue;
      const Vec closing = sign * (motions_of(point, port).row(0) * group->second.free).transpose();
      contact.ends.push_back({&group->second, closing, group->second.inverse * closing});
    }
    const bool is_one = contact.ends.size() == 2 && contact.ends[0].group == contact.ends[1].group;
    for (const Contact::End& end : contact.ends) contact.inverse += end.closing.dot(end.answer);
    if (contact.inverse > 0.0 && !is_one) contacts.push_back(std::move(contact));
  }
  double worst = std::numeric_limits<double>::infinity(), earlier = worst;
  for (int sweep = 0; sweep < most_sweeps && worst > precision; ++sweep) {
    if (sweep % some_sweeps == 0 && worst > 0.9 * std::exchange(earlier, worst)) break;
    worst = 0.0;
    for (Contact& contact : contacts) {
      double closed = -contact.gap;
      for (const Contact::End& end : contact.ends) closed += end.closing.dot(end.group->taken);
      const double change = std::max(-contact.pressed, closed / contact.inverse);
      worst = std::max(worst, std::abs(change) * contact.inverse);
      contact.pressed += change;
      for (const Contact::End& end : contact.ends) end.group->taken -= change * end.answer;
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
  constexpr double nothing = 1e-9, precise = 1e-12;  // of the largest motion
  const Exchange& exchange = model_->exchange;
  UnionFind linked = linked_parts(increment.carries);
  Groups groups = loose_groups(linked);
  if (groups.empty()) return {};
  const auto for_each_loose_port = [&](auto&& visit) {
    for (const Point& point : exchange.points)
      for (int p = point.first_port; p < point.end_port; ++p)
        if (const auto group = groups.find(linked.root(exchange.ports[static_cast<size_t>(p)].part));
            group != groups.end())
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
    group.inverse = pseudo_inverse(group.free.transpose() * group.square * group.free);
    group.taken = group.inverse * (group.free.transpose() * group.moved);
  }
  if (increment.gap) keep_apart(increment, linked, precise * largest, groups);
  std::vector<Vec3> found(exchange.ports.size(), Vec3::Zero());
  double largest_found = 0.0;
  for_each_loose_port([&](const Point& point, int p, const Group& group) {
    Vec3& own = found[static_cast<size_t>(p)];
    own = motions_of(point, exchange.ports[static_cast<size_t>(p)]) * (group.free * group.taken);
    largest_found = std::max(largest_found, own.cwiseAbs().maxCoeff());
  });
  if (largest_found <= nothing * largest) found.clear();
  return found;
}

}  // namespace dygita

#include "step/loose_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/union_find.hpp"
#include "law/law.hpp"
#include "numerics/dense.hpp"
#include "partition/all_pieces.hpp"
#include "step/distant_points.hpp"

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
        const RigidMotion row = frame_.row(body, node, held.directions.col(j));
        gram += row * row.transpose();
      }
    const auto resisted = frame_.resisted(body);
    gram += resisted * resisted.transpose();
  }
  may_be_ = !loose_groups(linked_parts([](int) { return false; })).empty();
}

LooseMotions::Linked LooseMotions::linked_parts(const std::function<bool(int point)>& carries) const {
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
  if (is_shared_out()) {
    std::vector<double> roots;
    for (int part = 0; part <= ground; ++part) roots.push_back(linked.root(part));
    for (const std::vector<double>& of_rank : ranks::of_all(roots))
      for (int part = 0; part <= ground; ++part)
        linked.join(part, static_cast<int>(of_rank[static_cast<size_t>(part)]));
  }
  std::vector<int> first(static_cast<size_t>(ground) + 1, -1);
  Linked found;
  for (int part = 0; part <= ground; ++part) {
    int& of_set = first[static_cast<size_t>(linked.root(part))];
    if (of_set < 0) of_set = part;
    found.push_back(of_set);
  }
  return found;
}

LooseMotions::Groups LooseMotions::loose_groups(const Linked& linked) const {
  Groups groups;
  for (size_t part = 0; part < held_.size(); ++part) groups[linked[part]].held += held_[part];
  groups.erase(linked.back());
  for (auto& [at, group] : groups) group.free = null_space(group.held);
  std::erase_if(groups, [](const auto& group) { return group.second.free.cols() == 0; });
  return groups;
}

// How the ports of each group move, and the squares of its motions there: piece by piece, whoever has them.
void LooseMotions::add_motions(const Increment& increment, const Linked& linked, Groups& groups) const {
  constexpr size_t width = 6 * 6 + 6;
  const Cut& cut = *model_->cut;
  const Exchange& exchange = model_->exchange;
  std::vector<double> sums(width * static_cast<size_t>(cut.n_pieces()), 0.0);
  const auto square_of = [&](int piece) { return Eigen::Map<Mat6>(sums.data() + width * static_cast<size_t>(piece)); };
  const auto moved_of = [&](int piece) {
    return Eigen::Map<RigidMotion>(sums.data() + width * static_cast<size_t>(piece) + 36);
  };
  for (const Point& point : exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = exchange.ports[static_cast<size_t>(p)];
      if (!model_->solves(port.piece) || !groups.contains(linked[static_cast<size_t>(port.part)])) continue;
      const Motions motions = motions_of(point, port);
      for (int d = 0; d < 3; ++d) {
        if (port.unknown[d] < 0) continue;
        const RigidMotion row = motions.row(d);
        square_of(port.piece) += row * row.transpose();
        moved_of(port.piece) += increment.moved(p, d) * row;
      }
    }
  if (is_shared_out())
    segments_of(cut, std::vector<int>(static_cast<size_t>(cut.n_pieces()), static_cast<int>(width)))
        .complete(sums.data());
  for (int piece = 0; piece < cut.n_pieces(); ++piece) {
    const auto group = groups.find(linked[static_cast<size_t>(cut.piece(piece).part)]);
    if (group == groups.end()) continue;
    group->second.square += square_of(piece);
    group->second.moved += moved_of(piece);
  }
}

// A point whose sides may not pass through each other, one of them of a loose group at least.
struct LooseMotions::Contact {
  std::pair<int, int> at;  // surface, and point of it
  double gap = 0.0, pressed = 0.0, inverse = 0.0;
  struct End {
    Group* group;
    Vec closing, answer;  // of the group's free motions; how these give way
  };
  std::vector<End> ends;
};

// In the order of the surfaces and their points, each from the rank that books it.
std::vector<LooseMotions::Contact> LooseMotions::contacts_of(const Increment& increment, const Linked& linked,
                                                             double precision, Groups& groups) const {
  const Exchange& exchange = model_->exchange;
  std::vector<double> own;
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    if (!point.law || (is_shared_out() && DistantPoints::booking(*model_, point) != ranks::me())) continue;
    // Apart by more than the sweeps leave: a force would answer to what is left of a penetration.
    const double gap = increment.gap(static_cast<int>(i)) - 2.0 * precision;
    if (!std::isfinite(gap)) continue;
    const Member& first = point.members.front();
    for (const double value : {static_cast<double>(first.surface), static_cast<double>(first.point), gap})
      own.push_back(value);
    for (const auto& [p, sign] : {std::pair{point.first_port, -1.0}, {point.first_port_2, 1.0}}) {
      RigidMotion closing = RigidMotion::Zero();
      double group = -1.0;
      if (p != point.end_port) {  // else a wall
        const Port& port = exchange.ports[static_cast<size_t>(p)];
        group = linked[static_cast<size_t>(port.part)];
        closing = sign * motions_of(point, port).row(0).transpose();
      }
      own.push_back(group);
      own.insert(own.end(), closing.begin(), closing.end());
    }
  }
  std::vector<Contact> contacts;
  for (const std::vector<double>& of_rank :
       is_shared_out() ? ranks::of_all(own) : std::vector<std::vector<double>>{own})
    for (auto value = of_rank.begin(); value != of_rank.end();) {
      Contact contact;
      contact.at.first = static_cast<int>(*value++);
      contact.at.second = static_cast<int>(*value++);
      contact.gap = *value++;
      for (int side = 0; side < 2; ++side, value += 6) {
        const auto group = groups.find(static_cast<int>(*value++));
        if (group == groups.end()) continue;
        const Vec closing = group->second.free.transpose() * Eigen::Map<const RigidMotion>(&*value);
        contact.ends.push_back({&group->second, closing, group->second.inverse * closing});
      }
      const bool is_one = contact.ends.size() == 2 && contact.ends[0].group == contact.ends[1].group;
      for (const Contact::End& end : contact.ends) contact.inverse += end.closing.dot(end.answer);
      if (contact.inverse > 0.0 && !is_one) contacts.push_back(std::move(contact));
    }
  std::sort(contacts.begin(), contacts.end(), [](const Contact& a, const Contact& b) { return a.at < b.at; });
  return contacts;
}

// Of what was to be taken back as much as leaves no side inside another one: the nearest by the squares at the ports
// (Hildreth 1957, one contact after the other).
void LooseMotions::keep_apart(std::vector<Contact> contacts, double precision) const {
  constexpr int most_sweeps = 5000, some_sweeps = 100;
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
  const auto largest_of_all = [&](double own) { return is_shared_out() ? ranks::largest(own) : own; };
  const Linked linked = linked_parts(increment.carries);
  Groups groups = loose_groups(linked);
  if (groups.empty()) return {};
  double largest = 0.0;
  for (const Port& port : exchange.ports)
    for (int d = 0; d < 3; ++d)
      if (port.unknown[d] >= 0 && model_->solves(port.piece))
        largest = std::max(largest, std::abs(increment.moved(static_cast<int>(&port - exchange.ports.data()), d)));
  largest = largest_of_all(largest);
  add_motions(increment, linked, groups);
  // Of the motions that supports leave, the nearest to how the ports move.
  for (auto& [at, group] : groups) {
    group.inverse = pseudo_inverse(group.free.transpose() * group.square * group.free);
    group.taken = group.inverse * (group.free.transpose() * group.moved);
  }
  const double precision = precise * largest;
  if (increment.gap) keep_apart(contacts_of(increment, linked, precision, groups), precision);
  std::vector<Vec3> found(exchange.ports.size(), Vec3::Zero());
  double largest_found = 0.0;
  for (const Point& point : exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = exchange.ports[static_cast<size_t>(p)];
      const auto group = groups.find(linked[static_cast<size_t>(port.part)]);
      if (group == groups.end()) continue;
      Vec3& own = found[static_cast<size_t>(p)];
      own = motions_of(point, port) * (group->second.free * group->second.taken);
      largest_found = std::max(largest_found, own.cwiseAbs().maxCoeff());
    }
  if (largest_of_all(largest_found) <= nothing * largest) found.clear();
  return found;
}

}  // namespace dygita

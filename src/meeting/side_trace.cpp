#include "meeting/side_trace.hpp"

#include <algorithm>
#include <cmath>

namespace dygita {

SideTrace::SideTrace(const std::vector<int>& nodes) {
  for (const int node : nodes) add({{node, 1.0}});
}

void SideTrace::add(const std::vector<Share>& shares, const Mat3& turn) {
  shares_.insert(shares_.end(), shares.begin(), shares.end());
  first_.push_back(static_cast<int>(shares_.size()));
  turn_of_.push_back(-1);
  if (turn.isZero(0.0)) return;
  turn_of_.back() = static_cast<int>(turns_.size());
  turns_.push_back(turn);
}

void SideTrace::append(const SideTrace& other) {
  const auto n_shares = static_cast<int>(shares_.size()), n_turns = static_cast<int>(turns_.size());
  for (size_t i = 1; i < other.first_.size(); ++i) first_.push_back(other.first_[i] + n_shares);
  shares_.insert(shares_.end(), other.shares_.begin(), other.shares_.end());
  for (const int turn : other.turn_of_) turn_of_.push_back(turn < 0 ? -1 : turn + n_turns);
  turns_.insert(turns_.end(), other.turns_.begin(), other.turns_.end());
}

int SideTrace::main_node(int i) const {
  int best = 0;
  for (int k = 1; k < n_shares(i); ++k)
    if (std::abs(share(i, k).weight) > std::abs(share(i, best).weight)) best = k;
  return share(i, best).node;
}

Mat3 SideTrace::block(int i, int k) const {
  const Share& own = share(i, k);
  Mat3 block = own.weight * Mat3::Identity();
  for (int c = 0; c < 3 && turn_of_[i] >= 0; ++c) block.col(c) += turns_[turn_of_[i]] * own.arm.cross(Vec3::Unit(c));
  return rotation_ ? Mat3(*rotation_ * block) : block;
}

std::pair<SideTrace, std::vector<int>> SideTrace::on_its_nodes() const {
  std::vector<int> nodes;
  for (const Share& share : shares_) nodes.push_back(share.node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  SideTrace own = *this;
  for (Share& share : own.shares_)
    share.node = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), share.node) - nodes.begin());
  return {std::move(own), std::move(nodes)};
}

// The transpose of [d]x is - [d]x.
void SideTrace::spread(int i, const Vec3& on_point, Points& nodal) const {
  const Vec3 force = rotation_ ? Vec3(rotation_->transpose() * on_point) : on_point;
  const Vec3 turned = turn_of_[i] < 0 ? Vec3(Vec3::Zero()) : Vec3(turns_[turn_of_[i]].transpose() * force);
  for (int k = 0; k < n_shares(i); ++k) {
    const Share& own = share(i, k);
    if (own.weight == 1.0 && turn_of_[i] < 0)
      nodal.col(own.node) += force;
    else
      nodal.col(own.node) += own.weight * force - own.arm.cross(turned);
  }
}

}  // namespace dygita

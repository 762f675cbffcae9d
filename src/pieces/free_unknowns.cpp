#include "pieces/free_unknowns.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace dygita {

FreeUnknowns::FreeUnknowns(int n_nodes, const std::vector<InterfaceRow>& rows,
                           const std::unordered_map<int, Held>& held, const Interior& inside)
    : special_(n_nodes, -1), count_(n_nodes, 3), first_(n_nodes), inside_(&inside) {
  std::unordered_map<int, std::vector<Vec3>> wanted;
  for (const InterfaceRow& row : rows)
    if (row.is_of_one_node()) wanted[row.nodes[0].node].push_back(row.nodes[0].along);
  for (const auto& [node, conditions] : held) wanted[node];
  std::unordered_map<int, std::vector<Vec3>> absent;  // directions without an unknown
  for (const auto& [node, direction] : inside.absent) absent[node].push_back(direction);
  for (const auto& [node, directions] : absent) wanted[node];
  for (const Interior::Follower& own : inside.followers) {
    wanted[own.node];
    for (int d = 0; d < 3; ++d) absent[own.node].push_back(Vec3::Unit(d));
  }
  for (const auto& [node, directions] : wanted) {
    Held basis;
    if (const auto it = held.find(node); it != held.end()) basis = it->second;
    if (const auto it = absent.find(node); it != absent.end())
      for (const Vec3& d : it->second) {
        const Vec3 rest = d - basis.directions.leftCols(basis.n) * (basis.directions.leftCols(basis.n).transpose() * d);
        if (basis.n < 3 && rest.norm() > 1e-6) basis.directions.col(basis.n++) = rest.normalized();
      }
    const int n_held = basis.n, n_free = 3 - n_held;
    for (const Vec3& along : directions) {  // of sums they are as long as what the node counts
      const Vec3 d = along.normalized();
      if (basis.n < 3 && (basis.directions.leftCols(basis.n).transpose() * d).norm() < 1e-9)
        basis.directions.col(basis.n++) = d;
    }
    const auto rest = basis.free_basis();
    Mat3 free = Mat3::Zero();
    for (int j = 0; j < n_free; ++j)
      free.col(j) =
          n_held + j < basis.n ? Vec3(basis.directions.col(n_held + j)) : Vec3(rest.col(n_held + j - basis.n));
    special_[node] = static_cast<int>(bases_.size());
    count_[node] = n_free;
    bases_.push_back(free);
  }
  for (int node = 0; node < n_nodes; ++node) {
    first_[node] = static_cast<int>(node_of_unknown_.size());
    node_of_unknown_.insert(node_of_unknown_.end(), count_[node], node);
  }
  set_held(held);
  position_.resize(node_of_unknown_.size());
  std::iota(position_.begin(), position_.end(), 0);
}

FreeUnknowns::FreeUnknowns(const FreeUnknowns& equal, const Mat3& turn, const std::unordered_map<int, Held>& held)
    : FreeUnknowns(equal) {
  is_turned_ = !turn.isIdentity(0.0);
  axes_ = turn * equal.axes_;
  for (Mat3& basis : bases_) basis = turn * basis;
  set_held(held);
}

void FreeUnknowns::set_held(const std::unordered_map<int, Held>& held) {
  held_.clear();
  for (const auto& [node, own] : held)
    for (int j = 0; j < own.n; ++j) held_.push_back({node, own.directions.col(j), own.motion[j]});
  // They came out in hash order: reproducible sums need node order.
  std::stable_sort(held_.begin(), held_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
}

void FreeUnknowns::put_in_order(const std::vector<int>& order) {
  for (size_t i = 0; i < order.size(); ++i) position_[order[i]] = static_cast<int>(i);
}

Traces FreeUnknowns::traces(const std::vector<InterfaceRow>& rows) const {
  Traces traces;
  for (const InterfaceRow& row : rows) {
    for (const auto& [node, along] : row.nodes)
      for (int j = 0; j < count_[node]; ++j) {
        const double value = is_plain(node) ? along[j] : axes(node).col(j).dot(along);
        if (std::abs(value) >= (is_turned_ ? 1e-11 : 1e-12)) traces.add(at(node, j), value);
      }
    traces.end_row();
  }
  return traces;
}

std::vector<char> FreeUnknowns::at_rows(const std::vector<InterfaceRow>& rows) const {
  std::vector<char> is_at_rows(size(), 0);
  const Traces all = traces(rows);
  for (int i = 0; i < all.size(); ++i)
    for (int j = 0; j < all[i].n; ++j) is_at_rows[all[i].at[j]] = 1;
  return is_at_rows;
}

Traces FreeUnknowns::held_traces(const std::vector<InterfaceRow>& rows) const {
  Traces traces;
  for (const InterfaceRow& row : rows) {
    for (const auto& [node, along] : row.nodes) {
      for (auto held = first_held(node); held != held_.end() && held->node == node; ++held)
        if (const double value = held->direction.dot(along); std::abs(value) >= 1e-12)
          traces.add(static_cast<int>(held - held_.begin()), value);
    }
    traces.end_row();
  }
  return traces;
}

Vec FreeUnknowns::restrict_nodal(const Points& nodal) const {
  Vec free(size());
  for (int node = 0; node < n_nodes(); ++node)
    for (int j = 0; j < count_[node]; ++j)
      free[at(node, j)] = is_plain(node) ? nodal(j, node) : axes(node).col(j).dot(nodal.col(node));
  return free;
}

SparseMatrix FreeUnknowns::restrict_matrix(const SparseMatrix& nodal) const {
  SparseMatrix basis(3 * n_nodes(), size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < n_nodes(); ++node)
    for (int j = 0; j < count_[node]; ++j)
      for (int d = 0; d < 3; ++d)
        if (const double value = axes(node)(d, j); value != 0.0) entries.emplace_back(3 * node + d, at(node, j), value);
  basis.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix transposed = basis.transpose(), times_basis = nodal * basis;
  return transposed * times_basis;
}

Points FreeUnknowns::directions() const {
  Points along(3, size());
  for (int node = 0; node < n_nodes(); ++node) {
    const Mat3 own = basis(node);
    for (int j = 0; j < count_[node]; ++j) along.col(at(node, j)) = own.col(j);
  }
  return along;
}

Points FreeUnknowns::expand(const Vec& free, const std::vector<double>& held) const {
  Points nodal(3, n_nodes());
  for (int node = 0; node < n_nodes(); ++node) {
    if (is_plain(node)) {
      for (int j = 0; j < 3; ++j) nodal(j, node) = free[at(node, j)];
      continue;
    }
    Vec3 value = Vec3::Zero();
    for (int j = 0; j < count_[node]; ++j) value += free[at(node, j)] * axes(node).col(j);
    nodal.col(node) = value;
  }
  for (size_t i = 0; i < held_.size(); ++i) nodal.col(held_[i].node) += held[i] * held_[i].direction;
  add_followers(nodal);
  return nodal;
}

void FreeUnknowns::add_followers(Points& nodal) const {
  for (const Interior::Follower& own : inside_->followers) {
    nodal.col(own.node) = nodal.col(own.point);
    if (own.turn >= 0) nodal.col(own.node) += Vec3(nodal.col(own.turn)).cross(own.arm) / own.size;
  }
}

Points FreeUnknowns::expand(const Vec& free, const std::vector<double>& held, const std::vector<int>& nodes) const {
  if (!inside_->followers.empty()) return expand(free, held)(Eigen::all, nodes);
  Points nodal(3, static_cast<Eigen::Index>(nodes.size()));
  for (size_t i = 0; i < nodes.size(); ++i) {
    const int node = nodes[i];
    Vec3 value = Vec3::Zero();
    for (int j = 0; j < count_[node]; ++j) {
      if (is_plain(node))
        value[j] = free[at(node, j)];
      else
        value += free[at(node, j)] * axes(node).col(j);
    }
    for (auto own = first_held(node); own != held_.end() && own->node == node; ++own)
      value += held[static_cast<size_t>(own - held_.begin())] * own->direction;
    nodal.col(static_cast<Eigen::Index>(i)) = value;
  }
  return nodal;
}

std::vector<HeldDirection>::const_iterator FreeUnknowns::first_held(int node) const {
  if (count_[node] == 3 || held_.empty()) return held_.end();
  return std::lower_bound(held_.begin(), held_.end(), node,
                          [](const HeldDirection& one, int at) { return one.node < at; });
}

}  // namespace dygita

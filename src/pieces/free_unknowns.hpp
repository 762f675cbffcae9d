// The free unknowns of a piece: the directions of its nodes that nothing holds, in the order of its factor.
#pragma once

#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "interfaces/conditions.hpp"
#include "mesh/condensed_body.hpp"
#include "pieces/piece.hpp"

namespace dygita {

struct HeldDirection {
  int node;
  Vec3 direction;
  std::vector<std::pair<int, double>> motion;  // (index of a motion, factor)
};

// A row in terms of unknowns x: its value is sum value[a] x[at[a]].
struct Trace {
  int n;
  const int* at;
  const double* value;

  double of(const Vec& x) const {
    double sum = 0.0;
    for (int a = 0; a < n; ++a) sum += value[a] * x[at[a]];
    return sum;
  }
  void add(double amount, Vec& x) const {
    for (int a = 0; a < n; ++a) x[at[a]] += value[a] * amount;
  }
};

// Rows one after the other.
class Traces {
 public:
  int size() const { return static_cast<int>(first_.size()) - 1; }
  Trace operator[](int i) const {
    return {first_[i + 1] - first_[i], at_.data() + first_[i], value_.data() + first_[i]};
  }
  // An entry of the row that `end_row` will end.
  void add(int at, double value) {
    at_.push_back(at);
    value_.push_back(value);
  }
  void end_row() { first_.push_back(static_cast<int>(at_.size())); }

 private:
  std::vector<int> first_{0}, at_;
  std::vector<double> value_;
};

class FreeUnknowns {
 public:
  // Of a node they are numbered from first(node) on, along the columns of its basis: the directions of rows of this
  // node alone where they are orthonormal, so that such a row is one unknown. inside: of the body, outlives this
  // object.
  FreeUnknowns(int n_nodes, const std::vector<InterfaceRow>& rows, const std::unordered_map<int, Held>& held,
               const Interior& inside = *Interior::of_cells());
  // Those of a turned copy of the piece that `equal` belongs to, along the turned directions and in the same order, so
  // that matrices have the same entries (manual, equal substructures). held: of the copy, the turned ones.
  FreeUnknowns(const FreeUnknowns& equal, const Mat3& turn, const std::unordered_map<int, Held>& held);

  int size() const { return static_cast<int>(node_of_unknown_.size()); }
  int n_nodes() const { return static_cast<int>(count_.size()); }
  int first(int node) const { return first_[node]; }
  int count(int node) const { return count_[node]; }
  Mat3 basis(int node) const { return axes(node); }
  // Are the node's unknowns its x, y and z?
  bool is_plain(int node) const { return !is_turned_ && special_[node] < 0; }
  // Do the two have their unknowns along the same axes?
  bool share_axes(int node, int other) const { return special_[node] < 0 && special_[other] < 0; }
  const std::vector<int>& node_of_unknown() const { return node_of_unknown_; }
  const std::vector<HeldDirection>& held() const { return held_; }  // by node

  // Vectors are in this order from now on: order[i] is the unknown at position i.
  void put_in_order(const std::vector<int>& order);
  // Where unknown j of a node stands in such vectors.
  int at(int node, int j) const { return position_[first_[node] + j]; }
  int position(int unknown) const { return position_[unknown]; }
  // The rows on the free unknowns, and on the held directions.
  Traces traces(const std::vector<InterfaceRow>& rows) const;
  Traces held_traces(const std::vector<InterfaceRow>& rows) const;
  // Is each of them in some row: on the interface?
  std::vector<char> at_rows(const std::vector<InterfaceRow>& rows) const;
  // Of each free unknown, 3 x size.
  Points directions() const;

  // B^T A B of a matrix on the nodes (3n x 3n), in the order of the unknowns.
  SparseMatrix restrict_matrix(const SparseMatrix& nodal) const;
  // Nodal field (3 x n_nodes) to the free unknowns, and back with values of the held directions; back at some nodes
  // alone, 3 x nodes.
  Vec restrict_nodal(const Points& nodal) const;
  Points expand(const Vec& free, const std::vector<double>& held) const;
  Points expand(const Vec& free, const std::vector<double>& held, const std::vector<int>& nodes) const;

 private:
  // Where the held directions of a node begin; the end of them where it has none.
  std::vector<HeldDirection>::const_iterator first_held(int node) const;
  const Mat3& axes(int node) const { return special_[node] < 0 ? axes_ : bases_[special_[node]]; }
  void set_held(const std::unordered_map<int, Held>& held);
  void add_followers(Points& nodal) const;

  bool is_turned_ = false;
  Mat3 axes_ = Mat3::Identity();
  std::vector<int> special_, count_, first_, node_of_unknown_;  // special: index in bases_, -1 for axes_
  std::vector<Mat3> bases_;
  std::vector<int> position_;
  std::vector<HeldDirection> held_;
  const Interior* inside_;
};

}  // namespace dygita

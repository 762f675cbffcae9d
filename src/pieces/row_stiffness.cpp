#include "pieces/row_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "numerics/spd_inverse.hpp"

namespace dygita {

namespace {

// Beyond so many unknowns an inverse costs more than the iterations that it spares.
constexpr int most_unknowns = 5000;
// Of a compliance, of its diagonal: rows that nearly depend on each other, as where the points are about as many as the
// nodes of the other side, would be far stiffer than any pattern that the iteration has to find (manual, eq. K6).
constexpr double regularisation = 0.1;

double along(const Mat& schur, const Trace& t, int n_interior) {
  double diagonal = 0.0;
  for (int a = 0; a < t.n; ++a)
    for (int b = 0; b < t.n; ++b)
      diagonal += t.value[a] * t.value[b] * schur(t.at[a] - n_interior, t.at[b] - n_interior);
  return diagonal;
}

// The rows of each side that has some over several nodes.
std::vector<std::vector<int>> coupled_sides(const PieceOperator& op) {
  std::map<int, std::vector<int>> sides;
  const std::vector<InterfaceRow>& rows = op.setup().rows;
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i].side >= 0 && op.traces()[static_cast<int>(i)].n > 0) sides[rows[i].side].push_back(static_cast<int>(i));
  std::vector<std::vector<int>> coupled;
  for (auto& [side, members] : sides)
    if (std::any_of(members.begin(), members.end(), [&](int i) { return !rows[i].is_of_one_node(); }))
      coupled.push_back(std::move(members));
  return coupled;
}

// Stiffness goes with a length, not with an area (manual, eq. K6): the mean of the nodes', times the root of how many
// nodes the row is as large as.
double by_length(const Mat& schur, const Trace& t, int n_interior) {
  double square = 0.0, mean = 0.0;
  for (int a = 0; a < t.n; ++a) {
    const int at = t.at[a] - n_interior;
    square += t.value[a] * t.value[a];
    mean += std::abs(t.value[a]) * schur(at, at);
  }
  return mean / std::sqrt(square);
}

}  // namespace

void take_reference_off(const PieceOperator& op, int n_interior, Mat& schur) {
  const FreeUnknowns& unknowns = op.unknowns();
  const std::vector<InterfaceRow>& rows = op.setup().rows;
  for (int i = 0; i < op.n_rows(); ++i) {
    if (!rows[i].is_of_one_node()) continue;
    const Trace t = op.traces()[i];
    for (int a = 0; a < t.n; ++a)
      for (int b = 0; b < t.n; ++b)
        schur(t.at[a] - n_interior, t.at[b] - n_interior) -= rows[i].reference_stiffness * t.value[a] * t.value[b];
  }
  for (const InterfaceRow& row : rows)
    for (const NodeAlong& on : row.nodes) {
      if (row.is_of_one_node() || row.reference_stiffness == 0.0) continue;
      const Mat3 spring = reference_spring(row, on), basis = unknowns.basis(on.node);
      for (int r = 0; r < unknowns.count(on.node); ++r)
        for (int c = 0; c < unknowns.count(on.node); ++c) {
          const int at = unknowns.at(on.node, r) - n_interior, column = unknowns.at(on.node, c) - n_interior;
          if (at >= 0 && column >= 0) schur(at, column) -= basis.col(r).dot(spring * basis.col(c));
        }
    }
}

Vec stiffness_of_rows(const Condensation& condensation, const PieceOperator& op) {
  const Mat& schur = *condensation.schur;
  const int n_i = condensation.factor->n_interior();
  Vec stiffness(op.n_rows());
  for (int i = 0; i < op.n_rows(); ++i) stiffness[i] = along(schur, op.traces()[i], n_i);
  const std::vector<std::vector<int>> sides = coupled_sides(op);
  if (sides.empty()) return stiffness;
  if (schur.rows() > most_unknowns) {
    for (const std::vector<int>& side : sides)
      for (const int i : side) stiffness[i] = by_length(schur, op.traces()[i], n_i);
    return stiffness;
  }
  Vec reference(op.n_rows());
  for (int i = 0; i < op.n_rows(); ++i) reference[i] = op.setup().rows[i].reference_stiffness;
  const Mat answer = inverse_spd(condensation.with_rows(op, reference), op.setup().what);
  for (const std::vector<int>& side : sides) {
    Mat compliance = on_rows(answer, op, n_i, side, side);
    compliance.diagonal() *= 1.0 + regularisation;
    const Mat own = inverse_spd(std::move(compliance), op.setup().what);
    for (size_t j = 0; j < side.size(); ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      stiffness[side[j]] = own(at, at) - reference[side[j]];
    }
  }
  return stiffness;
}

void share_nodes(std::vector<InterfaceRow>& rows) {
  std::map<int, std::vector<std::pair<int, const Vec3*>>> at_node;
  for (size_t i = 0; i < rows.size(); ++i)
    for (const NodeAlong& on : rows[i].nodes) at_node[on.node].emplace_back(static_cast<int>(i), &on.along);
  const auto is_of_same_law = [&](int i, int j) { return rows[i].side >= 0 && rows[i].side == rows[j].side; };
  const auto square = [](const InterfaceRow& row) {
    double sum = 0.0;
    for (const NodeAlong& on : row.nodes) sum += on.along.squaredNorm();
    return sum;
  };
  // Unit vectors have 1: no rounding where every row is of one node.
  const auto size = [&](const InterfaceRow& row) { return row.is_of_one_node() ? 1.0 : square(row); };
  for (size_t i = 0; i < rows.size(); ++i) {
    std::map<int, double> products;
    for (const NodeAlong& on : rows[i].nodes)
      for (const auto& [j, other] : at_node[on.node])
        if (j == static_cast<int>(i) || !is_of_same_law(static_cast<int>(i), j)) products[j] += on.along.dot(*other);
    rows[i].n_sharing = 0.0;
    const double own = size(rows[i]);
    for (const auto& [j, product] : products) rows[i].n_sharing += product * product / (own * size(rows[j]));
  }
}

}  // namespace dygita

#include "pieces/equal_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace dygita {

namespace {

// Copies in turned places agree but for rounding, of coordinates and of what is integrated over them.
constexpr double rounding = 1e-9;

bool agree(double a, double b) { return std::abs(a - b) <= rounding * (std::abs(a) + std::abs(b)); }

bool agree(const Mat3& turn, const Mat3& one, const Mat3& other) {
  return (turn * one * turn.transpose() - other).norm() <= rounding * one.norm();
}

bool have_equal_impedance(const Mat3& turn, const PieceSetup& a, const PieceSetup& b) {
  const auto is_matched = [&](const auto& entry) {
    const auto it = b.absorbing.find(entry.first);
    return it != b.absorbing.end() && agree(turn, entry.second, it->second);
  };
  const auto are_matched = [&](const NodePairImpedance& one, const NodePairImpedance& other) {
    return one.node == other.node && one.other == other.other && agree(turn, one.impedance, other.impedance);
  };
  return a.absorbing.size() == b.absorbing.size() && std::all_of(a.absorbing.begin(), a.absorbing.end(), is_matched) &&
         std::equal(a.absorbing_pairs.begin(), a.absorbing_pairs.end(), b.absorbing_pairs.begin(),
                    b.absorbing_pairs.end(), are_matched);
}

// The same directions of the same nodes; what moves them is no matter of the matrix.
bool have_equal_held(const Mat3& turn, const std::unordered_map<int, Held>& a, const std::unordered_map<int, Held>& b) {
  const auto count = [](const auto& held) {
    return std::count_if(held.begin(), held.end(), [](const auto& entry) { return entry.second.n > 0; });
  };
  if (count(a) != count(b)) return false;
  return std::all_of(a.begin(), a.end(), [&](const auto& entry) {
    const Held& one = entry.second;
    if (one.n == 0) return true;
    const auto it = b.find(entry.first);
    if (it == b.end() || it->second.n != one.n) return false;
    const auto across = it->second.free_basis();
    return (across.transpose() * turn * one.directions.leftCols(one.n)).norm() <= rounding;
  });
}

bool have_equal_matrices(const PieceSetup& a, const PieceSetup& b) {
  const Damping &damping_a = a.body->part->material.damping, &damping_b = b.body->part->material.damping;
  return a.body->mass == b.body->mass && a.precision == b.precision &&
         a.scheme.c1(damping_a) == b.scheme.c1(damping_b) && a.mass_share() == b.mass_share() &&
         a.n_nodes() == b.n_nodes();
}

}  // namespace

std::optional<Mat3> turn_between(const PieceSetup& first, const FreeUnknowns& of_first, const PieceSetup& second) {
  if (!have_equal_matrices(first, second)) return {};
  const Mat3 &from = first.body->part->mesh->turn, &to = second.body->part->mesh->turn;
  const Mat3 turn = from == to ? Mat3(Mat3::Identity()) : Mat3(to * from.transpose());
  if (!have_equal_impedance(turn, first, second) || !have_equal_held(turn, first.held, second.held)) return {};
  const FreeUnknowns turned(of_first, turn, second.held);
  if (of_first.at_rows(first.rows) != turned.at_rows(second.rows)) return {};
  return turn;
}

bool have_equal_rows(const PieceOperator& one, const PieceOperator& other) {
  if (one.n_rows() != other.n_rows()) return false;
  for (int i = 0; i < one.n_rows(); ++i) {
    const Trace a = one.traces()[i], b = other.traces()[i];
    const InterfaceRow &row = one.setup().rows[i], &row_b = other.setup().rows[i];
    if (!std::equal(a.at, a.at + a.n, b.at, b.at + b.n) || !agree(row.n_sharing, row_b.n_sharing) ||
        !agree(row.reference_stiffness, row_b.reference_stiffness))
      return false;
    double size = 0.0, change = 0.0;
    for (int j = 0; j < a.n; ++j) {
      size += a.value[j] * a.value[j];
      change += (a.value[j] - b.value[j]) * (a.value[j] - b.value[j]);
    }
    if (change > rounding * rounding * size) return false;
  }
  return true;
}

// Of two vectors in general position: matrices that agree there agree.
bool have_equal_springs(const PieceOperator& one, const Vec& k, const PieceOperator& other, const Vec& k_other) {
  constexpr double golden = 0.6180339887498949;
  if (one.n_free() != other.n_free()) return false;
  for (const double shift : {0.5, -1.0}) {
    Vec x(one.n_free());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = shift + std::fmod(golden * static_cast<double>(i + 1), 1.0);
    Vec change = Vec::Zero(x.size()), size = Vec::Zero(x.size());
    const auto add = [&](const PieceOperator& op, const Vec& stiffness, double sign) {
      for (int i = 0; i < op.n_rows(); ++i) {
        const Trace t = op.traces()[i];
        double sum = 0.0;
        for (int a = 0; a < t.n; ++a) sum += std::abs(t.value[a]);
        const double force = sign * stiffness[i] * t.of(x);
        for (int a = 0; a < t.n; ++a) {
          change[t.at[a]] += t.value[a] * force;
          size[t.at[a]] += stiffness[i] * std::abs(t.value[a]) * sum;
        }
      }
    };
    add(one, k, 1.0);
    add(other, k_other, -1.0);
    if ((change.array().abs() > rounding * size.array()).any()) return false;
  }
  return true;
}

}  // namespace dygita

#include "mesh/shape_functions.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

double power(double x, int exponent) {
  double result = 1.0;
  for (int i = 0; i < exponent; ++i) result *= x;
  return result;
}

// Coefficients of the functions of a factor: those that are 1 at one node and 0 at the others.
Mat coefficients_of(const ShapeFactor& factor) {
  const auto n = static_cast<Eigen::Index>(factor.nodes.size());
  CHECK(factor.monomials.size() == factor.nodes.size(), "as many monomials as nodes");
  Mat vandermonde(n, n);  // one row per monomial, one column per node
  for (Eigen::Index m = 0; m < n; ++m)
    for (Eigen::Index a = 0; a < n; ++a) {
      vandermonde(m, a) = 1.0;
      for (int axis = 0; axis < factor.n_axes; ++axis)
        vandermonde(m, a) *= power(factor.nodes[a][axis], factor.monomials[m][axis]);
    }
  return inverse(vandermonde);
}

// The factor's node at the place of a node of the element.
int node_in_factor(const ShapeFactor& factor, const Place& at) {
  const auto found = std::find_if(factor.nodes.begin(), factor.nodes.end(), [&](const Place& node) {
    return std::equal(node.begin(), node.begin() + factor.n_axes, at.begin() + factor.first_axis);
  });
  CHECK(found != factor.nodes.end(), "each node of an element is at a node of each factor");
  return static_cast<int>(found - factor.nodes.begin());
}

template <typename Rows>
std::vector<ShapeFunctions> functions_of(const Rows& rows) {
  std::vector<ShapeFunctions> all;
  for (const auto& row : rows) all.emplace_back(row.shape);
  return all;
}

}  // namespace

ShapeFunctions::ShapeFunctions(const ShapeSpace& space) {
  for (const ShapeFactor& factor : space.factors)
    factors_.push_back({factor.first_axis, factor.n_axes, factor.monomials, coefficients_of(factor)});
  for (const Place& at : space.nodes) {
    std::vector<int>& nodes = node_of_factor_.emplace_back();
    for (const ShapeFactor& factor : space.factors) nodes.push_back(node_in_factor(factor, at));
  }
}

double ShapeFunctions::Factor::value(int node, const Vec3& xi) const {
  double sum = 0.0;
  for (size_t m = 0; m < monomials.size(); ++m) {
    double monomial = 1.0;
    for (int axis = 0; axis < n_axes; ++axis) monomial *= power(xi[first_axis + axis], monomials[m][axis]);
    sum += coefficients(node, static_cast<Eigen::Index>(m)) * monomial;
  }
  return sum;
}

double ShapeFunctions::Factor::slope(int node, const Vec3& xi, int axis) const {
  double sum = 0.0;
  for (size_t m = 0; m < monomials.size(); ++m) {
    const int exponent = monomials[m][axis - first_axis];
    if (exponent == 0) continue;
    double monomial = exponent * power(xi[axis], exponent - 1);
    for (int other = 0; other < n_axes; ++other)
      if (first_axis + other != axis) monomial *= power(xi[first_axis + other], monomials[m][other]);
    sum += coefficients(node, static_cast<Eigen::Index>(m)) * monomial;
  }
  return sum;
}

Vec ShapeFunctions::values(const Vec3& xi) const {
  Vec values = Vec::Ones(static_cast<Eigen::Index>(node_of_factor_.size()));
  for (size_t a = 0; a < node_of_factor_.size(); ++a)
    for (size_t k = factors_.size(); k-- > 0;)
      values[static_cast<Eigen::Index>(a)] *= factors_[k].value(node_of_factor_[a][k], xi);
  return values;
}

Eigen::Matrix<double, Eigen::Dynamic, 3> ShapeFunctions::slopes(const Vec3& xi) const {
  Eigen::Matrix<double, Eigen::Dynamic, 3> slopes(static_cast<Eigen::Index>(node_of_factor_.size()), 3);
  for (size_t a = 0; a < node_of_factor_.size(); ++a)
    for (int axis = 0; axis < 3; ++axis) {
      double product = 1.0;
      bool has_axis = false;
      for (size_t k = 0; k < factors_.size(); ++k) {
        const Factor& factor = factors_[k];
        const int node = node_of_factor_[a][k];
        const bool is_its_axis = axis >= factor.first_axis && axis < factor.first_axis + factor.n_axes;
        product *= is_its_axis ? factor.slope(node, xi, axis) : factor.value(node, xi);
        has_axis |= is_its_axis;
      }
      slopes(static_cast<Eigen::Index>(a), axis) = has_axis ? product : 0.0;
    }
  return slopes;
}

const ShapeFunctions& shape_functions(CellType type) {
  static const std::vector<ShapeFunctions> all = functions_of(cell_shapes);
  return all[static_cast<size_t>(type)];
}

const ShapeFunctions& shape_functions(FacetType type) {
  static const std::vector<ShapeFunctions> all = functions_of(facet_shapes);
  return all[static_cast<size_t>(type)];
}

}  // namespace dygita

// The longest stable increment of a piece: that of its highest frequency with its interfaces free, since ties, contact
// and friction only join such pieces (manual, eq. S11).
#include <cmath>
#include <limits>
#include <random>

#include "numerics/dense.hpp"
#include "solution/integration.hpp"

namespace dygita {

namespace {

constexpr int most_products = 80;
constexpr double close_enough = 0.01;  // of the eigenvalue: half of that of the step

}  // namespace

// Lanczos in the mass's inner product, residual added.
double longest_explicit_step(const Body& body, const std::unordered_map<int, Held>& held) {
  const SparseMatrix& k = body.matrices->stiffness;
  const Vec mass = body.mass->lumped.replicate(1, 3).transpose().reshaped();
  const auto rest = [&](Vec& x) {
    for (const auto& [node, h] : held)
      for (int j = 0; j < h.n; ++j)
        x.segment<3>(3 * node) -= h.directions.col(j).dot(x.segment<3>(3 * node)) * h.directions.col(j);
  };
  const auto inner = [&](const Vec& a, const Vec& b) { return a.cwiseProduct(mass).dot(b); };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec q(mass.size()), before = Vec::Zero(mass.size()), next;
  for (double& value : q) value = uniform(random);
  rest(q);
  const double norm = std::sqrt(inner(q, q));
  if (norm == 0.0) return std::numeric_limits<double>::infinity();
  q /= norm;
  std::vector<double> alpha, beta;
  for (int i = 0; i < most_products; ++i) {
    next = (k * q).cwiseQuotient(mass);
    rest(next);
    if (i > 0) next -= beta.back() * before;
    alpha.push_back(inner(next, q));
    next -= alpha.back() * q;
    beta.push_back(std::sqrt(inner(next, next)));
    const EigenPairs pairs = tridiagonal_eigen(alpha, beta);
    const double value = pairs.values[i], residual = beta.back() * std::abs(pairs.vectors(i, i));
    if (residual <= close_enough * value || i + 1 == most_products)
      return value + residual > 0.0 ? 2.0 / std::sqrt(value + residual) : std::numeric_limits<double>::infinity();
    before.swap(q);
    q = next / beta.back();
  }
  return 0.0;
}

}  // namespace dygita

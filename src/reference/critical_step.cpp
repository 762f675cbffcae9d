#include "reference/critical_step.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "numerics/tridiagonal.hpp"

namespace dygita {

namespace {

constexpr int most_iterations = 80;
constexpr double close_enough = 0.01;  // of the eigenvalue: half of that of the step
constexpr double usual_damping_of_viscosity = 0.06;

}  // namespace

// Lanczos in the mass's inner product; copies of a node carry their own masses and equal values.
double highest_frequency(InternalForce& internal, const PenaltySprings& springs, const SharedNodes& shared,
                         const Vec& mass) {
  const auto accelerate = [&](Vec& force) {
    shared.restrict_force(force);
    force = force.cwiseQuotient(shared.moved_mass());
  };
  const auto inner = [&](const Vec& a, const Vec& b) { return a.cwiseProduct(mass).dot(b); };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec q(internal.n_dofs()), before = Vec::Zero(q.size()), next;
  for (double& value : q) value = uniform(random);
  q = q.cwiseProduct(mass).eval();
  accelerate(q);
  const double norm = std::sqrt(inner(q, q));
  if (norm == 0.0) return 0.0;
  q /= norm;
  TopOfTridiagonal top;
  double beta = 0.0;
  for (int k = 0; k < most_iterations; ++k) {
    internal.elastic(q, next);
    springs.add_closed_force(q, next);
    accelerate(next);
    if (k > 0) next -= beta * before;
    const double alpha = inner(next, q);
    top.add(alpha, beta);
    next -= alpha * q;
    beta = std::sqrt(inner(next, next));
    const double residual = beta * top.last_entry();
    if (residual <= close_enough * top.value() || k + 1 == most_iterations)
      return std::sqrt(std::max(0.0, top.value() + residual));
    before.swap(q);
    q = next / beta;
  }
  return 0.0;
}

double critical_step(double frequency, const InternalForce& internal) {
  if (frequency == 0.0) return std::numeric_limits<double>::infinity();
  frequency *= std::sqrt(internal.largest_of_sudden_motion());
  const double damping = (internal.has_viscosity() ? usual_damping_of_viscosity : 0.0) +
                         0.5 * internal.largest_stiffness_damping() * frequency;
  return 2.0 / frequency * (std::sqrt(1.0 + damping * damping) - damping);
}

}  // namespace dygita

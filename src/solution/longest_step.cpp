// The longest stable increment of a piece: that of its highest frequency with its interfaces free, since ties, contact
// and friction only join such pieces (manual, eq. S11).
#include <cmath>
#include <limits>
#include <random>

#include "fem/mass_edges.hpp"
#include "numerics/dense.hpp"
#include "solution/integration.hpp"

namespace dygita {

namespace {

constexpr int most_products = 80;
constexpr double close_enough = 0.01;  // of the eigenvalue: half of that of the step

using HeldNodes = std::unordered_map<int, Held>;

// Fields of three numbers a node in those of four.
void put(const Vec& x, std::vector<double>& padded) {
  Eigen::Map<Points, 0, Eigen::OuterStride<4>>(padded.data(), 3, x.size() / 3) = x.reshaped(3, x.size() / 3);
}

// K and the inverse of the mass, M^-1 + M^-1 C M^-1 (manual, eq. S13), on the free directions.
class FreeBody {
 public:
  FreeBody(const Body& body, const HeldNodes& held, const MassEdges& edges)
      : body_(body),
        held_(held),
        edges_(edges),
        mass_(body.mass->lumped.replicate(1, 3).transpose().reshaped()),
        from_(edges.empty() ? 0 : 4 * body.mass->lumped.size(), 0.0),
        to_(from_) {}

  const Vec& mass() const { return mass_; }
  void rest(Vec& x) const {
    for (const auto& [node, h] : held_)
      for (int j = 0; j < h.n; ++j)
        x.segment<3>(3 * node) -= h.directions.col(j).dot(x.segment<3>(3 * node)) * h.directions.col(j);
  }
  Vec force(const Vec& x) const {
    Vec y = body_.matrices->stiffness * x;
    rest(y);
    return y;
  }
  Vec answer(const Vec& force) {
    Vec x = force.cwiseQuotient(mass_);
    if (edges_.empty()) return x;
    put(x, from_);
    std::fill(to_.begin(), to_.end(), 0.0);
    edges_.add_product(from_.data(), to_.data());
    const Eigen::Index n = x.size() / 3;
    Vec more = Eigen::Map<const Points, 0, Eigen::OuterStride<4>>(to_.data(), 3, n).reshaped();
    rest(more);
    return x + more.cwiseQuotient(mass_);
  }

 private:
  const Body& body_;
  const HeldNodes& held_;
  const MassEdges& edges_;
  Vec mass_;
  std::vector<double> from_, to_;
};

// With stiffness damping taken at the velocity of the increment's start (manual, eq. S14).
double damped(double longest, const Body& body) {
  const double beta = body.part->material.damping.stiffness;
  return std::isfinite(longest) ? std::sqrt(beta * beta + longest * longest) - beta : longest;
}

// Lanczos on forces, in the inner product of the inverse mass, residual added.
double longest_step(FreeBody&& body) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec q(body.mass().size()), before = Vec::Zero(q.size()), next;
  for (double& value : q) value = uniform(random);
  body.rest(q);
  q = q.cwiseProduct(body.mass());
  Vec answer = body.answer(q);
  const double norm = std::sqrt(answer.dot(q));
  if (norm == 0.0) return std::numeric_limits<double>::infinity();
  q /= norm;
  answer /= norm;
  std::vector<double> alpha, beta;
  for (int i = 0; i < most_products; ++i) {
    next = body.force(answer);
    if (i > 0) next -= beta.back() * before;
    alpha.push_back(next.dot(answer));
    next -= alpha.back() * q;
    answer = body.answer(next);
    beta.push_back(std::sqrt(std::max(0.0, answer.dot(next))));
    const EigenPairs pairs = tridiagonal_eigen(alpha, beta);
    const double value = pairs.values[i], residual = beta.back() * std::abs(pairs.vectors(i, i));
    if (residual <= close_enough * value || i + 1 == most_products)
      return value + residual > 0.0 ? 2.0 / std::sqrt(value + residual) : std::numeric_limits<double>::infinity();
    before.swap(q);
    q = next / beta.back();
    answer /= beta.back();
  }
  return 0.0;
}

// Where supports leave one direction alone and the body is long in it, no other waves travel than those along it.
bool is_confined(const Body& body, const HeldNodes& held) {
  const Points& nodes = body.part->mesh->nodes;
  if (static_cast<Eigen::Index>(held.size()) < nodes.cols()) return false;
  Vec3 along = Vec3::Zero();
  for (const auto& [node, h] : held) {
    if (h.n == 3) continue;
    if (h.n != 2) return false;
    const Vec3 own = h.directions.col(0).cross(h.directions.col(1));
    if (along.isZero(0.0)) along = own;
    if (own.cross(along).norm() > 1e-6) return false;
  }
  if (along.isZero(0.0)) return false;
  const Vec ahead = nodes.transpose() * along;
  const Points across = nodes - along * ahead.transpose();
  const Vec3 width = across.rowwise().maxCoeff() - across.rowwise().minCoeff();
  return ahead.maxCoeff() - ahead.minCoeff() > 4.0 * width.maxCoeff();
}

}  // namespace

double tuned_wave_speed(const Body& body, const HeldNodes& held) {
  const Elastic& material = body.part->material;
  return is_confined(body, held) ? material.p_wave_speed() : material.s_wave_speed();
}

double longest_explicit_step(const Body& body, const HeldNodes& held) {
  const MassEdges none;
  return damped(longest_step(FreeBody(body, held, none)), body);
}

// The mass is tuned to the step that it allows: in a few rounds, each of which moves it by a tenth of the one before.
double longest_tuned_step(const Body& body, const HeldNodes& held) {
  constexpr int rounds = 3;
  double longest = longest_explicit_step(body, held);
  const double speed = tuned_wave_speed(body, held);
  for (int i = 0; i < rounds && std::isfinite(longest); ++i) {
    const MassEdges edges(*body.part->mesh, body.part->material, {speed, longest, true}, {});
    longest = damped(longest_step(FreeBody(body, held, edges)), body);
  }
  return longest;
}

}  // namespace dygita

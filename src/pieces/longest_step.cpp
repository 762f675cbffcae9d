// The longest stable increment of a piece is that of its highest frequency with its interfaces free, since ties,
// contact and friction only join such pieces.
#include "pieces/longest_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "fem/mass_edges.hpp"
#include "numerics/tridiagonal.hpp"

namespace dygita {

namespace {

constexpr int most_products = 80;
constexpr double close_enough = 0.01;  // of the eigenvalue: half of that of the step

using HeldNodes = std::unordered_map<int, Held>;

// K and the inverse of the mass, M^-1 + M^-1 C M^-1 (manual, eq. S13), on the free directions; by the products that an
// increment takes, on fields of four numbers a node.
class FreeBody {
 public:
  FreeBody(const Body& body, const HeldNodes& held)
      : held_(held),
        stiffness_(body.matrices->edges()),
        mass_(body.mass->lumped.replicate(1, 4).transpose().reshaped()) {}

  // Lanczos on forces, in the inner product of the inverse mass, residual added. more: C, or nothing.
  double longest_step(const MassEdges& more) const;

 private:
  Vec start() const;
  void rest(Vec& x) const {
    for (const auto& [node, h] : held_)
      for (int j = 0; j < h.n; ++j)
        x.segment<3>(4 * node) -= h.directions.col(j).dot(x.segment<3>(4 * node)) * h.directions.col(j);
  }
  void add_force(const Vec& x, Vec& y) const {
    stiffness_->add_product(x.data(), y.data());
    rest(y);
  }
  void answer(const Vec& force, const MassEdges& more, Vec& x) const {
    x = force.cwiseQuotient(mass_);
    if (more.empty()) return;
    Vec coupled = Vec::Zero(x.size());
    more.add_product(x.data(), coupled.data());
    rest(coupled);
    x += coupled.cwiseQuotient(mass_);
  }

  const HeldNodes& held_;
  std::shared_ptr<const EdgeBlocks> stiffness_;
  Vec mass_;
};

Vec FreeBody::start() const {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec q = Vec::Zero(mass_.size());
  for (Eigen::Index i = 0; i < q.size(); i += 4)
    for (Eigen::Index c = i; c < i + 3; ++c) q[c] = uniform(random);
  rest(q);
  return q.cwiseProduct(mass_);
}

double FreeBody::longest_step(const MassEdges& more) const {
  constexpr double none = std::numeric_limits<double>::infinity();
  Vec q = start(), before = Vec::Zero(q.size()), next, v;
  answer(q, more, v);
  const double norm = std::sqrt(v.dot(q));
  if (norm == 0.0) return none;
  q /= norm;
  v /= norm;
  TopOfTridiagonal top;
  double beta = 0.0;
  for (int i = 0; i < most_products; ++i) {
    next = -beta * before;
    add_force(v, next);
    const double alpha = next.dot(v);
    top.add(alpha, beta);
    next -= alpha * q;
    answer(next, more, v);
    beta = std::sqrt(std::max(0.0, v.dot(next)));
    const double residual = beta * top.last_entry();
    if (residual <= close_enough * top.value() || i + 1 == most_products)
      return TimeScheme::longest_of_central_differences(top.value() + residual);
    before.swap(q);
    q = next / beta;
    v /= beta;
  }
  return none;
}

double damped(double longest, const Body& body) {
  return TimeScheme::longest_damped(longest, body.part->material.damping);
}

// Where supports leave one direction alone and the body is long in it, no other waves travel than those along it.
bool is_confined(const Substructure& part, const HeldNodes& held) {
  const Points& nodes = part.mesh->nodes;
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

double tuned_wave_speed(const Substructure& part, const HeldNodes& held) {
  const Elastic& material = part.material;
  return is_confined(part, held) ? material.p_wave_speed() : material.s_wave_speed();
}

std::string why_not_explicit(const Body& body, double numerical_damping) {
  if (!body.part->mesh->has_cells()) return "a superelement has no mass of its own at each node";
  if (numerical_damping != 0.0) return "'numerical_damping' belongs to the implicit scheme";
  if (!body.mass->is_massless.empty()) return "'massless_contact' gives nodes without mass";
  if (body.mass->least <= 0.0) return "it has a node without mass";
  return "";
}

double longest_explicit_step(const Body& body, const HeldNodes& held) {
  return damped(FreeBody(body, held).longest_step({}), body);
}

// The mass is tuned to the step that it allows, which depends on it: by a tenth at most where shear waves keep their
// speed, by a third where those of compression do. Where the two meet, by secants from a share of what a wave takes
// along the shortest edge.
double longest_tuned_step(const Body& body, const HeldNodes& held, double speed) {
  constexpr int most_rounds = 6;
  constexpr double most_slope = 0.5, usual_share = 0.9;
  const Elastic& material = body.part->material;
  const CellEdges edges(*body.part->mesh, material, {});
  if (edges.lengths.empty()) return longest_explicit_step(body, held);
  const FreeBody free(body, held);
  const bool is_of_compression = speed == material.p_wave_speed();
  double slope = is_of_compression ? 0.3 : 0.07;
  const double near = is_of_compression ? 0.01 : 0.06;  // leaves half a percent, at most
  double tuned_to = (is_of_compression ? 1.0 : usual_share) / material.p_wave_speed() *
                    *std::min_element(edges.lengths.begin(), edges.lengths.end());
  double longest = 0.0, meeting = 0.0;
  for (int i = 0; i < most_rounds; ++i) {
    const double before = longest, tuned_before = tuned_to;
    if (i > 0) tuned_to = meeting;
    longest = damped(free.longest_step({edges, speed, tuned_to}), body);
    if (i > 0) slope = std::clamp((longest - before) / (tuned_to - tuned_before), 0.0, most_slope);
    meeting = std::max(0.5 * longest, (longest - slope * tuned_to) / (1.0 - slope));
    if (!(std::abs(longest - tuned_to) > near * longest)) break;
  }
  return meeting;
}

}  // namespace dygita

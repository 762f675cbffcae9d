// What the tangents at hand say beyond those that the factor is of (manual, eq. U6-U8).
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "numerics/gmres.hpp"
#include "step/assembled_system.hpp"

namespace dygita {

// What friction adds to it.
Vec AssembledSystem::following_times(const Vec& velocity) const {
  const Tangents& at_hand = has_others_ ? at_hand_ : tangents_;
  Vec force = Vec::Zero(velocity.size()), own;
  if (!is_following_) return force;
  std::vector<double> way(at_hand.points.size(), 0.0);
  for (const PreloadTangent& preload : at_hand.preloads)
    for (const int i : preload.points) way[i] = preload.way(velocity);
  for (size_t i = 0; i < way.size(); ++i) {
    const PointTangent& point = at_hand.points[i];
    if (point.following.size() == 0) continue;
    own = velocity(point.unknowns);
    own = point.following * (point.normal.dot(own) - point.normal_stiffness * way[i]);
    force(point.unknowns) += own;
  }
  return force;
}

void AssembledSystem::set_own() {
  has_others_ = is_following_ = false;
  at_hand_ = {};
  others_.clear();
}

void AssembledSystem::set_following(const Tangents& tangents) {
  set_own();
  for (size_t i = 0; i < tangents.points.size(); ++i) {
    PointTangent& point = tangents_.points[i];
    point.normal = tangents.points[i].normal;
    point.following = tangents.points[i].following;
    point.normal_stiffness = tangents.points[i].normal_stiffness;
    is_following_ = is_following_ || point.following.size() > 0;
  }
}

void AssembledSystem::set_other_tangents(const Tangents& tangents, const Vec& k) {
  set_own();
  has_others_ = true;
  at_hand_ = tangents;
  is_following_ = at_hand_.follow();
  for (size_t i = 0; i < tangents.points.size(); ++i) {
    const PointTangent &now = at_hand_.points[i], &before = tangents_.points[i];
    if (now.matrix == before.matrix) continue;
    const Mat own = k(now.unknowns).asDiagonal(), stiff = own + now.matrix;
    others_.push_back({i, now.matrix - before.matrix, (own + before.matrix) * stiff.inverse()});
  }
}

// What the tangents at hand say beyond those of the factor.
Vec AssembledSystem::others_times(const Vec& velocity) const {
  Vec force = following_times(velocity), own;
  if (!has_others_) return force;
  for (const OtherPoint& other : others_) {
    const std::vector<int>& unknowns = at_hand_.points[other.point].unknowns;
    own = other.added * velocity(unknowns);
    force(unknowns) += own;
  }
  const auto give_way = [&](const std::vector<PreloadTangent>& preloads, double sign) {
    for (const PreloadTangent& preload : preloads) {
      const double way = sign * preload.way(velocity);
      for (const auto& [unknown, value] : preload.column) force[unknown] -= way * value;
    }
  };
  give_way(at_hand_.preloads, 1.0);
  give_way(tangents_.preloads, -1.0);
  return force;
}

// As the forces of points would change if each had but a stiffness k behind it.
Vec AssembledSystem::scaled(Vec force) const {
  Vec own;
  for (const OtherPoint& other : others_) {
    const std::vector<int>& unknowns = at_hand_.points[other.point].unknowns;
    own = other.scale * force(unknowns);
    force(unknowns) = own;
  }
  return force;
}

// Where the forces of points whose tangents are others act, and those of preloads.
std::vector<char> AssembledSystem::reach_of_others() const {
  std::vector<char> is_other(static_cast<size_t>(model_->n_q()), 0);
  const Tangents& at_hand = has_others_ ? at_hand_ : tangents_;
  const auto add = [&](const std::vector<int>& unknowns) {
    for (const int i : unknowns) is_other[static_cast<size_t>(i)] = 1;
  };
  for (const OtherPoint& other : others_) add(at_hand.points[other.point].unknowns);
  for (const PointTangent& point : at_hand.points)
    if (point.following.size() > 0) add(point.unknowns);
  for (const Tangents* tangents : {&tangents_, &at_hand})
    for (const PreloadTangent& preload : tangents->preloads)
      for (const auto& [unknown, value] : preload.column) is_other[static_cast<size_t>(unknown)] = 1;
  std::vector<int> unknowns;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Traces& traces = pieces_[i]->op().traces();
    for (int r = 0; r < pieces_[i]->n_rows(); ++r) {
      if (!is_other[static_cast<size_t>(model_->offset[i] + r)]) continue;
      const Trace t = traces[r];
      for (int a = 0; a < t.n; ++a) unknowns.push_back(first_[i] + t.at[a]);
    }
  }
  return factor_->reach_of(unknowns);
}

// As many products as take as long as two thirds of a factor, about.
int AssembledSystem::most_products() const {
  if (!factor_) return 0;
  constexpr double operations_a_byte = 1.3;  // of a factor, while a substitution reads one
  const double worth = factor_->operations() / (operations_a_byte * 2.0 * factor_->bytes());
  return std::clamp(static_cast<int>(2.0 / 3.0 * worth), 8, 60);
}

// z = (M - M_A + N) (V - W_hat). to_image: V - W_hat as it is without (manual, eq. U7, U8).
std::optional<Vec> AssembledSystem::what_others_add(const Vec& to_image, double precision) {
  const int most = has_others_ ? most_products() : 30;
  const std::vector<char> reach = reach_of_others();
  const GmresSystem system = {[&](const Vec& z) {
                                ++n_products_;
                                if (watch_) watch_(fmt::format("product {} beside the factor", n_products_));
                                return scaled(z + others_times(at_rows(balanced(from_rows(z), &reach))));
                              },
                              [](const Vec& z) { return z; }};
  return gmres(system, scaled(others_times(to_image)), precision, most);
}

}  // namespace dygita

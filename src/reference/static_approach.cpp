#include "reference/static_approach.hpp"

#include <algorithm>
#include <cmath>

#include "law/law_slope.hpp"
#include "numerics/gmres.hpp"

namespace dygita {

StaticApproach::Fields StaticApproach::fields(const Vec& f, std::vector<PointRecord>& records,
                                              const std::vector<double>& limits) {
  const MergedAssembly& assembly = rows_->assembly();
  const Vec rate = assembly.free_rate() - assembly.compliance() * f;
  const Vec force = f + assembly.softening().cwiseProduct(rate - assembly.held_rate());
  for (const Preload& preload : *preloads_) {
    if (preload.points.empty()) continue;
    for (const int p : preload.points) records[p].trial = rows_->trial_of(p, rate, force, records[p]);
    const double target = preload.target(i_increment_, rows_->model().step->increments);
    shorten(rows_->model(), preload, target, increment_, records);
  }
  return rows_->fields(f, records, increment_, limits);
}

// The slopes at these fields; how many have changed by a tenth, or -1 where none has.
int StaticApproach::take_slopes(const Fields& now, const std::vector<PointRecord>& records) {
  TangentBounds bounds;
  bounds.softest = steps_.softest();
  const double least = 1e-9 * rows_->extent();
  std::vector<Mat3> slopes(records.size(), Mat3::Zero());
  int n_changed = 0, n_other = 0;
  for (size_t p = 0; p < records.size(); ++p) {
    const Point& point = rows_->model().exchange.points[p];
    if (!point.law || records[p].is_released) continue;
    const Trial trial = rows_->trial_of(p, now.rate, now.force, records[p]);
    const double* limit = steps_.limits().empty() ? nullptr : &steps_.limits()[p];
    const Mat3 slope = slope_of(*point.law, trial, increment_, records[p].law, limit, least);
    slopes[p] = stiffness_of(slope, trial.y, steps_.is_first(), bounds);
    if (slopes_.empty()) continue;
    const double own = trial.y.maxCoeff() > 0.0 ? 1.0 / trial.y.maxCoeff() : 0.0;
    const double change = (slopes[p] - slopes_[p]).norm();
    const double size = std::max({slopes[p].norm(), slopes_[p].norm(), own});
    n_changed += change > 0.1 * size;
    n_other += change > 1e-3 * size;
  }
  if (slopes_.empty()) n_changed = n_other = static_cast<int>(records.size());
  if (n_other == 0 && bounds.softest == slopes_softest_) return -1;
  slopes_ = std::move(slopes);
  slopes_softest_ = bounds.softest;
  return n_changed;
}

// M x, with the shortening of each preload giving way so that its force stays.
Vec StaticApproach::times_slopes(const Vec& x) const {
  const MergedAssembly& assembly = rows_->assembly();
  const auto motion = [&](size_t p) {
    Vec3 own = Vec3::Zero();
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly.row(p, d); i >= 0) own[d] = x[i];
    return own;
  };
  std::vector<double> way(slopes_.size(), 0.0);  // along the normal, of each point
  for (const Preload& preload : *preloads_) {
    double stiffness = 0.0, force = 0.0;
    for (const int p : preload.points) {
      stiffness += slopes_[p](0, 0);
      force += slopes_[p].row(0).dot(motion(p));
    }
    for (const int p : preload.points) way[p] = stiffness > 0.0 ? force / stiffness : 0.0;
  }
  Vec result = Vec::Zero(x.size());
  for (size_t p = 0; p < slopes_.size(); ++p) {
    const Vec3 force = slopes_[p] * (motion(p) - Vec3(way[p], 0.0, 0.0));
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly.row(p, d); i >= 0) result[i] = force[d];
  }
  return result;
}

// The transpose of 1 + (M - R) W, whose columns lie in one piece.
void StaticApproach::factorise() {
  const MergedAssembly& assembly = rows_->assembly();
  const Mat& w = assembly.compliance();
  const auto n = w.rows();
  Mat system = -w * assembly.softening().asDiagonal();
  system.diagonal().array() += 1.0;
  for (size_t p = 0; p < slopes_.size(); ++p)
    for (int d = 0; d < 3; ++d) {
      const int i = assembly.row(p, d);
      if (i < 0) continue;
      for (int e = 0; e < 3; ++e)
        if (const int k = assembly.row(p, e); k >= 0 && slopes_[p](d, e) != 0.0)
          system.col(i) += slopes_[p](d, e) * w.col(k);
    }
  for (const Preload& preload : *preloads_) {
    double stiffness = 0.0;
    Vec force = Vec::Zero(n);
    for (const int p : preload.points) {
      stiffness += slopes_[p](0, 0);
      for (int d = 0; d < 3; ++d)
        if (const int i = assembly.row(p, d); i >= 0) force += slopes_[p](0, d) * w.col(i);
    }
    if (stiffness <= 0.0) continue;
    for (const int p : preload.points)
      for (int d = 0; d < 3; ++d)
        if (const int i = assembly.row(p, d); i >= 0) system.col(i) -= slopes_[p](d, 0) / stiffness * force;
  }
  transposed_ = LuFactor(std::move(system));
  factor_ = Factor::of_these;
}

// (1 + (M - R) W) x
Vec StaticApproach::times(const Vec& x) const {
  const MergedAssembly& assembly = rows_->assembly();
  const Vec moved = assembly.compliance() * x;
  return x + times_slopes(moved) - assembly.softening().cwiseProduct(moved);
}

// From f to that of  F = F_hat + M (rate - rate_hat).
Vec StaticApproach::step(const Fields& now) {
  const MergedAssembly& assembly = rows_->assembly();
  const Vec asked_rate = now.rate + rows_->y().cwiseProduct(now.force - now.asked);
  const Vec rhs = now.asked + times_slopes(assembly.free_rate() - asked_rate) -
                  assembly.softening().cwiseProduct(assembly.free_rate() - assembly.held_rate());
  const Vec left = rhs - times(now.f);
  if (factor_ == Factor::of_other_slopes && !plain_) {
    const GmresSystem system{[&](const Vec& x) { return times(x); },
                             [&](const Vec& x) { return transposed_.solve_transposed(x); }};
    if (auto found = gmres(system, left, KeptFactor::close_enough(rows_->relative(now)),
                           KeptFactor::most_products(assembly.n_rows())))
      return std::move(*found);
  }
  if (factor_ != Factor::of_these) factorise();
  return transposed_.solve_transposed(left);
}

int StaticApproach::approach(Vec& f, std::vector<PointRecord>& records, const Increment& increment, int i_increment,
                             double near, int most) {
  increment_ = increment;
  i_increment_ = i_increment;
  steps_.begin();
  slopes_.clear();
  Vec best = f;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0;; ++n) {
    const Fields own = fields(f, records, {});
    if (own.distance < least) {
      least = own.distance;
      best = f;
    }
    const double eta = rows_->relative(own);
    if (!(eta > near) || n == most) {  // or not finite
      f = best;
      fields(f, records, {});
      return n;
    }
    Fields now = own;
    const auto distance = [&](const std::vector<double>& limits) {
      now = fields(f, records, limits);
      return now.distance;
    };
    const auto trials = [&] {
      std::vector<double> normal;
      for (size_t p = 0; p < records.size(); ++p)
        normal.push_back(rows_->trial_of(p, now.rate, now.force, records[p]).s[0]);
      return normal;
    };
    // The slopes here do not know how friction follows, which InterfaceNewton's do.
    const double before = steps_.begin_step(distance, trials, std::numeric_limits<double>::infinity());
    const int n_changed = take_slopes(now, records);
    if (n_changed >= 0 && factor_ == Factor::of_these) factor_ = Factor::of_other_slopes;
    const Vec step = this->step(now);
    const auto that_far = [&](double share) { return fields(f + share * step, records, steps_.limits()).distance; };
    f += steps_.end_step(before, that_far, std::max(n_changed, 0), eta) * step;
  }
}

}  // namespace dygita

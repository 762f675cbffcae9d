#include "reference/interface_newton.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

// A tangent is kept, over iterations and increments, while it brings the residual down at least this fast.
constexpr double fast_enough = 0.2;
// Newton steps in vain before Gauss-Seidel sweeps take over for a while, and how many of them.
constexpr int most_in_vain = 3, n_sweeps = 20;
// A step that raises the residual by more than this is not taken.
constexpr double too_bad = 10.0;
constexpr double regularisation = 1e-8;

}  // namespace

InterfaceNewton::InterfaceNewton(const StepModel& model, const MergedAssembly& assembly,
                                 const MonolithicSettings& settings)
    : model_(&model),
      assembly_(&assembly),
      settings_(settings),
      y_(assembly.compliance().diagonal()),
      f_(Vec::Zero(assembly.n_rows())) {
  // Any positive Y gives the same solution; one for both tangents keeps the friction disc round.
  for (size_t i = 0; i < model.exchange.points.size(); ++i) {
    const int t1 = assembly.row(i, 1), t2 = assembly.row(i, 2);
    if (t1 >= 0 && t2 >= 0) y_[t1] = y_[t2] = 0.5 * (y_[t1] + y_[t2]);
  }
  for (const SubstructurePtr& part : model.problem->substructures) {
    const Points& nodes = part->mesh->nodes;
    extent_ += (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
  }
}

Vec InterfaceNewton::force_of(const Vec& f, const Vec& rate) const {
  return f + assembly_->softening().cwiseProduct(rate - assembly_->held_rate());
}

Trial InterfaceNewton::trial_of(size_t i_point, const Vec& rate, const Vec& force, const PointRecord& record) const {
  Trial trial = record.trial;
  trial.s.setZero();
  trial.y.setZero();
  for (int d = 0; d < 3; ++d)
    if (const int i = assembly_->row(i_point, d); i >= 0) {
      trial.y[d] = y_[i];
      trial.s[d] = rate[i] + y_[i] * force[i];
    }
  return trial;
}

InterfaceNewton::Residual InterfaceNewton::evaluate(const Vec& f, const std::vector<PointRecord>& records,
                                                    const Increment& increment) const {
  const Vec rate = rate_of(f), force = force_of(f, rate);
  Residual r;
  r.phi = force;
  for (size_t p = 0; p < records.size(); ++p) {
    const Point& point = model_->exchange.points[p];
    if (!point.law || records[p].is_released) continue;
    const Vec3 asked = point.law->force(trial_of(p, rate, force, records[p]), increment, records[p].law);
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly_->row(p, d); i >= 0) r.phi[i] -= asked[d];
  }
  r.distance = (r.phi.array().square() * y_.array()).sum();
  r.size = 0.5 * (force.array().square() * y_.array() + rate.array().square() / y_.array()).sum();
  if (!std::isfinite(r.distance))
    throw NumericalError(fmt::format(
        "step '{}': the interface forces have diverged; likely cause: bodies left unconstrained once contacts "
        "open, or a time step far too large",
        model_->step->name));
  return r;
}

double InterfaceNewton::relative(const Residual& r) const {
  return std::sqrt(r.distance / std::max({largest_, r.size, floor_, std::numeric_limits<double>::min()}));
}

// d law / d s by differences of the law itself: exact where it is piecewise linear.
Mat3 InterfaceNewton::law_tangent(size_t i_point, const Trial& trial, const PointRecord& record,
                                  const Increment& increment) const {
  Mat3 tangent = Mat3::Zero();
  if (record.is_released) return tangent;
  const Law& law = *model_->exchange.points[i_point].law;
  const Vec3 force = law.force(trial, increment, record.law);
  const double h = 1e-7 * std::max(trial.s.cwiseAbs().maxCoeff(), 1e-9);
  for (int d = 0; d < 3; ++d) {
    if (assembly_->row(i_point, d) < 0) continue;
    Trial moved = trial;
    moved.s[d] += h;
    tangent.col(d) = (law.force(moved, increment, record.law) - force) / (moved.s[d] - trial.s[d]);
  }
  return tangent;
}

// J = F' - D s', with rate' = -W, F' = 1 - R W and s' = rate' + Y F'. Rows of points without force and tangent say f =
// 0 and are left out where R is zero.
void InterfaceNewton::factorise(const Vec& f, const std::vector<PointRecord>& records, const Increment& increment) {
  const Vec rate = rate_of(f), force = force_of(f, rate), &r = assembly_->softening();
  const Mat& w = assembly_->compliance();
  const int n = assembly_->n_rows();
  std::vector<Mat3> tangents(records.size(), Mat3::Zero());
  std::vector<std::pair<int, int>> place(n);  // point and direction of a row
  active_.clear();
  passive_.clear();
  for (size_t p = 0; p < records.size(); ++p) {
    const std::array rows{assembly_->row(p, 0), assembly_->row(p, 1), assembly_->row(p, 2)};
    if (std::max({rows[0], rows[1], rows[2]}) < 0) continue;
    tangents[p] = law_tangent(p, trial_of(p, rate, force, records[p]), records[p], increment);
    for (int d = 0; d < 3; ++d) {
      if (rows[d] < 0) continue;
      place[rows[d]] = {static_cast<int>(p), d};
      (tangents[p].isZero(0.0) && r[rows[d]] == 0.0 ? passive_ : active_).push_back(rows[d]);
    }
  }
  const int n_active = static_cast<int>(active_.size());
  Mat j(n_active, n);
  Eigen::RowVectorXd force_row(n);
  std::vector<int> order = active_;
  order.insert(order.end(), passive_.begin(), passive_.end());
  for (int a = 0; a < n_active; ++a) {
    const int i = active_[a];
    const auto [p, d] = place[i];
    const auto derivative_of_force = [&](int row) {
      force_row = -r[row] * w.col(row).transpose();  // W is symmetric
      force_row[row] += 1.0;
    };
    derivative_of_force(i);
    Eigen::RowVectorXd row = force_row;
    for (int e = 0; e < 3; ++e) {
      const int k = assembly_->row(p, e);
      if (k < 0 || tangents[p](d, e) == 0.0) continue;
      derivative_of_force(k);
      row -= tangents[p](d, e) * (y_[k] * force_row - w.col(k).transpose());
    }
    for (int c = 0; c < n; ++c) j(a, c) = row[order[c]];
  }
  tangent_passive_ = j.rightCols(n - n_active);
  Mat square = j.leftCols(n_active);
  // Laws in a loop share forces in more than one way, which makes J singular; the residual has no part there.
  square.diagonal().array() += regularisation;
  lu_.compute(square);
  has_factor_ = true;
}

Vec InterfaceNewton::direction(const Vec& phi) const {
  Vec step(phi.size()), rhs(active_.size()), known(passive_.size());
  for (size_t i = 0; i < passive_.size(); ++i) step[passive_[i]] = known[i] = -phi[passive_[i]];
  for (size_t i = 0; i < active_.size(); ++i) rhs[i] = -phi[active_[i]];
  if (active_.empty()) return step;
  if (!passive_.empty()) rhs -= tangent_passive_ * known;
  const Vec x = lu_.solve(rhs);
  for (size_t i = 0; i < active_.size(); ++i) step[active_[i]] = x[i];
  return step;
}

// Point by point, the others held: slow, but it cannot cycle as Newton's method can where contacts open and close.
void InterfaceNewton::sweep(Vec& f, const std::vector<PointRecord>& records, const Increment& increment) const {
  const Mat& w = assembly_->compliance();
  Vec rate = rate_of(f);
  for (size_t p = 0; p < records.size(); ++p) {
    const Point& point = model_->exchange.points[p];
    if (!point.law) continue;
    Trial trial = records[p].trial;
    trial.s.setZero();
    trial.y.setZero();
    Vec3 force = Vec3::Zero(), share = Vec3::Ones();
    for (int d = 0; d < 3; ++d) {
      const int i = assembly_->row(p, d);
      if (i < 0) continue;
      force[d] = f[i] + assembly_->softening()[i] * (rate[i] - assembly_->held_rate()[i]);
      share[d] = 1.0 - assembly_->softening()[i] * w(i, i);
      trial.y[d] = w(i, i) / share[d];
      trial.s[d] = rate[i] + trial.y[d] * force[d];
    }
    const Vec3 found = records[p].is_released ? Vec3(Vec3::Zero()) : point.law->force(trial, increment, records[p].law);
    for (int d = 0; d < 3; ++d) {
      const int i = assembly_->row(p, d);
      if (i < 0) continue;
      const double change = (found[d] - force[d]) / share[d];
      f[i] += change;
      rate -= change * w.col(i);
    }
  }
}

InterfaceNewton::Outcome InterfaceNewton::solve(std::vector<PointRecord>& records, const Increment& increment) {
  for (size_t p = 0; p < records.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly_->row(p, d); i >= 0) f_[i] = records[p].law.force[d];
  Residual residual = evaluate(f_, records, increment);
  Outcome outcome;
  Vec best = f_;
  double best_distance = residual.distance;
  int in_vain = 0;
  while (relative(residual) > settings_.tolerance && outcome.iterations < settings_.max_iterations) {
    ++outcome.iterations;
    const bool is_fresh = !has_factor_;
    if (is_fresh) factorise(f_, records, increment);
    const Vec f_new = f_ + direction(residual.phi);
    Residual next = evaluate(f_new, records, increment);
    const double ratio = std::sqrt(next.distance / residual.distance);
    if (ratio > fast_enough) has_factor_ = false;
    if (!is_fresh && ratio >= 1.0) continue;  // the old tangent misleads
    if (ratio >= 1.0) ++in_vain;
    if (ratio < too_bad) {
      f_ = f_new;
      residual = std::move(next);
    } else {
      in_vain = most_in_vain;
    }
    if (in_vain >= most_in_vain) {
      in_vain = 0;
      f_ = best;
      for (int i = 0; i < n_sweeps; ++i) sweep(f_, records, increment);
      residual = evaluate(f_, records, increment);
    }
    if (residual.distance < best_distance) {
      best = f_;
      best_distance = residual.distance;
    }
  }
  if (residual.distance > best_distance) {  // not converged: the best there was is what is shown
    f_ = best;
    residual = evaluate(f_, records, increment);
  }
  outcome.residual = relative(residual);
  outcome.distance = residual.distance;
  outcome.converged = outcome.residual <= settings_.tolerance;
  largest_ = std::max(largest_, residual.size);
  const Vec rate = rate_of(f_), force = force_of(f_, rate);
  outcome.is_apart = increment.is_static && rate.size() > 0 && rate.cwiseAbs().maxCoeff() > extent_;
  for (size_t p = 0; p < records.size(); ++p) {
    PointRecord& record = records[p];
    record.trial = trial_of(p, rate, force, record);
    record.force.setZero();
    const Point& point = model_->exchange.points[p];
    if (point.law && !record.is_released) record.force = point.law->force(record.trial, increment, record.law);
  }
  return outcome;
}

void InterfaceNewton::check_together(const Outcome& outcome) const {
  if (!outcome.is_apart) return;
  throw NumericalError(
      fmt::format("step '{}': sides of an interface move apart by more than the assembly's size; likely cause: a body "
                  "that was held by contact alone has come off, so that there is no equilibrium",
                  model_->step->name));
}

}  // namespace dygita

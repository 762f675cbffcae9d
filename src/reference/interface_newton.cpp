#include "reference/interface_newton.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "law/law_slope.hpp"
#include "numerics/gmres.hpp"

namespace dygita {

namespace {

// Newton steps in vain before Gauss-Seidel sweeps take over for a while, and how many of them: at first, and where that
// was in vain, too.
constexpr int most_in_vain = 3, n_sweeps = 20, sweeps_at_last = 1280;
// A step that raises the residual by more than this is not taken.
constexpr double too_bad = 10.0;
constexpr double regularisation = 1e-8;

}  // namespace

InterfaceNewton::InterfaceNewton(InterfaceRows& rows, const MonolithicSettings& settings)
    : rows_(&rows), assembly_(&rows.assembly()), settings_(settings), f_(Vec::Zero(rows.assembly().n_rows())) {}

void InterfaceNewton::start(const std::vector<PointRecord>& records) {
  for (size_t p = 0; p < records.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly_->row(p, d); i >= 0) f_[i] = records[p].law.force[d];
}

InterfaceNewton::Tangents InterfaceNewton::tangents_at(const Fields& fields, const std::vector<PointRecord>& records,
                                                       const Increment& increment) const {
  const double least = 1e-9 * rows_->extent() / increment.dt;
  Tangents tangents(records.size(), Mat3::Zero());
  for (size_t p = 0; p < records.size(); ++p) {
    const Point& point = rows_->model().exchange.points[p];
    if (!point.law || records[p].is_released) continue;
    if (std::max({assembly_->row(p, 0), assembly_->row(p, 1), assembly_->row(p, 2)}) < 0) continue;
    tangents[p] = slope_of(*point.law, rows_->trial_of(p, fields.rate, fields.force, records[p]), increment,
                           records[p].law, nullptr, least);
  }
  return tangents;
}

// J x, J = F' - D s', with rate' = -W, F' = 1 - R W and s' = rate' + Y F'.
Vec InterfaceNewton::times(const Tangents& tangents, const Vec& x) const {
  const Vec rate = -assembly_->compliance() * x;
  Vec force = x + assembly_->softening().cwiseProduct(rate);
  const Vec search = rate + rows_->y().cwiseProduct(force);
  for (size_t p = 0; p < tangents.size(); ++p)
    for (int d = 0; d < 3; ++d) {
      const int i = assembly_->row(p, d);
      if (i < 0) continue;
      for (int e = 0; e < 3; ++e)
        if (const int k = assembly_->row(p, e); k >= 0) force[i] -= tangents[p](d, e) * search[k];
    }
  return force;
}

// Rows of points without force and tangent say f = 0 and are left out where R is zero.
void InterfaceNewton::factorise(const Tangents& tangents) {
  const Vec &r = assembly_->softening(), &y = rows_->y();
  const Mat& w = assembly_->compliance();
  const int n = assembly_->n_rows();
  std::vector<std::pair<size_t, int>> place(static_cast<size_t>(n));  // point and direction of a row
  active_.clear();
  passive_.clear();
  for (size_t p = 0; p < tangents.size(); ++p)
    for (int d = 0; d < 3; ++d) {
      const int i = assembly_->row(p, d);
      if (i < 0) continue;
      place[static_cast<size_t>(i)] = {p, d};
      (tangents[p].isZero(0.0) && r[i] == 0.0 ? passive_ : active_).push_back(i);
    }
  const int n_active = static_cast<int>(active_.size());
  // The transpose by its columns, which lie in one piece, as those of W do, which is symmetric.
  Mat transposed(n_active, n_active);
  tangent_passive_.resize(static_cast<Eigen::Index>(passive_.size()), n_active);
  Vec row(n);
  for (int a = 0; a < n_active; ++a) {
    const int i = active_[static_cast<size_t>(a)];
    const auto [p, d] = place[static_cast<size_t>(i)];
    row = -r[i] * w.col(i);
    row[i] += 1.0;
    for (int e = 0; e < 3; ++e) {
      const int k = assembly_->row(p, e);
      const double slope = k < 0 ? 0.0 : tangents[p](d, e);
      if (slope == 0.0) continue;
      row += slope * (y[k] * r[k] + 1.0) * w.col(k);
      row[k] -= slope * y[k];
    }
    transposed.col(a) = row(active_);
    tangent_passive_.col(a) = row(passive_);
  }
  // Laws in a loop share forces in more than one way, which makes J singular; the residual has no part there.
  transposed.diagonal().array() += regularisation;
  transposed_ = LuFactor(std::move(transposed));
  has_factor_ = true;
}

// x of J x = b, with the tangents that were factorised.
Vec InterfaceNewton::factor_solve(const Vec& b) const {
  Vec x(b.size()), rhs(active_.size()), known(passive_.size());
  for (size_t i = 0; i < passive_.size(); ++i) x[passive_[i]] = known[i] = b[passive_[i]];
  for (size_t i = 0; i < active_.size(); ++i) rhs[i] = b[active_[i]];
  if (active_.empty()) return x;
  if (!passive_.empty()) rhs -= tangent_passive_.transpose() * known;
  const Vec solved = transposed_.solve_transposed(std::move(rhs));
  for (size_t i = 0; i < active_.size(); ++i) x[active_[i]] = solved[i];
  return x;
}

Vec InterfaceNewton::direction(const Tangents& tangents, const Fields& now) {
  const Vec phi = now.phi();
  if (has_factor_ && !settings_.plain) {
    const GmresSystem system{[&](const Vec& x) { return times(tangents, x); },
                             [&](const Vec& x) { return factor_solve(x); }};
    if (auto step = gmres(system, -phi, KeptFactor::close_enough(rows_->relative(now)),
                          KeptFactor::most_products(assembly_->n_rows())))
      return std::move(*step);
  }
  factorise(tangents);
  return factor_solve(-phi);
}

// Point by point, the others held: slow, but it cannot cycle as Newton's method can where contacts open and close.
void InterfaceNewton::sweep(Vec& f, const std::vector<PointRecord>& records, const Increment& increment) const {
  const Mat& w = assembly_->compliance();
  Vec rate = assembly_->free_rate() - w * f;
  for (size_t p = 0; p < records.size(); ++p) {
    const Point& point = rows_->model().exchange.points[p];
    if (!point.law) continue;
    Trial trial = records[p].trial;
    trial.s = records[p].given_rate;
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
  const auto fields_of = [&](Vec f) {
    Fields fields = rows_->fields(std::move(f), records, increment);
    if (std::isfinite(fields.distance)) return fields;
    throw NumericalError(fmt::format(
        "step '{}': the interface forces have diverged; likely cause: bodies left unconstrained once contacts "
        "open, or a time step far too large",
        rows_->model().step->name));
  };
  Fields now = fields_of(f_);
  Outcome outcome;
  Fields best = now;
  int in_vain = 0, sweeps = n_sweeps;
  while (rows_->relative(now) > settings_.tolerance && outcome.iterations < settings_.max_iterations) {
    ++outcome.iterations;
    Fields next = fields_of(now.f + direction(tangents_at(now, records, increment), now));
    const double ratio = std::sqrt(next.distance / now.distance);
    if (ratio >= 1.0) ++in_vain;
    if (ratio < too_bad)
      now = std::move(next);
    else
      in_vain = most_in_vain;
    if (in_vain >= most_in_vain) {
      in_vain = 0;
      Vec f = best.f;
      for (int i = 0; i < sweeps; ++i) sweep(f, records, increment);
      now = fields_of(std::move(f));
      sweeps = std::min(2 * sweeps, sweeps_at_last);
    }
    if (now.distance < best.distance) {
      best = now;
      sweeps = n_sweeps;
    }
  }
  if (now.distance > best.distance) now = best;  // not converged: the best there was is what is shown
  outcome.residual = rows_->relative(now);
  outcome.distance = now.distance;
  outcome.converged = outcome.residual <= settings_.tolerance;
  rows_->note_size(now.size);
  outcome.is_apart = increment.is_static && is_apart(now);
  rows_->keep(now, records, increment);
  f_ = std::move(now.f);
  return outcome;
}

// What only touches has no equilibrium apart; what is held, as by springs, is no small displacement any more.
bool InterfaceNewton::is_apart(const Fields& now) const {
  constexpr double too_far = 10.0;  // of the assembly's size, as LATIN has it
  const std::vector<Point>& points = rows_->model().exchange.points;
  for (size_t p = 0; p < points.size(); ++p) {
    if (!points[p].law) continue;
    const double most = points[p].law->shown().gap ? rows_->extent() : too_far * rows_->extent();
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly_->row(p, d); i >= 0 && std::abs(now.rate[i]) > most) return true;
  }
  return false;
}

void InterfaceNewton::check_together(const Outcome& outcome) const {
  if (!outcome.is_apart) return;
  throw NumericalError(
      fmt::format("step '{}': sides of an interface move apart by more than the assembly's size; likely cause: a body "
                  "held by contact alone has separated, so that there is no equilibrium, or springs are too soft for "
                  "the load that they hold",
                  rows_->model().step->name));
}

}  // namespace dygita

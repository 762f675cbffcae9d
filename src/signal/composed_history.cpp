// Histories made of others: scaled, added, shifted, stretched. Their integrals are as exact as those they are made of.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "signal/history_shape.hpp"

namespace dygita {

namespace {

class Scaled final : public History::Shape {
 public:
  Scaled(History of, double factor) : of_(std::move(of)), factor_(factor) {}

  double value(double t) const override { return factor_ * of_.value(t); }
  double integral(double t0, double t1) const override { return factor_ * of_.integral(t0, t1); }
  bool is_constant() const override { return of_.is_constant(); }
  std::string description() const override { return fmt::format("{} * {}", factor_, of_.description()); }
  std::optional<Profile> profile() const override {
    std::optional<Profile> profile = of_.profile();
    if (!profile) return profile;
    const double a = factor_ * profile->low, b = factor_ * profile->high;
    profile->low = std::min(a, b);
    profile->high = std::max(a, b);
    return profile;
  }
  std::optional<double> factor_without_unit() const override {
    const std::optional<double> factor = of_.factor_without_unit();
    return factor ? std::optional(factor_ * *factor) : factor;
  }

 private:
  History of_;
  double factor_;
};

class Sum final : public History::Shape {
 public:
  Sum(History a, History b) : a_(std::move(a)), b_(std::move(b)) {}

  double value(double t) const override { return a_.value(t) + b_.value(t); }
  double integral(double t0, double t1) const override { return a_.integral(t0, t1) + b_.integral(t0, t1); }
  bool is_constant() const override { return a_.is_constant() && b_.is_constant(); }
  std::string description() const override { return fmt::format("({} + {})", a_.description(), b_.description()); }
  std::string unit() const override { return a_.unit() == b_.unit() ? a_.unit() : ""; }
  std::optional<double> factor_without_unit() const override {
    const std::optional<double> factor = a_.factor_without_unit();
    return factor ? factor : b_.factor_without_unit();
  }
  std::optional<Profile> profile() const override;

 private:
  History a_, b_;
};

// Sampled: where two shapes meet, their sum may be highest anywhere.
std::optional<Profile> Sum::profile() const {
  const std::optional<Profile> a = a_.profile(), b = b_.profile();
  if (!a || !b) return std::nullopt;
  if (a_.is_constant() || b_.is_constant()) {  // moved up or down
    Profile moved = a_.is_constant() ? *b : *a;
    const double by = a_.is_constant() ? a->low : b->low;
    moved.low += by;
    moved.high += by;
    moved.is_record = a->is_record || b->is_record;
    return moved;
  }
  Profile both{std::min(a->begin, b->begin), std::max(a->end, b->end), 0.0, 0.0, 0.0, a->is_record || b->is_record};
  constexpr int n = 4000;
  const auto note = [&](double t, bool is_first) {
    const double v = value(t);
    if (is_first || std::abs(v) > both.largest()) both.peak = t;
    both.low = is_first ? v : std::min(both.low, v);
    both.high = is_first ? v : std::max(both.high, v);
  };
  note(a->peak, true);
  note(b->peak, false);
  for (int i = 0; i <= n; ++i) note(both.begin + (both.end - both.begin) * i / n, false);
  return both;
}

// At t it is what the other is at (t - by) / factor.
class Moved final : public History::Shape {
 public:
  Moved(History of, double by, double factor) : of_(std::move(of)), by_(by), factor_(factor) {}

  double value(double t) const override { return of_.value((t - by_) / factor_); }
  double integral(double t0, double t1) const override {
    return factor_ * of_.integral((t0 - by_) / factor_, (t1 - by_) / factor_);
  }
  bool is_constant() const override { return of_.is_constant(); }
  std::string description() const override {
    return factor_ == 1.0 ? fmt::format("{} shifted by {} s", of_.description(), by_)
                          : fmt::format("{} {} times as long", of_.description(), factor_);
  }
  std::string unit() const override { return of_.unit(); }
  std::optional<double> factor_without_unit() const override { return of_.factor_without_unit(); }
  std::optional<Profile> profile() const override {
    std::optional<Profile> profile = of_.profile();
    if (!profile) return profile;
    for (double* t : {&profile->begin, &profile->end, &profile->peak}) *t = factor_ * *t + by_;
    return profile;
  }

 private:
  History of_;
  double by_, factor_;
};

}  // namespace

History History::scaled(double factor) const {
  if (!std::isfinite(factor))
    throw InputError(fmt::format("a history times {}: the factor must be a finite number", factor));
  return History(std::make_shared<const Scaled>(*this, factor));
}

History History::plus(const History& other) const { return History(std::make_shared<const Sum>(*this, other)); }

History History::shifted(double by) const {
  if (!std::isfinite(by)) throw InputError(fmt::format("a history shifted by {} s: it must be a finite number", by));
  return History(std::make_shared<const Moved>(*this, by, 1.0));
}

History History::stretched(double factor) const {
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw InputError(fmt::format("a history made {} times as long: the factor must be above 0", factor));
  return History(std::make_shared<const Moved>(*this, 0.0, factor));
}

}  // namespace dygita

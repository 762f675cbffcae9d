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
  Scaled(History of, double factor, Extent extent) : of_(std::move(of)), factor_(factor), extent_(extent) {}

  Extent extent() const override { return extent_; }

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
  Extent extent_;
};

// A sum with itself asks once: doubled again and again it would not end.
class Sum final : public History::Shape {
 public:
  Sum(History a, History b, bool is_twice, Extent extent)
      : a_(std::move(a)),
        b_(std::move(b)),
        is_twice_(is_twice),
        is_constant_(a_.is_constant() && (is_twice_ || b_.is_constant())),
        extent_(extent) {}

  double value(double t) const override { return is_twice_ ? 2.0 * a_.value(t) : a_.value(t) + b_.value(t); }
  double integral(double t0, double t1) const override {
    return is_twice_ ? 2.0 * a_.integral(t0, t1) : a_.integral(t0, t1) + b_.integral(t0, t1);
  }
  bool is_constant() const override { return is_constant_; }
  Extent extent() const override { return extent_; }
  std::string description() const override {
    return is_twice_ ? fmt::format("2 * {}", a_.description())
                     : fmt::format("({} + {})", a_.description(), b_.description());
  }
  std::string unit() const override {
    const std::string unit = a_.unit();
    return is_twice_ || unit == b_.unit() ? unit : "";
  }
  std::optional<double> factor_without_unit() const override {
    const std::optional<double> factor = a_.factor_without_unit();
    return factor || is_twice_ ? factor : b_.factor_without_unit();
  }
  bool add_terms(std::vector<Profile>& terms) const override {
    return a_.add_terms(terms) && (is_twice_ || b_.add_terms(terms));
  }
  std::optional<Profile> profile() const override;

 private:
  Profile sampled(const std::vector<Profile>& terms) const;

  History a_, b_;
  bool is_twice_, is_constant_;
  Extent extent_;
};

std::optional<Profile> Sum::profile() const {
  if (is_twice_) {
    std::optional<Profile> both = a_.profile();
    if (both) both->low *= 2.0, both->high *= 2.0;
    return both;
  }
  if (a_.is_constant() || b_.is_constant()) {  // moved up or down
    const std::optional<Profile> a = a_.profile(), b = b_.profile();
    if (!a || !b) return std::nullopt;
    Profile moved = a_.is_constant() ? *b : *a;
    const double by = a_.is_constant() ? a->low : b->low;
    moved.low += by;
    moved.high += by;
    moved.is_record = a->is_record || b->is_record;
    return moved;
  }
  std::vector<Profile> terms;
  return add_terms(terms) ? std::optional(sampled(terms)) : std::nullopt;
}

// Where shapes meet, their sum may be highest anywhere.
Profile Sum::sampled(const std::vector<Profile>& terms) const {
  Profile both{terms.front().begin, terms.front().end, 0.0, 0.0, 0.0, false};
  for (const Profile& term : terms) {
    both.begin = std::min(both.begin, term.begin);
    both.end = std::max(both.end, term.end);
    both.is_record |= term.is_record;
  }
  constexpr int n = 4000;
  const auto note = [&](double t, bool is_first) {
    const double v = value(t);
    if (is_first || std::abs(v) > both.largest()) both.peak = t;
    both.low = is_first ? v : std::min(both.low, v);
    both.high = is_first ? v : std::max(both.high, v);
  };
  const size_t n_peaks = std::min(terms.size(), size_t{n});  // of more each is hardly the sum's
  for (size_t i = 0; i < n_peaks; ++i) note(terms[i].peak, i == 0);
  for (int i = 0; i <= n; ++i) note(both.begin + (both.end - both.begin) * i / n, false);
  return both;
}

// At t it is what the other is at (t - by) / factor.
class Moved final : public History::Shape {
 public:
  Moved(History of, double by, double factor, Extent extent)
      : of_(std::move(of)), by_(by), factor_(factor), extent_(extent) {}

  Extent extent() const override { return extent_; }

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
  Extent extent_;
};

// Of a history made of two others, or of one: bounded, since a deck can double it in a line.
History::Shape::Extent extent_of(const History::Shape& a, const History::Shape* b = nullptr) {
  constexpr double most_terms = 100000;
  constexpr int deepest = 10000;
  const History::Shape::Extent one = a.extent(), other = b ? b->extent() : History::Shape::Extent{0.0, 0};
  const History::Shape::Extent made{one.n_terms + other.n_terms, 1 + std::max(one.depth, other.depth)};
  if (made.n_terms <= most_terms && made.depth <= deepest) return made;
  throw InputError(
      made.depth > deepest
          ? fmt::format("a history nested {} deep: {} levels are allowed", made.depth, deepest)
          : fmt::format("a history of {:.3g} terms: {} are allowed", made.n_terms, static_cast<int>(most_terms)));
}

}  // namespace

bool History::add_terms(std::vector<Profile>& terms) const { return shape_->add_terms(terms); }

History History::scaled(double factor) const {
  if (!std::isfinite(factor))
    throw InputError(fmt::format("a history times {}: the factor must be a finite number", factor));
  return History(std::make_shared<const Scaled>(*this, factor, extent_of(*shape_)));
}

History History::plus(const History& other) const {
  const bool is_twice = shape_ == other.shape_;
  const Shape::Extent extent = extent_of(*shape_, is_twice ? nullptr : other.shape_.get());
  return History(std::make_shared<const Sum>(*this, other, is_twice, extent));
}

History History::shifted(double by) const {
  if (!std::isfinite(by)) throw InputError(fmt::format("a history shifted by {} s: it must be a finite number", by));
  return History(std::make_shared<const Moved>(*this, by, 1.0, extent_of(*shape_)));
}

History History::stretched(double factor) const {
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw InputError(fmt::format("a history made {} times as long: the factor must be above 0", factor));
  return History(std::make_shared<const Moved>(*this, 0.0, factor, extent_of(*shape_)));
}

}  // namespace dygita

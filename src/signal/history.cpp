#include "signal/history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/history_shape.hpp"
#include "signal/signal_file.hpp"

namespace dygita {

using std::numbers::pi;

namespace {

void require_finite(const char* kind, const char* argument, double value) {
  if (!std::isfinite(value)) {
    throw InputError(fmt::format("history.{}: '{}' = {} must be a finite number", kind, argument, value));
  }
}

void require_duration(const char* kind, const char* argument, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InputError(fmt::format("history.{}: '{}' = {} s must be above 0", kind, argument, value));
  }
}

void require_not_negative(const char* kind, const char* argument, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw InputError(fmt::format("history.{}: '{}' = {} s must be 0 or more", kind, argument, value));
  }
}

// Straight lines between points; two points at the same time are a jump, whose later value holds there.
class Polyline : public History::Shape {
 public:
  Polyline(std::vector<double> times, std::vector<double> values, std::string description)
      : times_(std::move(times)), values_(std::move(values)), description_(std::move(description)) {}

  double value(double t) const override { return value(segment_end(t), t); }

  double integral(double t0, double t1) const override {
    double sum = 0.0;
    while (t0 < t1) {
      const size_t i = segment_end(t0);
      const double end = i == times_.size() ? t1 : std::min(t1, times_[i]);
      sum += 0.5 * (end - t0) * (value(i, t0) + value(i, end));
      t0 = end;
    }
    return sum;
  }

  bool is_constant() const override {
    return std::all_of(values_.begin(), values_.end(), [this](double v) { return v == values_.front(); });
  }
  std::string description() const override { return description_; }
  std::optional<Profile> profile() const override {
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    const auto peak = -*low > *high ? low : high;
    return Profile{times_.front(), times_.back(), *low, *high, times_[static_cast<size_t>(peak - values_.begin())],
                   false};
  }

 private:
  // The point that ends the segment in which t lies; 0 before the first point, their number after the last.
  size_t segment_end(double t) const {
    return static_cast<size_t>(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
  }

  double value(size_t end, double t) const {
    if (end == 0) return values_.front();
    if (end == times_.size()) return values_.back();
    const double share = (t - times_[end - 1]) / (times_[end] - times_[end - 1]);
    return (1.0 - share) * values_[end - 1] + share * values_[end];
  }

  std::vector<double> times_, values_;
  std::string description_;
};

// Of a pulse that is highest in its middle.
Profile profile_of_pulse(double peak, double duration) {
  return {0.0, duration, std::min(peak, 0.0), std::max(peak, 0.0), 0.5 * duration, false};
}

class HalfSine : public History::Shape {
 public:
  HalfSine(double peak, double duration) : peak_(peak), duration_(duration) {}

  double value(double t) const override {
    return t <= 0.0 || t >= duration_ ? 0.0 : peak_ * std::sin(pi * t / duration_);
  }
  double integral(double t0, double t1) const override {
    const double a = std::clamp(t0, 0.0, duration_), b = std::clamp(t1, 0.0, duration_);
    // cos a - cos b as a product: no cancellation over a short interval.
    const double middle = 0.5 * pi * (a + b) / duration_, half = 0.5 * pi * (b - a) / duration_;
    return 2.0 * peak_ * duration_ / pi * std::sin(middle) * std::sin(half);
  }
  std::string description() const override { return fmt::format("half_sine(peak {}, duration {})", peak_, duration_); }
  std::optional<Profile> profile() const override { return profile_of_pulse(peak_, duration_); }

 private:
  double peak_, duration_;
};

class Haversine : public History::Shape {
 public:
  Haversine(double peak, double duration) : peak_(peak), duration_(duration) {}

  double value(double t) const override {
    if (t <= 0.0 || t >= duration_) return 0.0;
    const double sine = std::sin(pi * t / duration_);
    return peak_ * sine * sine;
  }
  double integral(double t0, double t1) const override {
    const double a = std::clamp(t0, 0.0, duration_), b = std::clamp(t1, 0.0, duration_);
    const double middle = pi * (a + b) / duration_, half = pi * (b - a) / duration_;
    return peak_ * (0.5 * (b - a) - 0.5 * duration_ / pi * std::cos(middle) * std::sin(half));
  }
  std::string description() const override { return fmt::format("haversine(peak {}, duration {})", peak_, duration_); }
  std::optional<Profile> profile() const override { return profile_of_pulse(peak_, duration_); }

 private:
  double peak_, duration_;
};

class Function : public History::Shape {
 public:
  explicit Function(std::function<double(double)> f) : f_(std::move(f)) {}

  double value(double t) const override {
    const double value = f_(t);
    if (!std::isfinite(value))
      throw InputError(fmt::format("history: the function's value at t = {} s is {}", t, value));
    return value;
  }
  double integral(double t0, double t1) const override {
    constexpr int n_parts = 4;
    double sum = 0.0;
    for (int i = 0; i <= 2 * n_parts; ++i) {
      const double weight = i == 0 || i == 2 * n_parts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      sum += weight * value(t0 + (t1 - t0) * i / (2 * n_parts));
    }
    return sum * (t1 - t0) / (6 * n_parts);
  }
  std::string description() const override { return "function"; }

 private:
  std::function<double(double)> f_;
};

// A file's signal: it continues after its ends with the values that it has there.
class Record final : public Polyline {
 public:
  Record(SampledSignal signal, std::string description)
      : Polyline(std::move(signal.times), std::move(signal.values), std::move(description)),
        unit_(std::move(signal.unit)),
        has_unit_(signal.has_unit || !unit_.empty()) {}

  std::string unit() const override { return unit_; }
  std::optional<double> factor_without_unit() const override { return has_unit_ ? std::nullopt : std::optional(1.0); }
  std::optional<Profile> profile() const override {
    std::optional<Profile> profile = Polyline::profile();
    profile->is_record = true;
    return profile;
  }

 private:
  std::string unit_;
  bool has_unit_;
};

template <class Kind, class... Arguments>
std::shared_ptr<const History::Shape> make(Arguments&&... arguments) {
  return std::make_shared<const Kind>(std::forward<Arguments>(arguments)...);
}

}  // namespace

History History::constant(double value) {
  require_finite("constant", "value", value);
  return History(make<Polyline>(std::vector{0.0}, std::vector{value}, fmt::format("constant({})", value)));
}

History History::step(double value, double at) {
  require_finite("step", "value", value);
  require_finite("step", "at", at);
  return History(
      make<Polyline>(std::vector{at, at}, std::vector{0.0, value}, fmt::format("step({} at {})", value, at)));
}

History History::ramp(double from, double to, double duration) {
  require_finite("ramp", "from", from);
  require_finite("ramp", "to", to);
  require_duration("ramp", "duration", duration);
  return History(make<Polyline>(std::vector{0.0, duration}, std::vector{from, to},
                                fmt::format("ramp(from {}, to {}, duration {})", from, to, duration)));
}

History History::half_sine(double peak, double duration) {
  require_finite("half_sine", "peak", peak);
  require_duration("half_sine", "duration", duration);
  return History(make<HalfSine>(peak, duration));
}

History History::haversine(double peak, double duration) {
  require_finite("haversine", "peak", peak);
  require_duration("haversine", "duration", duration);
  return History(make<Haversine>(peak, duration));
}

History History::pulse(double peak, double rise, double hold, double fall) {
  require_finite("pulse", "peak", peak);
  require_not_negative("pulse", "rise", rise);
  require_not_negative("pulse", "hold", hold);
  require_not_negative("pulse", "fall", fall);
  require_duration("pulse", "rise + hold + fall", rise + hold + fall);
  return History(make<Polyline>(std::vector{0.0, rise, rise + hold, rise + hold + fall},
                                std::vector{0.0, peak, peak, 0.0},
                                fmt::format("pulse(peak {}, rise {}, hold {}, fall {})", peak, rise, hold, fall)));
}

History History::piecewise(std::vector<double> times, std::vector<double> values) {
  if (times.empty() || times.size() != values.size()) {
    throw InputError(
        fmt::format("history.piecewise: {} 'times' and {} 'values': their numbers must be equal and at least one",
                    times.size(), values.size()));
  }
  for (size_t i = 0; i < times.size(); ++i) {
    require_finite("piecewise", "times", times[i]);
    require_finite("piecewise", "values", values[i]);
    if (i > 0 && times[i] <= times[i - 1]) {
      throw InputError(fmt::format("history.piecewise: 'times' must increase: number {} is {} s, after {} s", i + 1,
                                   times[i], times[i - 1]));
    }
  }
  std::string description = fmt::format("piecewise({} points, {} to {})", times.size(), times.front(), times.back());
  return History(make<Polyline>(std::move(times), std::move(values), std::move(description)));
}

History History::record(SampledSignal signal, const std::string& source) {
  CHECK(!signal.times.empty() && signal.times.size() == signal.values.size(), "a record has points");
  std::string description = fmt::format("file({}, {} points)", source, signal.times.size());
  return History(make<Record>(std::move(signal), std::move(description)));
}

History History::from_file(const std::string& path) { return record(read_signal(path), path); }

History History::function(std::function<double(double)> f) {
  if (!f) throw InputError("history.function: no function was given");
  return History(make<Function>(std::move(f)));
}

double History::value(double t) const { return shape_->value(t); }

double History::integral(double t0, double t1) const {
  CHECK(t0 <= t1, fmt::format("integral of a history from {} to {}", t0, t1));
  return shape_->integral(t0, t1);
}

double RunningIntegral::over(int n, double dt) {
  if (dt != dt_) sums_.clear();
  dt_ = dt;
  if (sums_.empty()) sums_.push_back(0.0);
  for (int i = static_cast<int>(sums_.size()) - 1; i < n; ++i)
    sums_.push_back(sums_.back() + history_.integral(dt * i, dt * (i + 1)));
  return sums_[static_cast<size_t>(n)];
}

bool History::is_constant() const { return shape_->is_constant(); }

std::string History::description() const { return shape_->description(); }

std::optional<Profile> History::profile() const { return shape_->profile(); }

std::string History::unit() const { return shape_->unit(); }

std::optional<double> History::factor_without_unit() const { return shape_->factor_without_unit(); }

}  // namespace dygita

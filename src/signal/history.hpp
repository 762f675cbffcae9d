// A value that depends on time: load histories. Time in seconds from the start of the step that uses it.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dygita {

struct SampledSignal;

// What can be told of a history without asking it everywhere.
struct Profile {
  double begin = 0.0, end = 0.0;  // s: before and after, it keeps the value that it has there
  double low = 0.0, high = 0.0;   // smallest and largest value at any time
  double peak = 0.0;              // s, when its modulus is largest
  bool is_record = false;         // comes from a file

  double largest() const { return std::max(-low, high); }
};

class History {
 public:
  History() : History(constant(0.0)) {}

  // Durations in seconds, values in the unit of what they load. All throw InputError on numbers that are not finite, on
  // a duration that is not above zero and on a negative rise, hold or fall.
  static History constant(double value);
  static History step(double value, double at);                              // value for t >= at, 0 before
  static History ramp(double from, double to, double duration);              // then stays at `to`; `from` before t = 0
  static History half_sine(double peak, double duration);                    // 0 before and after
  static History haversine(double peak, double duration);                    // peak sin^2, 0 before and after
  static History pulse(double peak, double rise, double hold, double fall);  // trapezoid; rise or fall 0 is a jump
  // Linear between the points, constant outside. Times strictly increasing (else InputError).
  static History piecewise(std::vector<double> times, std::vector<double> values);
  // Two columns (time, value), linear between the points: see signal_file.hpp. Throws InputError with file:line.
  static History from_file(const std::string& path);
  static History record(SampledSignal signal, const std::string& source);  // the same, read already
  // Any function of time; a value that is not finite throws InputError when it is met.
  static History function(std::function<double(double)> f);

  History scaled(double factor) const;  // factor times it: no longer known to be of its unit
  History plus(const History& other) const;
  History shifted(double by) const;        // s, later: what it was at t it is at t + by
  History stretched(double factor) const;  // as many times as long, factor above zero (else InputError)

  double value(double t) const;
  // Integral from t0 to t1 (s, t0 <= t1): closed form for the named histories; Simpson's rule on four equal parts of
  // the interval for functions (exact for cubics), which is made for a time step and for no longer interval.
  double integral(double t0, double t1) const;
  bool is_constant() const;  // the same value at all times, as far as can be told (never for a function)
  // None of a function, nor of what is made of one.
  std::optional<Profile> profile() const;
  // SI, of its values, where its file gives one ("m/s^2"); else empty.
  std::string unit() const;
  // What multiplies the values of a file for which neither it nor the deck gives a unit; none of any other history.
  std::optional<double> factor_without_unit() const;
  // Adds the profiles of what it is a sum of, itself where it is none; false where one has none.
  bool add_terms(std::vector<Profile>& terms) const;
  // "half_sine(peak 1e+08, duration 4e-05)": for the run record.
  std::string description() const;

  struct Shape;  // interface of the kinds, in history_shape.hpp

 private:
  explicit History(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}
  std::shared_ptr<const Shape> shape_;
};

// The integral from 0 over more and more time steps, each of which is integrated once.
class RunningIntegral {
 public:
  explicit RunningIntegral(History history) : history_(std::move(history)) {}
  // Over n steps of dt (s). One thread only.
  double over(int n, double dt);

 private:
  History history_;
  double dt_ = 0.0;
  std::vector<double> sums_;
};

// A value as the deck gives it: a number (ramped in a static step), a history or a function of time.
struct TimeValue {
  History history;
  bool is_number = false;
};

}  // namespace dygita

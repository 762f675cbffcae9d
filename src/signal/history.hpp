// A value that depends on time: load histories. Time in seconds from the start of the step that uses it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dygita {

class History {
 public:
  History() : History(constant(0.0)) {}

  static History constant(double value);
  static History step(double value, double at);                    // value for t >= at, 0 before
  static History ramp(double from, double to, double duration);    // then stays at `to`
  static History half_sine(double peak, double duration);          // then 0
  static History haversine(double peak, double duration);          // peak sin^2, then 0
  static History pulse(double peak, double rise, double hold, double fall);  // trapezoid
  // Linear between the points, constant outside. Times strictly increasing (else InputError).
  static History piecewise(std::vector<double> times, std::vector<double> values);
  // Two columns (time s, value), comma or blank separated, one optional header line. Throws InputError with file:line.
  static History from_file(const std::string& path);
  static History function(std::function<double(double)> f);

  double value(double t) const;
  // Integral from t0 to t1 (t0 <= t1): exact for the named histories, Simpson on the interval for functions.
  double integral(double t0, double t1) const;
  bool is_constant() const;
  // "half_sine(peak 1e+08, duration 4e-05)": for the run record.
  std::string description() const;

  struct Shape;  // interface of the kinds, in history.cpp

 private:
  explicit History(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}
  std::shared_ptr<const Shape> shape_;
};

}  // namespace dygita

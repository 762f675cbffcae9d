#include "signal/oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dygita {

using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

// (e^h - 1 - h) / h^2; by its series where the difference would lose digits.
Complex phi_2(Complex h) {
  if (std::abs(h) > 1.0) return (std::exp(h) - 1.0 - h) / (h * h);
  Complex sum = 0.0, term = 0.5;
  for (int n = 3; n < 22; ++n) {
    sum += term;
    term *= h / static_cast<double>(n);
  }
  return sum;
}

// Extreme of the parabola through three equidistant values of which `b`, in the middle, is the extreme. No square of
// them is taken: it may be too large or too small for a number.
double vertex(double a, double b, double c) {
  const double curvature = a - 2.0 * b + c, slope = c - a;
  return curvature == 0.0 ? b : b - slope / 8.0 * (slope / curvature);
}

}  // namespace

void ResponsePeaks::meet(double value) {
  highest = std::max(highest, value);
  lowest = std::min(lowest, value);
}

double ResponsePeaks::maximax() const { return std::max(highest, -lowest); }

Oscillator::Oscillator(double frequency, double q_factor, double dt, double first, SrsQuantity quantity) : x_(first) {
  const double wn = 2.0 * pi * frequency, damping = 0.5 / q_factor;
  wd_ = wn * std::sqrt((1.0 - damping) * (1.0 + damping));
  pole_ = Complex(-damping * wn, wd_);
  // Partial fractions of (2 z wn s + wn^2), -1 or -wn over (s^2 + 2 z wn s + wn^2); twice the real part stands for the
  // conjugate pole.
  const Complex numerator = quantity == SrsQuantity::absolute_acceleration   ? 2.0 * damping * wn * pole_ + wn * wn
                            : quantity == SrsQuantity::relative_displacement ? Complex(-1.0)
                                                                             : Complex(-wn);
  residue_ = numerator / Complex(0.0, wd_);
  sample_every(dt);
}

void Oscillator::sample_every(double dt) {
  decay_ = std::exp(pole_ * dt);
  // Integrals of e^(p (T - s)) times the base, linear from its old to its new value.
  const Complex h = pole_ * dt, phi = phi_2(h);
  from_new_ = residue_ * dt * phi;
  from_old_ = residue_ * dt * (1.0 + h * phi - phi);  // (e^h - 1) / h = 1 + h phi
  // The parabola is through samples equally far apart.
  extremes_.meet(u_.real());
  y_old_ = u_.real();
}

void Oscillator::advance(const std::vector<double>& base) {
  // A sample near the largest so far may have the higher vertex: with 40 samples a period a vertex is 0.3 % higher at
  // most.
  constexpr double near = 0.99;
  const double dr = decay_.real(), di = decay_.imag();
  double ur = u_.real(), ui = u_.imag(), y_old = y_old_, x_old = x_;
  double highest = extremes_.highest, lowest = extremes_.lowest;
  for (const double x : base) {
    const double y_middle = ur;
    const double real = dr * ur - di * ui + (from_old_.real() * x_old + from_new_.real() * x);
    ui = dr * ui + di * ur + (from_old_.imag() * x_old + from_new_.imag() * x);
    ur = real;
    if (y_middle > near * highest && y_middle > y_old && y_middle >= ur) {
      highest = std::max(highest, vertex(y_old, y_middle, ur));
    } else if (y_middle < near * lowest && y_middle < y_old && y_middle <= ur) {
      lowest = std::min(lowest, vertex(y_old, y_middle, ur));
    }
    y_old = y_middle;
    x_old = x;
  }
  u_ = Complex(ur, ui);
  y_old_ = y_old;
  x_ = x_old;
  extremes_ = {highest, lowest};
}

// Beside a straight line the response is that line and a vibration that decays: its envelope is convex, so that the
// largest value is met in the first period or in the last.
void Oscillator::follow_line(double to, double length) {
  constexpr double per_period = 40.0, ends = 2.0;
  const double period = 2.0 * pi / wd_, from = x_;
  std::vector<double> base;
  const auto follow = [&](double begin, double end, int n) {
    base.clear();
    for (int i = 1; i <= n; ++i) base.push_back(from + (to - from) * ((begin + (end - begin) * i / n) / length));
    sample_every((end - begin) / n);
    advance(base);
  };
  if (length <= 3.0 * ends * period)
    return follow(0.0, length, std::max(8, static_cast<int>(per_period * length / period)));
  const int n = static_cast<int>(ends * per_period);
  follow(0.0, ends * period, n);
  follow(ends * period, length - ends * period, 1);
  follow(length - ends * period, length, n);
}

ResponsePeaks Oscillator::during() const {
  ResponsePeaks extremes = extremes_;
  extremes.meet(u_.real());
  return extremes;
}

ResponsePeaks Oscillator::after() const {
  // y(t) = Re(u e^(pt)) is level where Re(p u e^(pt)) = 0: two of these, half a damped period apart, hold both
  // extremes.
  ResponsePeaks extremes;
  extremes.meet(u_.real());
  const double to_crest = 0.5 * pi - std::arg(pole_ * u_);
  const double angle = to_crest - pi * std::floor(to_crest / pi);
  for (const double crest : {angle, angle + pi}) extremes.meet((u_ * std::exp(pole_ * (crest / wd_))).real());
  return extremes;
}

}  // namespace dygita

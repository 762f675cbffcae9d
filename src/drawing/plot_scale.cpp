#include "drawing/plot_scale.hpp"

#include <algorithm>
#include <cmath>

#include "base/log.hpp"

namespace dygita {

namespace {

// 1, 2 or 5 times a power of ten, not below x.
double nice_step(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= 0.999 * x) return m * power;
  return 10.0 * power;
}

}  // namespace

PlotScale::PlotScale(const PlotAxis& axis, Extent data, int n_ticks) : axis_(axis) {
  low_ = axis.from.value_or(data.low.value_or(axis.is_log ? 1.0 : 0.0));
  high_ = axis.to.value_or(data.high.value_or(axis.is_log ? 10.0 : 1.0));
  if (axis.is_log) {
    if (!(low_ > 0.0)) low_ = high_ > 0.0 ? 1e-3 * high_ : 1.0;
    if (!(high_ > low_)) high_ = 10.0 * low_;
    // At least half a decade, so that a flat spectrum is not drawn as noise.
    if (const double decades = std::log10(high_ / low_); decades < 0.5 && !axis.from && !axis.to) {
      low_ *= std::pow(10.0, 0.5 * (decades - 0.5));
      high_ = low_ * std::sqrt(10.0);
    }
  } else if (!(high_ > low_)) {
    const double margin = low_ == 0.0 ? 1.0 : 0.1 * std::abs(low_);
    if (!axis.from) low_ -= low_ == 0.0 ? 0.0 : margin;
    high_ = std::max(high_, low_) + margin;
  }
  unit_ =
      engineering_unit(axis.unit, axis.is_log && high_ < 2e5 * low_ ? low_ : std::max(std::abs(low_), std::abs(high_)));
  if (!axis.ticks.empty()) {
    for (const auto& [value, label] : axis.ticks) ticks_.push_back({value, label, false});
  } else if (axis.is_log) {
    add_log_ticks(n_ticks);
  } else {
    add_linear_ticks(n_ticks);
  }
}

void PlotScale::set_pixels(double low_pixel, double high_pixel) {
  low_pixel_ = low_pixel;
  high_pixel_ = high_pixel;
}

double PlotScale::pixel(double value) const {
  const double share = axis_.is_log ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
  return low_pixel_ + share * (high_pixel_ - low_pixel_);
}

bool PlotScale::shows(double value) const { return std::isfinite(value) && (!axis_.is_log || value > 0.0); }

std::string PlotScale::title() const {
  return unit_.name.empty() || !axis_.ticks.empty() ? axis_.quantity : axis_.quantity + " (" + unit_.name + ")";
}

void PlotScale::add_linear_ticks(int n_ticks) {
  const double low = low_ / unit_.size, high = high_ / unit_.size, step = nice_step((high - low) / n_ticks);
  const double largest = std::max(std::abs(low), std::abs(high));
  const bool has_exponent = largest >= 1e6 || largest < 1e-2;
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  for (double i = std::ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; ++i) {
    const double value = i * step;
    std::string label = has_exponent ? plain_number(value, 3) : fmt::format("{:.{}f}", value + 0.0, decimals);
    if (label.front() == '-') label = "−" + label.substr(1);
    ticks_.push_back({value * unit_.size, label, false});
  }
}

void PlotScale::add_log_ticks(int n_ticks) {
  const double low = low_ / unit_.size, high = high_ / unit_.size, decades = std::log10(high / low);
  const int every = std::max(1, static_cast<int>(std::ceil(decades / n_ticks)));
  for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::ceil(std::log10(high)); ++power) {
    for (int m = 1; m < 10; ++m) {
      const double value = m * std::pow(10.0, power);
      if (value < low * (1 - 1e-6) || value > high * (1 + 1e-6)) continue;
      const bool has_label = m == 1 ? power % every == 0 : decades < 2.1 && (m == 2 || m == 5);
      const bool is_plain = power >= -2 && power < 6;
      std::string label;
      if (has_label) label = is_plain ? fmt::format("{:g}", value) : plain_number(value, 1);
      if (m == 1 || decades < 6) ticks_.push_back({value * unit_.size, label, m != 1});
    }
  }
}

}  // namespace dygita

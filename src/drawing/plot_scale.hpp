// One axis of a chart: from values (SI) to pixels, with its ticks.
#pragma once

#include "drawing/plot_data.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/units.hpp"

namespace dygita {

class PlotScale {
 public:
  // `data` is what the axis must show; `n_ticks` is about how many there is room for.
  PlotScale(const PlotAxis& axis, Extent data, int n_ticks);

  // Pixels from `low_pixel` (first value) to `high_pixel`.
  void set_pixels(double low_pixel, double high_pixel);
  double pixel(double value) const;
  bool shows(double value) const;  // can be drawn: finite, above zero on a logarithmic axis

  double low() const { return low_; }
  double high() const { return high_; }
  struct Tick {
    double value;
    std::string label;
    bool is_minor;
  };
  const std::vector<Tick>& ticks() const { return ticks_; }
  // "time (µs)"
  std::string title() const;
  double unit_size() const { return unit_.size; }  // SI, of what labels count in
  bool is_log() const { return axis_.is_log; }
  bool has_own_ticks() const { return !axis_.ticks.empty(); }  // given, not found: places are not values

 private:
  void add_linear_ticks(int n_ticks);
  void add_log_ticks(int n_ticks);

  PlotAxis axis_;
  EngineeringUnit unit_;
  double low_ = 0.0, high_ = 1.0, low_pixel_ = 0.0, high_pixel_ = 1.0;
  std::vector<Tick> ticks_;
};

}  // namespace dygita

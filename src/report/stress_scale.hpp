// Colours of a picture of stresses.
#pragma once

#include <utility>
#include <vector>

namespace dygita {

// The top is what one value in two hundred exceeds, so that a notch does not hide the rest. Where a peak would leave
// half of what is seen the lowest fifth of the scale, each colour covers as much of it.
class StressScale {
 public:
  // values: each with the area that it covers.
  StressScale(std::vector<std::pair<double, double>> values, int n_colors);

  int color(double value) const;  // 0 ... n_colors - 1
  // At the ends of the colours, n_colors + 1 of them.
  const std::vector<double>& ends() const { return ends_; }
  bool is_by_quantile() const { return is_by_quantile_; }
  bool is_exceeded() const { return is_exceeded_; }  // something is beyond the top

 private:
  std::vector<double> ends_;
  bool is_by_quantile_ = false, is_exceeded_ = false;
};

}  // namespace dygita

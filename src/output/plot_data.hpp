// What the data of a chart span.
#pragma once

#include <optional>
#include <vector>

namespace dygita {

// Smallest and largest finite value so far.
struct Extent {
  std::optional<double> low, high;
  void add(double value);
  void add(const std::vector<double>& values);
};

}  // namespace dygita

// Parameters that scatter: their distributions, and the points at which a computation tries them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dygita {

// Quantile of the standard normal distribution, 0 < p < 1.
double normal_quantile(double p);

struct Distribution {
  enum class Kind { uniform, normal, lognormal, triangular, list };
  Kind kind = Kind::uniform;
  // low, high; mean, deviation; median, deviation of the natural logarithm; low, likeliest, high; values, equally
  // likely
  std::vector<double> numbers;
  double factor = 1.0;  // of all its values

  double quantile(double p) const;  // 0 < p < 1, in the order of a list as given
  // What a corner of a design takes: the bounds, of a list the first and the last; where there are none, the quantiles
  // 2.5 % and 97.5 %.
  double corner(bool is_second) const;
  // Empty, or why its numbers are none of its kind.
  std::string complaint() const;
};

enum class Design { latin_hypercube, random, sobol, corners };

inline constexpr int most_sobol_parameters = 21, most_corner_parameters = 10;

// n points of the unit cube of k dimensions, the same for a seed on every machine; corners are 2^k points, 0 or 1.
// Latin hypercube: each of n equal strata of each parameter has one point. Random: independent ones. Sobol: the
// sequence with a random shift, whose first points stay what they are as n grows.
std::vector<std::vector<double>> design_points(Design design, int n, int k, std::uint64_t seed);

// The order in which points follow each other closely, from the first on.
std::vector<int> short_tour(const std::vector<std::vector<double>>& points);

}  // namespace dygita

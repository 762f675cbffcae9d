// What a material with directions bears along its axes, and how near a stress comes to it.
#pragma once

#include <map>
#include <string>

#include "material/elastic_tensor.hpp"

namespace dygita {

enum class Criterion { tsai_wu, hashin };
enum class FailureMode { any, fibre_tension, fibre_compression, matrix_tension, matrix_compression };
const char* name_of(FailureMode mode);

// The index is the inverse of the factor by which all stresses grow until the criterion is met: 1 is failure, twice the
// load is twice the index.
struct Failure {
  double index = 0.0;
  FailureMode mode = FailureMode::any;  // of Hashin's criterion: which of the four
};

class Strength {
 public:
  // Pa, all positive: xt, xc, yt, yc, zt, zc in tension and compression along axes 1, 2, 3; s12, s13, s23 in shear; and
  // f12, f13, f23, the couplings of Tsai and Wu, as shares of their bounds. Hashin's criterion needs xt, xc, yt, yc,
  // s12 and s23 alone. Throws InputError where one is missing or they contradict each other.
  Strength(const std::map<std::string, double>& given, Criterion criterion);

  Criterion criterion() const { return criterion_; }
  const std::map<std::string, double>& given() const { return given_; }
  // Of a stress (Pa) along the material's axes: 11 22 33 12 23 13 (manual, eq. Y7-Y9).
  Failure failure(const Vec6& stress) const;

 private:
  Failure hashin(const Vec6& stress) const;

  std::map<std::string, double> given_;
  Criterion criterion_;
  Vec6 linear_ = Vec6::Zero();     // 1/Pa, of Tsai and Wu
  Mat6 quadratic_ = Mat6::Zero();  // 1/Pa^2
};

}  // namespace dygita

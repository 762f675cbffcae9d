#include "material/strength.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr const char* couplings[3] = {"f12", "f23", "f13"};  // in the order of the stresses 12 23 13

// Positive root of index^2 - linear index - quadratic = 0.
double root_of(double linear, double quadratic) {
  return 0.5 * (linear + std::sqrt(linear * linear + 4.0 * std::max(quadratic, 0.0)));
}

void require(const std::map<std::string, double>& given, std::initializer_list<const char*> names, const char* who) {
  for (const char* name : names)
    if (!given.contains(name))
      throw InputError(
          fmt::format("'strength.{}' is missing, which {} needs\n    x, y, z are axes 1, 2, 3, t tension, c "
                      "compression; all positive, in Pa",
                      name, who));
}

// Else no load along some direction would ever break it.
void check_couplings(const Mat3& shares) {
  constexpr double rounding = 1e-9;
  for (const double value : principal_axes(shares).values)
    if (value < -rounding)
      throw InputError(fmt::format(
          "'strength.f12' = {:g}, 'f13' = {:g} and 'f23' = {:g} are too large together: 1 + 2 f12 f13 f23 - f12^2 - "
          "f13^2 - f23^2 must not be negative, else some stress could grow without bound\n    -0.5 each is usual",
          shares(0, 1), shares(0, 2), shares(1, 2)));
}

}  // namespace

const char* name_of(FailureMode mode) {
  switch (mode) {
    case FailureMode::any:
      return "";
    case FailureMode::fibre_tension:
      return "fibres in tension";
    case FailureMode::fibre_compression:
      return "fibres in compression";
    case FailureMode::matrix_tension:
      return "matrix in tension";
    case FailureMode::matrix_compression:
      return "matrix in compression";
  }
  CHECK(false, "a mode of failure without a name");
  return "";
}

Strength::Strength(const std::map<std::string, double>& given, Criterion criterion)
    : given_(given), criterion_(criterion) {
  if (criterion == Criterion::hashin) {
    require(given, {"xt", "xc", "yt", "yc", "s12", "s23"}, "Hashin's criterion");
    // Else equal pulls along axes 2 and 3 would never break the matrix.
    if (given.at("yt") > 2.0 * given.at("s23"))
      throw InputError(
          fmt::format("'strength.yt' = {:g} Pa is more than twice 'strength.s23' = {:g} Pa: Hashin's "
                      "criterion would let equal pulls along axes 2 and 3 grow without bound",
                      given.at("yt"), given.at("s23")));
    return;
  }
  require(given, {"xt", "xc", "yt", "yc", "zt", "zc", "s12", "s13", "s23"}, "Tsai's and Wu's criterion");
  const char* axes[3] = {"x", "y", "z"};
  const char* shears[3] = {"s12", "s23", "s13"};
  for (int i = 0; i < 3; ++i) {
    const double tension = given.at(std::string(axes[i]) + "t"), compression = given.at(std::string(axes[i]) + "c");
    linear_[i] = 1.0 / tension - 1.0 / compression;
    quadratic_(i, i) = 1.0 / (tension * compression);
    quadratic_(3 + i, 3 + i) = 1.0 / (given.at(shears[i]) * given.at(shears[i]));
  }
  Mat3 shares = Mat3::Identity();
  for (int k = 0; k < 3; ++k) {
    const int i = k == 1 ? 1 : 0, j = k == 0 ? 1 : 2;
    const auto found = given.find(couplings[k]);
    shares(i, j) = shares(j, i) = found == given.end() ? -0.5 : found->second;
    quadratic_(i, j) = quadratic_(j, i) = shares(i, j) * std::sqrt(quadratic_(i, i) * quadratic_(j, j));
  }
  check_couplings(shares);
}

Failure Strength::failure(const Vec6& stress) const {
  if (criterion_ == Criterion::hashin) return hashin(stress);
  return {root_of(linear_.dot(stress), stress.dot(quadratic_ * stress)), FailureMode::any};
}

// Z. Hashin (J. Appl. Mech. 47, 1980), in three dimensions; alike across the fibres.
Failure Strength::hashin(const Vec6& s) const {
  const auto square = [](double x) { return x * x; };
  const double s12 = given_.at("s12"), s23 = given_.at("s23"), across = s[1] + s[2];
  const double along_shear = (square(s[3]) + square(s[5])) / square(s12);
  const double in_plane = (square(s[4]) - s[1] * s[2]) / square(s23);
  const Failure fibre =
      s[0] >= 0.0 ? Failure{std::sqrt(square(s[0] / given_.at("xt")) + along_shear), FailureMode::fibre_tension}
                  : Failure{-s[0] / given_.at("xc"), FailureMode::fibre_compression};
  Failure matrix;
  if (across >= 0.0) {
    matrix = {root_of(0.0, square(across / given_.at("yt")) + in_plane + along_shear), FailureMode::matrix_tension};
  } else {
    const double yc = given_.at("yc");
    matrix = {
        root_of((square(0.5 * yc / s23) - 1.0) * across / yc, square(0.5 * across / s23) + in_plane + along_shear),
        FailureMode::matrix_compression};
  }
  return fibre.index >= matrix.index ? fibre : matrix;
}

}  // namespace dygita

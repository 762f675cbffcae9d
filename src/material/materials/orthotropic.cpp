// Three planes of symmetry, nine constants (manual, eq. Y5).
#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "material/material.hpp"

namespace dygita {

namespace {

constexpr const char* pairs[3] = {"12", "23", "13"};  // in the order of the stresses xy yz zx

// Else some pull along both axes would give energy away.
void check_pair(const MaterialNumbers& a, const std::string& one, const std::string& other) {
  const double nu = a.at("nu" + one + other), first = a.at("e" + one), second = a.at("e" + other);
  if (std::abs(nu) < std::sqrt(first / second)) return;
  throw InputError(fmt::format(
      "'nu{0}{1}' = {2:g} is too large: |nu{0}{1}| must be below sqrt(e{0}/e{1}) = {3:.4g}, with 'e{0}' = {4:g} Pa "
      "and 'e{1}' = {5:g} Pa, else the stiffness is not positive definite\n    nu{0}{1} is the contraction along {1} "
      "of a "
      "bar pulled along {0}; nu{1}{0} = nu{0}{1} e{1}/e{0}",
      one, other, nu, std::sqrt(first / second), first, second));
}

// All three together.
void check_all(const MaterialNumbers& a) {
  const double nu12 = a.at("nu12"), nu13 = a.at("nu13"), nu23 = a.at("nu23");
  const double nu21 = nu12 * a.at("e2") / a.at("e1"), nu31 = nu13 * a.at("e3") / a.at("e1"),
               nu32 = nu23 * a.at("e3") / a.at("e2");
  const double left = 1.0 - nu12 * nu21 - nu23 * nu32 - nu13 * nu31 - 2.0 * nu21 * nu32 * nu13;
  constexpr double least = 1e-6;  // rounding is as large as what is left
  if (left > least) return;
  throw InputError(fmt::format(
      "'nu12' = {:g}, 'nu13' = {:g} and 'nu23' = {:g} are too large together: 1 - nu12 nu21 - nu23 nu32 - nu13 nu31 - "
      "2 nu21 nu32 nu13 = {:.3g} is not positive, and so the stiffness is not positive definite",
      nu12, nu13, nu23, left));
}

Elastic make(const MaterialNumbers& a) {
  check_pair(a, "1", "2");
  check_pair(a, "1", "3");
  check_pair(a, "2", "3");
  check_all(a);
  Mat3 compliance;
  for (int i = 0; i < 3; ++i) compliance(i, i) = 1.0 / a.at(fmt::format("e{}", i + 1));
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
    compliance(i, j) = compliance(j, i) = -a.at(fmt::format("nu{}{}", i + 1, j + 1)) * compliance(i, i);
  Mat6 stiffness = Mat6::Zero();
  stiffness.topLeftCorner<3, 3>() = compliance.llt().solve(Mat3::Identity());
  stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
  for (int k = 0; k < 3; ++k) stiffness(3 + k, 3 + k) = a.at(std::string("g") + pairs[k]);
  std::vector<MaterialConstant> constants;
  for (const char* name : {"e1", "e2", "e3", "nu12", "nu13", "nu23", "g12", "g13", "g23"})
    constants.push_back({name, a.at(name)});
  return {std::move(constants), stiffness, a.at("density")};
}

}  // namespace

namespace materials {

MaterialEntry orthotropic() {
  return {"orthotropic", {"e1", "e2", "e3", "nu12", "nu13", "nu23", "g12", "g13", "g23"}, make};
}

}  // namespace materials

}  // namespace dygita

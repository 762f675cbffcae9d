// Upper bounds on the frequencies of an element.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace dygita {

// Keeps the largest of the bounds of the elements it has seen; the order they come in does not matter.
//
// With A = M^-1/2 K M^-1/2 (n x n, rank r = n - 6), the highest eigenvalue is at most ||A||_F, cheap, and at most
// ||A^2||_F^(1/2), which exceeds it by r^(1/4) at worst: 1.44 on the frequency of a hex8. The second is computed only
// when the first could raise the maximum. The frequencies of a mesh with lumped mass are at most those of its elements
// (Irons and Treharne).
class FrequencyBound {
 public:
  // stiffness: 3n x 3n, N/m, dof = 3 node + axis; mass: n, kg.
  template <class Stiffness, class Mass>
  void see(const Stiffness& stiffness, const Mass& mass) {
    Stiffness scaled = stiffness;
    for (int a = 0; a < mass.size(); ++a) {
      const double factor = 1 / std::sqrt(mass[a]);
      scaled.template middleCols<3>(3 * a) *= factor;
      scaled.template middleRows<3>(3 * a) *= factor;
    }
    const double rough = scaled.norm();
    if (rough <= eigenvalue_) return;
    const Stiffness square = scaled.transpose() * scaled;
    eigenvalue_ = std::max(eigenvalue_, std::min(rough, std::sqrt(square.norm())));
  }

  void see(const FrequencyBound& other) { eigenvalue_ = std::max(eigenvalue_, other.eigenvalue_); }

  double frequency() const { return std::sqrt(eigenvalue_); }  // rad/s

 private:
  double eigenvalue_ = 0.0;  // rad^2/s^2
};

}  // namespace dygita

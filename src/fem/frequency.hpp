// Upper bounds on the frequencies of an element.
#pragma once

#include <algorithm>
#include <cmath>

#include "fem/element.hpp"

namespace dygita {

// Keeps the largest of the bounds of the elements it has seen, whatever their order: at most 1.2 times the highest
// frequency of an element. The frequencies of a mesh with lumped mass are at most those of its elements (Irons and
// Treharne).
class FrequencyBound {
 public:
  // stiffness: 3n x 3n, N/m, dof = 3 node + axis; mass: n, kg.
  void see(const CellMatrix& stiffness, const Eigen::Ref<const Eigen::VectorXd>& mass);
  void see(const FrequencyBound& other) { eigenvalue_ = std::max(eigenvalue_, other.eigenvalue_); }

  double frequency() const { return std::sqrt(eigenvalue_); }  // rad/s

 private:
  double eigenvalue_ = 0.0;  // rad^2/s^2
};

}  // namespace dygita

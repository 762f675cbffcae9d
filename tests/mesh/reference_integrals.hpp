// Integrals over reference elements by a fine rule that shares nothing with the tables.
#pragma once

#include <functional>

#include "mesh/shape_functions.hpp"

namespace dygita::test {

// Which of the reference domains a set of corners spans: a simplex of 3 or 4 corners, a prism of 6, or a box.
enum class Domain { box, prism, simplex };

inline Domain domain_of(int n_corners, int n_axes) {
  if (n_corners == n_axes + 1) return Domain::simplex;
  return n_corners == 6 ? Domain::prism : Domain::box;
}

// Of f over the domain: Gauss points along the axes, four each, collapsed where the domain is a simplex. Exact for
// polynomials of degree 4 in each coordinate.
inline double integral(Domain domain, int n_axes, const std::function<double(const Vec3&)>& f) {
  const double at[] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
  const double weight[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < (n_axes == 3 ? 4 : 1); ++k) {
        Vec3 unit(at[i], at[j], n_axes == 3 ? at[k] : 0.0);
        double share = weight[i] * weight[j] * (n_axes == 3 ? weight[k] : 1.0);
        Vec3 xi = unit;
        if (domain == Domain::box) {
          for (int d = 0; d < n_axes; ++d) xi[d] = 2.0 * unit[d] - 1.0;
          share *= n_axes == 3 ? 8.0 : 4.0;
        } else if (domain == Domain::prism || n_axes == 2) {
          xi[1] *= 1.0 - xi[0];
          share *= 1.0 - xi[0];
          if (domain == Domain::prism) {
            xi[2] = 2.0 * unit[2] - 1.0;
            share *= 2.0;
          }
        } else {
          xi[1] *= 1.0 - xi[0];
          xi[2] *= 1.0 - xi[0] - xi[1];
          share *= (1.0 - xi[0]) * (1.0 - xi[0] - xi[1]);
        }
        sum += share * f(xi);
      }
  return sum;
}

}  // namespace dygita::test

// Shape functions of facets written out, all sizes known to the compiler: the integrals of interfaces ask for them
// millions of times. Those of mesh/shape_functions.hpp, to rounding.
#pragma once

#include "mesh/facet_types.hpp"
#include "numerics/types.hpp"

namespace dygita {

template <int n>
struct SizedFacet {
  using Values = Eigen::Matrix<double, n, 1>;
  using Slopes = Eigen::Matrix<double, n, 2>;
};

struct Tri3 : SizedFacet<3> {
  static Values values(double r, double s) { return {1 - r - s, r, s}; }
  static Slopes slopes(double, double) { return (Slopes() << -1, -1, 1, 0, 0, 1).finished(); }
};

struct Quad4 : SizedFacet<4> {
  static Values values(double r, double s) {
    return 0.25 * Values((1 - r) * (1 - s), (1 + r) * (1 - s), (1 + r) * (1 + s), (1 - r) * (1 + s));
  }
  static Slopes slopes(double r, double s) {
    return 0.25 * (Slopes() << s - 1, r - 1, 1 - s, -1 - r, 1 + s, 1 + r, -1 - s, 1 - r).finished();
  }
};

struct Tri6 : SizedFacet<6> {
  static Values values(double r, double s) {
    const double t = 1 - r - s;
    return (Values() << t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t).finished();
  }
  static Slopes slopes(double r, double s) {
    const double t = 1 - r - s, corner = 1 - 4 * t;
    return (Slopes() << corner, corner, 4 * r - 1, 0, 0, 4 * s - 1, 4 * (t - r), -4 * r, 4 * s, 4 * r, -4 * s,
            4 * (t - s))
        .finished();
  }
};

struct Quad8 : SizedFacet<8> {
  static Values values(double r, double s) {
    const double a = 1 - r, b = 1 + r, c = 1 - s, d = 1 + s;
    return (Values() << 0.25 * a * c * (-r - s - 1), 0.25 * b * c * (r - s - 1), 0.25 * b * d * (r + s - 1),
            0.25 * a * d * (s - r - 1), 0.5 * a * b * c, 0.5 * b * c * d, 0.5 * a * b * d, 0.5 * a * c * d)
        .finished();
  }
  static Slopes slopes(double r, double s) {
    const double a = 1 - r, b = 1 + r, c = 1 - s, d = 1 + s;
    return (Slopes() << 0.25 * c * (2 * r + s), 0.25 * a * (2 * s + r), 0.25 * c * (2 * r - s), 0.25 * b * (2 * s - r),
            0.25 * d * (2 * r + s), 0.25 * b * (2 * s + r), 0.25 * d * (2 * r - s), 0.25 * a * (2 * s - r), -r * c,
            -0.5 * a * b, 0.5 * c * d, -s * b, -r * d, 0.5 * a * b, -0.5 * c * d, -s * a)
        .finished();
  }
};

struct Quad9 : SizedFacet<9> {
  // Of a line with nodes at -1, 1 and 0.
  static Eigen::Vector3d line(double x) { return {0.5 * x * (x - 1), 0.5 * x * (x + 1), 1 - x * x}; }
  static Eigen::Vector3d line_slopes(double x) { return {x - 0.5, x + 0.5, -2 * x}; }
  static Values product(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    return (Values() << u[0] * v[0], u[1] * v[0], u[1] * v[1], u[0] * v[1], u[2] * v[0], u[1] * v[2], u[2] * v[1],
            u[0] * v[2], u[2] * v[2])
        .finished();
  }
  static Values values(double r, double s) { return product(line(r), line(s)); }
  static Slopes slopes(double r, double s) {
    Slopes both;
    both << product(line_slopes(r), line(s)), product(line(r), line_slopes(s));
    return both;
  }
};

// work(shape) for the shape of a type.
template <class Work>
auto with_facet(FacetType type, Work&& work) {
  switch (type) {
    case FacetType::tri3:
      return work(Tri3());
    case FacetType::quad4:
      return work(Quad4());
    case FacetType::tri6:
      return work(Tri6());
    case FacetType::quad8:
      return work(Quad8());
    default:
      return work(Quad9());
  }
}

}  // namespace dygita

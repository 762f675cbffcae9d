#include "material/layup.hpp"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "base/fnv1a.hpp"
#include "material/elastic.hpp"

namespace dygita {

PlyLaw::PlyLaw(const Mat6& stiffness) {
  const Mat3 plane = stiffness(plane_rows, plane_rows), mixed = stiffness(plane_rows, across_rows),
             across = stiffness(across_rows, across_rows);
  s = across.inverse();
  h = mixed * s;
  q = plane - h * mixed.transpose();
  s = (0.5 * (s + s.transpose())).eval();
  q = (0.5 * (q + q.transpose())).eval();
}

Layup::Layup(std::vector<Ply> plies) : plies_(std::move(plies)) {
  for (const Ply& ply : plies_) thickness_ += ply.thickness;
  double below = 0.0;
  for (const Ply& ply : plies_) {
    laws_.emplace_back(ply.stiffness);
    bounds_.push_back(2.0 * below / thickness_ - 1.0);
    below += ply.thickness;
  }
  bounds_.push_back(1.0);
}

bool Layup::has_strengths() const {
  for (const Ply& ply : plies_)
    if (!ply.strength) return false;
  return true;
}

Mat6 Layup::mean_stiffness() const {
  Mat3 q = Mat3::Zero(), h = Mat3::Zero(), s = Mat3::Zero();
  for (int i = 0; i < n_plies(); ++i) {
    const double share = ply(i).thickness / thickness_;
    q += share * law(i).q;
    h += share * law(i).h;
    s += share * law(i).s;
  }
  const Mat3 across = s.inverse(), mixed = h * across, plane = q + mixed * h.transpose();
  Mat6 mean;
  mean(plane_rows, plane_rows) = plane;
  mean(plane_rows, across_rows) = mixed;
  mean(across_rows, plane_rows) = mixed.transpose();
  mean(across_rows, across_rows) = across;
  return 0.5 * (mean + mean.transpose());
}

double Layup::digest() const {
  Checksum sum;
  for (const Ply& ply : plies_) {
    sum.add(&ply.thickness, sizeof(double));
    sum.add(ply.stiffness.data(), 36 * sizeof(double));
  }
  return static_cast<double>(sum.value() >> 12);  // a double holds so many bits
}

Elastic laminate(const std::vector<PlyOf>& given) {
  std::vector<Ply> plies;
  double mass = 0.0, thickness = 0.0;
  for (const PlyOf& one : given) {
    const double c = std::cos(one.angle), s = std::sin(one.angle);
    Ply& ply = plies.emplace_back();
    ply.material = one.material.name;
    ply.thickness = one.thickness;
    ply.angle = one.angle;
    ply.axes << c, -s, 0, s, c, 0, 0, 0, 1;
    ply.stiffness = one.material.tensor().turned(ply.axes).stiffness();
    ply.strength = one.strength;
    mass += one.material.density * one.thickness;
    thickness += one.thickness;
  }
  const auto layup = std::make_shared<const Layup>(std::move(plies));
  const Mat6 stiffness = layup->mean_stiffness(), soft = ElasticTensor(stiffness).compliance();
  const std::vector<MaterialConstant> constants = {{"e1", 1 / soft(0, 0)},
                                                   {"e2", 1 / soft(1, 1)},
                                                   {"e3", 1 / soft(2, 2)},
                                                   {"nu12", -soft(0, 1) / soft(0, 0)},
                                                   {"nu13", -soft(0, 2) / soft(0, 0)},
                                                   {"nu23", -soft(1, 2) / soft(1, 1)},
                                                   {"g12", 1 / soft(3, 3)},
                                                   {"g13", 1 / soft(5, 5)},
                                                   {"g23", 1 / soft(4, 4)}};
  Elastic material(constants, stiffness, mass / thickness);
  material.layup = layup;
  return material;
}

}  // namespace dygita

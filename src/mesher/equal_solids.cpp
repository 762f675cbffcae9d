#include "mesher/equal_solids.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "mesher/gmsh_session.hpp"

namespace dygita {

namespace {

constexpr double equal_places = 1e-5;  // of the size
constexpr double equal_areas = 1e-6;   // relative

struct Landmarks {
  double volume = 0.0, size = 0.0;
  Vec areas;
  Points places;  // centre of mass, centres of the faces, corners
  Mat3 inertia;   // about the centre of mass
};

Landmarks landmarks_of(const SolidFaces& solid) {
  namespace occ = gmsh::model::occ;
  Landmarks own;
  std::vector<Vec3> places(1);
  occ::getMass(3, solid.tag, own.volume);
  occ::getCenterOfMass(3, solid.tag, places[0][0], places[0][1], places[0][2]);
  own.areas.resize(static_cast<Eigen::Index>(solid.surfaces.size()));
  for (size_t i = 0; i < solid.surfaces.size(); ++i) {
    occ::getMass(2, solid.surfaces[i], own.areas[static_cast<Eigen::Index>(i)]);
    Vec3& centre = places.emplace_back();
    occ::getCenterOfMass(2, solid.surfaces[i], centre[0], centre[1], centre[2]);
  }
  GmshEntities corners;
  gmsh::model::getBoundary({{3, solid.tag}}, corners, false, false, true);
  std::sort(corners.begin(), corners.end());  // by the order of the file
  for (const auto& [dimension, tag] : corners) {
    std::vector<double> at;
    gmsh::model::getValue(dimension, tag, {}, at);
    places.emplace_back(at[0], at[1], at[2]);
  }
  own.places.resize(3, static_cast<Eigen::Index>(places.size()));
  for (size_t i = 0; i < places.size(); ++i) own.places.col(static_cast<Eigen::Index>(i)) = places[i];
  own.size = (own.places.rowwise().maxCoeff() - own.places.rowwise().minCoeff()).norm();
  std::vector<double> inertia;
  occ::getMatrixOfInertia(3, solid.tag, inertia);
  own.inertia = Eigen::Map<const Mat3>(inertia.data());
  return own;
}

bool have_equal_sizes(const Landmarks& a, const Landmarks& b) {
  return a.places.cols() == b.places.cols() && a.areas.size() == b.areas.size() &&
         std::abs(a.volume - b.volume) <= equal_areas * a.volume &&
         ((a.areas - b.areas).array().abs() <= equal_areas * a.areas.array()).all();
}

// W. Kabsch, Acta Crystallographica 32 (1976): the rotation that brings one set of places closest to another.
std::optional<SolidCopy> copy_of(const Landmarks& a, const Landmarks& b) {
  if (!have_equal_sizes(a, b) || !(a.size > 0.0)) return {};
  const Vec3 middle_a = a.places.rowwise().mean(), middle_b = b.places.rowwise().mean();
  const Points from = a.places.colwise() - middle_a, to = b.places.colwise() - middle_b;
  const Eigen::JacobiSVD<Mat3> svd(to * from.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  // All in a line, as of a ball: any turn about it fits.
  if (svd.singularValues()[1] <= equal_places * svd.singularValues()[0]) return {};
  Mat3 sense = Mat3::Identity();
  sense(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  SolidCopy copy;
  copy.turn = svd.matrixU() * sense * svd.matrixV().transpose();
  copy.shift = middle_b - copy.turn * middle_a;
  const double error = (copy.turn * from - to).colwise().norm().maxCoeff();
  const Mat3 inertia = copy.turn * a.inertia * copy.turn.transpose();
  if (error > equal_places * a.size || (inertia - b.inertia).norm() > equal_places * a.inertia.norm()) return {};
  return copy;
}

}  // namespace

std::vector<std::optional<SolidCopy>> equal_solids(const std::vector<SolidFaces>& solids, double unit) {
  std::vector<Landmarks> landmarks;
  std::vector<std::optional<SolidCopy>> copies(solids.size());
  for (size_t i = 0; i < solids.size(); ++i) {
    landmarks.push_back(landmarks_of(solids[i]));
    for (size_t j = 0; j < i && !copies[i]; ++j) {
      if (copies[j]) continue;
      copies[i] = copy_of(landmarks[j], landmarks[i]);
      if (!copies[i]) continue;
      copies[i]->of = static_cast<int>(j);
      copies[i]->shift *= unit;
    }
  }
  return copies;
}

}  // namespace dygita

// Plies on one another, glued: a layup, as one material.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "material/elastic_tensor.hpp"
#include "material/strength.hpp"

namespace dygita {

class Elastic;

struct Ply {
  std::string material;
  double thickness = 0.0, angle = 0.0;  // m; radians, of its axis 1 against that of the layup, about axis 3
  Mat6 stiffness = Mat6::Zero();        // Pa, in the axes of the layup
  Mat3 axes = Mat3::Identity();         // columns: its own, in those of the layup
  std::shared_ptr<const Strength> strength;
};

// A ply solved for what is the same on both sides of its faces, strains of the plane and stresses across it: s = q e +
// h t, d = -h^T e + s t, with e and s of the plane, d and t across (manual, eq. Y10).
struct PlyLaw {
  Mat3 q, h, s;  // Pa; 1; 1/Pa
  explicit PlyLaw(const Mat6& stiffness);
};

class Layup {
 public:
  // From below, along axis 3.
  explicit Layup(std::vector<Ply> plies);

  int n_plies() const { return static_cast<int>(plies_.size()); }
  const Ply& ply(int i) const { return plies_[static_cast<size_t>(i)]; }
  const PlyLaw& law(int i) const { return laws_[static_cast<size_t>(i)]; }
  double thickness() const { return thickness_; }  // m
  // Where a ply begins, and at n_plies() the last ends: -1 below, 1 above.
  double bound(int i) const { return bounds_[static_cast<size_t>(i)]; }
  bool has_strengths() const;
  // Pa, of many such layups on one another (eq. Y11): waves, impedances and search directions take it.
  Mat6 mean_stiffness() const;
  double digest() const;  // of all that makes matrices, a whole number

 private:
  std::vector<Ply> plies_;
  std::vector<PlyLaw> laws_;
  std::vector<double> bounds_;
  double thickness_ = 0.0;
};

// Positions of the two parts in a column of six.
inline constexpr int plane_rows[3] = {0, 1, 3}, across_rows[3] = {2, 4, 5};

struct PlyOf {
  const Elastic& material;
  std::shared_ptr<const Strength> strength;
  double thickness, angle;  // m; radians
};
// A layup as a material, its density the mean by thickness.
Elastic laminate(const std::vector<PlyOf>& plies);

}  // namespace dygita

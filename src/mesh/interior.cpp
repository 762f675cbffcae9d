#include "mesh/interior.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace dygita {

namespace {

struct Cells final : Interior {
  const CondensedBody* matrices() const override { return nullptr; }
  bool is_place(int) const override { return true; }
  using Interior::rigid_motion;
  Points rigid_motion(const Points& x, const Vec3& about, const Vec3& translation,
                      const Vec3& rotation) const override {
    Points motion(3, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) motion.col(i) = translation + rotation.cross(Vec3(x.col(i) - about));
    return motion;
  }
  ResistedMotions resisted_motions(const Points&) const override { return {6, 0}; }
  Points acceleration(const Points& x, const std::function<Vec3(const Vec3&)>& at) const override {
    Points nodal(3, x.cols());
    for (Eigen::Index node = 0; node < x.cols(); ++node) nodal.col(node) = at(x.col(node));
    return nodal;
  }
  double mass(double of_cells) const override { return of_cells; }
  std::shared_ptr<const Interior> turned(const Mat3&, const Points&) const override { return of_cells(); }
  void add_to(Fnv1a&) const override {}
};

}  // namespace

const std::shared_ptr<const Interior>& Interior::of_cells() {
  static const std::shared_ptr<const Interior> cells = std::make_shared<const Cells>();
  return cells;
}

const Interior::Follower* Interior::follower(int node) const {
  const auto own = std::lower_bound(followers.begin(), followers.end(), node,
                                    [](const Follower& one, int at) { return one.node < at; });
  return own == followers.end() || own->node != node ? nullptr : &*own;
}

double Interior::size_of_turn(int node) const {
  const auto own =
      std::find_if(followers.begin(), followers.end(), [&](const Follower& one) { return one.turn == node; });
  return own == followers.end() ? 0.0 : own->size;
}

bool Interior::resists(const Points& x, const Vec3& direction) const {
  constexpr double nothing = 1e-6;
  const Mat resisted = resisted_motions(x).topRows(3);
  return (resisted.transpose() * direction).norm() > nothing * direction.norm();
}

}  // namespace dygita

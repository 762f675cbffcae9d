#include "interfaces/sum_surfaces.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "law/law.hpp"
#include "meeting/sum_facing.hpp"
#include "model/extent.hpp"
#include "model/places.hpp"
#include "numerics/dense.hpp"
#include "numerics/frame_along.hpp"

namespace dygita {

namespace {

// Of one part: what the motion of each node adds to the sum, row . u.
class Terms {
 public:
  // Of a node that follows a rigid face: row . (u_point + u_turn / size x arm).
  void add(const Interior& body, int node, const Vec3& row) {
    const Interior::Follower* own = body.follower(node);
    add(own ? own->point : node, row);
    if (own && own->turn >= 0) add(own->turn, own->arm.cross(row) / own->size);
  }
  void add(int node, const Vec3& row) { rows_.try_emplace(node, Vec3::Zero()).first->second += row; }

  double square() const {
    double sum = 0.0;
    for (const auto& [node, row] : rows_) sum += row.squaredNorm();
    return sum;
  }
  const Vec3& largest() const {
    const auto shorter = [](const auto& a, const auto& b) {
      return a.second.squaredNorm() < (1.0 - 1e-9) * b.second.squaredNorm();
    };
    return std::max_element(rows_.begin(), rows_.end(), shorter)->second;
  }

  // A point whose motion along e is the sum: e . (t V + d x V) = row . V with t = e . row, d = row x e.
  void add_point(double sign, const Vec3& e, SideTrace& trace) const {
    std::vector<SideTrace::Share> shares;
    bool has_arms = false;
    for (const auto& [node, row] : rows_) {
      Vec3 arm = row.cross(e);
      if (arm.norm() < 1e-14 * row.norm()) arm.setZero();
      has_arms = has_arms || !arm.isZero(0.0);
      if (!row.isZero(0.0)) shares.push_back({node, sign * e.dot(row), sign * arm});
    }
    trace.add(shares, has_arms ? Mat3(Mat3::Identity()) : Mat3(Mat3::Zero()));
  }
  bool are_none() const { return square() == 0.0; }

 private:
  std::map<int, Vec3> rows_;
};

// A place and its mean motion; its rotation about an axis k is sum ((J^-1 k) x arm) . u.
struct Place {
  const Substructure* part;
  MeanNodes mean;
  const Interior::Follower* whole = nullptr;  // all nodes follow one rigid face

  explicit Place(const FaceOrRegion& on) : part(&part_of(on)), mean(mean_of(on)) {
    whole = part->mesh->inside->follower(mean.nodes.front());
    for (const int node : mean.nodes) {
      const Interior::Follower* own = part->mesh->inside->follower(node);
      if (!own || own->turn < 0 || own->turn != whole->turn) whole = nullptr;
    }
  }
  // m, of gyration.
  double radius() const { return std::max(std::sqrt(0.5 * mean.inertia.trace()), whole ? whole->size : 0.0); }

  void add_motion(const Vec3& along, Terms& terms) const {
    for (size_t k = 0; k < mean.nodes.size(); ++k)
      terms.add(*part->mesh->inside, mean.nodes[k], mean.shares[static_cast<Eigen::Index>(k)] * along);
  }
  // along: a unit vector times a length. Answers whether there is a rotation.
  bool add_rotation(const Vec3& about, Terms& terms) const {
    if (whole) {
      terms.add(whole->turn, about / whole->size);
      return true;
    }
    const PrincipalAxes principal = principal_axes(mean.inertia);
    constexpr double least = 1e-9;
    if (!(principal.values[0] > least * principal.values[2])) return false;
    const Vec3 axis = mean.inertia.inverse() * about;
    for (size_t k = 0; k < mean.nodes.size(); ++k)
      terms.add(*part->mesh->inside, mean.nodes[k], axis.cross(Vec3(mean.arms.col(static_cast<Eigen::Index>(k)))));
    return true;
  }
};

// All lines of a support are of the same places.
class Sum {
 public:
  Sum(const Problem& problem, const Support& sum) : problem_(problem), sum_(sum) {
    for (const FaceOrRegion& on : sum.on) {
      const Place& place = places_.emplace_back(on);
      parts_.try_emplace(index_of(problem.substructures, place.part));
      place_ += (place.mean.centre + place.part->place) / static_cast<double>(sum.on.size());
      const Mesh& mesh = *place.part->mesh;
      const double size = mesh.has_cells() ? std::cbrt(volume(mesh)) : extent_of(*place.part).size().norm();
      length_ = std::max(length_, size / std::cbrt(mesh.n_nodes()));
    }
    double positive = 0.0, negative = 0.0;
    for (const double factor : sum.factors) (factor > 0 ? positive : negative) += std::abs(factor);
    most_ = std::max(positive, negative);
    all_ = positive + negative;
    if (parts_.size() > 2) refuse(fmt::format("its places are on {} parts, and two are the most", parts_.size()));
  }

  // A line whose terms are along `of_place` of each, times its factor. Factors are scaled, so that those of one sign
  // make at most 1.
  Surface along(const std::vector<Vec3>& of_place) const {
    std::map<int, Terms> terms = parts_;
    Vec3 net = Vec3::Zero();
    for (size_t i = 0; i < places_.size(); ++i) {
      const Vec3 row = sum_.factors[i] / most_ * of_place[i];
      places_[i].add_motion(row, terms.at(part(i)));
      net += row;
    }
    Surface surface = of(terms, std::pow(all_ / most_, 2), of_place.front().normalized());
    surface.is_on_ground = net.norm() > 1e-9 * all_ / most_;
    return surface;
  }
  // The rotation of one place about an axis, or that against another's, times a length: that of gyration.
  std::pair<Surface, double> about(const Vec3& axis) const {
    const double radius = places_.front().radius();
    std::map<int, Terms> terms = parts_;
    for (size_t i = 0; i < places_.size(); ++i)
      if (!places_[i].add_rotation(sum_.factors[i] * radius * axis, terms.at(part(i))))
        refuse(fmt::format("the nodes of '{}' lie on a line or at a point, and have no mean rotation",
                           label_of(sum_.on[i])));
    Surface surface = of(terms, 1.0, terms.begin()->second.largest().normalized());
    surface.is_on_ground = places_.size() == 1;
    surface.is_of_rotation = true;
    return {surface, radius};
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(sum_.origin, fmt::format("support.{} '{}': {}", sum_.kind->word(), sum_.name, why));
  }
  int part(size_t i) const { return index_of(problem_.substructures, places_[i].part); }

  // A point that moves along e, and is as large as whole / sum of squares of the rows nodes.
  Surface of(const std::map<int, Terms>& terms, double whole, const Vec3& e) const {
    double square = 0.0;
    for (const auto& [part, own] : terms) {
      square += own.square();
      if (own.are_none()) refuse("its terms cancel each other");
    }
    Surface surface;
    surface.wall = &sum_;
    surface.part_1 = terms.begin()->first;
    surface.facing = facing_of_sum(place_, whole / std::max(square, 1e-6) * length_ * length_);
    surface.facing.frames = {frame_along(e)};
    surface.facing.directions = {{true, false, false}};
    surface.facing.normals = e;
    terms.begin()->second.add_point(1.0, e, surface.facing.side_1);
    if (terms.size() == 1) return surface;
    surface.part_2 = terms.rbegin()->first;
    terms.rbegin()->second.add_point(-1.0, e, surface.facing.side_2);
    return surface;
  }

  const Problem& problem_;
  const Support& sum_;
  std::vector<Place> places_;
  std::map<int, Terms> parts_;  // empty, one a part
  Vec3 place_ = Vec3::Zero();   // m
  double length_ = 0.0;         // m, between nodes
  double most_ = 0.0, all_ = 0.0;
};

}  // namespace

// One point a line: each is a direction of its own.
void add_sums(const Problem& problem, const Support& sum, std::vector<Surface>& surfaces) {
  const Sum of(problem, sum);
  const auto add = [&](Surface surface, const LawPtr& law) {
    surface.law = law;
    surfaces.push_back(std::move(surface));
  };
  if (!sum.terms.empty()) return add(of.along(sum.terms), sum.kind->law());
  for (int axis = 0; axis < 3; ++axis) {
    const auto spring = sum.kind->spring(axis);
    if (spring ? spring->stiffness == 0.0 : !sum.kind->sums().axes[static_cast<size_t>(axis)]) continue;
    const Surface surface = of.along(std::vector<Vec3>(sum.on.size(), sum.axes.col(axis)));
    add(surface, spring ? law_of_spring(*spring, surface.facing.areas[0]) : sum.kind->law());
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto spring = sum.kind->spring(3 + axis);
    if (!spring || spring->stiffness == 0.0) continue;
    const auto [surface, radius] = of.about(sum.axes.col(axis));
    const double square = radius * radius;
    add(surface, law_of_spring({spring->stiffness / square, spring->damping / square}, surface.facing.areas[0]));
  }
}

}  // namespace dygita

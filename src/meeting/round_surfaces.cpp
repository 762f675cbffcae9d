#include "meeting/round_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/face_nodes.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr double of_arc = 1e-3;     // of an arc over its facet: how far nodes may be off a round surface
constexpr double of_patch = 1e-9;   // of a patch: the same of a plane, by rounding
constexpr double unturned = 1e-12;  // a squared sine: normals that do not turn

// The middle of a circle or a sphere through points (columns), by least squares, and its radius.
std::pair<Vec, double> centre_through(const Mat& x) {
  Mat system(x.cols(), x.rows() + 1);
  system << x.transpose(), Vec::Ones(x.cols());
  const Vec solution = solve_least_norm(system, x.colwise().squaredNorm().transpose(), 1e-15).x;
  const Vec centre = 0.5 * solution.head(x.rows());
  return {centre, std::sqrt(std::max(0.0, solution[x.rows()] + centre.squaredNorm()))};
}

double size_of(const Points& x) { return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm(); }

}  // namespace

RoundSurface::Patch::Patch(const PlacedFace& face) {
  std::vector<int> corners;
  for (const Facet& facet : face.facets) corners.insert(corners.end(), facet.corners().begin(), facet.corners().end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  x = face.mesh->nodes(Eigen::all, corners).colwise() + face.place;
  middles = normals = Points::Zero(3, static_cast<Eigen::Index>(face.facets.size()));
  for (size_t f = 0; f < face.facets.size(); ++f) {
    const auto column = static_cast<Eigen::Index>(f);
    const std::span<const int> around = face.facets[f].corners();
    for (const int node : around)
      middles.col(column) += (face.mesh->nodes.col(node) + face.place) / static_cast<double>(around.size());
    normals.col(column) = facet_area_vector(face.mesh->nodes, face.facets[f]).normalized();
  }
}

Vec3 RoundSurface::across(const Vec3& x) const {
  const Vec3 from = x - centre_;
  if (kind_ == Kind::plane) return axis_;
  return kind_ == Kind::sphere ? from : Vec3(from - axis_.dot(from) * axis_);
}

// How far corners are off, how high arcs are over the facets, and where the body is.
void RoundSurface::measure(const Patch& patch) {
  const auto off = [&](const Vec3& x) {
    return kind_ == Kind::plane ? axis_.dot(x - centre_) : across(x).norm() - radius_;
  };
  double outward = 0.0;
  for (Eigen::Index i = 0; i < patch.x.cols(); ++i) off_ = std::max(off_, std::abs(off(patch.x.col(i))));
  for (Eigen::Index f = 0; f < patch.middles.cols(); ++f) {
    height_ = std::max(height_, std::abs(off(patch.middles.col(f))));
    outward += across(patch.middles.col(f)).dot(patch.normals.col(f));
  }
  sign_ = outward < 0.0 ? -1.0 : 1.0;
}

RoundSurface RoundSurface::plane(const Patch& patch) {
  RoundSurface surface;
  surface.centre_ = patch.x.rowwise().mean();
  surface.axis_ = patch.normals.rowwise().mean().normalized();
  surface.measure(patch);
  return surface;
}

RoundSurface RoundSurface::sphere(const Patch& patch) {
  RoundSurface surface;
  surface.kind_ = Kind::sphere;
  const Vec3 middle = patch.x.rowwise().mean();
  const auto [centre, radius] = centre_through(patch.x.colwise() - middle);
  surface.centre_ = middle + centre;
  surface.radius_ = radius;
  surface.measure(patch);
  return surface;
}

// Starts from what the normals have in common least, and turns and moves the axis (Gauss and Newton) until the corners
// are as near as can be: normals of triangles lean.
RoundSurface RoundSurface::cylinder(const Patch& patch) {
  RoundSurface surface;
  surface.kind_ = Kind::cylinder;
  const PrincipalAxes turned = principal_axes(patch.normals * patch.normals.transpose());
  const Vec3 middle = patch.x.rowwise().mean();
  surface.axis_ = turned.vectors.col(0);
  const Eigen::Matrix<double, 3, 2> plane = turned.vectors.rightCols<2>();
  const auto [centre, radius] = centre_through(plane.transpose() * (patch.x.colwise() - middle));
  surface.centre_ = middle + plane * centre;
  surface.radius_ = radius;
  const double size = size_of(patch.x);
  for (int step = 0; step < 30; ++step) {
    Eigen::Matrix<double, 3, 2> sides;
    sides << surface.axis_.unitOrthogonal(), surface.axis_.cross(surface.axis_.unitOrthogonal());
    Mat system(patch.x.cols(), 5);
    Vec off(patch.x.cols());
    for (Eigen::Index i = 0; i < patch.x.cols(); ++i) {
      const Vec3 across = surface.across(patch.x.col(i));
      const Eigen::Vector2d out = sides.transpose() * across.normalized();
      const double height = surface.axis_.dot(patch.x.col(i) - middle) / size;
      system.row(i) << out.transpose(), height * out.transpose(), 1.0;
      off[i] = across.norm() - surface.radius_;
    }
    const Vec change = solve_least_norm(system, off, 1e-13).x;
    // The axis turns about its place beside the middle.
    surface.centre_ += surface.axis_ * surface.axis_.dot(middle - surface.centre_) + sides * change.head<2>();
    surface.axis_ = (surface.axis_ + sides * change.segment<2>(2) / size).normalized();
    surface.radius_ += change[4];
    if (change.norm() < 1e-14 * size) break;
  }
  surface.measure(patch);
  return surface;
}

// Four lines of a cylinder lie on a circle where they are as far apart, those of a chamfered edge do whenever it is
// even: only more of them tell.
bool RoundSurface::is_determined_by(const Patch& patch) const {
  constexpr double apart = 1e-3, alike = 1.5;
  if (kind_ == Kind::sphere) return patch.x.cols() >= 8;
  const Vec3 first = axis_.unitOrthogonal(), second = axis_.cross(first);
  std::vector<double> angles;
  const Vec3 middle = across(patch.x.rowwise().mean());
  const double start = std::atan2(second.dot(middle), first.dot(middle));
  for (Eigen::Index i = 0; i < patch.x.cols(); ++i) {
    const Vec3 out = across(patch.x.col(i));
    angles.push_back(std::remainder(std::atan2(second.dot(out), first.dot(out)) - start, 2.0 * M_PI));
  }
  std::sort(angles.begin(), angles.end());
  std::vector<double> steps;
  for (size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > apart * (angles.back() - angles.front()))
      steps.push_back(angles[i] - angles[i - 1]);
  if (steps.size() > 3) return true;
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  return steps.size() == 3 && *most < alike * *least;
}

std::optional<RoundSurface> RoundSurface::through(const PlacedFace& face) {
  const Patch patch(face);
  const RoundSurface flat_one = plane(patch);
  if (flat_one.off_ < of_patch * size_of(patch.x)) return flat_one;
  if (patch.x.cols() < 6) return {};
  const Vec3 turns = principal_axes(patch.normals * patch.normals.transpose()).values;
  if (turns[1] < unturned * turns[2]) return {};
  for (const RoundSurface& surface : {cylinder(patch), sphere(patch)})
    if (surface.off_ < of_arc * surface.height_ && surface.is_determined_by(patch)) return surface;
  return {};
}

std::optional<double> RoundSurface::along(const Vec3& x, const Vec3& direction) const {
  if (kind_ == Kind::plane) {
    const double slope = axis_.dot(direction);
    if (std::abs(slope) < 0.1) return {};
    return axis_.dot(centre_ - x) / slope;
  }
  // |from + s d| = radius, in the plane across a cylinder.
  const Vec3 from = across(x), d = kind_ == Kind::sphere ? direction : Vec3(direction - axis_.dot(direction) * axis_);
  const double a = d.squaredNorm(), b = from.dot(d), c = from.squaredNorm() - radius_ * radius_, root = b * b - a * c;
  if (a < 0.01 || root < 0.0) return {};
  // The smaller root, without the difference of numbers that are nearly the same.
  return -c / (b + std::copysign(std::sqrt(root), b));
}

std::optional<double> RoundSurface::even_gap(const RoundSurface& other) const {
  constexpr double nothing = 1e-5, of_gap = 0.1;  // of a radius; how far centres may be off each other
  if (kind_ == Kind::plane || kind_ != other.kind_ || sign_ == other.sign_) return {};
  const double gap = sign_ * (other.radius_ - radius_);
  if (std::abs(gap) < std::max(nothing * radius_, 10.0 * (off_ + other.off_))) return {};
  const double tilt = kind_ == Kind::sphere ? 0.0 : axis_.cross(other.axis_).norm() * radius_;
  if (across(other.centre_).norm() + tilt > of_gap * std::abs(gap)) return {};
  return gap;
}

std::optional<double> RoundSurface::above(const RoundSurface& flat) const {
  constexpr double along = 1e-6;
  const Vec3 normal = flat.normal(flat.centre_);
  if (kind_ == Kind::cylinder && std::abs(axis_.dot(normal)) > along) return {};
  return normal.dot(centre_ - flat.centre_) - radius_;
}

RoundFace::RoundFace(const PlacedFace& face) {
  for (const PlacedFace& patch : smooth_parts(face)) {
    const std::optional<RoundSurface> surface = RoundSurface::through(patch);
    if (!surface) {
      is_known_ = false;
      continue;
    }
    for (const int node : nodes_of(patch.facets)) of_node_[node].push_back(static_cast<int>(surfaces_.size()));
    surfaces_.push_back(*surface);
  }
}

bool RoundFace::is_curved() const {
  return std::any_of(surfaces_.begin(), surfaces_.end(), [](const RoundSurface& s) { return s.radius() > 0.0; });
}

double RoundFace::least_radius() const {
  double least = std::numeric_limits<double>::max();
  for (const RoundSurface& surface : surfaces_)
    if (surface.radius() > 0.0) least = std::min(least, surface.radius());
  return least;
}

std::optional<double> RoundFace::even_gap(const RoundFace& other) const {
  if (surfaces_.size() != 1 || other.surfaces_.size() != 1 || !is_known_ || !other.is_known_) return {};
  return surfaces_[0].even_gap(other.surfaces_[0]);
}

std::pair<const RoundSurface*, const RoundSurface*> RoundFace::flat_and_round(const RoundFace& other) const {
  if (surfaces_.size() != 1 || other.surfaces_.size() != 1 || !is_known_ || !other.is_known_) return {};
  const RoundSurface *flat = &surfaces_[0], *round = &other.surfaces_[0];
  if (!flat->is_flat()) std::swap(flat, round);
  if (!flat->is_flat() || !round->bulges()) return {};
  return {flat, round};
}

double RoundFace::reach_on_flat(const RoundFace& other) const {
  constexpr double heights = 49.0;  // the gap three and a half facets from the middle of the first
  constexpr double of_radius = 0.125;
  const RoundSurface* round = flat_and_round(other).second;
  return round ? std::min(heights * round->height(), of_radius * round->radius()) : 0.0;
}

double RoundFace::missed_on_flat(const RoundFace& other, double least_at_nodes) const {
  constexpr double more = 1.01;
  constexpr double of_indentation =
      5e-4;  // of the radius, as deep as metals give: so much of it is a matter of the mesh
  const auto [flat, round] = flat_and_round(other);
  if (!round) return 0.0;
  const double missed = least_at_nodes - round->above(*flat).value_or(least_at_nodes);
  // Where it is more than an arc, the line is not where the faces meet.
  return missed < more * round->height() ? std::max(0.0, missed - of_indentation * round->radius()) : 0.0;
}

double RoundFace::off() const {
  double most = 0.0;
  for (const RoundSurface& surface : surfaces_) most = std::max(most, surface.off());
  return most;
}

std::optional<double> RoundFace::along(const Vec3& x, const Vec3& direction, int node) const {
  const auto own = of_node_.find(node);
  if (own == of_node_.end()) return {};
  const RoundSurface* best = nullptr;
  double most = -1.0;
  for (const int s : own->second) {
    const RoundSurface& surface = surfaces_[static_cast<size_t>(s)];
    const double cosine = std::abs(surface.normal(x).dot(direction));
    if (cosine > most) best = &surface;
    most = std::max(most, cosine);
  }
  return best->along(x, direction);
}

std::optional<RoundGaps> round_gaps(const PlacedFace& side_1, const PlacedFace& side_2, const Facing& facing) {
  const RoundFace face_1(side_1), face_2(side_2);
  if (!face_1.is_known() || !face_2.is_known()) return {};
  const auto gap = [&](const Vec3& x, const Vec3& normal, int i) -> std::optional<double> {
    const std::optional<double> to_1 = face_1.along(x, normal, facing.side_1.main_node(i)),
                                to_2 = face_2.along(x, normal, facing.side_2.main_node(i));
    if (!to_1 || !to_2) return {};
    return *to_2 - *to_1;
  };
  RoundGaps found{Vec(facing.n_points()), 0.0, face_1.off() + face_2.off(), face_1.reach_on_flat(face_2) > 0.0};
  for (int i = 0; i < facing.n_points(); ++i) {
    const std::optional<double> own = gap(facing.places.col(i), facing.normals.col(i), i);
    if (!own) return {};
    found.gaps[i] = *own;
  }
  for (const Facet& facet : facing.facets) {
    const std::span<const int> rim = facet_shape(facet.type()).rim;
    for (size_t a = 0; a < rim.size(); ++a) {
      const int i = facet.nodes()[static_cast<size_t>(rim[a])],
                j = facet.nodes()[static_cast<size_t>(rim[(a + 1) % rim.size()])];
      const Vec3 x = 0.5 * (facing.places.col(i) + facing.places.col(j)),
                 normal = (facing.normals.col(i) + facing.normals.col(j)).normalized();
      if (const std::optional<double> middle = gap(x, normal, i))
        found.bend = std::max(found.bend, std::abs(*middle - 0.5 * (found.gaps[i] + found.gaps[j])));
    }
  }
  if (facing.n_points() > 0) found.missed = face_1.missed_on_flat(face_2, found.gaps.minCoeff());
  return found;
}

}  // namespace dygita

#include "interfaces/sum_surfaces.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "law/law.hpp"
#include "meeting/sum_facing.hpp"
#include "model/extent.hpp"
#include "model/places.hpp"

namespace dygita {

namespace {

// Of one part: nodes with their weights, and rotations of rigid faces that nodes follow, with their arms.
struct Terms {
  std::map<int, double> weights;
  std::map<int, Vec3> arms;

  void add(const Interior& body, int node, double weight) {
    const Interior::Follower* own = body.follower(node);
    weights[own ? own->point : node] += weight;
    if (own && own->turn >= 0) arms.try_emplace(own->turn, Vec3::Zero()).first->second += weight * own->arm / own->size;
  }

  // Rotation x arm is -arm x rotation.
  std::pair<std::vector<SideTrace::Share>, Mat3> shares(double sign) const {
    std::vector<SideTrace::Share> all;
    for (const auto& [node, weight] : weights)
      if (weight != 0.0) all.push_back({node, sign * weight});
    for (const auto& [node, arm] : arms) all.push_back({node, 0.0, sign * arm});
    return {all, arms.empty() ? Mat3(Mat3::Zero()) : Mat3(-Mat3::Identity())};
  }

  double square() const {
    double sum = 0.0;
    for (const auto& [node, weight] : weights) sum += weight * weight;
    return sum;
  }
};

// Its terms by part: the motion of a place is that of its nodes, by the area behind them on a face. Factors are scaled,
// so that those of one sign make at most 1.
Surface surface_of_sum(const Problem& problem, const Support& sum) {
  double positive = 0.0, negative = 0.0, square = 0.0, length = 0.0;
  for (const double factor : sum.factors) (factor > 0 ? positive : negative) += std::abs(factor);
  const double scale = 1.0 / std::max(positive, negative);
  std::map<int, Terms> terms;  // by part
  Vec3 place = Vec3::Zero();
  for (size_t i = 0; i < sum.on.size(); ++i) {
    const Substructure& part = part_of(sum.on[i]);
    Terms& own = terms[index_of(problem.substructures, &part)];
    for (const auto& [node, share] : mean_of(sum.on[i])) {
      own.add(*part.mesh->inside, node, scale * sum.factors[i] * share);
      place += share / static_cast<double>(sum.on.size()) * (part.mesh->nodes.col(node) + part.place);
    }
    const double size = part.mesh->has_cells() ? std::cbrt(volume(*part.mesh)) : extent_of(part).size().norm();
    length = std::max(length, size / std::cbrt(part.mesh->n_nodes()));
  }
  const auto refuse = [&](const std::string& why) {
    throw InputError(sum.origin, fmt::format("support.{} '{}': {}", sum.kind->word(), sum.name, why));
  };
  if (terms.size() > 2) refuse(fmt::format("its places are on {} parts, and two are the most", terms.size()));
  for (const auto& [part, own] : terms) {
    square += own.square();
    if (own.shares(1.0).first.empty()) refuse("its terms cancel each other");
  }
  Surface surface;
  surface.wall = &sum;
  surface.is_on_ground = std::abs(positive - negative) > 1e-9 * (positive + negative);
  surface.part_1 = terms.begin()->first;
  if (terms.size() == 2) surface.part_2 = terms.rbegin()->first;
  // As large as so many nodes of the part.
  const double n_nodes = std::pow(scale * (positive + negative), 2) / std::max(square, 1e-6);
  surface.facing = facing_of_sum(place, n_nodes * length * length);
  const auto [shares_1, turn_1] = terms.begin()->second.shares(1.0);
  surface.facing.side_1.add(shares_1, turn_1);
  if (surface.part_2 < 0) return surface;
  const auto [shares_2, turn_2] = terms.rbegin()->second.shares(-1.0);
  surface.facing.side_2.add(shares_2, turn_2);
  return surface;
}

}  // namespace

// A point for all axes of an equation, one for each spring: along its normal.
void add_sums(const Problem& problem, const Support& sum, std::vector<Surface>& surfaces) {
  const Surface whole = surface_of_sum(problem, sum);
  const auto add = [&](const Mat3& frame, const std::array<bool, 3>& along, const LawPtr& law) {
    Surface& surface = surfaces.emplace_back(whole);
    surface.facing.frames = {frame};
    surface.facing.directions = {along};
    surface.facing.normals = frame.col(0);
    surface.law = law;
  };
  const Directions axes = sum.kind->sums();
  if (!sum.kind->spring(0)) return add(Mat3::Identity(), axes.axes, sum.kind->law());
  for (int axis = 0; axis < 3; ++axis) {
    if (!axes.axes[static_cast<size_t>(axis)]) continue;
    Mat3 frame;
    for (int d = 0; d < 3; ++d) frame.col(d) = Vec3::Unit((axis + d) % 3);
    add(frame, {true, false, false}, law_of_spring(*sum.kind->spring(axis), whole.facing.areas[0]));
  }
}

}  // namespace dygita

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <map>
#include <set>

#include "model/places.hpp"
#include "numerics/cross_matrix.hpp"
#include "numerics/dense.hpp"
#include "reduction/craig_bampton.hpp"
#include "watch/weighted_nodes.hpp"

namespace dygita {

namespace {

using NodeSum = std::vector<std::pair<int, Vec3>>;  // node, coefficient of its displacement

struct PlacedNodes {
  MeanNodes mean;            // nodes counted through all substructures; the centre where the part is
  std::vector<Vec3> places;  // m
};

PlacedNodes placed_nodes(const LinearAssembly& assembly, const Problem& problem, const FaceOrRegion& place) {
  const WeightedNodes on = weighted_nodes(problem, place);
  const Substructure& part = *problem.substructures[on.part];
  const Points& x = part.mesh->nodes;
  PlacedNodes placed;
  placed.mean = std::holds_alternative<Face>(place)
                    ? mean_of(place)
                    : mean_nodes(on.nodes, Eigen::Map<const Vec>(on.weights.data(), std::ssize(on.weights)), x);
  placed.mean.centre += part.place;
  for (int& node : placed.mean.nodes) {
    placed.places.push_back(x.col(node) + part.place);
    node += assembly.first_node[on.part];
  }
  return placed;
}

// Six mean motions (eq. D2): translations, and rotations where the nodes do not lie on a line.
std::vector<NodeSum> mean_rows(const MeanNodes& on) {
  const bool turns = principal_axes(on.inertia).values[0] > 1e-9 * on.inertia.trace();
  std::vector<NodeSum> rows(turns ? 6 : 3);
  const Mat3 inverse = turns ? Mat3(on.inertia.inverse()) : Mat3(Mat3::Zero());
  for (size_t i = 0; i < on.nodes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Mat3 turn = inverse * cross_matrix(on.arms.col(k));
    for (int d = 0; d < 3; ++d) rows[d].emplace_back(on.nodes[i], on.shares[k] * Vec3::Unit(d));
    for (int d = 0; d < 3 && turns; ++d) rows[3 + d].emplace_back(on.nodes[i], turn.row(d).transpose());
  }
  return rows;
}

// Takes rows as long as they are independent of those before, on the unknowns of the assembly.
class IndependentRows {
 public:
  explicit IndependentRows(const SparseMatrix& map) : map_(map) {}

  // Is the row one more? What supports hold has no unknowns, what depends on rows before has nothing new.
  enum class Taken { yes, is_held, depends };
  Taken try_to_take(const NodeSum& row) {
    std::map<int, double> entries;
    double scale = 0.0;
    for (const auto& [node, coefficient] : row)
      for (int d = 0; d < 3; ++d) {
        if (coefficient[d] == 0.0) continue;
        scale += coefficient[d] * coefficient[d];
        for (SparseMatrix::InnerIterator e(map_, 3 * node + d); e; ++e)
          entries[static_cast<int>(e.col())] += coefficient[d] * e.value();
      }
    double size = 0.0;
    for (const auto& [unknown, value] : entries) size += value * value;
    if (size <= 1e-12 * scale) return Taken::is_held;
    std::map<int, double> rest = entries;
    // Twice, for round-off; rows that share no unknown are orthogonal.
    for (int pass = 0; pass < 2; ++pass) {
      std::set<int> near;
      for (const auto& [unknown, value] : rest)
        if (const auto it = rows_at_.find(unknown); it != rows_at_.end())
          near.insert(it->second.begin(), it->second.end());
      for (const int other : near) {
        double along = 0.0;
        for (const auto& [unknown, value] : orthonormal_[other])
          if (const auto it = rest.find(unknown); it != rest.end()) along += value * it->second;
        for (const auto& [unknown, value] : orthonormal_[other]) rest[unknown] -= along * value;
      }
    }
    double norm = 0.0;
    for (const auto& [unknown, value] : rest) norm += value * value;
    if (norm <= 1e-12 * scale) return Taken::depends;
    const int index = static_cast<int>(orthonormal_.size());
    for (auto& [unknown, value] : rest) {
      value /= std::sqrt(norm);
      if (std::abs(value) > 1e-14) rows_at_[unknown].push_back(index);
    }
    orthonormal_.push_back(std::move(rest));
    for (const auto& [unknown, value] : entries)
      if (value != 0.0) triplets_.emplace_back(index, unknown, value);
    return Taken::yes;
  }

  SparseMatrix matrix() const {
    SparseMatrix w(static_cast<int>(orthonormal_.size()), map_.cols());
    w.setFromTriplets(triplets_.begin(), triplets_.end());
    return w;
  }

 private:
  const SparseMatrix& map_;
  std::vector<std::map<int, double>> orthonormal_;
  std::map<int, std::vector<int>> rows_at_;
  std::vector<Eigen::Triplet<double>> triplets_;
};

}  // namespace

InterfaceCoordinates interface_coordinates(const LinearAssembly& assembly, const Problem& problem,
                                           const SuperelementRequest& request) {
  const FaceMotion motion = request.motion;
  InterfaceCoordinates coordinates;
  IndependentRows independent(assembly.map);
  std::vector<Eigen::Triplet<double>> of_rows;
  int n_held = 0;
  for (size_t f = 0; f < request.on.size(); ++f) {
    const FaceOrRegion place = std::holds_alternative<Face>(request.on[f])
                                   ? FaceOrRegion(std::get<Face>(request.on[f]))
                                   : FaceOrRegion(std::get<Region>(request.on[f]));
    const PlacedNodes on = placed_nodes(assembly, problem, place);
    coordinates.nodes.insert(coordinates.nodes.end(), on.mean.nodes.begin(), on.mean.nodes.end());
    const int before = n_held, on_index = static_cast<int>(f);
    const int first_row = static_cast<int>(coordinates.rows.size());
    if (motion == FaceMotion::mean) {
      const std::vector<NodeSum> rows = mean_rows(on.mean);
      for (size_t d = 0; d < rows.size(); ++d) {
        const IndependentRows::Taken taken = independent.try_to_take(rows[d]);
        if (taken == IndependentRows::Taken::depends)
          coordinates.dependent.push_back({on_index, -1, static_cast<int>(d), on.mean.centre});
        if (taken != IndependentRows::Taken::yes) continue;
        coordinates.rows.push_back({on_index, -1, static_cast<int>(d), on.mean.centre});
        of_rows.emplace_back(n_held++, static_cast<int>(coordinates.rows.size()) - 1, 1.0);
      }
    } else {
      const bool is_rigid = motion == FaceMotion::rigid;
      const int n_motions = on.mean.nodes.size() > 1 ? 6 : 3;  // a node turns about itself
      for (int d = 0; d < n_motions && is_rigid; ++d) coordinates.rows.push_back({on_index, -1, d, on.mean.centre});
      const int part = index_of(problem.substructures, std::visit([](const auto& o) { return o.part.get(); }, place));
      for (size_t i = 0; i < on.mean.nodes.size(); ++i)
        for (int d = 0; d < 3; ++d) {
          const IndependentRows::Taken taken = independent.try_to_take({{on.mean.nodes[i], Vec3::Unit(d)}});
          const bool is_free = taken == IndependentRows::Taken::yes;
          if (taken == IndependentRows::Taken::depends)
            coordinates.dependent.push_back({on_index, on.mean.nodes[i] - assembly.first_node[part], d, on.places[i]});
          if (!is_rigid && is_free) {
            coordinates.rows.push_back({on_index, on.mean.nodes[i] - assembly.first_node[part], d, on.places[i]});
            of_rows.emplace_back(n_held, static_cast<int>(coordinates.rows.size()) - 1, 1.0);
          } else if (is_rigid && !is_free) {
            throw InputError(
                request.origin,
                fmt::format(
                    "output.superelement '{}': a node of {} is held by a support, "
                    "or tied to another face, so that the face cannot move as a rigid body\n    take motion = \"mean\"",
                    request.name, label_of(place)));
          } else if (is_rigid) {
            const Vec3 arm = on.places[i] - on.mean.centre;
            of_rows.emplace_back(n_held, first_row + d, 1.0);
            for (int turn = 0; turn + 3 < n_motions; ++turn)
              if (const double way = Vec3::Unit(turn).cross(arm)[d]; way != 0.0)
                of_rows.emplace_back(n_held, first_row + 3 + turn, way);
          }
          if (is_free) ++n_held;
        }
    }
    if (n_held == before)
      throw InputError(request.origin, fmt::format("output.superelement '{}': nothing of {} can move: a support holds "
                                                   "it, or other faces of 'on' contain all its nodes",
                                                   request.name, label_of(place)));
  }
  coordinates.w = independent.matrix();
  coordinates.of_rows = Mat::Zero(n_held, static_cast<int>(coordinates.rows.size()));
  for (const auto& entry : of_rows) coordinates.of_rows(entry.row(), entry.col()) = entry.value();
  return coordinates;
}

}  // namespace dygita

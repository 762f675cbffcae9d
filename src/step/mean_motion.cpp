#include "step/mean_motion.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/log.hpp"
#include "numerics/dense.hpp"
#include "partition/all_pieces.hpp"
#include "pieces/implicit_piece.hpp"

namespace dygita {

namespace {

// Of a matrix of masses; what has none is left out.
Mat inverse_of_masses(const Mat& masses) {
  constexpr double nothing = 1e-12;
  const EigenPairs eigen = symmetric_eigen(masses);
  const double least = eigen.values.size() > 0 ? nothing * eigen.values.tail(1)[0] : 0.0;
  const Vec inverse = (eigen.values.array() > least).select(eigen.values.cwiseInverse(), 0.0);
  return eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
}

// Work of forces (3 x n_nodes) on the rigid motions of a body.
RigidMotion work_on_motions(const RigidFrame& frame, const Substructure& body, const Points& force) {
  RigidMotion work;
  for (int k = 0; k < 6; ++k) work[k] = frame.displacements(RigidMotion::Unit(k), body).cwiseProduct(force).sum();
  return work;
}

// Of a unit of each load pattern on each free motion: motions x patterns, J.
Mat work_of_patterns(const Problem& problem, const FreeMotions& free, const Loads& loads) {
  const std::vector<LoadPattern>& patterns = loads.patterns();
  Mat work(free.columns.cols(), static_cast<Eigen::Index>(patterns.size()));
  for (size_t p = 0; p < patterns.size(); ++p) {
    const auto part = static_cast<size_t>(patterns[p].part);
    const Substructure& body = *problem.substructures[part];
    RigidMotion of_part = RigidMotion::Zero();
    for (const auto& [node, force] : patterns[p].nodes)
      for (int d = 0; d < 3; ++d) of_part += force[d] * free.frames[part].row(body, node, Vec3::Unit(d));
    work.col(static_cast<Eigen::Index>(p)) =
        free.columns.middleRows(6 * static_cast<Eigen::Index>(part), 6).transpose() * of_part;
  }
  return work;
}

}  // namespace

MeanMotion::MeanMotion(FreeMotions free, CutPtr cut, const std::vector<Body>& bodies)
    : free_(std::move(free)), cut_(std::move(cut)) {
  if (free_.columns.cols() == 0) return;
  for (int i = 0; i < cut_->n_pieces(); ++i)
    masses_.push_back(cut_->is_here(i) && moves(i) ? bodies[static_cast<size_t>(i)].mass : nullptr);
  const std::vector<double> squares = of_all_pieces(*cut_, 36, [&](int i, double* to) {
    if (!moves(i)) return;
    const RigidFrame& frame = free_.frames[static_cast<size_t>(cut_->piece(i).part)];
    for (int k = 0; k < 6; ++k)
      Eigen::Map<RigidMotion>(to + 6 * k) = moment(i, frame.displacements(RigidMotion::Unit(k), *cut_->piece(i).body));
  });
  Mat masses = Mat::Zero(free_.columns.cols(), free_.columns.cols());
  for (int i = 0; i < cut_->n_pieces(); ++i) {
    const auto rows = free_.columns.middleRows(6 * static_cast<Eigen::Index>(cut_->piece(i).part), 6);
    masses += rows.transpose() * Eigen::Map<const Eigen::Matrix<double, 6, 6>>(squares.data() + 36 * i) * rows;
  }
  inverse_ = inverse_of_masses(masses);
}

bool MeanMotion::moves(int piece) const {
  return !free_.columns.middleRows(6 * static_cast<Eigen::Index>(cut_->piece(piece).part), 6).isZero(0.0);
}

// Moments of mass (3 x n_nodes of a piece) with the rigid motions of its substructure.
RigidMotion MeanMotion::moment(int piece, const Points& field) const {
  const CutPiece& own = cut_->piece(piece);
  return work_on_motions(free_.frames[static_cast<size_t>(own.part)], *own.body,
                         masses_[static_cast<size_t>(piece)]->times(field, false));
}

void MeanMotion::take_off(const std::vector<std::unique_ptr<Piece>>& pieces, const std::vector<int>& here) const {
  if (free_.columns.cols() == 0) return;
  // V of a static increment is its displacement.
  const std::vector<double> moments = of_all_pieces(*cut_, 6, [&](int i, double* to) {
    if (!moves(i)) return;
    const RigidMotion own = moment(i, pieces[static_cast<size_t>(i)]->velocity());
    std::copy(own.begin(), own.end(), to);
  });
  Vec sums = Vec::Zero(free_.columns.cols());
  for (int i = 0; i < cut_->n_pieces(); ++i)
    sums += free_.columns.middleRows(6 * static_cast<Eigen::Index>(cut_->piece(i).part), 6).transpose() *
            Eigen::Map<const RigidMotion>(moments.data() + 6 * i);
  const Vec mean = inverse_ * sums;
  for (const int i : here) {
    const CutPiece& piece = cut_->piece(i);
    const RigidMotion motion = -free_.of_part(piece.part, mean);
    if (motion.isZero(0.0)) continue;
    auto* moved = dynamic_cast<ImplicitPiece*>(pieces[static_cast<size_t>(i)].get());
    CHECK(moved, "pieces of static steps are implicit");
    moved->add_free_motion(free_.frames[static_cast<size_t>(piece.part)].displacements(motion, *piece.body));
  }
}

InertiaRelief::InertiaRelief(const Problem& problem, const FreeMotions& free, const InertiaForce& inertia,
                             Loads& loads) {
  const int n_parts = static_cast<int>(problem.substructures.size());
  // Masses against motions as a whole about the origin.
  const auto masses_against = [&](const std::vector<std::vector<Points>>& forces, const Mat& motions) {
    Mat sums = Mat::Zero(motions.cols(), static_cast<Eigen::Index>(forces.size()));
    for (size_t j = 0; j < forces.size(); ++j)
      for (int part = 0; part < n_parts; ++part)
        sums.col(static_cast<Eigen::Index>(j)) +=
            motions.middleRows(6 * part, 6).transpose() *
            work_on_motions(free.frames[static_cast<size_t>(part)], *problem.substructures[static_cast<size_t>(part)],
                            forces[j][static_cast<size_t>(part)]);
    return sums;
  };
  const auto forces_of = [&](const Mat& motions) {
    std::vector<std::vector<Points>> forces(static_cast<size_t>(motions.cols()));
    for (Eigen::Index j = 0; j < motions.cols(); ++j)
      for (int part = 0; part < n_parts; ++part)
        forces[static_cast<size_t>(j)].push_back(
            inertia(part, free.frames[static_cast<size_t>(part)].displacements(
                              motions.block<6, 1>(6 * part, j), *problem.substructures[static_cast<size_t>(part)])));
    return forces;
  };
  const std::vector<std::vector<Points>> forces = forces_of(free.columns);
  const Mat inverse = inverse_of_masses(masses_against(forces, free.columns));
  const Mat at_origin = masses_against(forces_of(free.of_whole(Vec3::Zero())), free.of_whole(Vec3::Zero()));
  centre_ = Vec3(at_origin(1, 5), at_origin(2, 3), at_origin(0, 4)) / at_origin(0, 0);
  const Mat motions = free.of_whole(centre_);
  whole_ = inverse_of_masses(masses_against(forces_of(motions), motions)) * masses_against(forces, motions);
  loads.oppose(forces, inverse * work_of_patterns(problem, free, loads));
}

RigidAcceleration InertiaRelief::acceleration(const Loads& loads) const {
  const RigidMotion motion = whole_ * loads.accelerations();
  return {centre_, motion.head<3>(), motion.tail<3>()};
}

void check_loads(const Problem& problem, const Step& step, const FreeMotions& free, Loads& loads) {
  if (free.columns.cols() == 0) return;
  const Mat work = work_of_patterns(problem, free, loads);
  for (int increment = 0; increment < step.increments; ++increment) {
    loads.evaluate(increment);
    const Eigen::Map<const Vec> values(loads.values().data(), work.cols());
    double forces = 0.0;
    for (size_t p = 0; p < loads.patterns().size(); ++p)
      for (const auto& [node, unit] : loads.patterns()[p].nodes) forces += std::abs(loads.values()[p]) * unit.norm();
    check_unloaded(problem, step, free, work * values, forces);
  }
}

}  // namespace dygita

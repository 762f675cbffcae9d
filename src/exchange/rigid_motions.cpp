// The rigid motions that nothing holds in a step: found from the conditions between bodies, held against the loads, and
// named for the user. One source, since all of it works on the same blocks of bodies; hence longer than most.
#include "exchange/rigid_motions.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <optional>
#include <set>

#include "base/log.hpp"
#include "law/law.hpp"
#include "numerics/pairs_below.hpp"

namespace dygita {

std::string name_of(const RigidMotion& motion) {
  constexpr double along_axis = 0.99;  // cosine
  const Vec3 translation = motion.head<3>(), rotation = motion.tail<3>();
  const bool is_translation = translation.norm() >= rotation.norm();
  const Vec3 axis = (is_translation ? translation : rotation).normalized();
  int nearest = 0;
  const bool is_along_one = axis.cwiseAbs().maxCoeff(&nearest) > along_axis;
  const double thousand = axis[nearest] < 0.0 ? -1e3 : 1e3;
  const Vec3 shown = ((thousand * axis).array().round() + 0.0) / 1e3;
  return (is_translation ? "translation along " : "rotation about ") +
         (is_along_one ? std::string(1, "xyz"[nearest])
                       : fmt::format("({:g}, {:g}, {:g})", shown[0], shown[1], shown[2]));
}

namespace {

// The turn of a sector about the axis of its ring, which, seen from the sector's middle, is a translation above all.
std::optional<RigidMotion> turn_of_ring(const Problem& problem, const RigidFrame& frame) {
  for (const InterfacePtr& interface : problem.interfaces) {
    if (!interface->cyclic) continue;
    RigidMotion turn;
    turn << interface->cyclic->along.cross(frame.centre - interface->cyclic->through),
        frame.size * interface->cyclic->along;
    return turn.normalized();
  }
  return {};
}

constexpr double nearly_all = 0.99;  // of a motion, that it is another

std::string describe(const Problem& problem, const RigidFrame& frame, const RigidMotion& motion) {
  const auto turn = turn_of_ring(problem, frame);
  const bool is_turn = turn && std::abs(turn->dot(motion)) > nearly_all * motion.norm();
  return is_turn ? "rotation about the axis of the ring" : name_of(motion);
}

// Blocks of 6 x 6, of each body and of each two that a constraint joins.
using Blocks = std::map<std::pair<int, int>, Eigen::Matrix<double, 6, 6>>;

// Sum of squares of all constraints on the rigid motions of all substructures: 6 n x 6 n.
Blocks constraint_gram(const Problem& problem, const Exchange& exchange, const Conditions& conditions,
                       const std::vector<RigidFrame>& frames) {
  const int n = static_cast<int>(frames.size());
  Blocks gram;
  const auto block = [&gram](int i, int j) -> Eigen::Matrix<double, 6, 6>& {
    return gram.try_emplace({i, j}, Eigen::Matrix<double, 6, 6>::Zero()).first->second;
  };
  for (int part = 0; part < n; ++part) block(part, part);
  for (int part = 0; part < n; ++part) {
    const auto resisted = frames[part].resisted(*problem.substructures[part]);
    block(part, part) += resisted * resisted.transpose();
  }
  for (int part = 0; part < n; ++part)
    for (const auto& [node, held] : conditions.held[part])
      for (int j = 0; j < held.n; ++j) {
        const RigidMotion r = frames[part].row(*problem.substructures[part], node, held.directions.col(j));
        block(part, part) += r * r.transpose();
      }
  for (const Point& point : exchange.points) {
    const auto row_of = [&](int p, int d) {
      const Port& port = exchange.ports[p];
      return frames[port.part].row(*problem.substructures[port.part], port, point.frame.col(d));
    };
    const auto tie = [&](int p, int other, int d) {
      const RigidMotion a = row_of(p, d);
      const int i = exchange.ports[p].part;
      block(i, i) += a * a.transpose();
      if (other < 0) return;
      const RigidMotion b = row_of(other, d);
      const int j = exchange.ports[other].part;
      block(j, j) += b * b.transpose();
      block(i, j) -= a * b.transpose();
      block(j, i) -= b * a.transpose();
    };
    for (int d = 0; d < 3; ++d) {
      for (int p = point.first_port + 1; p < point.first_port_2; ++p) tie(p, point.first_port, d);
      for (int p = point.first_port_2 + 1; p < point.end_port; ++p) tie(p, point.first_port_2, d);
      if (!point.has_law[d]) continue;
      tie(point.first_port, point.is_wall ? -1 : point.first_port_2, d);
    }
  }
  return gram;
}

SparseMatrix scaled(const Blocks& gram, const Vec& weight) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [at, block] : gram)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) {
        const int i = 6 * at.first + a, j = 6 * at.second + b;
        entries.emplace_back(i, j, weight[i] * block(a, b) * weight[j]);
      }
  const auto size = static_cast<int>(weight.size());
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Interfaces of a part that carry nothing in a static step: "; interface 'gasket' does not in a static step".
std::string what_lets_go(const Problem& problem, const Substructure& part) {
  for (const InterfacePtr& interface : problem.interfaces)
    if ((interface->side_1.part.get() == &part || interface->side_2.part.get() == &part) &&
        !interface->law->takes_part(true))
      return ": interface." + interface->law->word() + " '" + interface->name + "' carries nothing in a static step";
  return "";
}

// What nothing resists and nothing loads, a line for each part.
void warn_of_unconstrained(const Problem& problem, const Step& step,
                           const std::map<int, std::vector<std::string>>& motions) {
  for (const auto& [part, all] : motions) {
    const std::string& name = problem.substructures[static_cast<size_t>(part)]->name;
    if (all.size() >= 6) {
      warn(
          fmt::format("static step '{}': substructure '{}' is unconstrained: no support or interface holds it{}; "
                      "it carries no load and stays at zero",
                      step.name, name, what_lets_go(problem, *problem.substructures[static_cast<size_t>(part)])));
      continue;
    }
    const std::set<std::string> each(all.begin(), all.end());
    std::string text;
    for (const std::string& motion : each) text += (text.empty() ? "" : " and ") + motion;
    const bool is_one = each.size() == 1;
    warn(
        fmt::format("static step '{}': {} of substructure '{}' {} unconstrained, and no load acts along {}; the part "
                    "moves that way only as others push it",
                    step.name, text, name, is_one ? "is" : "are", is_one ? "it" : "them"));
  }
}

}  // namespace

bool is_floating(const Substructure& part, const std::unordered_map<int, Held>& held) {
  const RigidFrame frame(extent_of(part));
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  double scale = 0.0;
  for (const auto& [node, conditions] : held)
    for (int j = 0; j < conditions.n; ++j) {
      const RigidMotion r = frame.row(part, node, conditions.directions.col(j));
      gram += r * r.transpose();
      scale += 1.0;
    }
  const auto resisted = frame.resisted(part);
  gram += resisted * resisted.transpose();
  scale += static_cast<double>(resisted.cols());
  if (scale == 0.0) return true;
  return symmetric_eigen(gram).values[0] < 1e-8 * scale;
}

namespace {

// Motions of all bodies, 6 n x m, orthonormal.
Mat orthonormal(Mat motions) {
  for (Eigen::Index i = 0; i < motions.cols(); ++i) {
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index j = 0; j < i; ++j) motions.col(i) -= motions.col(j).dot(motions.col(i)) * motions.col(j);
    motions.col(i).normalize();
  }
  return motions;
}

// One direction of one node.
struct Pin {
  int part = -1, node = -1;
  Vec3 direction = Vec3::Zero();
};

// Finds directions of nodes that hold what is free and nothing else: as far as a body may move at all, a node is held
// along its own motion, which no support and no law resists. So many of them as there are free motions are statically
// determinate, and carry nothing.
class Pinning {
 public:
  Pinning(const Problem& problem, const Exchange& exchange, const Conditions& conditions,
          const std::vector<RigidFrame>& frames)
      : problem_(problem), exchange_(exchange), conditions_(conditions), frames_(frames) {
    for (size_t i = 0; i < exchange.points.size(); ++i)
      for (int p = exchange.points[i].first_port; p < exchange.points[i].end_port; ++p)
        exchange.ports[static_cast<size_t>(p)].for_each_node([&](int node, const Mat3& /*block*/) {
          points_at_[{exchange.ports[static_cast<size_t>(p)].part, node}].push_back(static_cast<int>(i));
        });
  }

  // The node that moves furthest, and that way: whatever the basis of the free motions, and however all is turned.
  Pin best(const Mat& free) const {
    constexpr double nearly = 1.0 + 1e-9;  // of nodes that are alike the first
    double best = 0.0;
    Pin pin;
    for (int part = 0; part < static_cast<int>(frames_.size()); ++part) {
      const Mat own = free.middleRows(6 * part, 6);
      const Mat6 gram = own * own.transpose();
      const Substructure& body = *problem_.substructures[static_cast<size_t>(part)];
      for (int node = 0; node < body.mesh->n_nodes(); ++node) {
        if (body.mesh->inside->follower(node)) continue;  // it has no unknowns
        Mat3 square = square_of(part, node, gram);
        const double most = std::sqrt(std::max(0.0, square.trace()));
        if (most <= nearly * best) continue;
        const double weight = weight_of(part, node);
        if (weight * most <= nearly * best) continue;
        if (const Held* held = conditions_.at(part, node)) {
          const Mat3 is_free = held->free_basis() * held->free_basis().transpose();
          square = (is_free * square * is_free).eval();
        }
        const PrincipalAxes axes = principal_axes(square);
        const Vec3 direction = axes.vectors.col(2);
        const double reach =
            std::sqrt(std::max(0.0, axes.values[2])) * weight * (fits_frames(part, node, direction) ? 1.0 : at_odds);
        if (reach <= nearly * best) continue;
        best = reach;
        pin = {part, node, direction};
      }
    }
    return pin;
  }

  // How each free motion moves a pin.
  Vec along(const Pin& pin, const Mat& free) const {
    const Substructure& body = *problem_.substructures[static_cast<size_t>(pin.part)];
    return free.middleRows(6 * pin.part, 6).transpose() *
           frames_[static_cast<size_t>(pin.part)].row(body, pin.node, pin.direction);
  }

 private:
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  // Rather where no support and no interface is: what a pin adds to them is theirs no more.
  static constexpr double at_support = 1e-2, at_interface = 1e-3, at_odds = 1e-3;

  double weight_of(int part, int node) const {
    const Held* held = conditions_.at(part, node);
    return (held && held->n > 0 ? at_support : 1.0) * (points_at_.contains({part, node}) ? at_interface : 1.0);
  }

  // Sum of squares of the displacements of a node.
  Mat3 square_of(int part, int node, const Mat6& gram) const {
    const Substructure& body = *problem_.substructures[static_cast<size_t>(part)];
    Eigen::Matrix<double, 3, 6> rows;
    for (int d = 0; d < 3; ++d) rows.row(d) = frames_[static_cast<size_t>(part)].row(body, node, Vec3::Unit(d));
    return rows * gram * rows.transpose();
  }

  // The axes of a point contain what is held of its nodes: a direction must be along or across the normal of a law, and
  // what is held already.
  bool fits_frames(int part, int node, const Vec3& direction) const {
    constexpr double rounding = 1e-6;
    const auto is_oblique = [&](const Vec3& axis) {
      const double along = std::abs(axis.dot(direction));
      return along > rounding && along < 1.0 - rounding;
    };
    const auto points = points_at_.find({part, node});
    if (points == points_at_.end()) return true;
    for (const int i : points->second) {
      const Point& point = exchange_.points[static_cast<size_t>(i)];
      if (point.law && is_oblique(point.frame.col(0))) return false;
      for (int p = point.first_port; p < point.end_port; ++p) {
        const Port& port = exchange_.ports[static_cast<size_t>(p)];
        const Held* held = conditions_.at(port.part, port.node);
        for (int j = 0; held && held->n < 3 && j < held->n; ++j)
          if (is_oblique(held->directions.col(j))) return false;
      }
    }
    return true;
  }

  const Problem& problem_;
  const Exchange& exchange_;
  const Conditions& conditions_;
  const std::vector<RigidFrame>& frames_;
  std::map<std::pair<int, int>, std::vector<int>> points_at_;  // by part and node
};

// Which of the motions (6 n x m) moves a body most, for `work` of the loads on each: the body, and how far.
std::pair<int, double> most_driven(const Vec& driven) {
  std::pair<int, double> most{0, 0.0};
  for (int i = 0; 6 * i < driven.size(); ++i)
    if (const double own = driven.segment<6>(6 * i).norm(); own > most.second) most = {i, own};
  return most;
}

// Names for as many motions as a body (6 x n) has: first those nearest to an axis.
std::vector<std::string> names_of(const Problem& problem, const RigidFrame& frame, const Mat& motions) {
  Mat left = orthonormal(motions);
  std::vector<std::string> names;
  const auto take = [&](const Vec& taken, const std::string& name) {
    names.push_back(name);
    left -= (left * taken) * taken.transpose();
  };
  if (const auto turn = turn_of_ring(problem, frame)) {
    const Vec share = left.transpose() * *turn;
    if (share.norm() > nearly_all) take(share.normalized(), describe(problem, frame, *turn));
  }
  while (static_cast<Eigen::Index>(names.size()) < motions.cols()) {
    int nearest = 0;
    left.rowwise().squaredNorm().maxCoeff(&nearest);
    const Vec share = left.row(nearest).transpose().normalized();
    const RigidMotion motion = left * share;
    take(share, name_of(motion));
  }
  return names;
}

// Of free motions those of the whole as one rigid body, orthonormal, where all six are free; none where something holds
// it.
Mat motions_of_whole(const FreeMotions& free) {
  Vec3 centre = Vec3::Zero();
  for (const RigidFrame& frame : free.frames) centre += frame.centre / static_cast<double>(free.frames.size());
  const Mat whole = orthonormal(free.of_whole(centre));
  const Mat within = free.columns.transpose() * whole;
  constexpr double rounding = 1e-6;
  return (within.transpose() * within - Mat::Identity(6, 6)).norm() < rounding ? Mat(free.columns * within) : Mat();
}

// What a motion that nothing resists falls below, of bodies of unit weight. Rounded coordinates resist by some 1e-10; a
// row of n bodies, the most flexible way of joining them, bends with (1.9 / n)^4 and must stay above.
double least_resistance(int bodies) {
  constexpr double rounding = 1e-14, of_coordinates = 1e-9;
  return std::clamp(0.01 * std::pow(1.9 / bodies, 4), rounding, of_coordinates);
}

// Those of the motions that do not move a pin: one less. along: how each of them moves it.
Mat without(const Mat& free, const Vec& along) {
  const Vec moving = along.normalized();
  Mat others(free.cols(), free.cols());
  others.col(0) = moving;
  others.rightCols(free.cols() - 1).setIdentity();
  int last = 0;
  moving.cwiseAbs().maxCoeff(&last);  // the unit vector nearest to it is left out
  if (last < free.cols() - 1) others.col(last + 1) = Vec::Unit(free.cols(), free.cols() - 1);
  return orthonormal(free * orthonormal(others).rightCols(free.cols() - 1));
}

}  // namespace

Mat FreeMotions::of_whole(const Vec3& centre) const {
  Mat motions(6 * static_cast<Eigen::Index>(frames.size()), 6);
  for (size_t i = 0; i < frames.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto row = 6 * static_cast<Eigen::Index>(i);
      const Vec3 axis = Vec3::Unit(k);
      motions.block<6, 1>(row, k) << axis, Vec3::Zero();
      motions.block<6, 1>(row, 3 + k) << axis.cross(frames[i].centre - centre), frames[i].size * axis;
    }
  return motions;
}

FreeMotions find_free_motions(const Problem& problem, const Exchange& exchange, const Conditions& conditions) {
  const int n = static_cast<int>(problem.substructures.size());
  FreeMotions free;
  for (const SubstructurePtr& part : problem.substructures) free.frames.emplace_back(extent_of(*part));
  const Blocks gram = constraint_gram(problem, exchange, conditions, free.frames);
  // Each body's scale: how often it is constrained; a motion nothing resists has a vanishing eigenvalue.
  Vec weight(6 * n);
  for (int i = 0; i < n; ++i)
    weight.segment<6>(6 * i).setConstant(1.0 / std::sqrt(std::max(1.0, gram.at({i, i}).trace())));
  const EigenPairs eigen = pairs_below(scaled(gram, weight), least_resistance(n));
  free.columns = Mat(6 * n, 0);
  if (eigen.values.size() > 0) free.columns = orthonormal(weight.asDiagonal() * eigen.vectors);
  free.whole = Mat(6 * n, 0);
  if (free.columns.cols() >= 6)
    if (const Mat whole = motions_of_whole(free); whole.size() > 0) free.whole = whole;
  return free;
}

void check_unloaded(const Problem& problem, const Step& step, const FreeMotions& free, const Vec& work, double forces) {
  if (work.isZero(0.0)) return;
  const Vec driven = free.columns * work.normalized();
  const auto [part, largest] = most_driven(driven);
  if (work.norm() <= 1e-7 * forces * largest) return;
  throw InputError(
      step.origin,
      fmt::format("static step '{}': {} of substructure '{}' is loaded, but no support or interface holds it",
                  step.name, describe(problem, free.frames[static_cast<size_t>(part)], driven.segment<6>(6 * part)),
                  problem.substructures[part]->name) +
          what_lets_go(problem, *problem.substructures[part]) +
          (free.whole.cols() > 0 ? "\n    nothing holds the assembly: add a support, or step.static{ inertia_relief = "
                                   "true }, and the loads accelerate it"
                                 : ""));
}

void pin_free_motions(const Problem& problem, const Step& step, const Exchange& exchange, const FreeMotions& motions,
                      Conditions& conditions) {
  const Pinning pinning(problem, exchange, conditions, motions.frames);
  Mat free = motions.columns, whole = motions.whole;
  const auto hold = [&](const Pin& pin) {
    CHECK(pin.node >= 0, "no node can be pinned against a free rigid motion");
    // Of the free motions one moves the pin, and the others, across it, do not.
    free = without(free, pinning.along(pin, free));
    Held& held = conditions.held[pin.part][pin.node];
    held.directions.col(held.n) = held.given.col(held.n) = pin.direction;
    ++held.n;
  };
  // An assembly that nothing holds is free on purpose; parts that move against it are named.
  while (whole.cols() > 0) {
    const Pin pin = pinning.best(whole);
    hold(pin);
    whole = without(whole, pinning.along(pin, whole));
  }
  std::map<int, Mat> unconstrained;  // by part, a column a motion
  while (free.cols() > 0) {
    const Pin pin = pinning.best(free);
    Mat& own = unconstrained[pin.part];
    own.conservativeResize(6, own.cols() + 1);
    own.rightCols(1) = (free * pinning.along(pin, free).normalized()).segment<6>(6 * pin.part);
    hold(pin);
  }
  std::map<int, std::vector<std::string>> names;
  // Of a sector they are those of its ring, and inertia opposes the loads along them.
  const auto is_cyclic = [](const InterfacePtr& interface) { return interface->cyclic.has_value(); };
  if (step.inertia_relief && std::any_of(problem.interfaces.begin(), problem.interfaces.end(), is_cyclic)) return;
  for (const auto& [part, all] : unconstrained)
    names[part] = names_of(problem, motions.frames[static_cast<size_t>(part)], all);
  warn_of_unconstrained(problem, step, names);
}

}  // namespace dygita

#include "step/assembled_system.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/aside.hpp"
#include "base/error.hpp"
#include "base/task.hpp"
#include "numerics/dense.hpp"
#include "ranks/ranks.hpp"
#include "step/make_pieces.hpp"

namespace dygita {

AssembledSystem::AssembledSystem(const StepModel& model) : model_(&model), first_{0} {
  for (size_t i = 0; i < model.pieces.size(); ++i) {
    pieces_.push_back(&assembled_piece(model, static_cast<int>(i)));
    first_.push_back(first_.back() + pieces_.back()->op().n_free());
  }
  Task task("system of step '" + model.step->name + "'", 0, Task::Interrupts::wait);
  task.tell("points of interfaces");
  find_points();
  if (first_.back() == 0) return;
  task.tell("pattern");
  const SparseMatrix pattern = make_pattern();
  task.tell("order");
  put_in_order(pattern);
}

void AssembledSystem::find_points() {
  for (const Point& point : model_->exchange.points) {
    std::vector<int>& rows = unknowns_of_points_.emplace_back();
    for (int p = point.first_port; p < point.end_port; ++p)
      for (int d = 0; d < 3; ++d)
        if (const int i = model_->unknown(model_->exchange.ports[p], d); i >= 0) rows.push_back(i);
    points_.push_back(traces_of(rows));
  }
  points_at_.resize(first_.back());
  for (size_t i = 0; i < points_.size(); ++i)
    for (size_t c = 0; c < points_[i].unknowns.size(); ++c)
      points_at_[points_[i].unknowns[c]].push_back({static_cast<int>(i), static_cast<int>(c)});
}

AssembledSystem::PointTraces AssembledSystem::traces_of(const std::vector<int>& rows) const {
  const auto each_entry = [&](auto&& visit) {
    for (size_t r = 0; r < rows.size(); ++r) {
      const auto next = std::upper_bound(model_->offset.begin(), model_->offset.end(), rows[r]);
      const auto piece = static_cast<size_t>(next - model_->offset.begin()) - 1;
      const Trace t = pieces_[piece]->op().traces()[rows[r] - model_->offset[piece]];
      for (int a = 0; a < t.n; ++a) visit(static_cast<Eigen::Index>(r), first_[piece] + t.at[a], t.value[a]);
    }
  };
  PointTraces traces;
  std::vector<int>& unknowns = traces.unknowns;
  each_entry([&](Eigen::Index, int unknown, double) { unknowns.push_back(unknown); });
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  traces.rows = Mat::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(unknowns.size()));
  each_entry([&](Eigen::Index row, int unknown, double value) {
    traces.rows(row, std::lower_bound(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin()) += value;
  });
  return traces;
}

// The pieces' entries, and all that a point may ever couple; without values.
SparseMatrix AssembledSystem::make_pattern() {
  const int n = first_.back();
  SparseMatrix pattern(n, n);
  std::vector<int> columns, own;
  diagonal_.resize(n);
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const SparseMatrix of_piece = pieces_[i]->matrix();
    diagonal_.segment(first_[i], of_piece.rows()) = of_piece.diagonal();
    for (Eigen::Index r = 0; r < of_piece.rows(); ++r) {
      const auto row = static_cast<size_t>(first_[i] + r);
      own.clear();
      for (SparseMatrix::InnerIterator entry(of_piece, r); entry; ++entry)
        own.push_back(first_[i] + static_cast<int>(entry.col()));
      for (const PointAt& at : points_at_[row])
        own.insert(own.end(), points_[at.point].unknowns.begin(), points_[at.point].unknowns.end());
      std::sort(own.begin(), own.end());
      columns.insert(columns.end(), own.begin(), std::unique(own.begin(), own.end()));
      pattern.outerIndexPtr()[row + 1] = static_cast<int>(columns.size());
    }
  }
  pattern.resizeNonZeros(static_cast<Eigen::Index>(columns.size()));
  std::copy(columns.begin(), columns.end(), pattern.innerIndexPtr());
  return pattern;
}

// A symmetric matrix that is factorised in one order is stored in that order, and half of it is enough.
void AssembledSystem::put_in_order(const SparseMatrix& pattern) {
  const auto n = static_cast<int>(pattern.rows());
  std::vector<int> nodes, own;
  for (const AssembledPiece* piece : pieces_) {
    const int before = nodes.empty() ? 0 : nodes.back() + 1;
    for (const int node : piece->op().unknowns().node_of_unknown()) nodes.push_back(before + node);
  }
  const MayBeAbandoned may(ranks::is_alone());
  factor_ = std::make_unique<RepeatedFactor>(pattern, nodes, "static step '" + model_->step->name + "'");
  position_.resize(n);
  entry_at_.resize(n);
  for (int p = 0; p < n; ++p) position_[factor_->order()[p]] = p;
  matrix_.resize(n, n);
  matrix_.resizeNonZeros((pattern.nonZeros() + n) / 2);
  int* columns = matrix_.innerIndexPtr();
  for (int p = 0; p < n; ++p) {
    own.clear();
    for (SparseMatrix::InnerIterator entry(pattern, factor_->order()[p]); entry; ++entry)
      if (const int at = position_[entry.col()]; at >= p) own.push_back(at);
    std::sort(own.begin(), own.end());
    columns = std::copy(own.begin(), own.end(), columns);
    matrix_.outerIndexPtr()[p + 1] = static_cast<int>(columns - matrix_.innerIndexPtr());
  }
  CHECK(columns == matrix_.innerIndexPtr() + matrix_.nonZeros(), "a pattern that is not symmetric");
}

double AssembledSystem::bytes() const {
  double sum = (factor_ ? factor_->bytes() : 0.0) + 12.0 * static_cast<double>(matrix_.nonZeros());
  for (const PointTraces& point : points_) sum += 8.0 * static_cast<double>(point.rows.size());
  return sum;
}

double AssembledSystem::bytes_to_come() const {
  constexpr double kept = 6.0;  // of the factor, at hand, of the iteration before, what they differ by
  double of_points = 0.0;
  for (const PointTraces& point : points_) of_points += 8.0 * std::pow(static_cast<double>(point.rows.rows()), 2);
  return kept * of_points + (factor_ ? factor_->bytes() + factor_->bytes_at_work() : 0.0);
}

void AssembledSystem::fill_matrix() {
  std::vector<Mat> forces;  // of each point, by its unknowns
  for (size_t i = 0; i < points_.size(); ++i) forces.emplace_back(tangents_.points[i].matrix * points_[i].rows);
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const SparseMatrix of_piece = pieces_[i]->matrix();
    for (int r = 0; r < pieces_[i]->op().n_free(); ++r) add_row(first_[i] + r, of_piece, first_[i], forces);
  }
}

// first: of the piece's unknowns.
void AssembledSystem::add_row(int unknown, const SparseMatrix& of_piece, int first, const std::vector<Mat>& forces) {
  const int row = position_[unknown];
  for (int e = matrix_.outerIndexPtr()[row]; e < matrix_.outerIndexPtr()[row + 1]; ++e)
    entry_at_[matrix_.innerIndexPtr()[e]] = e;
  const auto add = [&](int column, double value) {
    if (const int at = position_[column]; at >= row) matrix_.valuePtr()[entry_at_[at]] += value;
  };
  for (SparseMatrix::InnerIterator entry(of_piece, unknown - first); entry; ++entry)
    add(first + static_cast<int>(entry.col()), entry.value());
  Vec own;
  for (const PointAt& at : points_at_[unknown]) {
    const PointTraces& point = points_[at.point];
    own.noalias() = forces[at.point].transpose() * point.rows.col(at.column);
    for (Eigen::Index c = 0; c < own.size(); ++c) add(point.unknowns[c], own[c]);
  }
}

Vec AssembledSystem::stiffness_times(const Vec& x) const {
  Vec force(x.size());
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const PieceOperator& op = pieces_[i]->op();
    const std::vector<double> at_rest(op.held().size(), 0.0);
    force.segment(first_[i], op.n_free()) =
        op.c1() * op.stiffness_times(op.unknowns().expand(x.segment(first_[i], op.n_free()), at_rest));
  }
  return force;
}

void AssembledSystem::answer_preloads() {
  const auto n = static_cast<Eigen::Index>(tangents_.preloads.size());
  columns_.resize(first_.back(), n);
  yielding_ = Mat::Zero(n, n);
  if (n == 0) return;
  for (Eigen::Index i = 0; i < n; ++i) {
    const PreloadTangent& preload = tangents_.preloads[static_cast<size_t>(i)];
    Vec column = Vec::Zero(model_->n_q());
    for (const auto& [unknown, value] : preload.column) column[unknown] += value;
    columns_.col(i) = from_rows(column);
    yielding_(i, i) = preload.stiffness;
  }
  answers_ = factor_->solve(columns_);
  yielding_ -= columns_.transpose() * answers_;
}

std::string AssembledSystem::place_of(int unknown) const {
  const auto piece = std::upper_bound(first_.begin(), first_.end(), unknown) - first_.begin() - 1;
  const Substructure& body = *model_->cut->piece(static_cast<int>(piece)).body;
  const int node = pieces_[static_cast<size_t>(piece)]->op().unknowns().node_of_unknown()[unknown - first_[piece]];
  const Vec3 x = 1e3 * (body.mesh->nodes.col(node) + body.place);
  return fmt::format("in '{}' at ({:.4g}, {:.4g}, {:.4g}) mm", body.name, x[0], x[1], x[2]);
}

void AssembledSystem::set_tangents(Tangents tangents) {
  tangents_ = std::move(tangents);
  set_own();
  is_following_ = tangents_.follow();
  if (!factor_) return;
  fill_matrix();
  const auto tell = [&](double share) {
    if (watch_) watch_(fmt::format("factor {:.0f} %", 100.0 * share));
  };
  if (!factor_->factorise_in_order(matrix_, tell))
    throw NumericalError(fmt::format(
        "static step '{}': the system is not positive definite, first found so {}: an unconstrained rigid motion, or a "
        "cell of almost no volume",
        model_->step->name, place_of(factor_->not_positive())));
  answer_preloads();
}

Vec AssembledSystem::at_rows(const Vec& x) const {
  Vec values(model_->n_q());
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Traces& traces = pieces_[i]->op().traces();
    for (int r = 0; r < pieces_[i]->n_rows(); ++r) {
      const Trace t = traces[r];
      double sum = 0.0;
      for (int a = 0; a < t.n; ++a) sum += t.value[a] * x[first_[i] + t.at[a]];
      values[model_->offset[i] + r] = sum;
    }
  }
  return values;
}

Vec AssembledSystem::from_rows(const Vec& values) const {
  Vec x = Vec::Zero(first_.back());
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Traces& traces = pieces_[i]->op().traces();
    for (int r = 0; r < pieces_[i]->n_rows(); ++r) {
      const Trace t = traces[r];
      for (int a = 0; a < t.n; ++a) x[first_[i] + t.at[a]] += t.value[a] * values[model_->offset[i] + r];
    }
  }
  return x;
}

Vec AssembledSystem::tangent_times(const Vec& velocity) const {
  Vec force = Vec::Zero(velocity.size()), own, answer;
  for (const PointTangent& point : tangents_.points) {
    own = velocity(point.unknowns);
    answer.noalias() = point.matrix * own;
    force(point.unknowns) += answer;
  }
  for (const PreloadTangent& preload : tangents_.preloads) {
    const double way = preload.way(velocity);
    for (const auto& [unknown, value] : preload.column) force[unknown] -= way * value;
  }
  return force;
}

Vec AssembledSystem::balanced(const Vec& right_hand_side, const std::vector<char>* reach) const {
  Vec x = reach ? factor_->solve(right_hand_side, *reach) : Vec(factor_->solve(right_hand_side));
  if (yielding_.size() > 0) x += answers_ * solve_dense(yielding_, columns_.transpose() * x);
  return x;
}

bool AssembledSystem::solve(Vec& velocity, Vec& force, double precision) {
  if (!factor_) return true;
  Vec held = Vec::Zero(model_->n_q()), loads(first_.back());
  for (size_t i = 0; i < pieces_.size(); ++i) {
    loads.segment(first_[i], pieces_[i]->op().n_free()) = pieces_[i]->right_hand_side();
    if (const Vec* own = pieces_[i]->moved_rows()) held.segment(model_->offset[i], own->size()) = *own;
  }
  n_products_ = 0;
  Vec at_rest = force + tangent_times(velocity - held);
  if (is_following_ || has_others_) {
    const Vec to_image = at_rows(balanced(loads + from_rows(at_rest))) + held - velocity;
    const std::optional<Vec> more = what_others_add(to_image, precision);
    if (!more) return false;
    at_rest -= *more;
  }
  const auto missing = [&] {
    velocity = at_rows(x_) + held;
    force = at_rest - tangent_times(velocity - held);
    return Vec(loads + from_rows(force) - stiffness_times(x_));
  };
  x_ = balanced(loads + from_rows(at_rest));
  x_ += balanced(missing());  // ties are stiff beside the cells: what rounding left, once
  const Vec left = missing();
  // Rounding of motions beside which the forces are nothing is no imbalance.
  const double moved = 1e-5 * diagonal_.cwiseProduct(x_).cwiseAbs().maxCoeff();
  const double size = std::max({from_rows(force).cwiseAbs().maxCoeff(), loads.cwiseAbs().maxCoeff(), moved});
  imbalance_ = size > 0.0 ? left.cwiseAbs().maxCoeff() / size : 0.0;
  return true;
}

void AssembledSystem::set_velocities() {
  if (!factor_) return;
  for (size_t i = 0; i < pieces_.size(); ++i)
    pieces_[i]->set_velocity(x_.segment(first_[i], pieces_[i]->op().n_free()));
}

}  // namespace dygita

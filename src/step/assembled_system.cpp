#include "step/assembled_system.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "numerics/dense.hpp"
#include "step/make_pieces.hpp"

namespace dygita {

AssembledSystem::AssembledSystem(const StepModel& model) : model_(&model), first_{0} {
  for (size_t i = 0; i < model.pieces.size(); ++i) pieces_.push_back(&assembled_piece(model, static_cast<int>(i)));
  const SparseMatrix stiffness = pieces_together();
  find_points();
  make_pattern(stiffness);
}

SparseMatrix AssembledSystem::pieces_together() {
  std::vector<SparseMatrix> of_pieces;
  std::vector<int> counts;
  for (const AssembledPiece* piece : pieces_) {
    const SparseMatrix& own = of_pieces.emplace_back(piece->matrix());
    first_.push_back(first_.back() + piece->op().n_free());
    for (Eigen::Index r = 0; r < own.rows(); ++r) counts.push_back(own.outerIndexPtr()[r + 1] - own.outerIndexPtr()[r]);
  }
  SparseMatrix together(first_.back(), first_.back());
  together.reserve(counts);
  for (size_t i = 0; i < pieces_.size(); ++i)
    for (Eigen::Index r = 0; r < of_pieces[i].rows(); ++r)
      for (SparseMatrix::InnerIterator entry(of_pieces[i], r); entry; ++entry)
        together.insertBackUncompressed(first_[i] + r, first_[i] + entry.col()) = entry.value();
  together.makeCompressed();
  return together;
}

Eigen::Map<const SparseMatrix> AssembledSystem::stiffness() const {
  return {matrix_.rows(),          matrix_.cols(),          matrix_.nonZeros(),
          matrix_.outerIndexPtr(), matrix_.innerIndexPtr(), stiffness_values_.data()};
}

void AssembledSystem::find_points() {
  for (const Point& point : model_->exchange.points) {
    std::vector<int>& rows = unknowns_of_points_.emplace_back();
    for (int p = point.first_port; p < point.end_port; ++p)
      for (int d = 0; d < 3; ++d)
        if (const int i = model_->unknown(model_->exchange.ports[p], d); i >= 0) rows.push_back(i);
    points_.push_back(traces_of(rows));
  }
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

// The pieces' entries, and all that a point may ever couple.
void AssembledSystem::make_pattern(const SparseMatrix& stiffness) {
  const int n = first_.back();
  std::vector<std::vector<int>> points_at(n);
  for (size_t i = 0; i < points_.size(); ++i)
    for (const int unknown : points_[i].unknowns) points_at[unknown].push_back(static_cast<int>(i));
  std::vector<int> columns, starts{0}, own, nodes;
  for (int r = 0; r < n; ++r) {
    own.clear();
    for (SparseMatrix::InnerIterator entry(stiffness, r); entry; ++entry) own.push_back(static_cast<int>(entry.col()));
    for (const int i : points_at[r]) own.insert(own.end(), points_[i].unknowns.begin(), points_[i].unknowns.end());
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    columns.insert(columns.end(), own.begin(), own.end());
    starts.push_back(static_cast<int>(columns.size()));
  }
  const std::vector<double> zeros(columns.size(), 0.0);
  matrix_ = Eigen::Map<const SparseMatrix>(n, n, static_cast<Eigen::Index>(columns.size()), starts.data(),
                                           columns.data(), zeros.data());
  for (int r = 0; r < n; ++r) {
    int at = starts[r];
    for (SparseMatrix::InnerIterator entry(stiffness, r); entry; ++entry) {
      while (columns[at] < entry.col()) ++at;
      matrix_.valuePtr()[at] = entry.value();
    }
  }
  for (PointTraces& point : points_) {
    const size_t n_own = point.unknowns.size();
    point.entries.resize(n_own * n_own);
    for (size_t r = 0; r < n_own; ++r) {
      auto at = columns.begin() + starts[point.unknowns[r]];
      const auto end = columns.begin() + starts[point.unknowns[r] + 1];
      for (size_t c = 0; c < n_own; ++c) {
        at = std::lower_bound(at, end, point.unknowns[c]);
        point.entries[c * n_own + r] = static_cast<int>(at - columns.begin());
      }
    }
  }
  stiffness_values_.assign(matrix_.valuePtr(), matrix_.valuePtr() + columns.size());
  diagonal_ = matrix_.diagonal();
  for (const AssembledPiece* piece : pieces_) {
    const int before = nodes.empty() ? 0 : nodes.back() + 1;
    for (const int node : piece->op().unknowns().node_of_unknown()) nodes.push_back(before + node);
  }
  if (n > 0) factor_ = std::make_unique<RepeatedFactor>(matrix_, nodes, "static step '" + model_->step->name + "'");
}

double AssembledSystem::bytes() const {
  const double entries = static_cast<double>(matrix_.nonZeros());
  double of_points = 0.0;
  for (const PointTraces& point : points_) of_points += static_cast<double>(point.entries.size());
  return (factor_ ? factor_->bytes() : 0.0) + 20.0 * entries + 4.0 * of_points;
}

void AssembledSystem::add_tangents() {
  std::copy(stiffness_values_.begin(), stiffness_values_.end(), matrix_.valuePtr());
  Mat block;
  for (size_t i = 0; i < points_.size(); ++i) {
    const PointTraces& point = points_[i];
    block.noalias() = point.rows.transpose() * tangents_.points[i].matrix * point.rows;
    for (size_t e = 0; e < point.entries.size(); ++e) matrix_.valuePtr()[point.entries[e]] += block.data()[e];
  }
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

void AssembledSystem::set_tangents(Tangents tangents) {
  tangents_ = std::move(tangents);
  set_own();
  is_following_ = tangents_.follow();
  if (!factor_) return;
  add_tangents();
  const auto tell = [&](double share) {
    if (watch_) watch_(fmt::format("factor {:.0f} %", 100.0 * share));
  };
  if (!factor_->factorise(matrix_, tell))
    throw NumericalError("static step '" + model_->step->name +
                         "': the system is not positive definite: an unconstrained rigid motion, or a cell of almost "
                         "no volume");
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

bool AssembledSystem::solve(Vec& velocity, Vec& force) {
  if (!factor_) return true;
  Vec held = Vec::Zero(model_->n_q()), loads(first_.back());
  for (size_t i = 0; i < pieces_.size(); ++i) {
    loads.segment(first_[i], pieces_[i]->op().n_free()) = pieces_[i]->right_hand_side();
    if (const Vec* own = pieces_[i]->moved_rows()) held.segment(model_->offset[i], own->size()) = *own;
  }
  n_products_ = 0;
  Vec at_rest = force + tangent_times(velocity - held);
  if (is_following_ || has_others_) {
    const std::optional<Vec> more = what_others_add(at_rows(balanced(loads + from_rows(at_rest))) + held - velocity);
    if (!more) return false;
    at_rest -= *more;
  }
  const auto missing = [&] {
    velocity = at_rows(x_) + held;
    force = at_rest - tangent_times(velocity - held);
    return Vec(loads + from_rows(force) - stiffness() * x_);
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

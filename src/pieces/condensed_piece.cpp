#include "pieces/condensed_piece.hpp"

#include <numeric>

#include "base/error.hpp"
#include "pieces/equal_pieces.hpp"
#include "pieces/row_stiffness.hpp"

namespace dygita {

namespace {

// f on one vector where there is one piece, on the columns of a matrix where there are several.
template <class Function>
void together(const std::vector<Vec*>& vectors, Function&& f) {
  if (vectors.size() == 1) return f(*vectors.front());
  Mat columns(vectors.front()->size(), static_cast<Eigen::Index>(vectors.size()));
  for (size_t i = 0; i < vectors.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = *vectors[i];
  f(columns);
  for (size_t i = 0; i < vectors.size(); ++i) *vectors[i] = columns.col(static_cast<Eigen::Index>(i));
}

}  // namespace

Condensation::Condensation(std::unique_ptr<Factor> own, const PieceOperator& op) {
  auto condensed = std::make_shared<Mat>(own->take_schur());
  factor = std::move(own);
  take_reference_off(op, factor->n_interior(), *condensed);
  schur = std::move(condensed);
  set_diagonal(op);
}

void Condensation::set_diagonal(const PieceOperator& op) {
  CHECK(schur, "the Schur complement has been given away for H");
  schur_diagonal = stiffness_of_rows(*this, op);
  for (int i = 0; i < op.n_rows(); ++i) schur_diagonal[i] /= op.setup().rows[i].n_sharing;
}

namespace {

void add_rows(const PieceOperator& op, const Vec& k, int n_interior, Mat& to) {
  for (int i = 0; i < op.n_rows(); ++i) {
    const Trace t = op.traces()[i];
    for (int a = 0; a < t.n; ++a)
      for (int b = 0; b < t.n; ++b) to(t.at[a] - n_interior, t.at[b] - n_interior) += k[i] * t.value[a] * t.value[b];
  }
}

std::vector<int> all_rows(const PieceOperator& op) {
  std::vector<int> all(op.n_rows());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

Mat Condensation::with_rows(const PieceOperator& op, const Vec& k) const {
  CHECK(schur, "the Schur complement has been given away for H");
  Mat sum = *schur;
  add_rows(op, k, factor->n_interior(), sum);
  return sum;
}

Mat Condensation::take_with_rows(const PieceOperator& op, const Vec& k) {
  CHECK(schur, "the Schur complement has been given away for H");
  if (schur.use_count() > 1) return with_rows(op, k);
  Mat sum = std::move(*schur);
  schur.reset();
  add_rows(op, k, factor->n_interior(), sum);
  return sum;
}

Mat on_rows(const Mat& h, const PieceOperator& op, int n_interior, const std::vector<int>& columns) {
  return on_rows(h, op, n_interior, all_rows(op), columns);
}

// H T^T first: a row over many nodes then costs no more than its entries.
Mat on_rows(const Mat& h, const PieceOperator& op, int n_interior, const std::vector<int>& rows,
            const std::vector<int>& columns) {
  const auto n_rows = static_cast<Eigen::Index>(rows.size()), n_columns = static_cast<Eigen::Index>(columns.size());
  Mat compliance = Mat::Zero(n_rows, n_columns);
  Vec line(h.rows());
  for (Eigen::Index j = 0; j < n_columns; ++j) {
    const Trace one = op.traces()[columns[j]];
    line.setZero();
    for (int a = 0; a < one.n; ++a) {
      const Eigen::Index at = one.at[a] - n_interior, after = h.rows() - at;
      line.head(at) += one.value[a] * h.row(at).head(at).transpose();
      line.tail(after) += one.value[a] * h.col(at).tail(after);
    }
    for (Eigen::Index i = 0; i < n_rows; ++i) {
      const Trace other = op.traces()[rows[i]];
      for (int b = 0; b < other.n; ++b) compliance(i, j) += other.value[b] * line[other.at[b] - n_interior];
    }
  }
  return compliance;
}

CondensedPiece::CondensedPiece(PieceOperator op, Condensation condensation, const CondensedPiece* twin)
    : ImplicitPiece(std::move(op)), condensation_(std::move(condensation)), twin_(twin) {
  schur_diagonal_ = condensation_.schur_diagonal;
}

void CondensedPiece::set_search_directions(const Vec& k) {
  ImplicitPiece::set_search_directions(k);
  const PieceSetup& setup = op_.setup();
  h_ = twin_ && twin_->h_ && have_equal_springs(twin_->op_, twin_->k_, op_, k)
           ? twin_->h_
           : std::make_shared<const SpdInverse>(
                 condensation_.take_with_rows(op_, k),
                 SpdInverse::cheapest(condensation_.factor->n_interface(), setup.n_products),
                 SpdInverse::Storage{setup.precision, setup.storage_error / 16, setup.half_error, setup.rough_error},
                 setup.what);
  condensation_.schur.reset();
}

// By substitution where it is cheaper than the whole inverse.
Mat CondensedPiece::row_compliance(const std::vector<int>& columns) const {
  const int n_i = condensation_.factor->n_interior(), n_b = h_->size();
  const auto n = static_cast<Eigen::Index>(columns.size());
  if (h_->form() == SpdInverse::Form::matrix || 3 * n > n_b) return on_rows(h_->lower(), op_, n_i, columns);
  const Traces& traces = op_.traces();
  Mat x = Mat::Zero(n_b, n);
  for (Eigen::Index c = 0; c < n; ++c) {
    const Trace t = traces[columns[c]];
    for (int a = 0; a < t.n; ++a) x(t.at[a] - n_i, c) += t.value[a];
  }
  x = h_->times(std::move(x));
  Mat compliance = Mat::Zero(n_rows(), n);
  for (Eigen::Index c = 0; c < n; ++c)
    for (int r = 0; r < n_rows(); ++r) {
      const Trace t = traces[r];
      for (int a = 0; a < t.n; ++a) compliance(r, c) += t.value[a] * x(t.at[a] - n_i, c);
    }
  return compliance;
}

void CondensedPiece::prepare(double quiet) {
  add_start_force();
  // A support that moves never rests: what its velocity brings would be left out of W.
  // Of a consistent mass the lumped one beside it is no bound: soft patterns within a cell move on unseen.
  const bool may_rest = solves_for_change() && !op_.has_motions() && !op_.setup().body->mass->is_consistent;
  quiet_ = may_rest ? quiet : 0.0;
  is_forward_due_ = true;
  const bool is_quiet =
      quiet_ > 0.0 && op_.scheme().dt * work_.x.cwiseAbs2().cwiseQuotient(op_.mass().lumped()).sum() <= quiet_;
  is_moved_ = !is_quiet;
  if (solves_for_change()) v_rows_ = op_.at_rows(work_.v_old);
}

void CondensedPiece::take_forward() {
  is_forward_due_ = false;
  b_ = work_.x.tail(condensation_.factor->n_interface());
  ++n_solved_;
}

Vec* CondensedPiece::to_substitute_forward() { return is_forward_due_ && is_moved_ ? &work_.x : nullptr; }

void CondensedPiece::forward(std::span<Piece* const> equal) {
  std::vector<Vec*> vectors;
  std::vector<CondensedPiece*> moved;
  for (Piece* piece : equal) {
    auto* own = static_cast<CondensedPiece*>(piece);  // the key is one of these
    Vec* const x = own->to_substitute_forward();
    if (!x) continue;
    moved.push_back(own);
    vectors.push_back(x);
  }
  if (!moved.empty()) together(vectors, [&](auto& x) { condensation_.factor->forward(x); });
  for (CondensedPiece* piece : moved) piece->take_forward();
}

Vec* CondensedPiece::to_substitute_backward() {
  if (!is_moved_) {
    n_spared_ += 2;
    return nullptr;
  }
  if (n_rows() > 0) work_.x.tail(dv_b_.size()) = dv_b_;
  ++n_solved_;
  return &work_.x;
}

void CondensedPiece::backward(std::span<Piece* const> equal) {
  std::vector<Vec*> vectors;
  for (Piece* piece : equal)
    if (Vec* const x = static_cast<CondensedPiece*>(piece)->to_substitute_backward()) vectors.push_back(x);
  if (!vectors.empty()) together(vectors, [&](auto& x) { condensation_.factor->backward(x); });
}

void CondensedPiece::wake() {
  if (is_moved_) return;
  is_moved_ = true;
  Piece* const self = this;
  forward({&self, 1});
}

const SpdInverse* CondensedPiece::to_multiply(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity, Vec& rhs) {
  const bool for_change = solves_for_change();
  const Traces& traces = op_.traces();
  const Vec* const held = held_rows();
  if (!is_moved_) {
    const double change = (q - state_.q).cwiseAbs2().cwiseQuotient(k_).sum();
    if (change <= quiet_) {
      velocity = v_rows_;
      return nullptr;
    }
    wake();
  }
  const int n_i = condensation_.factor->n_interior();
  rhs = b_;
  for (int i = 0; i < n_rows(); ++i) {
    const Trace t = traces[i];
    const double own = held ? q[i] - k_[i] * (*held)[i] : q[i], data = for_change ? own - state_.q[i] : own;
    for (int a = 0; a < t.n; ++a) rhs[t.at[a] - n_i] += t.value[a] * data;
  }
  return h_.get();
}

void CondensedPiece::take_product(Eigen::Ref<Vec> velocity) const {
  const bool for_change = solves_for_change();
  const Traces& traces = op_.traces();
  const Vec* const held = held_rows();
  const int n_i = condensation_.factor->n_interior();
  for (int i = 0; i < n_rows(); ++i) {
    const Trace t = traces[i];
    velocity[i] = for_change ? v_rows_[i] : 0.0;
    for (int a = 0; a < t.n; ++a) velocity[i] += t.value[a] * dv_b_[t.at[a] - n_i];
    if (held) velocity[i] += (*held)[i];
  }
}

void CondensedPiece::interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) {
  thread_local Vec rhs;
  const SpdInverse* const h = to_multiply(q, velocity, rhs);
  if (!h) return;
  h->multiply(rhs, dv_b_);
  if (h->has_half()) {
    whole_rhs_ = rhs;
    whole_ = dv_b_;
  }
  take_product(velocity);
}

void CondensedPiece::interface_velocity_in_half(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) {
  // A piece that rested has no product of this increment to start from.
  if (!h_->has_half() || !is_moved_) return interface_velocity(q, velocity);
  thread_local Vec rhs;
  to_multiply(q, velocity, rhs);
  rhs -= whole_rhs_;
  h_->multiply_in_half(rhs, dv_b_);
  dv_b_ += whole_;
  take_product(velocity);
}

const SpdInverse* CondensedPiece::to_multiply_roughly(const Vec& change, Vec& rhs) const {
  if (!h_->has_rough()) return nullptr;
  const Traces& traces = op_.traces();
  const int n_i = condensation_.factor->n_interior();
  rhs.setZero(h_->size());
  for (int i = 0; i < n_rows(); ++i) {
    const Trace t = traces[i];
    for (int a = 0; a < t.n; ++a) rhs[t.at[a] - n_i] += t.value[a] * change[i];
  }
  return h_.get();
}

void CondensedPiece::take_rough_product(const Vec& answer, Eigen::Ref<Vec> velocity) const {
  const Traces& traces = op_.traces();
  const int n_i = condensation_.factor->n_interior();
  for (int i = 0; i < n_rows(); ++i) {
    const Trace t = traces[i];
    velocity[i] = 0.0;
    for (int a = 0; a < t.n; ++a) velocity[i] += t.value[a] * answer[t.at[a] - n_i];
  }
}

void CondensedPiece::rough_change(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) const {
  thread_local Vec rhs, answer;
  const SpdInverse* const h = to_multiply_roughly(q, rhs);
  if (!h) return Piece::rough_change(q, velocity);
  h->multiply_roughly(rhs, answer);
  take_rough_product(answer, velocity);
}

bool CondensedPiece::find_velocity() {
  if (!is_moved_) return false;
  state_.v = work_.x;
  if (solves_for_change()) state_.v += work_.v_old;
  return true;
}

PieceFigures CondensedPiece::figures() const {
  PieceFigures figures = ImplicitPiece::figures();
  if (!twin_) figures.bytes += condensation_.factor->bytes();
  if (h_ && !(twin_ && twin_->h_ == h_)) figures.bytes += h_->bytes();
  figures.n_solved = n_solved_;
  figures.n_spared = n_spared_;
  return figures;
}

}  // namespace dygita

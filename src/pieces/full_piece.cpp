#include "pieces/full_piece.hpp"

#include "numerics/spd_inverse.hpp"

namespace dygita {

FullPiece::FullPiece(PieceOperator op, std::optional<Condensation> condensation, bool is_shared)
    : ImplicitPiece(std::move(op)), condensation_(std::move(condensation)), is_shared_(is_shared) {
  if (condensation_) schur_diagonal_ = condensation_->schur_diagonal;
}

void FullPiece::set_search_directions(const Vec& k) {
  ImplicitPiece::set_search_directions(k);
  if (twin_ && twin_->factor_ && twin_->k_ == k) {
    factor_ = twin_->factor_;
    return;
  }
  const PieceSetup& setup = op_.setup();
  const std::vector<char> no_interface(op_.n_free(), 0);
  const std::vector<int>& nodes = op_.unknowns().node_of_unknown();
  factor_ = condensation_ ? std::make_shared<const Factor>(op_.matrix(k), nodes, no_interface, setup.what)
                          : std::make_shared<const Factor>(op_.matrix(k), nodes, no_interface, setup.what,
                                                           setup.precision, setup.storage_error);
}

void FullPiece::prepare(double /*quiet*/) { add_start_force(); }

// The right-hand side stays as it is for the next q.
void FullPiece::interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) {
  const bool for_change = solves_for_change();
  const Traces& traces = op_.traces();
  const Vec* const held = held_rows();
  const FreeUnknowns& unknowns = op_.unknowns();
  Vec& v = state_.v;
  v = work_.x;
  for (int i = 0; i < n_rows(); ++i) {
    const double own = held ? q[i] - k_[i] * (*held)[i] : q[i];
    traces[i].add(for_change ? own - state_.q[i] : own, v);
  }
  Vec ordered(v.size());
  for (int i = 0; i < v.size(); ++i) ordered[i] = v[unknowns.position(factor_->order()[i])];
  factor_->solve(ordered);
  for (int i = 0; i < v.size(); ++i) v[unknowns.position(factor_->order()[i])] = ordered[i];
  if (for_change) v += work_.v_old;
  for (int i = 0; i < n_rows(); ++i) velocity[i] = traces[i].of(v) + (held ? (*held)[i] : 0.0);
}

Mat FullPiece::row_compliance(const std::vector<int>& columns) const {
  if (condensation_)
    return on_rows(inverse_spd(condensation_->with_rows(op_, k_), op_.setup().what), op_,
                   condensation_->factor->n_interior(), columns);
  constexpr int together = 16;
  const int n_columns = static_cast<int>(columns.size());
  const Traces& traces = op_.traces();
  Mat compliance = Mat::Zero(n_rows(), n_columns);
  std::vector<int> place(op_.n_free());
  for (int i = 0; i < op_.n_free(); ++i) place[factor_->order()[i]] = i;
  for (int first = 0; first < n_columns; first += together) {
    const int n = std::min(together, n_columns - first);
    Mat x = Mat::Zero(op_.n_free(), n);
    for (int c = 0; c < n; ++c) {
      const Trace t = traces[columns[first + c]];
      for (int a = 0; a < t.n; ++a) x(place[t.at[a]], c) += t.value[a];
    }
    factor_->solve(x);
    for (int c = 0; c < n; ++c)
      for (int r = 0; r < n_rows(); ++r)
        for (int a = 0; a < traces[r].n; ++a)
          compliance(r, first + c) += traces[r].value[a] * x(place[traces[r].at[a]], c);
  }
  return compliance;
}

PieceFigures FullPiece::figures() const {
  PieceFigures figures = ImplicitPiece::figures();
  if (condensation_ && !is_shared_) figures.bytes += condensation_->factor->bytes();
  if (factor_ && !(twin_ && twin_->factor_ == factor_)) figures.bytes += factor_->bytes();
  figures.is_mostly_interface = !condensation_;
  return figures;
}

}  // namespace dygita

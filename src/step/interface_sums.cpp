#include "step/interface_sums.hpp"

#include "base/parallel.hpp"
#include "partition/all_pieces.hpp"

namespace dygita {

InterfaceSums::InterfaceSums(Eigen::Index length) : runs_{{0, 0, length}} { find_starts(); }

InterfaceSums::InterfaceSums(const StepModel& model, int n_fields)
    : n_pieces_(model.cut->n_pieces()), is_shared_out_(!model.near.is_all()) {
  for (const int piece : model.here)
    for (int i = 0; i < n_fields; ++i)
      if (const int n = model.exchange.n_unknowns[piece]; n > 0)
        runs_.push_back({piece, model.near.start(piece) + i * static_cast<Eigen::Index>(model.near.n_own()), n});
  find_starts();
  if (is_shared_out_) of_pieces_ = segments_of(*model.cut, std::vector<int>(static_cast<size_t>(n_pieces_), 1));
}

void InterfaceSums::find_starts() {
  for (size_t i = 0; i < runs_.size(); ++i) {
    if (i == 0 || runs_[i].piece != runs_[i - 1].piece) starts_.push_back(i);
    n_unknowns_ += runs_[i].n;
  }
  starts_.push_back(runs_.size());
}

const std::vector<double>& InterfaceSums::add(int n_sums, const Share& share) {
  constexpr Eigen::Index few = 3000;  // unknowns: added up before threads have met
  const auto n = static_cast<size_t>(n_sums);
  shares_.assign(n * static_cast<size_t>(n_pieces_), 0.0);
  const auto add_piece = [&](int at) {
    for (size_t i = starts_[at]; i < starts_[at + 1]; ++i)
      share(runs_[i].first, runs_[i].n, shares_.data() + n * static_cast<size_t>(runs_[i].piece));
  };
  parallel_for(static_cast<int>(starts_.size()) - 1, add_piece, Schedule::as_free, n_unknowns_ < few ? 1 : 0);
  if (is_shared_out_) of_pieces_.complete(shares_.data(), n_sums);
  sums_.assign(n, 0.0);
  for (size_t i = 0; i < shares_.size(); ++i) sums_[i % n] += shares_[i];
  return sums_;
}

}  // namespace dygita

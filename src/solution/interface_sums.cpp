#include "solution/interface_sums.hpp"

#include "solution/all_pieces.hpp"

namespace dygita {

InterfaceSums::InterfaceSums(Eigen::Index length) : runs_{{0, 0, length}} {}

InterfaceSums::InterfaceSums(const StepModel& model, int n_fields)
    : n_pieces_(model.cut->n_pieces()), is_shared_out_(!model.near.is_all()) {
  for (const int piece : model.here)
    for (int i = 0; i < n_fields; ++i)
      if (const int n = model.exchange.n_unknowns[piece]; n > 0)
        runs_.push_back({piece, model.near.start(piece) + i * static_cast<Eigen::Index>(model.near.n_own()), n});
  if (is_shared_out_) of_pieces_ = segments_of(*model.cut, std::vector<int>(static_cast<size_t>(n_pieces_), 1));
}

const std::vector<double>& InterfaceSums::add(int n_sums, const Share& share) {
  const auto n = static_cast<size_t>(n_sums);
  shares_.assign(n * static_cast<size_t>(n_pieces_), 0.0);
  for (const Run& run : runs_) share(run.first, run.n, shares_.data() + n * static_cast<size_t>(run.piece));
  if (is_shared_out_) of_pieces_.complete(shares_.data(), n_sums);
  sums_.assign(n, 0.0);
  for (size_t i = 0; i < shares_.size(); ++i) sums_[i % n] += shares_[i];
  return sums_;
}

}  // namespace dygita

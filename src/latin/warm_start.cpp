#include "latin/warm_start.hpp"

#include <algorithm>

namespace dygita {

bool OwnFields::read(size_t increment, Eigen::Index n_own, Vec& q) const {
  if (!near || ranks::is_alone()) return fields->read(i_step, increment, n_own, q);
  if (i_step >= fields->n_steps()) return false;
  const AssembledRuns& runs = fields->runs(i_step);
  Vec kept;
  if (runs.is_whole()) {
    // A file, which every rank reads: what it has of the step.
    const bool is_kept = near->is_all() ? fields->read(i_step, increment, near->n_assembled(), kept)
                                        : fields->read_some(i_step, increment, near->kept_runs(), kept);
    if (ranks::any(!is_kept)) return false;
    q = kept;
    return true;
  }
  const bool is_kept = runs.n_all == near->n_assembled() && increment < fields->n_increments(i_step) &&
                       fields->read(i_step, increment, fields->size(i_step, increment), kept);
  if (ranks::any(!is_kept)) return false;
  if (!ranks::any(runs != near->kept_runs() || near->is_all())) {
    q = kept;
    return true;
  }
  // Pieces are on other ranks now: each puts in what it has, where the others have zero.
  Vec mine = Vec::Zero(runs.n_all);
  runs.place(kept, mine);
  const std::vector<double> all = ranks::sums({mine.begin(), mine.end()});
  q = near->part(Eigen::Map<const Vec>(all.data(), static_cast<Eigen::Index>(all.size()))).head(n_own);
  return true;
}

WarmStart::WarmStart(const OwnFields& fields, Vec weight, InterfaceSums sums)
    : fields_(fields), weight_(std::move(weight)), sums_(std::move(sums)) {}

bool WarmStart::predict(int increment, Eigen::Ref<Vec> q) {
  constexpr double memory = 0.5;
  if (!fields_.fields) return true;
  if (has_guessed_) {
    const std::vector<double>& errors = sums_.add(n_guesses, [&](Eigen::Index first, Eigen::Index n, double* to) {
      for (int i = 0; i < n_guesses; ++i)
        to[i] += (guess_[i] - q).segment(first, n).cwiseProduct(weight_.segment(first, n)).squaredNorm();
    });
    for (int i = 0; i < n_guesses; ++i) error_[i] = memory * error_[i] + errors[i];
  }
  kept_before_.swap(kept_);
  has_guessed_ = fields_.read(static_cast<size_t>(increment), q.size(), kept_);
  if (!has_guessed_) {
    kept_.resize(0);
    return false;
  }
  if (kept_before_.size() != q.size()) {  // the first increment: what was before is not known
    q = kept_;
    has_guessed_ = false;
    return true;
  }
  guess_ = {q, kept_, q + kept_ - kept_before_};
  const auto least = std::min_element(error_.begin(), error_.end()) - error_.begin();
  // The second increment has no hindsight yet.
  q = guess_[error_ == std::array<double, n_guesses>{} ? n_guesses - 1 : static_cast<size_t>(least)];
  return true;
}

}  // namespace dygita

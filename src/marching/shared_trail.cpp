#include "marching/shared_trail.hpp"

#include "ranks/ranks.hpp"

namespace dygita {

namespace {

// Whole numbers among them are far below 2^53.
void put(std::vector<double>& to, const Vec& values) {
  to.push_back(static_cast<double>(values.size()));
  to.insert(to.end(), values.begin(), values.end());
}

std::vector<double> numbers_of(const TrailEntry& entry) {
  std::vector<double> numbers{entry.eta,
                              entry.size,
                              entry.force_size,
                              static_cast<double>(entry.iterations),
                              entry.is_solved ? 1.0 : 0.0,
                              entry.is_assembled ? 1.0 : 0.0};
  put(numbers, entry.q);
  put(numbers, entry.uncorrected);
  put(numbers, entry.shortening);
  put(numbers, Eigen::Map<const Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>>(
                   entry.moved.data(), static_cast<Eigen::Index>(entry.moved.size()))
                   .cast<double>()
                   .matrix());
  numbers.push_back(entry.missed ? 1.0 : 0.0);
  if (!entry.missed) return numbers;
  const Missed& missed = *entry.missed;
  numbers.insert(numbers.end(), {static_cast<double>(missed.increment), static_cast<double>(missed.iterations),
                                 missed.indicator, missed.tolerance, missed.is_falling ? 1.0 : 0.0,
                                 missed.halving ? 1.0 : 0.0, missed.halving.value_or(0.0)});
  return numbers;
}

TrailEntry entry_of(const std::vector<double>& numbers) {
  const double* at = numbers.data();
  const auto vector = [&] {
    const auto n = static_cast<Eigen::Index>(*at++);
    const Vec values = Eigen::Map<const Vec>(at, n);
    at += n;
    return values;
  };
  TrailEntry entry;
  entry.eta = *at++;
  entry.size = *at++;
  entry.force_size = *at++;
  entry.iterations = static_cast<int>(*at++);
  entry.is_solved = *at++ != 0.0;
  entry.is_assembled = *at++ != 0.0;
  entry.q = vector();
  entry.uncorrected = vector();
  entry.shortening = vector();
  for (const double moved : vector()) entry.moved.push_back(moved != 0.0);
  if (*at++ == 0.0) return entry;
  Missed missed{static_cast<int>(at[0]), static_cast<int>(at[1]), at[2], at[3], at[4] != 0.0, {}};
  if (at[5] != 0.0) missed.halving = at[6];
  entry.missed = missed;
  return entry;
}

}  // namespace

bool SharedTrail::leads(long n) { return ranks::any(kept_ && kept_->leads(n)); }

long SharedTrail::n_left() const {
  return static_cast<long>(ranks::largest(kept_ ? static_cast<double>(kept_->n_left()) : 0.0));
}

TrailEntry SharedTrail::take() {
  const TrailEntry entry = kept_ ? kept_->take() : TrailEntry();
  return entry_of(ranks::shared(ranks::is_first() ? numbers_of(entry) : std::vector<double>()));
}

void SharedTrail::leave(const TrailEntry& entry) {
  if (kept_) kept_->leave(entry);
}

void SharedTrail::note_difference() {
  if (kept_) kept_->note_difference();
}

}  // namespace dygita

// Constant damping over a band of frequencies, by branches that relax (manual, eq. D22-D23).
#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "material/elastic.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr int n_frequencies = 120;

double geometric(double first, double last, double share) { return first * std::pow(last / first, share); }

// Rates evenly spread over the band (1/s), `inset` times its lower end to the upper one over `inset`; strengths by
// least squares of what the loss is off, as a share of that asked for. The storage that it is asked for beside depends
// on the strengths: a few rounds. A branch that never relaxes takes off what the others add in the middle of the band.
std::vector<Branch> branches_of(int n, double inset, double loss_factor, const std::array<double, 2>& band) {
  constexpr int n_rounds = 30;
  constexpr double pi = std::numbers::pi;
  const double middle = 2.0 * pi * std::sqrt(band[0] * band[1]);
  std::vector<Branch> branches;
  for (int b = 0; b < n; ++b)
    branches.push_back(
        {0.0,
         n == 1 ? middle : 2.0 * pi * geometric(inset * band[0], band[1] / inset, static_cast<double>(b) / (n - 1))});
  Mat loss(n_frequencies, n), storage(n_frequencies, n);
  for (int i = 0; i < n_frequencies; ++i) {
    const double w = 2.0 * pi * geometric(band[0], band[1], static_cast<double>(i) / (n_frequencies - 1));
    for (int b = 0; b < n; ++b) {
      const double r = branches[b].rate;
      loss(i, b) = w * r / (w * w + r * r);
      storage(i, b) = w * w / (w * w + r * r) - middle * middle / (middle * middle + r * r);
    }
  }
  Vec strength = Vec::Zero(n);
  for (int round = 0; round < n_rounds; ++round) {
    const Vec asked = loss_factor * (Vec::Ones(n_frequencies) + storage * strength);
    const Mat share = asked.cwiseInverse().asDiagonal() * loss;
    strength = (share.transpose() * share).ldlt().solve(share.transpose() * Vec::Ones(n_frequencies));
  }
  double in_the_middle = 0.0;
  for (int b = 0; b < n; ++b) {
    const double r = branches[b].rate;
    branches[b].strength = strength[b];
    in_the_middle += strength[b] * middle * middle / (middle * middle + r * r);
  }
  branches.push_back({-in_the_middle, 0.0});
  return branches;
}

// Largest error of the ratio in the band, as a share of it; infinite where these are no branches of a body.
double error_of(const Damping& damping, double ratio, const std::array<double, 2>& band) {
  constexpr double least_left = 0.2;  // of the static stiffness, for motions slower than the band
  const double slow = 1.0 + damping.branches.back().strength;
  double error = slow >= least_left ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Branch& b : damping.branches)
    if (!(b.strength > 0.0) && b.rate > 0.0) error = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_frequencies; ++i) {
    const double f = geometric(band[0], band[1], static_cast<double>(i) / (n_frequencies - 1));
    error = std::max(error, std::abs(damping.ratio(f) / ratio - 1.0));
  }
  return error;
}

}  // namespace

Damping damping_over(double ratio, const std::array<double, 2>& band) {
  constexpr int most = 12;
  constexpr double close_enough = 0.04, hardly_enough = 0.08;
  if (ratio == 0.0) return {};
  Damping best;
  double best_error = std::numeric_limits<double>::infinity();
  const double loss_factor = std::tan(2.0 * std::asin(std::min(ratio, 0.7)));
  for (int n = 1; n <= most && best_error > close_enough; ++n)
    for (double inset = 0.4; inset < 4.0; inset *= 1.06) {
      const Damping damping{0.0, 0.0, branches_of(n, inset, loss_factor, band), band};
      const double error = error_of(damping, ratio, band);
      if (error < best_error) best = damping, best_error = error;
    }
  if (best_error > hardly_enough)
    throw InputError(fmt::format(
        "a damping ratio of {:g} from {:g} Hz to {:g} Hz would change the stiffness too much: such a material stiffens "
        "by a factor of (upper/lower)^((4/pi) asin(ratio)) = {:.3g} over the band\n    take a lower ratio or a "
        "narrower "
        "band",
        ratio, band[0], band[1],
        std::pow(band[1] / band[0], 4.0 / std::numbers::pi * std::asin(std::min(ratio, 1.0)))));
  return best;
}

}  // namespace dygita

#include "estimates/grid_convergence.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "numerics/time_scheme.hpp"

namespace dygita {

namespace {

constexpr double formal_order = TimeScheme::order, lowest_order = 0.9, highest_order = 2.5, no_order = 0.1;
constexpr double trusted = 1.25, doubted = 3.0;  // factors of safety

using Values = std::vector<double>;

double largest_change(const Values& from, const Values& to) {
  double largest = 0.0;
  for (size_t i = 0; i < to.size(); ++i) {
    const double change = std::abs(to[i] - from[i]);
    if (!std::isfinite(change)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, change);
  }
  return largest;
}

bool turns_back(const Values& coarse, const Values& middle, const Values& fine) {
  double product = 0.0;
  for (size_t i = 0; i < fine.size(); ++i) product += (middle[i] - coarse[i]) * (fine[i] - middle[i]);
  return product < 0.0;
}

// After a change that was smaller than the next one or went the other way, as on a plateau, the last change may be
// small by chance.
bool falls_by_chance(const std::vector<Values>& values) {
  const size_t n = values.size();
  if (n < 4) return false;
  const Values &first = values[n - 4], &coarse = values[n - 3], &middle = values[n - 2];
  return !(largest_change(first, coarse) >= largest_change(coarse, middle)) || turns_back(first, coarse, middle);
}

// Of errors C h^p, from the changes of three runs and the ratios of their sizes.
double observed_order(double change_coarse, double change_fine, double ratio_coarse, double ratio_fine) {
  double order = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double bent = std::log((std::pow(ratio_fine, order) - 1.0) / (std::pow(ratio_coarse, order) - 1.0));
    const double next = (std::log(change_coarse / change_fine) + bent) / std::log(ratio_fine);
    if (!std::isfinite(next) || next < no_order) return ratio_coarse == ratio_fine ? next : 0.0;
    if (std::abs(next - order) < 1e-12) break;
    order = next;
  }
  return order;
}

Tendency tendency_of(double order) {
  if (order < no_order) return Tendency::divergent;
  if (order < lowest_order) return Tendency::slow;
  return order > highest_order ? Tendency::fast : Tendency::asymptotic;
}

}  // namespace

const char* meaning(Tendency tendency) {
  switch (tendency) {
    case Tendency::settled:
      return "does not move";
    case Tendency::asymptotic:
      return "asymptotic";
    case Tendency::fast:
      return "not asymptotic yet: the coarse runs deviate more than their order predicts; refine further";
    case Tendency::slow:
      return "slow: a singularity, such as a re-entrant or contact edge (grade the mesh there), or an impact";
    case Tendency::oscillating:
      return "not asymptotic: the changes from run to run do not fall steadily; refine further";
    case Tendency::divergent:
      return "no limit in these runs: they are too coarse, or there is none, as for stress at a sharp corner";
  }
  CHECK(false, "unknown tendency");
  return "";
}

double GridConvergence::at(double size) const { return uncertainty * std::pow(size / finest, exponent); }

GridConvergence grid_convergence(const std::vector<double>& sizes, const std::vector<std::vector<double>>& values,
                                 double noise) {
  CHECK(sizes.size() >= 3 && sizes.size() == values.size(), "an order of convergence takes three runs");
  const size_t n = sizes.size();
  const Values &coarse = values[n - 3], &middle = values[n - 2], &fine = values[n - 1];
  CHECK(coarse.size() == fine.size() && middle.size() == fine.size(), "runs differ in what they give");
  const double change_coarse = largest_change(coarse, middle), change_fine = largest_change(middle, fine);
  const double ratio_coarse = sizes[n - 3] / sizes[n - 2], ratio_fine = sizes[n - 2] / sizes[n - 1];
  GridConvergence found;
  found.limit = fine;
  found.finest = sizes[n - 1];
  if (!std::isfinite(change_coarse + change_fine)) return found;
  if (std::max(change_coarse, change_fine) <= noise) {
    found.tendency = Tendency::settled;
    found.uncertainty = noise;
    found.exponent = 0.0;
    return found;
  }
  const auto doubt = [&] {
    found.tendency = Tendency::oscillating;
    found.uncertainty = doubted * std::max(change_coarse, change_fine);
    return found;
  };
  if (turns_back(coarse, middle, fine)) return doubt();
  found.order = change_fine <= noise ? std::numeric_limits<double>::infinity()
                                     : observed_order(change_coarse, change_fine, ratio_coarse, ratio_fine);
  found.tendency = tendency_of(found.order);
  if (found.tendency == Tendency::fast && falls_by_chance(values)) return doubt();
  if (found.tendency == Tendency::divergent) return found;
  found.exponent = found.tendency == Tendency::fast ? formal_order : found.order;
  const double share = 1.0 / (std::pow(ratio_fine, found.exponent) - 1.0);
  found.uncertainty =
      (found.tendency == Tendency::asymptotic ? trusted : doubted) * std::max(share * change_fine, noise);
  if (found.tendency != Tendency::fast)
    for (size_t i = 0; i < fine.size(); ++i) found.limit[i] += share * (fine[i] - middle[i]);
  return found;
}

}  // namespace dygita

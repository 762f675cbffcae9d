// What units of one kind have in common and by how much they differ: quantiles, the level for 95 % of them, what drives
// the spread (manual, eq. N4, N5).
#pragma once

#include <optional>
#include <vector>

#include "result/result.hpp"

namespace dygita {

// k of the upper normal tolerance limit: mean + k deviation of n values lies above a share of the units with this
// confidence; P95/50 has 0.95 and 0.5. From the noncentral t distribution; n > 1.
double tolerance_factor(int n, double share = 0.95, double confidence = 0.5);

double sample_mean(const std::vector<double>& values);
double sample_deviation(const std::vector<double>& values);  // with n - 1; nan of one value
// Linear between the values in order, 0 <= p <= 1; nan where a value is none.
double sample_quantile(std::vector<double> values, double p);

// Spearman's, with the bounds within which it lies with 95 % confidence: -1 and 1 of three values or fewer.
struct RankCorrelation {
  double value = 0.0, low = -1.0, high = 1.0;
  // Do its bounds exclude zero? Else it is not distinguishable from none.
  bool is_clear() const { return low * high > 0.0; }
};
// nan where one of both is the same everywhere, or differs by rounding alone.
RankCorrelation rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

// Do values differ by no more than tables round them, which keep nine digits?
bool are_rounded_alike(const std::vector<double>& values);

// Values that fall into two groups with a gap between them, which normal ones hardly ever leave (once in ten thousand
// samples); nothing of fewer than eight.
struct TwoGroups {
  int n_upper = 0;
  double gap = 0.0, middle = 0.0;  // between the groups
};
std::optional<TwoGroups> two_groups(std::vector<double> values);

// Row by row over the members' tables: median, lowest, highest; of levels (spectra: amplitudes above zero) also p95_50
// and spread, the standard deviation in dB. factor: of p95_50; none: the members are no sample.
Table scatter_of(const Column& abscissa, const std::vector<double>& at, const std::vector<int>& step,
                 const std::vector<const std::vector<double>*>& members, const Column& column, bool is_level,
                 std::optional<double> factor);

}  // namespace dygita

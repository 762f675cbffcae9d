#include "estimates/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "estimates/random_design.hpp"

namespace dygita {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double normal_share(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

// P(mean + k s >= quantile of the units) of n standard normal values: the mean is normal, s^2 that of chi squared, and
// both are independent. Simpson's rule over s.
double confidence_of(double k, int n, double z) {
  constexpr int intervals = 4000;
  const double nu = n - 1.0, reach = 12.0 / std::sqrt(2.0 * nu);
  const double from = std::max(0.0, 1.0 - reach), to = 1.0 + reach, h = (to - from) / intervals;
  const double log_scale = std::log(2.0) + 0.5 * nu * std::log(0.5 * nu) - std::lgamma(0.5 * nu);
  double sum = 0.0, all = 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double s = from + i * h, weight = i == 0 || i == intervals ? 1.0 : i % 2 ? 4.0 : 2.0;
    const double power = nu == 1.0 ? 0.0
                         : s > 0.0 ? (nu - 1.0) * std::log(s)
                                   : -std::numeric_limits<double>::infinity();
    const double density = weight * std::exp(log_scale + power - 0.5 * nu * s * s);
    all += density;
    sum += density * normal_share(std::sqrt(static_cast<double>(n)) * (k * s - z));
  }
  return sum / all;
}

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (size_t i = 0; i < order.size();) {
    size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (size_t j = i; j < end; ++j)
      ranks[order[j]] = 0.5 * static_cast<double>(i + end - 1);  // of equal ones the mean
    i = end;
  }
  return ranks;
}

}  // namespace

double tolerance_factor(int n, double share, double confidence) {
  CHECK(n > 1, "a tolerance limit takes two values at least");
  const double z = normal_quantile(share);
  double low = -1.0, high = 1.0;
  while (confidence_of(low, n, z) > confidence) low *= 2.0;
  while (confidence_of(high, n, z) < confidence) high *= 2.0;
  while (high - low > 1e-13 * (1.0 + std::abs(low))) {
    const double middle = 0.5 * (low + high);
    (confidence_of(middle, n, z) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double sample_mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sample_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return not_a_number;
  const double centre = sample_mean(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - centre) * (v - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double sample_quantile(std::vector<double> values, double p) {
  if (values.empty() || std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    return not_a_number;
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = std::min(values.size() - 1, static_cast<size_t>(at)),
             above = std::min(values.size() - 1, below + 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

bool are_rounded_alike(const std::vector<double>& values) {
  constexpr double rounding = 2e-8;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low <= rounding * std::max(std::abs(*low), std::abs(*high));
}

// The bound is that of repetition (tests): the widest gap of normal values, of their range.
std::optional<TwoGroups> two_groups(std::vector<double> values) {
  const auto n = static_cast<int>(values.size());
  const auto is_known = [](double v) { return std::isfinite(v); };
  if (n < 8 || !std::all_of(values.begin(), values.end(), is_known)) return {};
  std::sort(values.begin(), values.end());
  const int least = std::max(2, n / 8);  // a single one is an outlier, no regime
  int at = least;
  for (int i = least; i <= n - least; ++i)
    if (values[i] - values[i - 1] > values[at] - values[at - 1]) at = i;
  const double gap = values[at] - values[at - 1], range = values.back() - values.front();
  if (!(gap > (0.25 + 5.0 / n) * range)) return {};
  return TwoGroups{n - at, gap, 0.5 * (values[at] + values[at - 1])};
}

RankCorrelation rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  CHECK(x.size() == y.size() && !x.empty(), "values in pairs");
  const auto is_nan = [](double v) { return std::isnan(v); };
  if (std::any_of(x.begin(), x.end(), is_nan) || std::any_of(y.begin(), y.end(), is_nan)) return {not_a_number};
  if (are_rounded_alike(x) || are_rounded_alike(y)) return {not_a_number};
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double centre = sample_mean(a);  // that of both
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - centre) * (b[i] - centre);
    aa += (a[i] - centre) * (a[i] - centre);
    bb += (b[i] - centre) * (b[i] - centre);
  }
  RankCorrelation found{std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0)};
  if (a.size() < 4) return found;
  // Fisher's transform, with the variance of Bonett and Wright. Few members may agree by chance: those that do are
  // taken half as far from it as the nearest order.
  const double n = static_cast<double>(a.size()), most = 1.0 - 6.0 / (n * (n * n - 1.0));
  const double z = std::atanh(std::clamp(found.value, -most, most));
  const double within = normal_quantile(0.975) * std::sqrt((1.0 + 0.5 * found.value * found.value) / (n - 3.0));
  found.low = std::tanh(z - within);
  found.high = std::tanh(z + within);
  return found;
}

Table scatter_of(const Column& abscissa, const std::vector<double>& at, const std::vector<int>& step,
                 const std::vector<const std::vector<double>*>& members, const Column& column, bool is_level,
                 std::optional<double> factor) {
  const std::string& unit = column.unit;
  Columns columns = {abscissa, {"median", unit}, {"lowest", unit}, {"highest", unit}};
  if (is_level && factor) columns.push_back({"p95_50", unit});
  if (is_level) columns.push_back({"spread", "dB"});
  Table table = empty_table(columns);
  table.step = step;
  table.columns[0] = at;
  for (size_t row = 0; row < at.size(); ++row) {
    std::vector<double> values, logarithms;
    for (const std::vector<double>* of : members) values.push_back((*of)[row]);
    for (const double v : values) logarithms.push_back(v > 0.0 ? std::log(v) : not_a_number);
    const double spread = sample_deviation(logarithms);
    std::vector<double> found = {sample_quantile(values, 0.5), sample_quantile(values, 0.0),
                                 sample_quantile(values, 1.0)};
    if (is_level && factor) found.push_back(std::exp(sample_mean(logarithms) + *factor * spread));
    if (is_level) found.push_back(20.0 / std::log(10.0) * spread);
    for (size_t i = 0; i < found.size(); ++i) table.columns[i + 1].push_back(found[i]);
  }
  return table;
}

}  // namespace dygita

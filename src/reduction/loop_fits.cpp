// Fits to what loops give: a curve whose slope never grows, an exponent.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reduction/loop_cycles.hpp"

namespace dygita {

std::vector<double> decreasing(const std::vector<double>& stiffness, const std::vector<double>& length) {
  struct Pool {
    double value, length;
    int n;
  };
  std::vector<Pool> pools;
  for (size_t i = 0; i < stiffness.size(); ++i) {
    pools.push_back({stiffness[i], length[i], 1});
    while (pools.size() > 1 && pools.back().value > pools[pools.size() - 2].value) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& into = pools.back();
      into.value = (into.value * into.length + last.value * last.length) / (into.length + last.length);
      into.length += last.length;
      into.n += last.n;
    }
  }
  std::vector<double> result;
  for (const Pool& pool : pools) result.insert(result.end(), pool.n, pool.value);
  return result;
}

double exponent_of(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, low = 0.0, high = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0.0) || !(y[i] > 0.0)) continue;
    const double u = std::log(x[i]), v = std::log(y[i]);
    low = n == 0.0 ? x[i] : std::min(low, x[i]);
    high = std::max(high, x[i]);
    n += 1.0;
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  if (n < 2.0 || high < 1.05 * low) return std::numeric_limits<double>::quiet_NaN();
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace dygita

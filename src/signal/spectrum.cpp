#include "signal/spectrum.hpp"

#include <complex>
#include <unsupported/Eigen/FFT>

#include "base/error.hpp"

namespace dygita {

double band_limit(const std::vector<double>& samples, double dt, double share) {
  CHECK(dt > 0.0 && share > 0.0 && share < 1.0, "a sampling interval and a share of the energy are needed");
  const size_t n = 2 * samples.size();
  if (n == 0) return 0.0;
  std::vector<double> padded(n, 0.0);
  for (size_t i = 0; i < samples.size(); ++i) padded[i] = samples[i] - samples.front();
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double>().fwd(spectrum, padded);
  double total = 0.0, below = 0.0;
  const size_t half = n / 2 + 1;
  for (size_t i = 0; i < half; ++i) total += std::norm(spectrum[i]);
  if (total == 0.0) return 0.0;
  size_t i = 0;
  while (i < half && (below += std::norm(spectrum[i])) < share * total) ++i;
  return static_cast<double>(i) / (static_cast<double>(n) * dt);
}

}  // namespace dygita

#include "material/elastic.hpp"

#include <spdlog/fmt/fmt.h>

#include <numbers>

#include "base/error.hpp"

namespace dygita {

using std::numbers::pi;

double Damping::ratio(double frequency) const { return mass / (4.0 * pi * frequency) + pi * frequency * stiffness; }

Damping damping_of(double ratio, double frequency) { return {0.0, ratio / (pi * frequency)}; }

Damping damping_of(const std::array<double, 2>& ratio, const std::array<double, 2>& frequency) {
  const double f = frequency[0], h = frequency[1];
  if (f == h) throw InputError(fmt::format("two damping ratios at one frequency, {:g} Hz", f));
  const double scale = 1.0 / (h * h - f * f);
  const Damping damping{4.0 * pi * f * h * scale * (ratio[0] * h - ratio[1] * f),
                        scale / pi * (ratio[1] * h - ratio[0] * f)};
  // Either part would feed energy in, beyond or between the frequencies.
  if (damping.mass < 0.0 || damping.stiffness < 0.0) {
    const double times = std::max(f, h) / std::min(f, h);
    throw InputError(fmt::format(
        "damping ratios of {:g} at {:g} Hz and {:g} at {:g} Hz would need a negative part: at frequencies {:g} times "
        "apart the ratios may differ by a factor of {:g} at most",
        ratio[0], f, ratio[1], h, times, times));
  }
  return damping;
}

Eigen::Matrix<double, 6, 6> Elastic::hooke() const {
  const double mu = shear_modulus();
  const double lambda = p_wave_modulus() - 2.0 * mu;
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(lambda);
  d.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
  return d;
}

}  // namespace dygita

#include "material/elastic.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "material/layup.hpp"
#include "numerics/dense.hpp"

namespace dygita {

using std::numbers::pi;

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

namespace {

// Of a quartic form of two directions, C : (m n) : (m n), the extreme that steps from one to the other reach from a
// start: with n given m is an eigenvector, and the other way round.
double extreme_from(const ElasticTensor& tensor, Vec3 normal, bool is_largest) {
  constexpr int most_rounds = 100;
  constexpr double close_enough = 1e-12;
  double modulus = 0.0;
  for (int i = 0; i < most_rounds; ++i) {
    const PrincipalAxes waves = principal_axes(tensor.acoustic(normal));
    const double before = modulus;
    modulus = waves.values[is_largest ? 2 : 0];
    if (std::abs(modulus - before) <= close_enough * modulus) break;
    normal = waves.vectors.col(is_largest ? 2 : 0);
  }
  return modulus;
}

// Along and between the axes of a cube that leans against those of the material: where these are symmetric, steps from
// an axis never leave it.
double extreme_modulus(const ElasticTensor& tensor, bool is_largest) {
  constexpr double lean = 0.05;
  double extreme = extreme_from(tensor, Vec3::UnitX(), is_largest);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = 0; z <= 1; ++z) {
        const Vec3 start = Vec3(x + lean * y, y + lean * z, z - lean * x);
        if (start.isZero()) continue;
        const double found = extreme_from(tensor, start.normalized(), is_largest);
        extreme = is_largest ? std::max(extreme, found) : std::min(extreme, found);
      }
  return extreme;
}

}  // namespace

Elastic::Elastic(std::string own_name, double young, double poisson, double own_density, const Damping& own_damping)
    : name(std::move(own_name)),
      density(own_density),
      damping(own_damping),
      tensor_(ElasticTensor::isotropic(young, poisson)),
      largest_(tensor_.wave_modulus(Vec3::UnitX(), Vec3::UnitX())),
      smallest_(tensor_.mu()),
      constants_{{"young", young}, {"poisson", poisson}} {}

Elastic::Elastic(std::vector<MaterialConstant> constants, const Mat6& stiffness, double own_density)
    : density(own_density),
      tensor_(stiffness),
      largest_(extreme_modulus(tensor_, true)),
      smallest_(extreme_modulus(tensor_, false)),
      constants_(std::move(constants)) {}

std::optional<double> Elastic::constant(const std::string& own_name) const {
  for (const MaterialConstant& own : constants_)
    if (own.name == own_name) return own.value;
  return {};
}

MaterialKey Elastic::key() const {
  const Mat6 d = tensor_.stiffness();
  MaterialKey key{density};
  size_t at = 1;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) key[at++] = d(i, j);
  if (layup) key[at] = layup->digest();
  return key;
}

double Elastic::young() const {
  return std::max({tensor_.young(Vec3::UnitX()), tensor_.young(Vec3::UnitY()), tensor_.young(Vec3::UnitZ())});
}

bool Elastic::has_strength() const { return layup ? layup->has_strengths() : strength != nullptr; }

Vec3 Elastic::wave_speeds(const Vec3& normal) const {
  return (principal_axes(tensor_.acoustic(normal)).values / density).cwiseSqrt().reverse();
}

}  // namespace dygita

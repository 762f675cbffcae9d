#include "estimates/random_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "base/error.hpp"

namespace dygita {

double normal_quantile(double p) {
  if (p > 0.5) return -normal_quantile(1.0 - p);
  double low = -40.0, high = 0.0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

namespace {

// Joe and Kuo (2008), new-joe-kuo-6: degree, coefficients of the primitive polynomial, first direction numbers.
struct SobolRow {
  int degree;
  unsigned polynomial;
  std::array<unsigned, 7> first;
};
constexpr std::array<SobolRow, most_sobol_parameters - 1> sobol_rows = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};

constexpr int sobol_bits = 32;

std::array<std::uint32_t, sobol_bits> directions(int dimension) {
  std::array<std::uint32_t, sobol_bits> v{};
  if (dimension == 0) {
    for (int i = 0; i < sobol_bits; ++i) v[i] = std::uint32_t{1} << (sobol_bits - 1 - i);
    return v;
  }
  const SobolRow& row = sobol_rows[static_cast<size_t>(dimension - 1)];
  const int s = row.degree;
  for (int i = 0; i < sobol_bits; ++i) {
    if (i < s) {
      v[i] = row.first[static_cast<size_t>(i)] << (sobol_bits - 1 - i);
      continue;
    }
    v[i] = v[i - s] ^ (v[i - s] >> s);
    for (int j = 1; j < s; ++j)
      if ((row.polynomial >> (s - 1 - j)) & 1U) v[i] ^= v[i - j];
  }
  return v;
}

// The distributions of the standard library differ between compilers, its generator does not.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : generator_(seed) {}
  double operator()() { return (static_cast<double>(generator_() >> 11) + 0.5) * 0x1p-53; }  // 0 < x < 1
  size_t below(size_t n) { return std::min(n - 1, static_cast<size_t>((*this)() * static_cast<double>(n))); }
  std::uint32_t bits() { return static_cast<std::uint32_t>(generator_() >> 32); }

 private:
  std::mt19937_64 generator_;
};

using PointList = std::vector<std::vector<double>>;

PointList latin_hypercube(size_t n, size_t k, std::uint64_t seed) {
  PointList points(n, std::vector<double>(k));
  Uniform uniform(seed);
  std::vector<size_t> stratum(n);
  for (size_t j = 0; j < k; ++j) {
    std::iota(stratum.begin(), stratum.end(), size_t{0});
    for (size_t i = n; i > 1; --i) std::swap(stratum[i - 1], stratum[uniform.below(i)]);
    for (size_t i = 0; i < n; ++i)
      points[i][j] = (static_cast<double>(stratum[i]) + uniform()) / static_cast<double>(n);
  }
  return points;
}

PointList random_points(size_t n, size_t k, std::uint64_t seed) {
  PointList points(n, std::vector<double>(k));
  Uniform uniform(seed);
  for (std::vector<double>& point : points)
    for (double& x : point) x = uniform();
  return points;
}

PointList sobol(size_t n, size_t k, std::uint64_t seed) {
  PointList points(n, std::vector<double>(k));
  Uniform uniform(seed);
  for (size_t j = 0; j < k; ++j) {
    const auto v = directions(static_cast<int>(j));
    const std::uint32_t shift = uniform.bits();
    std::uint32_t x = 0;
    for (size_t i = 0; i < n; ++i) {
      points[i][j] = (static_cast<double>(x ^ shift) + 0.5) * 0x1p-32;
      int bit = 0;
      while ((i >> bit) & 1U) ++bit;
      x ^= v[static_cast<size_t>(bit)];
    }
  }
  return points;
}

PointList corners(size_t k) {
  PointList points(size_t{1} << k, std::vector<double>(k));
  for (size_t i = 0; i < points.size(); ++i)
    for (size_t j = 0; j < k; ++j) points[i][j] = static_cast<double>((i >> j) & 1U);
  return points;
}

double of_triangle(double low, double peak, double high, double p) {
  const double share = (peak - low) / (high - low);
  if (p < share) return low + std::sqrt(p * (high - low) * (peak - low));
  return high - std::sqrt((1.0 - p) * (high - low) * (high - peak));
}

}  // namespace

double Distribution::quantile(double p) const {
  const std::vector<double>& a = numbers;
  switch (kind) {
    case Kind::uniform:
      return factor * (a[0] + p * (a[1] - a[0]));
    case Kind::normal:
      return factor * (a[0] + a[1] * normal_quantile(p));
    case Kind::lognormal:
      return factor * a[0] * std::exp(a[1] * normal_quantile(p));
    case Kind::triangular:
      return factor * of_triangle(a[0], a[1], a[2], p);
    case Kind::list:
      return factor * a[std::min(a.size() - 1, static_cast<size_t>(p * static_cast<double>(a.size())))];
  }
  CHECK(false, "unknown distribution");
  return 0.0;
}

double Distribution::corner(bool is_second) const {
  if (kind == Kind::normal || kind == Kind::lognormal) return quantile(is_second ? 0.975 : 0.025);
  return factor * (is_second ? numbers.back() : numbers.front());
}

std::string Distribution::complaint() const {
  const std::vector<double>& a = numbers;
  if (!std::all_of(a.begin(), a.end(), [](double x) { return std::isfinite(x); })) return "its numbers must be finite";
  if (kind == Kind::uniform && !(a[0] < a[1])) return "its bounds must rise, as in uniform(0.7, 1.3)";
  if (kind == Kind::normal && !(a[1] > 0.0)) return "its standard deviation must be above zero";
  if (kind == Kind::lognormal && !(a[0] > 0.0 && a[1] > 0.0))
    return "its median and the standard deviation of its logarithm must be above zero, as in lognormal(1, 0.25)";
  if (kind == Kind::triangular && !(a[0] <= a[1] && a[1] <= a[2] && a[0] < a[2]))
    return "its numbers are lowest, likeliest and highest, as in triangular(0.1, 0.15, 0.3)";
  if (kind == Kind::list && a.size() < 2) return "a list has two values at least";
  return "";
}

std::vector<std::vector<double>> design_points(Design design, int n, int k, std::uint64_t seed) {
  CHECK(n > 0 && k > 0, "a design has points and parameters");
  if (design == Design::corners) return corners(static_cast<size_t>(k));
  if (design == Design::latin_hypercube) return latin_hypercube(static_cast<size_t>(n), static_cast<size_t>(k), seed);
  if (design == Design::random) return random_points(static_cast<size_t>(n), static_cast<size_t>(k), seed);
  CHECK(k <= most_sobol_parameters, "more parameters than Sobol's sequence has here");
  return sobol(static_cast<size_t>(n), static_cast<size_t>(k), seed);
}

std::vector<int> short_tour(const std::vector<std::vector<double>>& points) {
  std::vector<int> left(points.size()), tour;
  std::iota(left.begin(), left.end(), 0);
  while (!left.empty()) {
    const auto distance = [&](int i) {
      double sum = 0.0;
      for (size_t j = 0; !tour.empty() && j < points[0].size(); ++j)
        sum += std::pow(points[static_cast<size_t>(i)][j] - points[static_cast<size_t>(tour.back())][j], 2);
      return sum;
    };
    const auto next =
        std::min_element(left.begin(), left.end(), [&](int a, int b) { return distance(a) < distance(b); });
    tour.push_back(*next);
    left.erase(next);
  }
  return tour;
}

}  // namespace dygita

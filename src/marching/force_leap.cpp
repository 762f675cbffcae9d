#include "marching/force_leap.hpp"

#include <algorithm>
#include <optional>

#include "numerics/gmres.hpp"

namespace dygita {

namespace {

constexpr double precision = 1e-3, difference = 1e-7;
constexpr int most_products = 100;
// Keeps the Jacobian regular: in a direction in which rounds do not converge the solution is long, but finite.
constexpr double shift = 1e-5;
constexpr double far = 1e12;  // rounds taken at once where GMRES has found no solution
constexpr int most_halvings = 50;
constexpr double as_before = 1.01;  // times the change of the first round

}  // namespace

Vec leap(const Vec& forces, const Vec& weight, const std::function<Vec(const Vec&)>& round) {
  const Vec scale = weight.cwiseSqrt();
  const Vec unscale = scale.unaryExpr([](double a) { return a > 0.0 ? 1.0 / a : 0.0; });
  const Vec after = round(forces);
  const Vec change = scale.cwiseProduct(after - forces);
  const double size = std::max(scale.cwiseProduct(after).norm(), change.norm());
  const auto times = [&](const Vec& x) -> Vec {
    const double by = difference * size / x.norm();
    const Vec moved = round(forces + by * unscale.cwiseProduct(x));
    return (1.0 + shift) * x - scale.cwiseProduct(moved - after) / by;
  };
  const GmresSystem system{times, [](const Vec& x) { return x; }};
  const std::optional<Vec> found =
      gmres(system, change, precision, std::min(most_products, static_cast<int>(forces.size())));
  Vec way = found ? *found : Vec(far * change);
  if (way.dot(change) < 0.0) way = -way;

  Vec reached = after;
  const auto goes = [&](double share) {
    const Vec there = forces + share * unscale.cwiseProduct(way), next = round(there);
    const bool is_good = scale.cwiseProduct(next - there).norm() <= as_before * change.norm();
    if (is_good) reached = next;
    return is_good;
  };
  double share = 1.0;
  for (int i = 0; i < most_halvings && !goes(share); ++i) share *= 0.5;
  if (share == 1.0) return reached;
  for (const double part : {0.5, 0.25, 0.125, 0.0625, 0.03125})
    if (goes(share + part * share)) share += part * share;
  return reached;
}

}  // namespace dygita

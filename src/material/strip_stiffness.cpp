#include "material/strip_stiffness.hpp"

#include "material/layup.hpp"

namespace dygita {

StripStiffness strip_of(const Layup& layup, int direction) {
  const int shear = direction == 0 ? 2 : 1;  // of the stresses across
  const auto height = [&](int i) {
    return 0.5 * layup.thickness() * layup.bound(i);
  };  // m, where a ply begins, over the middle
  double stiffness = 0.0, moment = 0.0, soft = 0.0;
  for (int i = 0; i < layup.n_plies(); ++i) {
    const double e = layup.law(i).q(direction, direction), t = layup.ply(i).thickness;
    stiffness += e * t;
    moment += e * t * (height(i) + 0.5 * t);
    soft += t * layup.law(i).s(shear, shear);
  }
  const double neutral = moment / stiffness;
  double bending = 0.0, below = 0.0, of_shear = 0.0;  // below: of E (z - neutral), over what lies below
  for (int i = 0; i < layup.n_plies(); ++i) {
    const double e = layup.law(i).q(direction, direction), t = layup.ply(i).thickness, from = height(i) - neutral,
                 to = from + t;
    constexpr double at[3] = {-0.7745966692414834, 0.0, 0.7745966692414834}, weight[3] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
    for (int k = 0; k < 3; ++k) {
      const double z = from + 0.5 * t * (1.0 + at[k]), flow = below + 0.5 * e * (z * z - from * from);
      of_shear += weight[k] * t * layup.law(i).s(shear, shear) * flow * flow;
    }
    below += 0.5 * e * (to * to - from * from);
    bending += e * (to * to * to - from * from * from) / 3.0;
  }
  return {bending, bending * bending / of_shear, layup.thickness() * layup.thickness() / soft};
}

}  // namespace dygita

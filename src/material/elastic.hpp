// Linear elasticity: what a material answers, moduli, waves and what makes two materials one.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "material/elastic_tensor.hpp"
#include "numerics/time_scheme.hpp"

namespace dygita {

// Damping proportional to the stiffness with a ratio at a frequency (Hz) (manual, eq. D8).
Damping damping_of(double ratio, double frequency);
// Rayleigh's, with a ratio at each of two frequencies (Hz). Throws InputError where they ask for a negative mass or
// stiffness part.
Damping damping_of(const std::array<double, 2>& ratio, const std::array<double, 2>& frequency);
// A ratio at all frequencies between two (Hz), within 5 %, by branches (manual, eq. D22-D23). Throws InputError where
// the stiffness would change too much.
Damping damping_over(double ratio, const std::array<double, 2>& band);

// By the name that a deck gives it, SI.
struct MaterialConstant {
  std::string name;
  double value = 0.0;
};

// Density, stiffness and layup: bodies of equal meshes and keys have equal matrices.
using MaterialKey = std::array<double, 23>;

class Layup;
class Strength;

class Elastic {
 public:
  std::string name;
  double density = 0.0;  // kg/m^3
  Damping damping;
  std::shared_ptr<const Strength> strength;  // null: none is given
  std::shared_ptr<const Layup> layup;        // of plies, whose mean the stiffness is; null: the same all through

  Elastic() = default;
  // The same in all directions.
  Elastic(std::string name, double young, double poisson, double density, const Damping& damping = {});
  // constants: what a deck gave, for records. stiffness: in the material's own axes, Pa.
  Elastic(std::vector<MaterialConstant> constants, const Mat6& stiffness, double density);

  // In the material's own axes; bodies lay them cell by cell (fem/cell_tensor.hpp).
  const ElasticTensor& tensor() const { return tensor_; }
  bool is_isotropic() const { return tensor_.is_isotropic(); }
  const std::vector<MaterialConstant>& constants() const { return constants_; }
  std::optional<double> constant(const std::string& name) const;
  MaterialKey key() const;

  double young() const;  // Pa, of a bar along that of its axes where it is stiffest
  // Pa, of plane waves: of all directions the largest and the smallest; isotropic: lambda + 2 mu and mu.
  double p_wave_modulus() const { return largest_; }
  double shear_modulus() const { return smallest_; }
  double p_wave_speed() const { return std::sqrt(largest_ / density); }   // m/s, no wave is faster
  double s_wave_speed() const { return std::sqrt(smallest_ / density); }  // m/s, no wave is slower
  // m/s, of plane waves with a unit normal, in the material's own axes: decreasing.
  Vec3 wave_speeds(const Vec3& normal) const;

  // Is it, or each of its plies, told what it bears?
  bool has_strength() const;

  // Hooke's matrix (6 x 6, Pa) for strains xx yy zz 2xy 2yz 2zx, in the material's own axes.
  Mat6 hooke() const { return tensor_.stiffness(); }

 private:
  ElasticTensor tensor_;
  double largest_ = 0.0, smallest_ = 0.0;  // Pa
  std::vector<MaterialConstant> constants_;
};

}  // namespace dygita

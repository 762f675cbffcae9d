// Materials of a Nastran file, in its units. Source: MSC Nastran Quick Reference Guide, MAT1, MAT9, MAT11.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "foreign/nastran_model.hpp"

namespace dygita {

namespace {

constexpr const char* modulus = "a modulus";

void set_density(const BulkFields& fields, int i, double mass_factor, ForeignMaterial& material) {
  const double density = fields.real_or(i, 0.0, "a density");
  if (density != 0.0) material.density = density * mass_factor;
}

// Two of E, G and NU; the third follows.
void read_mat1(const BulkFields& fields, double mass_factor, ForeignMaterial& material) {
  double e = fields.real_or(2, 0.0, modulus), nu = fields.real_or(4, 0.0, "Poisson's ratio");
  const double g = fields.real_or(3, 0.0, modulus);
  const bool has_e = fields.has(2), has_g = fields.has(3), has_nu = fields.has(4);
  set_density(fields, 5, mass_factor, material);
  if (has_e + has_g + has_nu < 2) {
    material.doubt = fmt::format("two of E, G and NU are expected ({})", material.where);
    return;
  }
  if (!has_e) e = 2 * g * (1 + nu);
  if (!has_nu && g != 0.0) nu = e / (2 * g) - 1;
  constexpr double close = 0.01;
  if (has_e && has_g && has_nu && std::abs(g - e / (2 * (1 + nu))) > close * std::abs(g))
    material.doubt = fmt::format("G is not E / 2 (1 + NU), so that it is not isotropic ({})", material.where);
  material.word = "elastic";
  material.moduli = {{"young", e}};
  material.ratios = {{"poisson", nu}};
}

// The upper triangle of the stiffness by rows; stresses in the order xx, yy, zz, xy, yz, zx.
void read_mat9(const BulkFields& fields, double mass_factor, ForeignMaterial& material) {
  constexpr int n = 6, first = 2;
  double c[n][n];
  double largest = 0.0;
  for (int i = 0, field = first; i < n; ++i)
    for (int j = i; j < n; ++j, ++field) {
      c[i][j] = fields.real_or(field, 0.0, "a stiffness");
      largest = std::max(largest, std::abs(c[i][j]));
    }
  constexpr int density = 23;
  set_density(fields, density, mass_factor, material);
  constexpr double negligible = 1e-9;
  for (int i = 0; i < n; ++i)
    for (int j = std::max(i + 1, 3); j < n; ++j)
      if (std::abs(c[i][j]) > negligible * largest) {
        material.doubt = fmt::format("its stiffnesses G{}{} couple directions, as no orthotropic material does ({})",
                                     i + 1, j + 1, material.where);
        return;
      }
  if (!(c[3][3] > 0) || !(c[4][4] > 0) || !(c[5][5] > 0)) {
    material.doubt = fmt::format("its stiffness is not positive definite ({})", material.where);
    return;
  }
  set_stiffnesses(material.where, {c[0][0], c[0][1], c[1][1], c[0][2], c[1][2], c[2][2], c[3][3], c[5][5], c[4][4]},
                  material);
}

void read_mat11(const BulkFields& fields, double mass_factor, ForeignMaterial& material) {
  std::vector<double> constants;
  constexpr int last = 10, density = 11;
  for (int i = 2; i <= last; ++i) constants.push_back(fields.real(i, "an elastic constant"));
  set_constants(constants, material);
  set_density(fields, density, mass_factor, material);
}

struct MaterialCard {
  const char* name;
  void (*read)(const BulkFields&, double, ForeignMaterial&);
  int damping;  // field of GE
};
constexpr MaterialCard material_cards[] = {{"MAT1", read_mat1, 8}, {"MAT9", read_mat9, 31}, {"MAT11", read_mat11, 16}};

}  // namespace

std::string unique_name(const std::map<long, std::string>& names, long number, const std::string& card,
                        std::vector<std::string>& taken) {
  const auto found = names.find(number);
  const std::string by_number = fmt::format("{} {}", card, number);
  std::string name = found == names.end() ? by_number : found->second;
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) name = fmt::format("{} ({})", name, by_number);
  taken.push_back(name);
  return name;
}

std::vector<NastranMaterial> nastran_materials(const BulkFile& file, const NastranNames& names, double mass_factor,
                                               std::vector<std::string>& told) {
  std::vector<NastranMaterial> materials;
  std::vector<std::string> taken;
  for (const BulkCard& card : file.cards())
    for (const MaterialCard& known : material_cards) {
      if (card.name != known.name) continue;
      const BulkFields fields(file, card);
      NastranMaterial made{fields.whole(1, "the number of a material"), {}};
      for (const NastranMaterial& other : materials)
        if (other.number == made.number)
          fields.fail(fmt::format("there is a material {} already, '{}'", made.number, other.material.name));
      made.material.name = unique_name(names.materials, made.number, known.name, taken);
      made.material.where = file.where(card);
      known.read(fields, mass_factor, made.material);
      if (const double damping = fields.real_or(known.damping, 0.0, "a damping"); damping != 0.0)
        told.push_back(fmt::format("{}: material '{}': structural damping GE = {:g} is not used", made.material.where,
                                   made.material.name, damping));
      materials.push_back(std::move(made));
    }
  for (const BulkCard& card : file.cards()) {
    if (!card.name.starts_with("MATT") && !card.name.starts_with("MATS")) continue;
    const BulkFields fields(file, card);
    const long number = fields.whole(1, "the number of a material");
    for (NastranMaterial& one : materials)
      if (one.number == number) one.material.doubt = fmt::format("{} is not read ({})", card.name, file.where(card));
  }
  return materials;
}

}  // namespace dygita

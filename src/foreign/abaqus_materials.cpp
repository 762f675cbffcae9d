// *MATERIAL of an .inp: elasticity, density and damping, in the units of the file.
#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_model.hpp"

namespace dygita {

namespace {

// Behaviour that changes nothing of small isothermal motions, or that is read.
const std::set<std::string> harmless = {"ELASTIC",      "DENSITY",      "DAMPING", "EXPANSION",
                                        "CONDUCTIVITY", "SPECIFICHEAT", "DEPVAR"};

// All numbers of a card's lines; `doubt`: where there are more lines than one set of numbers needs, by temperature.
std::vector<double> numbers_of(const CardFile& file, const FileCard& card, size_t n, ForeignMaterial& material) {
  std::vector<double> numbers;
  size_t i = 0;
  for (; i < card.data.size() && numbers.size() < n; ++i) {
    LineFields fields(file, card.data[i]);
    for (std::string_view field; numbers.size() < n && fields.next(field);)
      if (!field.empty()) numbers.push_back(fields.real_of(field, "a number"));
  }
  if (numbers.size() < n) file.fail(card, fmt::format("{} numbers are expected, not {}", n, numbers.size()));
  if (i < card.data.size())
    material.doubt =
        fmt::format("{} depends on temperature ({})", card.written, file.where(card.data[i].file, card.data[i].line));
  return numbers;
}

void read_elasticity(const CardFile& file, const FileCard& card, ForeignMaterial& material) {
  std::string type = in_capitals(card.option("TYPE"));
  std::erase(type, ' ');
  constexpr size_t n_isotropic = 2, n_orthotropic = 9;
  if (type.empty() || type == "ISO" || type == "ISOTROPIC") {
    const std::vector<double> c = numbers_of(file, card, n_isotropic, material);
    material.word = "elastic";
    material.moduli = {{"young", c[0]}};
    material.ratios = {{"poisson", c[1]}};
  } else if (type == "ENGINEERINGCONSTANTS") {
    set_constants(numbers_of(file, card, n_orthotropic, material), material);
  } else if (type == "ORTHO" || type == "ORTHOTROPIC") {
    set_stiffnesses(file.where(card), numbers_of(file, card, n_orthotropic, material), material);
  } else {
    material.doubt = fmt::format("*ELASTIC, TYPE = {} is not read ({})", printable(type), file.where(card));
  }
}

void read_behaviour(const CardFile& file, const FileCard& card, ForeignMaterial& material) {
  const LineFields fields(file, {"", card.file, card.line});
  if (card.keyword == "ELASTIC") read_elasticity(file, card, material);
  if (card.keyword == "DENSITY") material.density = numbers_of(file, card, 1, material)[0];
  if (card.keyword == "EXPANSION" && card.data.size() == 1 &&
      (!card.has("TYPE") || in_capitals(card.option("TYPE")) == "ISO"))
    material.expansion = numbers_of(file, card, 1, material)[0];
  if (card.keyword == "DAMPING") {
    if (card.has("ALPHA")) material.mass_damping = fields.real_of(card.option("ALPHA"), "ALPHA");
    if (card.has("BETA")) material.stiffness_damping = fields.real_of(card.option("BETA"), "BETA");
    for (const char* other : {"COMPOSITE", "STRUCTURAL"})
      if (card.has(other)) material.doubt = fmt::format("*DAMPING, {} is not read ({})", other, file.where(card));
  }
}

// What may stand below *MATERIAL and makes another material of it.
bool is_behaviour(const std::string& keyword) {
  static const std::set<std::string> others = {"PLASTIC",
                                               "HYPERELASTIC",
                                               "HYPERFOAM",
                                               "CREEP",
                                               "VISCOELASTIC",
                                               "USERMATERIAL",
                                               "CYCLICHARDENING",
                                               "DEFORMATIONPLASTICITY",
                                               "DRUCKERPRAGER",
                                               "MOHRCOULOMB",
                                               "VISCOUS",
                                               "RATEDEPENDENT",
                                               "MOHRCOULOMBHARDENING",
                                               "COMPRESSIONONLY"};
  return others.contains(keyword);
}

}  // namespace

void set_constants(const std::vector<double>& c, ForeignMaterial& material) {
  material.word = "orthotropic";
  material.moduli = {{"e1", c[0]}, {"e2", c[1]}, {"e3", c[2]}, {"g12", c[6]}, {"g13", c[7]}, {"g23", c[8]}};
  material.ratios = {{"nu12", c[3]}, {"nu13", c[4]}, {"nu23", c[5]}};
}

void set_stiffnesses(const std::string& where, const std::vector<double>& d, ForeignMaterial& material) {
  Mat3 stiffness;
  stiffness << d[0], d[1], d[3], d[1], d[2], d[4], d[3], d[4], d[5];
  const Eigen::LLT<Mat3> factor(stiffness);
  if (factor.info() != Eigen::Success) {
    material.doubt = fmt::format("its stiffness is not positive definite ({})", where);
    return;
  }
  const Mat3 s = factor.solve(Mat3::Identity());
  set_constants({1 / s(0, 0), 1 / s(1, 1), 1 / s(2, 2), -s(0, 1) / s(0, 0), -s(0, 2) / s(0, 0), -s(1, 2) / s(1, 1),
                 d[6], d[7], d[8]},
                material);
}

std::vector<ForeignMaterial> abaqus_materials(const CardFile& file) {
  std::vector<ForeignMaterial> materials;
  bool is_open = false;
  for (const FileCard& card : file.cards()) {
    if (card.keyword == "MATERIAL") {
      const std::string name = card.option("NAME");
      if (name.empty()) file.fail(card, "NAME = ... is expected");
      ForeignMaterial material;
      material.name = name;
      material.where = file.where(card);
      materials.push_back(std::move(material));
      is_open = true;
    } else if (is_open && harmless.contains(card.keyword)) {
      read_behaviour(file, card, materials.back());
    } else if (is_open && is_behaviour(card.keyword)) {
      materials.back().doubt = fmt::format("{} is not read ({})", card.written, file.where(card));
    } else if (card.keyword == "SOLIDSECTION" || card.keyword == "STEP") {
      is_open = false;
    }
  }
  return materials;
}

}  // namespace dygita

#include "foreign/foreign_meshes.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_steps.hpp"
#include "foreign/nastran_cases.hpp"
#include "foreign/unv_model.hpp"

namespace dygita {

namespace {

std::string text_of_report(const ForeignModel& model) {
  std::string text;
  for (const std::string& line : model.told) text += line + "\n";
  for (const std::string& line : model.unused) text += "not used: " + line + "\n";
  return text.empty() ? "all of the file is used\n" : text;
}

}  // namespace

std::shared_ptr<const ForeignMeshes> ForeignMeshes::of_abaqus(const ForeignOptions& options) {
  AbaqusModel read({options.file, options.unit, options.skip});
  analysis_of(read);  // names what loads and supports list by numbers
  return std::shared_ptr<const ForeignMeshes>(new ForeignMeshes(std::move(read.model()), options));
}

std::shared_ptr<const ForeignMeshes> ForeignMeshes::of_nastran(const ForeignOptions& options) {
  NastranModel read({options.file, options.unit, options.skip});
  analysis_of(read);
  return std::shared_ptr<const ForeignMeshes>(new ForeignMeshes(std::move(read.model()), options));
}

std::shared_ptr<const ForeignMeshes> ForeignMeshes::of_unv(const ForeignOptions& options) {
  const std::optional<double> unit = options.has_unit ? std::optional(options.unit) : std::nullopt;
  return std::shared_ptr<const ForeignMeshes>(
      new ForeignMeshes(unv_model({options.file, unit, options.skip}), options));
}

ForeignMeshes::ForeignMeshes(ForeignModel model, const ForeignOptions& options) : units_(options.units) {
  constexpr double equal = 1e-9;
  if (units_ && std::abs(units_->length / options.unit - 1.0) > equal)
    throw InputError(fmt::format("'unit' is {:g} m, but the length of 'units' {:g} m", options.unit, units_->length));
  file_ = options.file;
  std::vector<ForeignPart> parts = parts_of(model);
  for (ForeignPart& part : parts) {
    regions_[part.mesh] = std::move(part.regions);
    inner_surfaces_[part.mesh] = std::move(part.inner_surfaces);
    parts_.push_back(std::move(part));
  }
  materials_ = std::move(model.materials);
  elasticity_ = model.elasticity;
  density_ = model.density;
  report_ = text_of_report(model);
  say_parts(file_, parts_);
  for (const std::string& line : model.told) say("  " + line);
  if (!model.unused.empty())
    say(fmt::format("  {} keywords are not used: file:report() lists them", model.unused.size()));
}

const std::map<std::string, std::vector<int>>* ForeignMeshes::regions(const MeshPtr& mesh) const {
  const auto found = regions_.find(mesh);
  return found == regions_.end() ? nullptr : &found->second;
}

const std::map<std::string, std::vector<InnerFacet>>* ForeignMeshes::inner_surfaces(const MeshPtr& mesh) const {
  const auto found = inner_surfaces_.find(mesh);
  return found == inner_surfaces_.end() ? nullptr : &found->second;
}

FileMaterial ForeignMeshes::material(const std::string& name) const {
  const auto found =
      std::find_if(materials_.begin(), materials_.end(), [&](const ForeignMaterial& one) { return one.name == name; });
  if (found == materials_.end()) {
    std::vector<std::string> known;
    for (const ForeignMaterial& one : materials_) known.push_back(one.name);
    throw InputError(fmt::format("'{}' has no material '{}'\n    {}", file_, name, did_you_mean(name, known)));
  }
  if (!found->doubt.empty())
    throw InputError(fmt::format("{}: material '{}': {}\n    declare it as material.elastic or material.orthotropic",
                                 found->where, name, found->doubt));
  if (found->word.empty())
    throw InputError(fmt::format("{}: material '{}' has no {}", found->where, name, elasticity_));
  if (!units_)
    throw InputError(
        fmt::format("material '{}' of '{}' requires the units of the file, which it does not state\n    as in units = "
                    "\"mm t s\" beside 'file'",
                    name, file_));
  FileMaterial material{name, found->word, found->ratios, {}, density_};
  for (const auto& [key, value] : found->moduli) material.numbers[key] = value * units_->stress();
  if (found->density) material.density = *found->density * units_->density();
  material.mass_damping = found->mass_damping / units_->time;
  material.stiffness_damping = found->stiffness_damping * units_->time;
  return material;
}

}  // namespace dygita

#include "deck/model_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/names.hpp"
#include "deck/build_model.hpp"

namespace dygita {

namespace {

constexpr double bytes_per_byte_of_file = 8.0;  // text, nodes, cells, facets

// What lua/schema.lua asks of a material that a deck declares.
struct PlausibleRange {
  double low, high;
  const char* unit;
};

PlausibleRange plausible(const std::string& name) {
  if (name == "density") return {10, 1e5, "kg/m^3"};
  if (name == "young") return {1e6, 2e12, "Pa"};
  if (name == "poisson") return {-0.9, 0.4999, ""};
  if (name.starts_with("nu")) return {-50, 50, ""};
  return {1e3, 2e12, "Pa"};
}

void check_plausible(const FileMaterial& material) {
  for (const auto& [name, value] : material.numbers) {
    const PlausibleRange range = plausible(name);
    if (value >= range.low && value <= range.high) continue;
    throw InputError(
        fmt::format("material '{}': '{}' = {:g} {} is outside the plausible range [{:g}, {:g}] {}\n    are "
                    "the 'units' of the file correct?",
                    material.name, name, value, range.unit, range.low, range.high, range.unit));
  }
}

std::shared_ptr<const Material> made_of(FileMaterial given, const LuaArguments* a) {
  const bool has_density = a && a->has("density");
  if (!has_density && !given.density)
    throw InputError(
        fmt::format("material '{}' has no {}\n    file:material{{ name = \"{}\", density = 7850 }} "
                    "gives it one",
                    given.name, given.density_word, given.name));
  given.numbers["density"] = has_density ? a->number("density") : *given.density;
  check_plausible(given);
  const auto entry = std::find_if(material_table().begin(), material_table().end(),
                                  [&](const MaterialEntry& one) { return one.word == given.word; });
  CHECK(entry != material_table().end(), "files have materials of words that there are");
  auto material = std::make_shared<Material>(Material{entry->make(given.numbers), {}});
  material->name = given.name;
  material->damping = {given.mass_damping, given.stiffness_damping};
  if (!a) return material;
  if (const Damping own = damping_in(*a); own.mass != 0.0 || own.stiffness != 0.0) material->damping = own;
  if (a->has("yield")) {
    if (!material->is_isotropic())
      throw InputError(
          fmt::format("material '{}': 'yield' is of materials that are the same in all directions", given.name));
    material->yield = a->number("yield");
  }
  if (a->has("strength")) {
    if (material->is_isotropic())
      throw InputError(
          fmt::format("material '{}': 'strength' is of materials with axes, 'yield' of those that are the "
                      "same in all directions",
                      given.name));
    material->strength = strength_in(*a);
  }
  return material;
}

using Reader = std::shared_ptr<const ForeignMeshes> (*)(const ForeignOptions&);

Content build_model_file(const Declaration& d, const char* word, Reader read) {
  const LuaArguments& a = d.arguments;
  ForeignOptions options;
  options.file = a.file("file");
  if (a.has("units")) {
    options.units = file_units(a.text("units"));
    options.unit = options.units->length;
  }
  options.has_unit = a.has("unit");
  if (options.has_unit) options.unit = a.number("unit");
  if (a.has("skip")) options.skip = a.texts("skip");
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(options.file, ignored);
  const auto bytes = ignored ? size_t{0} : static_cast<size_t>(bytes_per_byte_of_file * static_cast<double>(size));
  d.lua.reserve(word, bytes);
  std::shared_ptr<const ForeignMeshes> file;
  {
    const LuaState::Pause pause(d.lua);
    file = read(options);
  }
  d.lua.hold_reserved(file, bytes);
  DeckState::of(d.lua).model_files.push_back(file);
  return file;
}

}  // namespace

Content build_abaqus(const Declaration& d) { return build_model_file(d, "mesh.abaqus", ForeignMeshes::of_abaqus); }
Content build_nastran(const Declaration& d) { return build_model_file(d, "mesh.nastran", ForeignMeshes::of_nastran); }
Content build_unv(const Declaration& d) { return build_model_file(d, "mesh.unv", ForeignMeshes::of_unv); }

Object file_material(DeckState& state, const Object& self, lua_State* L, const Origin& origin) {
  const auto& file = *self.as<std::shared_ptr<const ForeignMeshes>>();
  try {
    if (!lua_istable(L, 3)) {
      const std::string name = lua_tostring(L, 3);
      return {"material", "model file:material", name, self.id, made_of(file.material(name), nullptr)};
    }
    const LuaArguments a(L, 3, "file:material", origin, state.folder);
    const std::string name = a.text("name");
    return {"material", "model file:material", name, self.id, made_of(file.material(name), &a)};
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
}

const std::map<std::string, std::vector<int>>* regions_of(const DeckState& state, const MeshPtr& mesh) {
  if (const auto half = state.regions_of_halves.find(mesh); half != state.regions_of_halves.end()) return &half->second;
  for (const auto& file : state.model_files)
    if (const auto* regions = file->regions(mesh)) return regions;
  return nullptr;
}

Region named_region(const DeckState& state, lua_State* L, const Origin& origin) {
  const SubstructurePtr& part = the_object_at(L, 2).as<SubstructurePtr>();
  const std::string name = lua_tostring(L, 3);
  lua_getiuservalue(L, 2, 1);
  lua_getfield(L, -1, "mesh");
  const Object* mesh = object_at(L, -1);
  const std::map<std::string, std::vector<int>>* regions = mesh ? regions_of(state, mesh->as<MeshPtr>()) : nullptr;
  if (!regions)
    throw InputError(origin,
                     fmt::format("substructure '{}' has no named regions: its mesh is of no file that has sets\n"
                                 "    part:where(function(x, y, z) return boolean end) picks nodes",
                                 part->name));
  const auto found = regions->find(name);
  if (found != regions->end()) return {part, found->second};
  std::vector<std::string> known;
  for (const auto& [one, nodes] : *regions) known.push_back(one);
  throw InputError(origin, fmt::format("substructure '{}' has no node of a set '{}'\n    {}", part->name, name,
                                       did_you_mean(name, known)));
}

}  // namespace dygita

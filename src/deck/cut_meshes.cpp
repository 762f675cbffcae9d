#include "deck/cut_meshes.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <optional>

#include "base/log.hpp"
#include "base/names.hpp"
#include "deck/arguments.hpp"
#include "deck/model_files.hpp"
#include "deck/object.hpp"
#include "mesh/cut_mesh.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

const std::vector<InnerFacet>& surface_in(const DeckState& state, const MeshPtr& mesh, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& file : state.model_files)
    if (const auto* surfaces = file->inner_surfaces(mesh)) {
      if (const auto found = surfaces->find(name); found != surfaces->end()) return found->second;
      for (const auto& [one, facets] : *surfaces) known.push_back(one);
    }
  throw InputError(fmt::format(
      "the mesh has no surface '{}' inside it\n    {}", name,
      known.empty() ? "mesh:cut{ normal = { 0, 0, 1 }, at = 18*mm } cuts by a plane" : did_you_mean(name, known)));
}

// Sets of nodes of the whole, as far as each half has them.
void share_regions(DeckState& state, const MeshPtr& whole, const MeshCut& cut) {
  const auto* regions = regions_of(state, whole);
  if (!regions) return;
  for (const MeshHalf& half : cut.halves) state.regions_of_halves.emplace(half.mesh, regions_of_half(*regions, half));
}

double area_of(const Mesh& mesh, const std::string& face) {
  double area = 0.0;
  for (const Facet& facet : mesh.faces.at(face)) area += facet_area_vector(mesh.nodes, facet).norm();
  return area;
}

void tell(const MeshCut& cut, const std::string& face, double asked) {
  const Mesh& first = *cut.halves[0].mesh;
  std::string text =
      fmt::format("mesh:cut: {} and {} cells, {} facets and {:.4g} mm^2 between them", first.n_cells(),
                  cut.halves[1].mesh->n_cells(), first.faces.at(face).size(), 1e6 * area_of(first, face));
  if (cut.n_divided > 0) text += fmt::format("; {} cells are divided", cut.n_divided);
  constexpr double same = 1e-9;  // m
  if (std::abs(cut.at - asked) > same)
    text += fmt::format("; cut at {:.6g} mm along the normal, where cells have facets, {:.3g} mm from the plane",
                        1e3 * cut.at, 1e3 * std::abs(cut.at - asked));
  say(text);
}

}  // namespace

int push_halves(DeckState& state, lua_State* L, const Origin& origin) {
  const Object& self = the_object_at(L, 2);
  const MeshPtr mesh = self.as<MeshPtr>();
  constexpr double bytes_per_cell = 800.0;  // of both halves, and what they are made of
  const auto bytes = static_cast<size_t>(bytes_per_cell * mesh->n_cells());
  state.reserve("mesh:cut", bytes);
  MeshCut cut;
  std::string face = "cut";
  std::optional<double> asked;
  try {
    if (lua_istable(L, 3)) {
      const LuaArguments a(L, 3, "mesh:cut", origin, state.folder);
      face = a.text("face");
      if (a.has("surface") && a.has("normal"))
        throw InputError("'surface' and 'normal' are mutually exclusive: give one of them");
      cut = a.has("surface") ? cut_along(*mesh, surface_in(state, mesh, a.text("surface")), face)
                             : cut_by_plane(*mesh, a.unit_vector("normal"), a.number("at"), face);
      if (a.has("at")) asked = a.number("at");
    } else {
      cut = cut_along(*mesh, surface_in(state, mesh, lua_tostring(L, 3)), face);
    }
    tell(cut, face, asked.value_or(cut.at));
  } catch (const InputError& error) {
    throw InputError(origin, fmt::format("mesh:cut: {}", error.what()));
  }
  share_regions(state, mesh, cut);
  lua_createtable(L, 2, 0);
  for (size_t i = 0; i < cut.halves.size(); ++i) {
    state.hold_reserved(cut.halves[i].mesh, bytes / 2);
    push_object(L, {"mesh", "mesh:cut", self.name, self.id, cut.halves[i].mesh});
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

}  // namespace dygita

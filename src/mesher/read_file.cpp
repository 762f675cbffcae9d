// Every volume of one file, its cells read or generated.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "base/error.hpp"
#include "intake/mesh_file.hpp"
#include "mesher/estimate.hpp"
#include "mesher/gmsh_session.hpp"
#include "mesher/read.hpp"

namespace dygita {

namespace {

// Makes bodies that touch share their surfaces, so that their meshes match there. Surfaces are numbered anew.
void join_touching_bodies() {
  GmshEntities volumes, pieces;
  gmsh::model::getEntities(volumes, 3);
  if (volumes.size() < 2) return;
  std::vector<GmshEntities> origins;
  gmsh::model::occ::fragment({volumes.front()}, GmshEntities(volumes.begin() + 1, volumes.end()), pieces, origins);
  gmsh::model::occ::synchronize();
  for (size_t i = 0; i < volumes.size(); ++i) {
    const auto n_pieces =
        std::count_if(origins[i].begin(), origins[i].end(), [](const auto& e) { return e.first == 3; });
    if (n_pieces != 1) throw InputError(fmt::format("body {} intersects another one: they overlap", i + 1));
  }
}

void load(const GmshOptions& options, const std::string& path, const GmshSession& session) {
  const std::string kind = kind_of_file(options.file);
  // gmsh converts a STEP file to metres by the unit it states.
  const double unit = kind == "step" ? 1.0 : options.unit;
  session.run([&] {
    // Without a least size gmsh would not go above a tenth of the model's diagonal.
    for (const char* option : {"Mesh.MeshSizeMin", "Mesh.MeshSizeMax"})
      if (options.size) gmsh::option::setNumber(option, *options.size / unit);
    gmsh::open(path);
  });
  if (kind == "msh") return;
  session.run([&] {
    if (kind == "step" || kind == "brep") join_touching_bodies();
    if (options.size)
      refuse_hopeless(
          options.file, [&](int) { return *options.size / unit; }, unit);
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", options.is_complete ? 0 : 1);
    tell("lines, faces and bodies");
    gmsh::model::mesh::generate(3);
    if (options.order > 1) gmsh::model::mesh::setOrder(options.order);
  });
}

TaggedVolume read_volume(const std::string& name, const std::vector<int>& entities, const std::string& file) {
  TaggedVolume volume{name, {}};
  for (const int entity : entities) read_gmsh_cells(entity, file, name, volume.cells);
  return volume;
}

TaggedSurface read_surface(const std::string& name, const std::vector<int>& entities) {
  TaggedSurface surface{name, {}};
  for (const int entity : entities) read_gmsh_facets(entity, surface.facets);
  return surface;
}

// The entities of each physical group. gmsh goes through all entities for each group that it is asked for.
std::map<int, std::vector<int>> entities_of_groups(int dimension) {
  std::map<int, std::vector<int>> result;
  for (const int entity : gmsh_tags(dimension)) {
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
    for (const int group : groups) result[std::abs(group)].push_back(entity);
  }
  return result;
}

// Physical groups of a dimension: name and entities; without any, each entity is a group, "volume3" or "surface7".
std::vector<std::pair<std::string, std::vector<int>>> groups(int dimension) {
  const char* word = dimension == 3 ? "volume" : "surface";
  std::vector<std::pair<std::string, std::vector<int>>> result;
  GmshEntities physical;
  gmsh::model::getPhysicalGroups(physical, dimension);
  std::map<int, std::vector<int>> entities = entities_of_groups(dimension);
  for (const auto& group : physical) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, group.second, name);
    result.emplace_back(name.empty() ? word + std::to_string(group.second) : name, entities[group.second]);
  }
  if (physical.empty())
    for (const int tag : gmsh_tags(dimension)) result.push_back({word + std::to_string(tag), {tag}});
  return result;
}

// gmsh's interface answers cells of one order in a volume of its own, and is silent on the others.
void refuse_lost_cells(const std::string& file) {
  double all = 0.0;
  for (const char* kind : {"Mesh.NbTetrahedra", "Mesh.NbHexahedra", "Mesh.NbPrisms", "Mesh.NbPyramids"}) {
    double n = 0.0;
    gmsh::option::getNumber(kind, n);
    all += n;
  }
  std::vector<int> types;
  std::vector<std::vector<size_t>> cells, nodes;
  gmsh::model::mesh::getElements(types, cells, nodes, 3);
  size_t n_read = 0;
  for (const std::vector<size_t>& of_type : cells) n_read += of_type.size();
  if (static_cast<double>(n_read) < all)
    throw InputError(fmt::format(
        "{}: gmsh passes on {} of its {:.0f} cells: those of a different order in the same volume are lost\n    "
        "all cells of a volume must have the same order; put the others into their own volume (elementary entity)",
        file, n_read, all));
}

TaggedModel read_model(const GmshOptions& options) {
  refuse_lost_cells(options.file);
  TaggedModel model;
  model.file = options.file;
  for (const auto& [name, entities] : groups(3)) {
    model.volumes.push_back(read_volume(name, entities, options.file));
    if (model.volumes.back().cells.empty()) model.volumes.pop_back();
  }
  if (model.volumes.empty())
    throw InputError(
        fmt::format("{}: no volume with cells; a Physical Volume groups cells of dimension 3", options.file));
  for (const auto& [name, entities] : groups(2)) model.surfaces.push_back(read_surface(name, entities));

  const double unit = kind_of_file(options.file) == "step" ? 1.0 : options.unit;
  read_gmsh_nodes(unit, model.nodes);
  return model;
}

}  // namespace

MesherAnswer read_file(const GmshOptions& options, const std::string& path) {
  const GmshSession session(options.file);
  load(options, path, session);
  MesherAnswer answer;
  session.run([&] { answer.model = read_model(options); });
  return answer;
}

}  // namespace dygita

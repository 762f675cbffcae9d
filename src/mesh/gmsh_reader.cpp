#include "mesh/gmsh_reader.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "mesh/gmsh_session.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/straighten.hpp"

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
    if (n_pieces != 1) throw InputError(fmt::format("body {} is cut by another one: they overlap", i + 1));
  }
}

void load(const GmshOptions& options, const GmshSession& session) {
  const std::string kind = kind_of_file(options.file);
  // gmsh converts a STEP file to metres by the unit it states.
  const double unit = kind == "step" ? 1.0 : options.unit;
  session.run([&] {
    // Without a least size gmsh would not go above a tenth of the model's diagonal.
    for (const char* option : {"Mesh.MeshSizeMin", "Mesh.MeshSizeMax"})
      if (options.size) gmsh::option::setNumber(option, *options.size / unit);
    if (options.set.empty()) {
      gmsh::open(options.file);
    } else {
      const ParameterFile parameters(options.file, options.set);
      gmsh::open(parameters.path());
    }
  });
  if (kind == "msh") return;
  session.run([&] {
    if (kind == "step" || kind == "brep") join_touching_bodies();
    gmsh::option::setNumber("Mesh.SecondOrderIncomplete", options.is_complete ? 0 : 1);
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

// Physical groups of a dimension: name and entities; without any, each entity is a group, "volume3" or "surface7".
std::vector<std::pair<std::string, std::vector<int>>> groups(int dimension) {
  const char* word = dimension == 3 ? "volume" : "surface";
  std::vector<std::pair<std::string, std::vector<int>>> result;
  GmshEntities physical;
  gmsh::model::getPhysicalGroups(physical, dimension);
  for (const auto& group : physical) {
    std::string name;
    std::vector<int> entities;
    gmsh::model::getPhysicalName(dimension, group.second, name);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
    result.emplace_back(name.empty() ? word + std::to_string(group.second) : name, entities);
  }
  if (physical.empty())
    for (const int tag : gmsh_tags(dimension)) result.push_back({word + std::to_string(tag), {tag}});
  return result;
}

TaggedModel read_model(const GmshOptions& options) {
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

TaggedModel load_model(const GmshOptions& options) {
  const GmshSession session(options.file);
  load(options, session);
  TaggedModel model;
  session.run([&] { model = read_model(options); });
  return model;
}

// Lengths in millimetres taken for metres, or the reverse, show in the size of a part.
void warn_of_implausible_size(const Mesh& mesh, const std::string& volume) {
  const double length = (mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff()).norm();
  if (length > 100 || length < 1e-5)
    warn(fmt::format(
        "{}: volume '{}' is {:.3g} m across; is 'unit' right? mesh files are in metres unless it says otherwise",
        mesh.source, volume, length));
}

}  // namespace

GmshMeshes::GmshMeshes(const GmshOptions& options) : file_(options.file) {
  check_options(options);
  TaggedModel model = load_model(options);
  for (const Straightened& one : straighten(model)) warn(text_of(one, file_));
  Fnv1a digest;
  for (const TaggedVolume& volume : model.volumes) {
    const MeshPtr mesh = build_mesh(model, volume);
    warn_of_implausible_size(*mesh, volume.name);
    volumes_[volume.name] = mesh;
    digest.add(volume.name);
    digest.add(mesh->digest);
  }
  digest_ = digest.hexadecimal();
}

MeshPtr GmshMeshes::volume(const std::string& name) const {
  const auto found = volumes_.find(name);
  if (found != volumes_.end()) return found->second;
  throw InputError(
      fmt::format("mesh file '{}' has no volume '{}'\n    {}", file_, name, did_you_mean(name, volume_names())));
}

std::vector<std::string> GmshMeshes::volume_names() const {
  std::vector<std::string> names;
  for (const auto& [name, mesh] : volumes_) names.push_back(name);
  return names;
}

}  // namespace dygita

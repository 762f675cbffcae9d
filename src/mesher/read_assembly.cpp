// Every solid of a STEP or BREP file meshed by itself, with its names.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "base/log.hpp"
#include "mesh/mesh_file.hpp"
#include "mesher/estimate.hpp"
#include "mesher/gmsh_session.hpp"
#include "mesher/read.hpp"
#include "mesher/step_solids.hpp"
#include "mesher/sweep.hpp"

namespace dygita {

namespace {

// Hexahedra where solids are a face moved along its normal.
void sweep_solids(const StepOptions& options, std::vector<Solid>& solids) {
  if (options.sweep == StepOptions::Sweep::none) return;
  for (Solid& solid : solids) {
    if (solid.copy) continue;
    if (auto swept = sweep_solid(solid.tag, solid.surfaces, solid.size)) {
      solid.tag = swept->tag;
      solid.surfaces = swept->surfaces;
    } else if (options.sweep == StepOptions::Sweep::all) {
      throw InputError(
          fmt::format("{}: part '{}' cannot have hexahedra: it is no flat face moved along its normal, as a plate or a "
                      "washer is\n    cells = \"hexahedra where possible\" gives it tetrahedra",
                      options.file, solid.part.name));
    }
  }
  gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 3);  // quadrilaterals alone
}

// Small at the edges of contacts, growing with the distance from them.
void grade(const std::vector<int>& curves, const StepOptions::Fine& fine, double unit) {
  const int distance = gmsh::model::mesh::field::add("Distance"), size = gmsh::model::mesh::field::add("MathEval");
  gmsh::model::mesh::field::setNumbers(distance, "EdgesList", {curves.begin(), curves.end()});
  gmsh::model::mesh::field::setNumber(distance, "NNodesByEdge", 200);
  gmsh::model::mesh::field::setString(size, "F",
                                      fmt::format("{:.9g} + {:.9g}*F{}", fine.size / unit, fine.growth, distance));
  gmsh::model::mesh::field::setAsBackgroundMesh(size);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);  // inside, the field says it
}

// gmsh meshes these alone.
void show_meshed(const std::vector<Solid>& solids) {
  GmshEntities all;
  gmsh::model::getEntities(all);
  gmsh::model::setVisibility(all, 0);
  for (const Solid& solid : solids)
    if (!solid.copy) gmsh::model::setVisibility({{3, solid.tag}}, 1, true);
  gmsh::option::setNumber("Mesh.MeshOnlyVisible", 1);
}

void mesh_solids(const StepOptions& options, const std::vector<Solid>& solids, double unit) {
  std::map<std::pair<int, int>, double> size_of;  // of entities, by dimension and tag
  for (const Solid& solid : solids) {
    GmshEntities all = {{3, solid.tag}}, boundary;
    gmsh::model::getBoundary(all, boundary, false, false, true);  // down to the points
    all.insert(all.end(), boundary.begin(), boundary.end());
    gmsh::model::getBoundary({{3, solid.tag}}, boundary, false, false);
    for (const auto& [dimension, tag] : boundary) {
      all.emplace_back(dimension, tag);
      GmshEntities curves;
      gmsh::model::getBoundary({{dimension, tag}}, curves, false, false);
      all.insert(all.end(), curves.begin(), curves.end());
    }
    for (const auto& entity : all) size_of[entity] = solid.size;
  }
  const auto on_contacts = options.sizes.find("contacts");
  if (is_finer_at_contacts(options)) {
    const StepContacts contacts = contacts_of(solids);
    if (contacts.surfaces.empty())
      warn(fmt::format("{}: no faces of its parts touch: {} makes nothing finer", options.file,
                       options.fine ? "'fine'" : "'sizes.contacts'"));
    if (options.fine && !contacts.curves.empty()) grade(contacts.curves, *options.fine, unit);
    if (on_contacts != options.sizes.end()) {
      for (const int tag : contacts.surfaces) size_of[{2, tag}] = on_contacts->second / unit;
      for (const int tag : contacts.curves) size_of[{1, tag}] = on_contacts->second / unit;
    }
  }
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", options.cells_a_turn);
  gmsh::model::mesh::setSizeCallback([&](int dimension, int tag, double, double, double) {
    const auto found = size_of.find({dimension, tag});
    return found == size_of.end() ? 1e22 : found->second;
  });
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", options.is_complete ? 0 : 1);
  show_meshed(solids);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::removeSizeCallback();
  if (options.order > 1) gmsh::model::mesh::setOrder(options.order);
}

TaggedModel tagged(const StepOptions& options, const std::vector<Solid>& solids, double unit) {
  TaggedModel model;
  model.file = options.file;
  for (const Solid& solid : solids) {
    TaggedVolume& volume = model.volumes.emplace_back(TaggedVolume{solid.part.name, {}});
    if (!solid.copy) read_gmsh_cells(solid.tag, options.file, volume.name, volume.cells);
  }
  read_gmsh_nodes(unit, model.nodes);
  return model;
}

// Surfaces of a solid, called after it: "bolt1.head".
std::vector<TaggedSurface> surfaces_of(const Solid& solid) {
  std::vector<TaggedSurface> surfaces;
  for (size_t i = 0; i < solid.surfaces.size(); ++i) {
    std::string name = solid.surface_names[i];
    name = name.substr(name.find_last_of('/') + 1);
    if (name.empty()) name = fmt::format("surface{}", i + 1);
    const std::string full = solid.part.name + "." + name;
    auto known = std::find_if(surfaces.begin(), surfaces.end(), [&](const auto& s) { return s.name == full; });
    if (known == surfaces.end()) known = surfaces.insert(surfaces.end(), TaggedSurface{full, {}});
    if (!solid.copy) read_gmsh_facets(solid.surfaces[i], known->facets);
  }
  return surfaces;
}

// How often a STEP file names an entity.
size_t count_in_file(const std::string& file, const std::string& entity) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  size_t n = 0;
  for (size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1)) ++n;
  return n;
}

// A spoiled file loses solids without a word of OpenCASCADE's.
void doubt_losses(const std::string& file, size_t n_solids) {
  if (kind_of_file(file) != "step") return;
  const size_t n = count_in_file(file, "MANIFOLD_SOLID_BREP(") + count_in_file(file, "BREP_WITH_VOIDS(");
  if (n > n_solids)
    warn(fmt::format("{}: it holds {} solids, and {} could be read: is it whole? export it once more", file, n,
                     n_solids));
}

void open(const StepOptions& options) {
  std::string build;
  gmsh::option::getString("General.BuildOptions", build);
  if (build.find("OpenCASCADE-CAF") == std::string::npos)
    throw InputError(
        fmt::format("{}: this gmsh reads no names of parts (built without OpenCASCADE-CAF)", options.file));
  gmsh::option::setNumber("Geometry.OCCImportLabels", 1);
  // OpenCASCADE's tolerances are made for millimetres.
  gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
  gmsh::open(options.file);
}

}  // namespace

MesherAnswer read_assembly(const StepOptions& options) {
  const double unit = kind_of_file(options.file) == "step" ? 1e-3 : options.unit;
  const GmshSession session(options.file);
  session.run([&] { open(options); });
  session.run([&] { doubt_losses(options.file, gmsh_tags(3).size()); });
  MesherAnswer answer;
  session.run([&] {
    std::vector<Solid> solids = read_solids(options, unit);
    sweep_solids(options, solids);
    const auto size_of = [&](int volume) {
      const auto solid = std::find_if(solids.begin(), solids.end(), [&](const Solid& s) { return s.tag == volume; });
      return solid == solids.end() || solid->copy ? 0.0 : solid->size;
    };
    refuse_hopeless(options.file, size_of, unit);
    mesh_solids(options, solids, unit);
    answer.model = tagged(options, solids, unit);
    for (const Solid& solid : solids) {
      answer.solids.push_back(solid.part);
      answer.copies.push_back(solid.copy);
      answer.surfaces.push_back(surfaces_of(solid));
    }
  });
  return answer;
}

}  // namespace dygita

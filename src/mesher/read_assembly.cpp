// Every solid of a STEP or BREP file meshed by itself, with its names.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include "base/error.hpp"
#include "base/log.hpp"
#include "intake/mesh_file.hpp"
#include "mesh/jacobian.hpp"
#include "mesher/estimate.hpp"
#include "mesher/gmsh_session.hpp"
#include "mesher/read.hpp"
#include "mesher/step_solids.hpp"
#include "mesher/sweep.hpp"

namespace dygita {

namespace {

// Why parts keep their tetrahedra, by name.
using Unswept = std::map<std::string, std::string>;

// A solid made anew, so that it has hexahedra.
struct Swept {
  size_t solid;
  double volume;  // of the model's unit, of the CAD
};

// Hexahedra where solids are a face moved along its normal.
std::vector<Swept> sweep_solids(const StepOptions& options, const Unswept& unswept, std::vector<Solid>& solids) {
  std::vector<Swept> all;
  if (options.sweep == StepOptions::Sweep::none) return all;
  for (size_t i = 0; i < solids.size(); ++i) {
    Solid& solid = solids[i];
    if (solid.copy || unswept.contains(solid.part.name)) continue;
    double cad = 0.0;
    gmsh::model::occ::getMass(3, solid.tag, cad);
    if (auto swept = sweep_solid(solid.tag, solid.surfaces, solid.size)) {
      solid.tag = swept->tag;
      solid.surfaces = swept->surfaces;
      all.push_back({i, cad});
    } else if (options.sweep == StepOptions::Sweep::all) {
      throw InputError(
          fmt::format("{}: part '{}' cannot have hexahedra: it is not an extruded flat face, such as a plate or a "
                      "washer\n    cells = \"hexahedra where possible\" gives it tetrahedra",
                      options.file, solid.part.name));
    }
  }
  if (all.empty()) return all;
  gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 3);  // quadrilaterals alone
  std::vector<int> tags;
  for (const Swept& one : all) tags.push_back(solids[one.solid].tag);
  leave_others_unswept(tags);
  return all;
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

// What gmsh works on, by the entity that it asks a size for.
class Told {
 public:
  void add(const std::pair<int, int>& entity, int solid) { solid_of_[entity] = solid; }
  void tell_of(const std::vector<Solid>& solids, const std::pair<int, int>& entity) {
    const auto solid = solid_of_.find(entity);
    if (solid == solid_of_.end() || entity == last_) return;
    last_ = entity;
    constexpr const char* what[] = {"points", "lines", "faces", "inside"};
    tell(fmt::format("{} of '{}', solid {} of {}", what[std::clamp(entity.first, 0, 3)],
                     solids[static_cast<size_t>(solid->second)].part.name, solid->second + 1, solids.size()));
  }

 private:
  std::map<std::pair<int, int>, int> solid_of_;
  std::pair<int, int> last_;
};

// Sizes of entities, by dimension and tag, as gmsh asks for them. Of `solids`, which outlive the mesh.
void set_sizes(const StepOptions& options, const std::vector<Solid>& solids, double unit) {
  std::map<std::pair<int, int>, double> size_of;
  Told told;
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
    for (const auto& entity : all) {
      size_of[entity] = solid.size;
      told.add(entity, static_cast<int>(&solid - solids.data()));
    }
  }
  const auto on_contacts = options.sizes.find("contacts");
  if (is_finer_at_contacts(options)) {
    const StepContacts contacts = contacts_of(solids);
    if (contacts.surfaces.empty())
      warn(fmt::format("{}: no faces of its parts touch: {} refines nothing", options.file,
                       options.fine ? "'fine'" : "'sizes.contacts'"));
    if (options.fine && !contacts.curves.empty()) grade(contacts.curves, *options.fine, unit);
    if (on_contacts != options.sizes.end()) {
      for (const int tag : contacts.surfaces) size_of[{2, tag}] = on_contacts->second / unit;
      for (const int tag : contacts.curves) size_of[{1, tag}] = on_contacts->second / unit;
    }
  }
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", options.cells_a_turn);
  gmsh::model::mesh::setSizeCallback([size_of = std::move(size_of), told = std::move(told), &solids](
                                         int dimension, int tag, double, double, double) mutable {
    told.tell_of(solids, {dimension, tag});
    const auto found = size_of.find({dimension, tag});
    return found == size_of.end() ? 1e22 : found->second;
  });
}

void mesh_solids(const StepOptions& options, const std::vector<Solid>& solids, double unit) {
  set_sizes(options, solids, unit);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", options.is_complete ? 0 : 1);
  show_meshed(solids);
  gmsh::model::mesh::generate(3);
  if (options.order > 1) {
    tell("nodes of order two");
    gmsh::model::mesh::setOrder(options.order);
  }
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

// A spoiled file loses solids, and OpenCASCADE does not say so.
void doubt_losses(const std::string& file, size_t n_solids) {
  if (kind_of_file(file) != "step") return;
  const size_t n = count_in_file(file, "MANIFOLD_SOLID_BREP(") + count_in_file(file, "BREP_WITH_VOIDS(");
  if (n > n_solids)
    warn(fmt::format("{}: it holds {} solids, and {} could be read: is the file complete? export it again", file, n,
                     n_solids));
}

void open(const StepOptions& options) {
  std::string build;
  gmsh::option::getString("General.BuildOptions", build);
  if (build.find("OpenCASCADE-CAF") == std::string::npos)
    throw InputError(
        fmt::format("{}: this gmsh cannot read the names of parts (built without OpenCASCADE-CAF)", options.file));
  gmsh::option::setNumber("Geometry.OCCImportLabels", 1);
  // OpenCASCADE's tolerances are made for millimetres.
  gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
  tell("reading");
  gmsh::open(options.file);
}

// Of the cells that are read of a solid, in the model's unit.
double volume_of(const TaggedModel& model, const TaggedVolume& volume, double unit) {
  double sum = 0.0;
  for (const auto& [type, tags] : volume.cells) {
    const auto n = static_cast<size_t>(nodes_per_cell(type));
    Points x(3, static_cast<Eigen::Index>(n));
    for (size_t first = 0; first < tags.size(); first += n) {
      for (size_t a = 0; a < n; ++a) x.col(static_cast<Eigen::Index>(a)) = model.nodes.at(tags[first + a]);
      sum += std::abs(cell_volume(type, x));
    }
  }
  return sum / (unit * unit * unit);
}

// Parts whose hexahedra do not fill them: quadrilaterals of a narrow ring may lie across its hole.
Unswept badly_filled(const StepOptions& options, const MesherAnswer& answer, const std::vector<Solid>& solids,
                     const std::vector<Swept>& swept, double unit) {
  constexpr double exact = 0.02;  // of the volume
  const double turn = 2.0 * std::acos(-1.0) / options.cells_a_turn, chords = 1.0 - std::sin(turn) / turn,
               within = exact + (options.order > 1 ? 0.0 : 2.0 * chords);
  Unswept bad;
  for (const auto& [solid, volume] : swept) {
    const double share = volume_of(answer.model, answer.model.volumes[solid], unit) / volume;
    if (std::abs(share - 1.0) > within)
      bad[solids[solid].part.name] = fmt::format("they fill {:.3g} times the volume of the solid", share);
  }
  return bad;
}

// Parts whose hexahedra gmsh does not manage, each tried by itself.
Unswept not_meshed(const GmshSession& session, const std::vector<Solid>& solids, const std::vector<Swept>& swept) {
  Unswept bad;
  for (const Swept& one : swept) try {
      session.run([&] {
        gmsh::model::mesh::clear();
        show_meshed({solids[one.solid]});
        gmsh::model::mesh::generate(3);
        std::map<CellType, std::vector<size_t>> cells;
        read_gmsh_cells(solids[one.solid].tag, "", solids[one.solid].part.name, cells);
      });
    } catch (const InputError& error) {
      const std::string text = error.what();
      bad[solids[one.solid].part.name] = "gmsh fails: " + text.substr(0, text.find('\n'));
    }
  return bad;
}

// Reads and meshes the file once. Answers the parts that cannot have hexahedra although they are swept; then the answer
// is none.
Unswept read_once(const StepOptions& options, const Unswept& unswept, MesherAnswer& answer) {
  const double unit = kind_of_file(options.file) == "step" ? 1e-3 : options.unit;
  const GmshSession session(options.file);
  session.run([&] { open(options); });
  session.run([&] { doubt_losses(options.file, gmsh_tags(3).size()); });
  std::vector<Solid> solids;
  std::vector<Swept> swept;
  session.run([&] {
    solids = read_solids(options, unit);
    swept = sweep_solids(options, unswept, solids);
    const auto size_of = [&](int volume) {
      const auto solid = std::find_if(solids.begin(), solids.end(), [&](const Solid& s) { return s.tag == volume; });
      return solid == solids.end() || solid->copy ? 0.0 : solid->size;
    };
    refuse_hopeless(options.file, size_of, unit);
  });
  try {
    session.run([&] {
      mesh_solids(options, solids, unit);
      answer.model = tagged(options, solids, unit);
    });
  } catch (const InputError&) {
    const Unswept bad = not_meshed(session, solids, swept);
    if (bad.empty()) throw;
    return bad;
  }
  session.run([&] {
    for (const Solid& solid : solids) {
      answer.solids.push_back(solid.part);
      answer.copies.push_back(solid.copy);
      answer.surfaces.push_back(surfaces_of(solid));
    }
  });
  return badly_filled(options, answer, solids, swept, unit);
}

}  // namespace

MesherAnswer read_assembly(const StepOptions& options) {
  Unswept unswept;
  while (true) {
    MesherAnswer answer;
    const Unswept bad = read_once(options, unswept, answer);
    if (bad.empty()) return answer;
    for (const auto& [part, why] : bad) {
      if (options.sweep == StepOptions::Sweep::all)
        throw InputError(
            fmt::format("{}: part '{}' cannot have hexahedra of this size: {}\n    a smaller size, more cells around "
                        "('round'), or cells = \"hexahedra where possible\", which gives it tetrahedra",
                        options.file, part, why));
      warn(
          fmt::format("{}: part '{}' has tetrahedra, since hexahedra of its size are invalid: {}; a smaller size, or "
                      "more cells around ('round')",
                      options.file, part, why));
    }
    unswept.insert(bad.begin(), bad.end());
  }
}

}  // namespace dygita

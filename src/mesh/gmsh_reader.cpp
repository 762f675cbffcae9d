#include "mesh/gmsh_reader.hpp"

#include <gmsh.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/tagged_model.hpp"

namespace dygita {

namespace {

using Entities = gmsh::vectorpair;  // (dimension, tag)

// gmsh from initialize to finalize. Its state is process-wide: one session at a time; initialize resets its options.
class Session {
 public:
  explicit Session(std::string file) : lock_(mutex()), file_(std::move(file)) {
    gmsh::initialize(0, nullptr, false);
    const std::pair<const char*, double> numbers[] = {
        {"General.Terminal", 0},
        {"General.ExpertMode", 1},
        {"General.NumThreads", 1},
        {"General.Verbosity", 5},
        // An exception thrown while gmsh parses leaves its parser unusable for the next file: errors are read from
        // the log instead.
        {"General.AbortOnError", 0},
        {"Mesh.ElementOrder", 1},
        {"Mesh.Algorithm", 6},
        {"Mesh.Algorithm3D", 1},
        {"Mesh.Optimize", 1},
        {"Mesh.RandomSeed", 1},
    };
    for (const auto& [name, value] : numbers) gmsh::option::setNumber(name, value);
    gmsh::option::setString("Geometry.OCCTargetUnit", "M");
    gmsh::logger::start();
  }
  ~Session() {
    gmsh::logger::stop();
    gmsh::clear();
    gmsh::onelab::clear();
    gmsh::finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Does `work` and turns what gmsh throws or logs as an error into an InputError, its warnings into ours.
  void run(const std::function<void()>& work) const {
    std::vector<std::string> errors;
    try {
      work();
    } catch (const InputError&) {
      throw;
    } catch (const std::exception& error) {
      errors.push_back(error.what());
    } catch (const std::string& error) {
      errors.push_back(error);
    }
    std::vector<std::string> lines;
    gmsh::logger::get(lines);
    for (const std::string& line : lines) {
      if (line.starts_with("Error: ")) errors.push_back(line.substr(7));
      if (line.starts_with("Warning: ")) warn(fmt::format("{}: gmsh: {}", file_, line.substr(9)));
    }
    if (errors.empty()) return;
    constexpr size_t most = 5;
    std::string text = fmt::format("{}: gmsh cannot read or mesh it", file_);
    for (size_t i = 0; i < std::min(errors.size(), most); ++i) text += "\n    " + errors[i];
    if (errors.size() > most) text += fmt::format("\n    and {} more", errors.size() - most);
    throw InputError(text);
  }

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }

  std::lock_guard<std::mutex> lock_;
  std::string file_;
};

std::vector<int> tags_of_dimension(int dimension) {
  Entities entities;
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> tags;
  for (const auto& entity : entities) tags.push_back(entity.second);
  return tags;
}

// Makes bodies that touch share their surfaces, so that their meshes match there. Surfaces are numbered anew.
void join_touching_bodies() {
  Entities volumes, pieces;
  gmsh::model::getEntities(volumes, 3);
  if (volumes.size() < 2) return;
  std::vector<Entities> origins;
  gmsh::model::occ::fragment({volumes.front()}, Entities(volumes.begin() + 1, volumes.end()), pieces, origins);
  gmsh::model::occ::synchronize();
  for (size_t i = 0; i < volumes.size(); ++i) {
    const auto n_pieces =
        std::count_if(origins[i].begin(), origins[i].end(), [](const auto& e) { return e.first == 3; });
    if (n_pieces != 1) throw InputError(fmt::format("body {} is cut by another one: they overlap", i + 1));
  }
}

void load(const GmshOptions& options, const Session& session) {
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
    gmsh::model::mesh::generate(3);
  });
}

// What gmsh says of a type of elements.
struct GmshType {
  std::string name;
  int dimension, order, n_nodes, n_primary;
  std::vector<double> coordinates;  // of the nodes, one after the other, `dimension` each

  explicit GmshType(int number) {
    gmsh::model::mesh::getElementProperties(number, name, dimension, order, n_nodes, coordinates, n_primary);
  }
};

// Our cells of gmsh's type, or an InputError that names it.
const CellShape& cell_of(int gmsh_type, const std::string& file, const std::string& volume) {
  std::string known;
  for (const CellShape& cell : cell_shapes) {
    if (cell.gmsh_type == gmsh_type) return cell;
    known += fmt::format("{}, ", cell.name);
  }
  const GmshType type(gmsh_type);
  throw InputError(
      fmt::format("{}: volume '{}' has cells of gmsh's type '{}' (order {}, {} nodes)\n    known: {}all of first order",
                  file, volume, type.name, type.order, type.n_nodes, known));
}

// Gmsh's number of each of our nodes of a cell: the one at the same place of the reference cell.
std::vector<int> gmsh_numbers(const CellShape& cell) {
  const GmshType type(cell.gmsh_type);
  std::vector<int> numbers;
  for (const Place& at : cell.shape.nodes)
    for (int a = 0; a < type.n_nodes; ++a)
      if ((Vec3(at[0], at[1], at[2]) - Eigen::Map<const Vec3>(&type.coordinates[3 * a])).norm() < 1e-9)
        numbers.push_back(a);
  CHECK(numbers.size() == cell.shape.nodes.size(), fmt::format("gmsh's nodes of '{}' are where ours are", cell.name));
  return numbers;
}

TaggedVolume read_volume(const std::string& name, const std::vector<int>& entities, const std::string& file) {
  TaggedVolume volume{name, {}};
  for (const int entity : entities) {
    std::vector<int> types;
    std::vector<std::vector<size_t>> cells, nodes;
    gmsh::model::mesh::getElements(types, cells, nodes, 3, entity);
    for (size_t i = 0; i < types.size(); ++i) {
      const CellShape& cell = cell_of(types[i], file, name);
      const std::vector<int> numbers = gmsh_numbers(cell);
      std::vector<size_t>& all = volume.cells[cell.type];
      for (size_t first = 0; first < nodes[i].size(); first += numbers.size())
        for (const int a : numbers) all.push_back(nodes[i][first + a]);
    }
  }
  return volume;
}

TaggedSurface read_surface(const std::string& name, const std::vector<int>& entities) {
  TaggedSurface surface{name, {}};
  for (const int entity : entities)
    for (const FacetShape& shape : facet_shapes) {
      std::vector<size_t> facets, nodes;
      gmsh::model::mesh::getElementsByType(shape.gmsh_type, facets, nodes, entity);
      for (size_t i = 0; i < facets.size(); ++i) {  // gmsh has corners first, too
        TaggedFacet facet{{}, shape.n_corners};
        std::copy_n(nodes.begin() + static_cast<long>(i * shape.shape.nodes.size()), shape.n_corners,
                    facet.corners.begin());
        surface.facets.push_back(facet);
      }
    }
  return surface;
}

// Physical groups of a dimension: name and entities; without any, each entity is a group, "volume3" or "surface7".
std::vector<std::pair<std::string, std::vector<int>>> groups(int dimension) {
  const char* word = dimension == 3 ? "volume" : "surface";
  std::vector<std::pair<std::string, std::vector<int>>> result;
  Entities physical;
  gmsh::model::getPhysicalGroups(physical, dimension);
  for (const auto& group : physical) {
    std::string name;
    std::vector<int> entities;
    gmsh::model::getPhysicalName(dimension, group.second, name);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
    result.emplace_back(name.empty() ? word + std::to_string(group.second) : name, entities);
  }
  if (physical.empty())
    for (const int tag : tags_of_dimension(dimension)) result.push_back({word + std::to_string(tag), {tag}});
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
  std::vector<size_t> tags;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getNodes(tags, coordinates, parametric);
  for (size_t i = 0; i < tags.size(); ++i) model.nodes[tags[i]] = unit * Eigen::Map<const Vec3>(&coordinates[3 * i]);
  return model;
}

TaggedModel load_model(const GmshOptions& options) {
  const Session session(options.file);
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
  const TaggedModel model = load_model(options);
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

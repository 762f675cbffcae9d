#include "mesher/gmsh_session.hpp"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "base/error.hpp"
#include "base/log.hpp"

namespace dygita {

namespace {

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
    known += (known.empty() ? "" : ", ") + std::string(cell.name);
  }
  const GmshType type(gmsh_type);
  throw InputError(fmt::format("{}: volume '{}' has cells of gmsh's type '{}' (order {}, {} nodes)\n    known: {}",
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

}  // namespace

GmshSession::GmshSession(std::string file) : file_(std::move(file)) {
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
      {"Mesh.HighOrderOptimize", 0},  // it gives up on some models where straightening does not
      {"Mesh.Algorithm", 6},
      {"Mesh.Algorithm3D", 1},
      {"Mesh.Optimize", 1},
      {"Mesh.RandomSeed", 1},
  };
  for (const auto& [name, value] : numbers) gmsh::option::setNumber(name, value);
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  gmsh::logger::start();
}

GmshSession::~GmshSession() {
  gmsh::logger::stop();
  gmsh::clear();
  gmsh::onelab::clear();
  gmsh::finalize();
}

void GmshSession::run(const std::function<void()>& work) const {
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
  gmsh::logger::stop();  // which forgets them: errors are those of one run
  gmsh::logger::start();
  for (const std::string& line : lines) {
    if (line.starts_with("Error: ")) errors.push_back(line.substr(7));
    // Of curved cells: what is straightened is told by its own name (straighten.hpp).
    if (line.find("mesh: worst distortion") != std::string::npos) continue;
    if (line.starts_with("Warning: ")) warn(fmt::format("{}: gmsh: {}", file_, line.substr(9)));
  }
  if (errors.empty()) return;
  constexpr size_t most = 5;
  std::string text = fmt::format("{}: gmsh cannot read or mesh it", file_);
  for (size_t i = 0; i < std::min(errors.size(), most); ++i) text += "\n    " + errors[i];
  if (errors.size() > most) text += fmt::format("\n    and {} more", errors.size() - most);
  throw InputError(text);
}

std::vector<int> gmsh_tags(int dimension) {
  GmshEntities entities;
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> tags;
  for (const auto& entity : entities) tags.push_back(entity.second);
  return tags;
}

void read_gmsh_cells(int entity, const std::string& file, const std::string& volume,
                     std::map<CellType, std::vector<size_t>>& cells) {
  std::vector<int> types;
  std::vector<std::vector<size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 3, entity);
  for (size_t i = 0; i < types.size(); ++i) {
    const CellShape& cell = cell_of(types[i], file, volume);
    const std::vector<int> numbers = gmsh_numbers(cell);
    std::vector<size_t>& all = cells[cell.type];
    for (size_t first = 0; first < nodes[i].size(); first += numbers.size())
      for (const int a : numbers) all.push_back(nodes[i][first + a]);
  }
}

void read_gmsh_facets(int entity, std::vector<TaggedFacet>& all) {
  for (const FacetShape& shape : facet_shapes) {
    std::vector<size_t> facets, nodes;
    gmsh::model::mesh::getElementsByType(shape.gmsh_type, facets, nodes, entity);
    for (size_t i = 0; i < facets.size(); ++i) {  // gmsh has corners first, too
      TaggedFacet facet{{}, shape.n_corners};
      std::copy_n(nodes.begin() + static_cast<long>(i * shape.shape.nodes.size()), shape.n_corners,
                  facet.corners.begin());
      all.push_back(facet);
    }
  }
}

void read_gmsh_nodes(double unit, std::unordered_map<size_t, Vec3>& nodes) {
  std::vector<size_t> tags;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getNodes(tags, coordinates, parametric);
  for (size_t i = 0; i < tags.size(); ++i) nodes[tags[i]] = unit * Eigen::Map<const Vec3>(&coordinates[3 * i]);
}

}  // namespace dygita

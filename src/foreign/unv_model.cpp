#include "foreign/unv_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_cells.hpp"
#include "foreign/cards.hpp"
#include "foreign/unv_file.hpp"

namespace dygita {

namespace {

// Which of the file's nodes each of the type is: the file goes around a facet with the nodes between corners. The
// prism's first triangle turns the other way here (mesh/cell_shape.hpp).
struct UnvCell {
  long descriptor;
  CellType type;
  std::vector<int> order;
};

const std::vector<UnvCell>& unv_cells() {
  static const std::vector<UnvCell> cells = {
      {111, CellType::tet4, {0, 1, 2, 3}},
      {112, CellType::prism6, {0, 2, 1, 3, 5, 4}},
      {113, CellType::prism15, {0, 4, 2, 9, 13, 11, 5, 3, 1, 14, 12, 10, 6, 8, 7}},
      {115, CellType::hex8, {0, 1, 2, 3, 4, 5, 6, 7}},
      {116, CellType::hex20, {0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11}},
      {118, CellType::tet10, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}}};
  return cells;
}

constexpr const char* types_of_cells = "111, 112, 113, 115, 116, 118";
constexpr long a_node = 7, an_element = 8;  // types of entities in a group

const UnvCell* unv_cell(long descriptor) {
  for (const UnvCell& cell : unv_cells())
    if (cell.descriptor == descriptor) return &cell;
  return nullptr;
}

// Corners of an element of a surface, and the step from one to the next among its nodes; 0: it is none.
struct SurfaceShape {
  size_t corners = 0, step = 1;
};
SurfaceShape surface_shape(long descriptor) {
  if (descriptor < 41 || descriptor > 95) return {};
  switch (descriptor % 10) {
    case 1:
      return {3, 1};
    case 2:
      return {3, 2};
    case 4:
      return {4, 1};
    case 5:
      return {4, 2};
    default:
      return {};
  }
}

bool is_solid(long descriptor) { return descriptor >= 101 && descriptor <= 119; }

struct Group {
  std::string name, where;
  std::vector<int> nodes;   // of the model
  std::vector<int> cells;   // of the model
  std::vector<int> facets;  // of the reader
};

class Reader {
 public:
  explicit Reader(const UnvOptions& options) : options_(options), file_(options.file) {
    model_.file = options.file;
    model_.files = {options.file};
    model_.elasticity = "material that is read";
    model_.density = "density that is read";
    const auto each = [&](std::initializer_list<long> numbers, auto read) {
      for (const UnvDataset& dataset : file_.datasets())
        if (std::find(numbers.begin(), numbers.end(), dataset.number) != numbers.end()) (this->*read)(dataset);
    };
    each({164}, &Reader::read_units);
    settle_unit();
    each({2420}, &Reader::read_systems);
    each({2411, 781}, &Reader::read_nodes);
    each({2412}, &Reader::read_elements);
    if (model_.cells.empty())
      throw InputError(fmt::format("mesh file '{}' has no element that is a cell here (types {} of dataset 2412)",
                                   options.file, types_of_cells));
    each({2467, 2477, 2452, 2435}, &Reader::read_groups);
    name_parts();
    name_faces();
    name_sets();
    list_unused();
  }

  ForeignModel take() { return std::move(model_); }

 private:
  void read_units(const UnvDataset& dataset) {
    UnvLines lines(file_, dataset);
    lines.take("a code of units");
    const double factor = lines.reals(2, "factors of units")[0];
    if (!(factor > 0.0)) lines.fail(fmt::format("a factor of lengths above 0 is expected, not {:g}", factor));
    stated_ = 1.0 / factor;  // what SI is divided by
  }

  void settle_unit() {
    constexpr double equal = 1e-6;
    unit_ = options_.unit.value_or(stated_.value_or(1.0));
    if (!stated_ && !options_.unit) model_.told.emplace_back("no dataset 164 (units): lengths are taken as metres");
    if (stated_ && options_.unit && std::abs(*stated_ / *options_.unit - 1.0) > equal)
      model_.told.push_back(fmt::format(
          "dataset 164 says that lengths are in units of {:g} m: 'unit' = {:g} m is taken", *stated_, *options_.unit));
  }

  // Coordinate systems by number; those of nodes are 0 or 1, which is the global one unless it is given as another.
  void read_systems(const UnvDataset& dataset) {
    UnvLines lines(file_, dataset);
    for (const char* what : {"the number of a part", "the name of a part"}) lines.take(what);
    while (!lines.is_at_end()) {
      const std::vector<long> head = lines.wholes(2, "the number and the type of a coordinate system");
      lines.take("the name of a coordinate system");
      bool is_global = head[1] == 0;
      for (int row = 0; row < 4; ++row) {
        const std::vector<double>& values = lines.reals(3, "an axis or the origin of a coordinate system");
        for (int axis = 0; axis < 3; ++axis)
          is_global &= values[static_cast<size_t>(axis)] == (row == axis ? 1.0 : 0.0);
      }
      if (!is_global) others_.insert(head[0]);
    }
  }

  void read_nodes(const UnvDataset& dataset) {
    for (UnvLines lines(file_, dataset); !lines.is_at_end();) {
      const std::vector<long>& head = lines.wholes(2, "the number of a node");
      const long number = head[0];
      if (head[1] > 1 || others_.contains(head[1]))
        lines.fail(fmt::format("node {} is in coordinate system {}: only the global one is read", number, head[1]));
      if (!node_of_.emplace(number, static_cast<int>(model_.nodes.size())).second)
        lines.fail(fmt::format("node {} is given twice", number));
      const std::vector<double>& x = lines.reals(3, "coordinates");
      model_.nodes.emplace_back(unit_ * Vec3(x[0], x[1], x[2]));
    }
  }

  void read_elements(const UnvDataset& dataset) {
    for (UnvLines lines(file_, dataset); !lines.is_at_end();) {
      const std::vector<long> head = lines.wholes(6, "the number of an element");
      const int line = lines.line();
      const long number = head[0], descriptor = head[1];
      const auto n = static_cast<size_t>(std::max(head[5], 0L));
      const bool is_beam = descriptor >= 21 && descriptor <= 25;
      if (is_beam || (descriptor == 11 && lines.n_in_next() != n)) lines.wholes(1, "the orientation of a beam");
      std::vector<int> nodes;
      while (nodes.size() < n)
        for (const long node : lines.wholes(1, "nodes of an element"))
          if (nodes.size() < n) nodes.push_back(node_at(node, lines));
      if (!element_of_.emplace(number, Element{}).second) lines.fail(fmt::format("element {} is given twice", number));
      add(descriptor, head[2], nodes, {CellType::hex8, 0, -1, 0, line, number}, lines);
    }
  }

  void add(long descriptor, long property, const std::vector<int>& nodes, ForeignCell cell, const UnvLines& lines) {
    Element& element = element_of_[cell.number];
    const SurfaceShape surface = surface_shape(descriptor);
    const bool is_skipped =
        std::find(options_.skip.begin(), options_.skip.end(), std::to_string(descriptor)) != options_.skip.end();
    if (const UnvCell* type = unv_cell(descriptor); type && !is_skipped) {
      if (nodes.size() != type->order.size())
        lines.fail(fmt::format("element {} of type {} has {} nodes, not {}", cell.number, descriptor, nodes.size(),
                               type->order.size()));
      cell.type = type->type;
      cell.first = static_cast<int>(model_.connectivity.size());
      for (const int a : type->order) model_.connectivity.push_back(nodes[static_cast<size_t>(a)]);
      element.cell = static_cast<int>(model_.cells.size());
      model_.cells.push_back(cell);
      property_.push_back(property);
    } else if (surface.corners > 0 && !is_skipped) {
      if (nodes.size() < surface.corners * surface.step)
        lines.fail(fmt::format("element {} of type {} has {} nodes", cell.number, descriptor, nodes.size()));
      std::vector<int> corners;
      for (size_t a = 0; a < surface.corners; ++a) corners.push_back(nodes[a * surface.step]);
      element.facet = static_cast<int>(facets_.size());
      facets_.push_back(std::move(corners));
      ++n_left_out_[descriptor];
    } else {
      if (is_solid(descriptor) && !is_skipped)
        lines.fail(
            fmt::format("solid elements of type {} are no cells here: {} are\n    skip = {{ \"{}\" }} leaves "
                        "them out",
                        descriptor, types_of_cells, descriptor));
      ++n_left_out_[descriptor];
    }
  }

  int node_at(long number, const UnvLines& lines) const {
    const auto found = node_of_.find(number);
    if (found == node_of_.end()) lines.fail(fmt::format("there is no node {}", number));
    return found->second;
  }

  void read_groups(const UnvDataset& dataset) {
    for (UnvLines lines(file_, dataset); !lines.is_at_end();) {
      const std::vector<long>& head = lines.wholes(8, "a group");
      const long number = head[0], n = head[7];
      Group group;
      group.where = fmt::format("{}:{}", file_.file(), lines.line());
      group.name = printable(std::string(without_blanks_around(lines.take("the name of a group"))));
      if (group.name.empty() || !names_.insert(group.name).second)
        names_.insert(group.name += fmt::format("{}(group {})", group.name.empty() ? "" : " ", number));
      for (long i = 0; i < n;) {
        const std::vector<long>& entries = lines.wholes(4, "entities of a group");
        for (size_t k = 0; k + 3 < entries.size() && i < n; k += 4, ++i) take(entries[k], entries[k + 1], lines, group);
      }
      groups_.push_back(std::move(group));
    }
  }

  void take(long kind, long number, const UnvLines& lines, Group& group) {
    if (kind == a_node) {
      group.nodes.push_back(node_at(number, lines));
      return;
    }
    if (kind != an_element) {
      ++n_other_entities_;
      return;
    }
    const auto found = element_of_.find(number);
    if (found == element_of_.end()) lines.fail(fmt::format("there is no element {}", number));
    if (found->second.cell >= 0) group.cells.push_back(found->second.cell);
    if (found->second.facet >= 0) group.facets.push_back(found->second.facet);
  }

  // By the first group that has them, else by their property.
  void name_parts() {
    size_t n_again = 0;
    for (const Group& group : groups_) {
      if (group.cells.empty()) continue;
      const auto number = static_cast<int>(model_.groups.size());
      size_t n_own = 0;
      for (const int c : group.cells) {
        int& of = model_.cells[static_cast<size_t>(c)].group;
        if (of < 0) of = number, ++n_own;
      }
      n_again += group.cells.size() - n_own;
      if (n_own > 0) model_.groups.push_back({group.name, "", "", ""});
      if (n_own < group.cells.size()) add_set_of_cells(group);
    }
    if (n_again > 0)
      model_.told.push_back(
          fmt::format("{} cells are in more than one group: their part is the first, and the others "
                      "are regions",
                      n_again));
    std::map<long, int> by_property;
    for (size_t c = 0; c < model_.cells.size(); ++c) {
      if (model_.cells[c].group >= 0) continue;
      const auto [found, is_new] = by_property.try_emplace(property_[c], static_cast<int>(model_.groups.size()));
      if (is_new) model_.groups.push_back({fmt::format("property {}", property_[c]), "", "", ""});
      model_.cells[c].group = found->second;
    }
  }

  void add_set_of_cells(const Group& group) {
    std::set<int> nodes;
    for (const int c : group.cells) {
      const ForeignCell& cell = model_.cells[static_cast<size_t>(c)];
      nodes.insert(model_.nodes_of(cell), model_.nodes_of(cell) + nodes_per_cell(cell.type));
    }
    model_.node_sets.push_back({group.name, {nodes.begin(), nodes.end()}});
  }

  // Facets of cells that elements of surfaces in groups lie on: of both, where two cells share one.
  void name_faces() {
    std::unordered_map<FacetKey, std::vector<ForeignFacet>, FacetKeyHash> wanted;
    for (const Group& group : groups_)
      for (const int facet : group.facets) wanted[facet_key(facets_[static_cast<size_t>(facet)])];
    if (wanted.empty()) return;
    for (size_t c = 0; c < model_.cells.size(); ++c) {
      const int* nodes = model_.nodes_of(model_.cells[c]);
      for (const std::vector<int>& corners : abaqus_cell_of(model_.cells[c].type).faces) {
        ForeignFacet facet{static_cast<int>(c), {-1, -1, -1, -1}};
        for (size_t a = 0; a < corners.size(); ++a) facet.corners[a] = nodes[corners[a]];
        const auto found = wanted.find(facet_key(std::span<const int>(facet.corners.data(), corners.size())));
        if (found != wanted.end()) found->second.push_back(facet);
      }
    }
    for (const Group& group : groups_) {
      if (group.facets.empty()) continue;
      ForeignFace face{group.name, {}, group.where};
      size_t n_alone = 0;
      for (const int facet : group.facets) {
        const std::vector<ForeignFacet>& of = wanted.at(facet_key(facets_[static_cast<size_t>(facet)]));
        face.facets.insert(face.facets.end(), of.begin(), of.end());
        n_alone += of.empty();
      }
      if (n_alone > 0)
        model_.told.push_back(fmt::format("{}: {} of {} elements of surfaces in group '{}' lie on no cell", group.where,
                                          n_alone, group.facets.size(), group.name));
      if (!face.facets.empty()) model_.surfaces.push_back(std::move(face));
    }
  }

  void name_sets() {
    for (Group& group : groups_) {
      if (group.nodes.empty()) continue;
      std::sort(group.nodes.begin(), group.nodes.end());
      group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
      model_.node_sets.push_back({group.name, std::move(group.nodes)});
    }
  }

  void list_unused() {
    for (const auto& [descriptor, n] : n_left_out_)
      model_.told.push_back(
          surface_shape(descriptor).corners > 0
              ? fmt::format("{} elements of type {} (surfaces) name faces where groups have them; as "
                            "shells they are left out",
                            n, descriptor)
              : fmt::format("{} elements of type {} are no cells here and are left out", n, descriptor));
    if (n_other_entities_ > 0)
      model_.told.push_back(
          fmt::format("{} entities of groups are neither nodes nor elements and are left out", n_other_entities_));
    const std::set<long> used = {164, 2420, 2411, 781, 2412, 2467, 2477, 2452, 2435};
    std::map<long, std::vector<std::string>> others;
    for (const UnvDataset& dataset : file_.datasets())
      if (!used.contains(dataset.number))
        others[dataset.number].push_back(fmt::format("{}:{}", file_.file(), dataset.line));
    for (const auto& [number, places] : others)
      model_.unused.push_back(fmt::format("dataset {}: {}", number, few_of(places)));
  }

  struct Element {
    int cell = -1, facet = -1;
  };

  const UnvOptions& options_;
  UnvFile file_;
  ForeignModel model_;
  std::optional<double> stated_;  // m
  double unit_ = 1.0;             // m
  std::set<long> others_;         // numbers of coordinate systems that are not the global one
  std::unordered_map<long, int> node_of_;
  std::unordered_map<long, Element> element_of_;
  std::vector<long> property_;            // of each cell
  std::vector<std::vector<int>> facets_;  // corners
  std::vector<Group> groups_;
  std::set<std::string> names_;
  std::map<long, size_t> n_left_out_;
  size_t n_other_entities_ = 0;
};

}  // namespace

ForeignModel unv_model(const UnvOptions& options) { return Reader(options).take(); }

}  // namespace dygita

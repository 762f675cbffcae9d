#include "foreign/foreign_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "base/error.hpp"
#include "mesh/jacobian.hpp"

namespace dygita {

namespace {

using CellList = std::vector<int>;  // in increasing order

int root_of(std::vector<int>& above, int i) {
  while (above[static_cast<size_t>(i)] != i)
    i = above[static_cast<size_t>(i)] = above[static_cast<size_t>(above[static_cast<size_t>(i)])];
  return i;
}

// The cells of a group by those that share nodes, in the order of their first cells.
std::vector<CellList> pieces_of_group(const ForeignModel& model, const CellList& cells, std::vector<int>& above) {
  for (const int c : cells) {
    const ForeignCell& cell = model.cells[static_cast<size_t>(c)];
    for (int a = 0; a < nodes_per_cell(cell.type); ++a)
      above[static_cast<size_t>(model.nodes_of(cell)[a])] = model.nodes_of(cell)[a];
  }
  for (const int c : cells) {
    const ForeignCell& cell = model.cells[static_cast<size_t>(c)];
    const int* nodes = model.nodes_of(cell);
    for (int a = 1; a < nodes_per_cell(cell.type); ++a)
      above[static_cast<size_t>(root_of(above, nodes[a]))] = root_of(above, nodes[0]);
  }
  std::unordered_map<int, size_t> piece_of;
  std::vector<CellList> pieces;
  for (const int c : cells) {
    const auto [found, is_new] =
        piece_of.emplace(root_of(above, *model.nodes_of(model.cells[static_cast<size_t>(c)])), pieces.size());
    if (is_new) pieces.emplace_back();
    pieces[found->second].push_back(c);
  }
  return pieces;
}

// Makes one part after the other, with what is needed for that as large as the model.
class PartMaker {
 public:
  explicit PartMaker(ForeignModel& model)
      : model_(model), local_(model.nodes.size(), -1), is_in_set_(model.nodes.size(), 0) {
    is_of_part_.resize(model.cells.size(), 0);
  }

  ForeignPart make(const CellList& cells, const std::string& name) {
    ForeignPart part;
    part.name = name;
    part.group = model_.cells[static_cast<size_t>(cells[0])].group;
    const ForeignGroup& group = model_.groups[static_cast<size_t>(part.group)];
    part.product = group.name;
    part.instance = group.instance;
    auto mesh = std::make_shared<Mesh>();
    mesh->source = model_.file;
    for (const int c : cells) is_of_part_[static_cast<size_t>(c)] = 1;
    number_nodes(cells, *mesh);
    add_cells(cells, *mesh);
    check(cells, *mesh, name);
    part.file_nodes = nodes_;
    add_places(*mesh, part);
    mesh->digest = mesh_digest(*mesh);
    for (const int node : nodes_) local_[static_cast<size_t>(node)] = -1;
    for (const int c : cells) is_of_part_[static_cast<size_t>(c)] = 0;
    part.mesh = mesh;
    return part;
  }

 private:
  void number_nodes(const CellList& cells, Mesh& mesh) {
    nodes_.clear();
    for (const int c : cells) {
      const ForeignCell& cell = model_.cells[static_cast<size_t>(c)];
      nodes_.insert(nodes_.end(), model_.nodes_of(cell), model_.nodes_of(cell) + nodes_per_cell(cell.type));
    }
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    mesh.nodes.resize(3, static_cast<long>(nodes_.size()));
    for (size_t i = 0; i < nodes_.size(); ++i) {
      local_[static_cast<size_t>(nodes_[i])] = static_cast<int>(i);
      mesh.nodes.col(static_cast<long>(i)) = model_.nodes[static_cast<size_t>(nodes_[i])];
    }
  }

  // A file may give cells either way round, as a mirrored copy does.
  void add_cells(const CellList& cells, Mesh& mesh) {
    std::map<CellType, CellBlock> blocks;
    for (const int c : cells) {
      const ForeignCell& cell = model_.cells[static_cast<size_t>(c)];
      const int n = nodes_per_cell(cell.type), *nodes = model_.nodes_of(cell);
      Points x(3, n);
      for (int a = 0; a < n; ++a) x.col(a) = model_.nodes[static_cast<size_t>(nodes[a])];
      const bool is_mirrored = cell_volume(cell.type, x) < 0;
      CellBlock& block = blocks.try_emplace(cell.type, CellBlock{cell.type, {}}).first->second;
      const std::span<const int> mirrored = cell_shape(cell.type).mirrored;
      for (int a = 0; a < n; ++a)
        block.nodes.push_back(local_[static_cast<size_t>(nodes[is_mirrored ? mirrored[static_cast<size_t>(a)] : a])]);
    }
    for (auto& [type, block] : blocks) mesh.blocks.push_back(std::move(block));
  }

  // The cell that check_mesh refuses, by its number and line in the file.
  void check(const CellList& cells, const Mesh& mesh, const std::string& name) const {
    try {
      check_mesh(mesh, fmt::format("{}, part {}", model_.file, name));
    } catch (const InputError& error) {
      std::map<CellType, int> next;
      for (const int c : cells) {
        const ForeignCell& cell = model_.cells[static_cast<size_t>(c)];
        const auto block = std::find_if(mesh.blocks.begin(), mesh.blocks.end(),
                                        [&](const CellBlock& one) { return one.type == cell.type; });
        const Points x = cell_nodes(mesh.nodes, *block, next[cell.type]++);
        if (smallest_jacobian(cell.type, x) <= 0.0)
          throw InputError(fmt::format("{}: element {} is inverted or too distorted\n    {}", model_.where(cell),
                                       cell.number, error.what()));
      }
      throw;
    }
  }

  void add_places(Mesh& mesh, ForeignPart& part) {
    std::unordered_map<FacetKey, Facet, FacetKeyHash> boundary;
    const std::vector<Facet> facets = boundary_facets(mesh.blocks);
    for (const Facet& facet : facets) boundary.emplace(facet_key(facet), facet);
    for (const ForeignFace& surface : model_.surfaces) add_surface(surface, boundary, mesh, part);
    for (const ForeignSet& set : model_.node_sets) {
      std::vector<int> own;
      for (const int node : set.nodes)
        if (const int local = local_[static_cast<size_t>(node)]; local >= 0) own.push_back(local);
      if (own.empty()) continue;
      if (!mesh.faces.contains(set.name)) add_face_of_nodes(set.name, own, facets, mesh);
      part.regions.try_emplace(set.name, std::move(own));
    }
  }

  void add_surface(const ForeignFace& surface, const std::unordered_map<FacetKey, Facet, FacetKeyHash>& boundary,
                   Mesh& mesh, ForeignPart& part) {
    std::vector<Facet> facets;
    std::vector<InnerFacet> inside;
    std::unordered_set<FacetKey, FacetKeyHash> known;  // a facet that is listed twice is there once
    for (const ForeignFacet& facet : surface.facets) {
      if (!is_of_part_[static_cast<size_t>(facet.cell)]) continue;
      std::vector<int> corners;
      for (const int corner : facet.corners)
        if (corner >= 0) corners.push_back(local_[static_cast<size_t>(corner)]);
      if (!known.insert(facet_key(corners)).second) continue;
      const auto found = boundary.find(facet_key(corners));
      if (found == boundary.end())
        inside.push_back({facet_key(corners), node_behind(facet, corners)});
      else
        facets.push_back(found->second);
    }
    if (!inside.empty())
      model_.told.push_back(
          fmt::format("{}: {} of {} facets of surface '{}' lie inside part '{}', where it has no face; "
                      "mesh:cut divides it there",
                      surface.where, inside.size(), inside.size() + facets.size(), surface.name, part.name));
    if (inside.empty() && !facets.empty()) mesh.faces[surface.name] = std::move(facets);
    if (!inside.empty()) part.inner_surfaces[surface.name] = std::move(inside);
  }

  // A corner of the facet's cell that is none of the facet's.
  int node_behind(const ForeignFacet& facet, const std::vector<int>& corners) const {
    const ForeignCell& cell = model_.cells[static_cast<size_t>(facet.cell)];
    const int* nodes = model_.nodes_of(cell);
    for (int a = 0; a < cell_shape(cell.type).n_corners; ++a) {
      const int node = local_[static_cast<size_t>(nodes[a])];
      if (std::find(corners.begin(), corners.end(), node) == corners.end()) return node;
    }
    return -1;
  }

  void add_face_of_nodes(const std::string& name, const std::vector<int>& nodes, const std::vector<Facet>& boundary,
                         Mesh& mesh) {
    for (const int node : nodes) is_in_set_[static_cast<size_t>(node)] = 1;
    std::vector<Facet> facets;
    for (const Facet& facet : boundary) {
      const std::span<const int> all = facet.nodes();
      if (std::all_of(all.begin(), all.end(), [&](int node) { return is_in_set_[static_cast<size_t>(node)] != 0; }))
        facets.push_back(facet);
    }
    for (const int node : nodes) is_in_set_[static_cast<size_t>(node)] = 0;
    if (!facets.empty()) mesh.faces[name] = std::move(facets);
  }

  ForeignModel& model_;
  std::vector<int> local_, nodes_;  // by the model's node, -1: not of the part; of the part
  std::vector<char> is_in_set_, is_of_part_;
};

}  // namespace

std::string ForeignModel::where(const ForeignCell& cell) const {
  return fmt::format("{}:{}", files[static_cast<size_t>(cell.file)], cell.line);
}

std::map<std::string, std::vector<int>> regions_of_half(const std::map<std::string, std::vector<int>>& regions,
                                                        const MeshHalf& half) {
  std::unordered_map<int, int> own;
  for (size_t i = 0; i < half.nodes.size(); ++i) own.emplace(half.nodes[i], static_cast<int>(i));
  std::map<std::string, std::vector<int>> of_half;
  for (const auto& [name, nodes] : regions)
    for (const int node : nodes)
      if (const auto found = own.find(node); found != own.end()) of_half[name].push_back(found->second);
  return of_half;
}

std::vector<ForeignPart> parts_of(ForeignModel& model) {
  std::vector<CellList> of_group(model.groups.size());
  for (size_t c = 0; c < model.cells.size(); ++c)
    of_group[static_cast<size_t>(model.cells[c].group)].push_back(static_cast<int>(c));
  std::vector<int> above(model.nodes.size());
  PartMaker maker(model);
  std::vector<ForeignPart> parts;
  for (size_t g = 0; g < of_group.size(); ++g) {
    if (of_group[g].empty()) continue;
    const std::string& name = model.groups[g].name;
    const std::vector<CellList> pieces = pieces_of_group(model, of_group[g], above);
    if (pieces.size() > 1)
      model.told.push_back(
          fmt::format("the cells of '{}' form {} unconnected pieces: parts '{}[1]' to '{}[{}]', all of which "
                      "file:parts \"{}\" returns",
                      name, pieces.size(), name, name, pieces.size(), name));
    for (size_t p = 0; p < pieces.size(); ++p)
      parts.push_back(maker.make(pieces[p], pieces.size() == 1 ? name : fmt::format("{}[{}]", name, p + 1)));
  }
  return parts;
}

}  // namespace dygita

#include "intake/tagged_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "mesh/jacobian.hpp"

namespace dygita {

namespace {

using IndexOfTag = std::unordered_map<size_t, int>;
using FacetOfKey = std::unordered_map<FacetKey, Facet, FacetKeyHash>;

// Numbers the volume's nodes from 0 in the order of their tags.
IndexOfTag number_nodes(const TaggedModel& model, const TaggedVolume& volume, Mesh& mesh) {
  std::vector<size_t> tags;
  for (const auto& [type, cells] : volume.cells) tags.insert(tags.end(), cells.begin(), cells.end());
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  IndexOfTag index;
  mesh.nodes.resize(3, static_cast<long>(tags.size()));
  for (size_t i = 0; i < tags.size(); ++i) {
    index[tags[i]] = static_cast<int>(i);
    mesh.nodes.col(static_cast<long>(i)) = model.nodes.at(tags[i]);
  }
  return index;
}

// Mirrors the numbering of cells whose volume is negative: a generator may give them either way round.
void turn_right_side_out(const Points& nodes, CellBlock& block) {
  const std::span<const int> mirrored = cell_shape(block.type).mirrored;
  for (int i = 0; i < block.n_cells(); ++i) {
    if (cell_volume(block.type, cell_nodes(nodes, block, i)) >= 0) continue;
    int* cell = block.nodes.data() + static_cast<size_t>(i) * mirrored.size();
    const std::vector<int> before(cell, cell + mirrored.size());
    std::transform(mirrored.begin(), mirrored.end(), cell, [&](int a) { return before[a]; });
  }
}

// The part of the surface that lies on the boundary, outward.
std::vector<Facet> facets_on(const FacetOfKey& boundary, const IndexOfTag& index, const TaggedSurface& surface) {
  std::vector<Facet> facets;
  for (const TaggedFacet& tagged : surface.facets) {
    std::vector<int> corners;
    for (int a = 0; a < tagged.n_corners; ++a)
      if (const auto known = index.find(tagged.corners[a]); known != index.end()) corners.push_back(known->second);
    if (static_cast<int>(corners.size()) < tagged.n_corners) continue;
    const auto found = boundary.find(facet_key(corners));
    if (found != boundary.end()) facets.push_back(found->second);
  }
  return facets;
}

// What the volume calls the surface: "name.x" is x, another volume's "other.x" is not its business.
std::optional<std::string> name_for(const TaggedModel& model, const TaggedVolume& volume, const std::string& surface) {
  if (surface.starts_with(volume.name + ".")) return surface.substr(volume.name.size() + 1);
  for (const TaggedVolume& other : model.volumes)
    if (surface.starts_with(other.name + ".")) return {};
  return surface;
}

void add_faces(const TaggedModel& model, const TaggedVolume& volume, const IndexOfTag& index, Mesh& mesh) {
  FacetOfKey boundary;
  for (const Facet& facet : boundary_facets(mesh.blocks)) boundary.emplace(facet_key(facet), facet);
  std::map<std::string, std::vector<Facet>> shared;
  for (const TaggedSurface& surface : model.surfaces) {
    const std::optional<std::string> name = name_for(model, volume, surface.name);
    if (!name) continue;
    const bool is_own = *name != surface.name;
    std::vector<Facet> facets = facets_on(boundary, index, surface);
    if (is_own && (facets.size() < surface.facets.size() || facets.empty()))
      throw InputError(fmt::format(
          "{}: surface group '{}' is named after volume '{}' but {} of its {} facets are not on "
          "the boundary of that volume",
          model.file, surface.name, volume.name, surface.facets.size() - facets.size(), surface.facets.size()));
    if (!facets.empty()) (is_own ? mesh.faces : shared)[*name] = std::move(facets);
  }
  mesh.faces.merge(shared);  // keeps the volume's own where both exist
}

}  // namespace

MeshPtr build_mesh(const TaggedModel& model, const TaggedVolume& volume) {
  auto mesh = std::make_shared<Mesh>();
  mesh->source = model.file;
  const IndexOfTag index = number_nodes(model, volume, *mesh);
  for (const auto& [type, tags] : volume.cells) {
    CellBlock block{type, {}};
    block.nodes.reserve(tags.size());
    for (const size_t tag : tags) block.nodes.push_back(index.at(tag));
    turn_right_side_out(mesh->nodes, block);
    mesh->blocks.push_back(std::move(block));
  }
  check_mesh(*mesh, fmt::format("{}, volume {}", model.file, volume.name));
  add_faces(model, volume, index, *mesh);
  mesh->digest = mesh_digest(*mesh);
  return mesh;
}

}  // namespace dygita

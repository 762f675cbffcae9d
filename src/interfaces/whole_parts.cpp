#include "interfaces/whole_parts.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/parallel.hpp"
#include "meeting/neighbours.hpp"
#include "mesh/unmatched_cells.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"

namespace dygita {

namespace {

constexpr size_t most_pieces = 64;  // that are held against each other, two by two

std::string in_mm(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]); }

// Boxes and bolts are made as wholes.
bool is_from_file(const Mesh& mesh) { return mesh.has_cells() && mesh.source.find('.') != std::string::npos; }

// Facets of a part that an interface joins to others of the same part, and those of which an equation joins a node to
// another one of it.
FacetKeys joined_to_itself(const Mesh& mesh, const std::vector<Surface>& surfaces, int part) {
  FacetKeys joined;
  std::set<int> in_equations;
  for (const Surface& surface : surfaces)
    if (surface.wall && surface.facing.is_of_sums() && surface.part_1 == part && surface.facing.side_1.n_shares(0) > 1)
      for (int k = 0; k < surface.facing.side_1.n_shares(0); ++k)
        in_equations.insert(surface.facing.side_1.share(0, k).node);
  if (!in_equations.empty())
    for (const Facet& facet : boundary_facets(mesh))
      if (std::any_of(facet.nodes().begin(), facet.nodes().end(),
                      [&](int node) { return in_equations.contains(node); }))
        joined.insert(facet_key(facet));
  for (const Surface& surface : surfaces)
    if (surface.part_1 == part && surface.part_2 == part)
      for (const std::vector<Facet>* facets : {&surface.facing.facets_1, &surface.facing.facets_2})
        for (const Facet& facet : *facets) joined.insert(facet_key(facet));
  return joined;
}

// Pieces that overlap, or touch as round faces of unlike meshes do; with nothing to tell, empty.
std::string text_of_contact(const std::vector<LoosePiece>& pieces, const Vec3& place) {
  if (pieces.size() > most_pieces) return "";
  for (size_t i = 0; i < pieces.size(); ++i)
    for (size_t j = i + 1; j < pieces.size(); ++j) {
      const Neighbours found = find_neighbours({&pieces[i].mesh, place}, {&pieces[j].mesh, place}, 0.0);
      if (const auto& in = found.intrusion)
        return fmt::format("two of the {} pieces of its mesh overlap, up to {:.3g} mm deep at {} mm", pieces.size(),
                           1e3 * in->depth, in_mm(in->place));
      if (const auto& touch = found.touch)
        return fmt::format("two of the {} pieces of its mesh touch on {:.4g} mm^2, at {} mm, and share no nodes",
                           pieces.size(), 1e6 * touch->area, in_mm(touch->place));
    }
  return "";
}

// What is wrong with a part's mesh; empty: nothing.
std::string text_of_seam(const Substructure& part, const FacetKeys& joined) {
  const Mesh& mesh = *part.mesh;
  const std::vector<LoosePiece> pieces = loose_pieces(mesh);
  if (const std::optional<Seam> seam = find_seam(mesh, joined)) {
    const std::string where = fmt::format("{} and {} at {} mm{}", cell_with(mesh, seam->facet_1),
                                          cell_with(mesh, seam->facet_2), in_mm(seam->place + part.place),
                                          pieces.empty() ? "" : fmt::format("; it is in {} pieces", pieces.size()));
    if (seam->is_overlap)
      return fmt::format(
          "cells of its mesh overlap: facets of {:.4g} mm^2 lie on others with their cells on one side, "
          "the first are of {}",
          1e6 * seam->area, where);
    return fmt::format("cells of its mesh meet on {:.4g} mm^2 without sharing nodes and facets, the first are {}",
                       1e6 * seam->area, where);
  }
  return joined.empty() ? text_of_contact(pieces, part.place) : "";
}

// Those whose meshes are to be looked at: of copies the first.
std::vector<int> parts_to_look_at(const Problem& problem) {
  std::vector<int> parts;
  std::set<std::string> known;
  for (size_t i = 0; i < problem.substructures.size(); ++i) {
    const Mesh& mesh = *problem.substructures[i]->mesh;
    if (is_from_file(mesh) && known.insert(mesh.shape_digest()).second) parts.push_back(static_cast<int>(i));
  }
  return parts;
}

std::set<int> nodes_with_interface_or_support(const Problem& problem, const std::vector<Surface>& surfaces, int part) {
  std::set<int> nodes;
  const auto add = [&](const std::vector<int>& of) { nodes.insert(of.begin(), of.end()); };
  for (const Surface& surface : surfaces) {
    if (surface.part_1 == part) add(nodes_of(surface.facing.facets_1));
    if (surface.part_2 == part) add(nodes_of(surface.facing.facets_2));
  }
  for (const SupportPtr& support : all_supports(problem))
    for (const FaceOrRegion& on : support->on)
      if (&part_of(on) == problem.substructures[static_cast<size_t>(part)].get()) add(nodes_at(on));
  return nodes;
}

// Within a twentieth of the smaller one's size, as parts are.
bool are_near(const std::vector<LoosePiece>& pieces) {
  constexpr double nearness = 0.05;
  if (pieces.size() > most_pieces) return true;
  for (size_t i = 0; i < pieces.size(); ++i)
    for (size_t j = i + 1; j < pieces.size(); ++j) {
      const PlacedBody one{&pieces[i].mesh, Vec3::Zero()}, other{&pieces[j].mesh, Vec3::Zero()};
      const double size = std::min(one.box().size().norm(), other.box().size().norm());
      if (find_neighbours(one, other, nearness * size).are_near()) return true;
    }
  return false;
}

}  // namespace

void refuse_seams(const Problem& problem, const std::vector<Surface>& surfaces) {
  const std::vector<int> parts = parts_to_look_at(problem);
  std::vector<std::string> texts(parts.size());
  parallel_for(static_cast<int>(parts.size()), [&](int k) {
    const Substructure& part = *problem.substructures[static_cast<size_t>(parts[static_cast<size_t>(k)])];
    texts[static_cast<size_t>(k)] =
        text_of_seam(part, joined_to_itself(*part.mesh, surfaces, parts[static_cast<size_t>(k)]));
  });
  for (size_t k = 0; k < parts.size(); ++k) {
    if (texts[k].empty()) continue;
    const Substructure& part = *problem.substructures[static_cast<size_t>(parts[k])];
    check::fail(
        problem, part.origin,
        fmt::format("substructure '{}': {}: they are not joined and pass through each other", part.name, texts[k]),
        "merge the nodes (gmsh: Coherence before meshing, Coherence Mesh after it) with matching facets, or make a "
        "volume of each piece and join them by an interface");
  }
}

void doubt_loose_pieces(const Problem& problem, const std::vector<Surface>& surfaces) {
  constexpr size_t most_told = 4;
  for (const int i : parts_to_look_at(problem)) {
    const Substructure& part = *problem.substructures[static_cast<size_t>(i)];
    const std::vector<LoosePiece> pieces = loose_pieces(*part.mesh);
    if (pieces.empty()) continue;
    const std::set<int> held = nodes_with_interface_or_support(problem, surfaces, i);
    const bool all_held = std::all_of(pieces.begin(), pieces.end(), [&](const LoosePiece& piece) {
      return std::any_of(piece.nodes.begin(), piece.nodes.end(), [&](int node) { return held.contains(node); });
    });
    if (all_held && !are_near(pieces)) continue;
    std::string list;
    for (size_t p = 0; p < std::min(pieces.size(), most_told); ++p) {
      const Points& x = pieces[p].mesh.nodes;
      list += fmt::format("{}{} cells from {} to {} mm", p == 0 ? "" : ", ", pieces[p].mesh.n_cells(),
                          in_mm(x.rowwise().minCoeff() + part.place), in_mm(x.rowwise().maxCoeff() + part.place));
    }
    check::doubt(
        problem, part.origin,
        fmt::format(
            "substructure '{}' is in {} pieces that share no nodes: {}{}; {}, and nothing prevents them from passing "
            "through each other: is a connection missing? Give each its own volume to join them by an interface",
            part.name, pieces.size(), list, pieces.size() > most_told ? ", ..." : "",
            all_held ? "some are near each other" : "some have no interface and no support"));
  }
}

}  // namespace dygita

#include "watch/part_views.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "fem/patch_recovery.hpp"

namespace dygita {

// How Eigen adds up depends on where numbers lie in memory, unless they are its own.
double sum_of(const std::vector<double>& values) {
  return Vec(Eigen::Map<const Vec>(values.data(), static_cast<Eigen::Index>(values.size()))).sum();
}

std::vector<int> ranks_of(const Cut& cut, int part) {
  std::set<int> ranks;
  for (int i = cut.first(part); i < cut.first(part) + cut.n_pieces(part); ++i) ranks.insert(cut.piece(i).rank);
  return {ranks.begin(), ranks.end()};
}

std::pair<MeshPtr, std::vector<int>> some_cells(const Mesh& mesh, const std::vector<std::vector<char>>& is_kept) {
  auto some = std::make_shared<Mesh>();
  std::vector<int> number(static_cast<size_t>(mesh.n_nodes()), -1), nodes;
  for (size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    CellBlock& kept = some->blocks.emplace_back(CellBlock{block.type, {}});
    const int n = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      if (!is_kept[b][static_cast<size_t>(i)]) continue;
      kept.nodes.insert(kept.nodes.end(), block.cell(i), block.cell(i) + n);
      if (!block.axes.empty()) kept.axes.push_back(block.axes[static_cast<size_t>(i)]);
    }
    for (const int node : kept.nodes) number[static_cast<size_t>(node)] = 0;
  }
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    if (number[static_cast<size_t>(node)] < 0) continue;
    number[static_cast<size_t>(node)] = static_cast<int>(nodes.size());
    nodes.push_back(node);
  }
  for (CellBlock& block : some->blocks)
    for (int& node : block.nodes) node = number[static_cast<size_t>(node)];
  some->nodes = mesh.nodes(Eigen::all, nodes);
  return {std::move(some), std::move(nodes)};
}

PartView::PartView(const Cut& cut, int part, const MeshPtr& whole) {
  for (int i = cut.first(part); i < cut.first(part) + cut.n_pieces(part); ++i)
    if (cut.is_here(i)) pieces_.push_back(i);
  if (is_empty()) return;
  mesh_ = whole;
  if (cut.n_pieces(part) == 1) return;
  of_cells_ = pieces_of_cells(cut, *whole);
  if (static_cast<int>(pieces_.size()) < cut.n_pieces(part)) {
    // Polynomials of order two reach one ring further where the cells around a node do not determine them.
    const int n_rings = is_of_order_two(*whole) ? 2 : 1;
    std::vector<std::vector<char>> is_seen;
    for (const std::vector<int>& of_block : of_cells_) {
      std::vector<char>& seen = is_seen.emplace_back();
      for (const int piece : of_block) seen.push_back(piece >= 0);
    }
    for (int ring = 0; ring < n_rings; ++ring) {
      std::vector<char> is_touched(static_cast<size_t>(whole->n_nodes()), 0);
      const auto each = [&](const auto& visit) {
        for (size_t b = 0; b < whole->blocks.size(); ++b) {
          const CellBlock& block = whole->blocks[b];
          for (int i = 0; i < block.n_cells(); ++i)
            visit(is_seen[b][static_cast<size_t>(i)], std::span(block.cell(i), size_t(nodes_per_cell(block.type))));
        }
      };
      each([&](char seen, std::span<const int> nodes) {
        for (const int node : nodes) is_touched[static_cast<size_t>(node)] |= seen;
      });
      each([&](char& seen, std::span<const int> nodes) {
        for (const int node : nodes) seen |= is_touched[static_cast<size_t>(node)];
      });
    }
    std::tie(mesh_, nodes_) = some_cells(*whole, is_seen);
    for (size_t b = 0; b < of_cells_.size(); ++b) {
      std::vector<int> kept;
      for (size_t i = 0; i < of_cells_[b].size(); ++i)
        if (is_seen[b][i]) kept.push_back(of_cells_[b][i]);
      of_cells_[b] = std::move(kept);
    }
  }
  for (int i = 0; i < mesh_->n_nodes(); ++i) {
    const auto at = std::lower_bound(pieces_.begin(), pieces_.end(), cut.owner(part, node(i)).piece);
    const bool is_here = at != pieces_.end() && *at == cut.owner(part, node(i)).piece;
    owner_.push_back(is_here ? static_cast<int>(at - pieces_.begin()) : -1);
  }
}

// The cells of a piece are in the order of the part's.
std::vector<std::vector<int>> PartView::pieces_of_cells(const Cut& cut, const Mesh& whole) const {
  struct Next {
    size_t block = 0;
    int cell = 0;
  };
  std::vector<Next> next(pieces_.size());
  const auto is_next = [&](size_t k, CellType type, const int* cell) {
    const CutPiece& piece = cut.piece(pieces_[k]);
    const std::vector<CellBlock>& blocks = piece.body->mesh->blocks;
    Next& at = next[k];
    if (at.block < blocks.size() && at.cell == blocks[at.block].n_cells()) at = {at.block + 1, 0};
    if (at.block == blocks.size() || blocks[at.block].type != type) return false;
    const int* own = blocks[at.block].cell(at.cell);
    const int n = nodes_per_cell(type);
    if (!std::equal(own, own + n, cell, [&](int a, int b) { return piece.node(a) == b; })) return false;
    ++at.cell;
    return true;
  };
  std::vector<std::vector<int>> found;
  for (const CellBlock& block : whole.blocks) {
    std::vector<int>& of_block = found.emplace_back(static_cast<size_t>(block.n_cells()), -1);
    for (int i = 0; i < block.n_cells(); ++i)
      for (size_t k = 0; k < pieces_.size() && of_block[static_cast<size_t>(i)] < 0; ++k)
        if (is_next(k, block.type, block.cell(i))) of_block[static_cast<size_t>(i)] = static_cast<int>(k);
  }
  return found;
}

std::vector<int> PartView::all_nodes() const {
  if (!is_whole() || is_empty()) return nodes_;
  std::vector<int> all(static_cast<size_t>(mesh_->n_nodes()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<double> PartView::sums(const std::vector<Vec>& of_cells) const {
  std::vector<double> sums(pieces_.size(), 0.0);
  for (size_t b = 0; b < of_cells.size(); ++b) {
    if (of_cells_.empty()) {
      sums.front() += of_cells[b].sum();
      continue;
    }
    std::vector<std::vector<double>> of_pieces(pieces_.size());
    for (size_t i = 0; i < of_cells_[b].size(); ++i)
      if (const int piece = of_cells_[b][i]; piece >= 0)
        of_pieces[static_cast<size_t>(piece)].push_back(of_cells[b][static_cast<Eigen::Index>(i)]);
    for (size_t k = 0; k < sums.size(); ++k) sums[k] += sum_of(of_pieces[k]);
  }
  return sums;
}

PartView::Shown PartView::shown() const {
  if (is_whole()) return {mesh_, all_nodes()};
  std::vector<std::vector<char>> is_here;
  for (const std::vector<int>& of_block : of_cells_) {
    std::vector<char>& here = is_here.emplace_back();
    for (const int piece : of_block) here.push_back(piece >= 0);
  }
  auto [mesh, nodes] = some_cells(*mesh_, is_here);
  return {std::move(mesh), std::move(nodes)};
}

void PartViews::prepare(const CutPtr& cut) {
  if (cut_) return;
  cut_ = cut;
  std::vector<std::vector<int>> nodes;
  for (size_t i = 0; i < problem_.substructures.size(); ++i) {
    views_.emplace_back(*cut, static_cast<int>(i), problem_.substructures[i]->mesh);
    nodes.push_back(views_.back().all_nodes());
  }
  nodes_ = WatchedNodes(*cut, std::move(nodes));
}

void PartViews::take(const Instant& instant, NodalField field) {
  prepare(instant.model.cut);
  nodes_.take(instant, field);
  for (size_t part = 0; part < problem_.substructures.size(); ++part) {
    const Mesh& mesh = *problem_.substructures[part]->mesh;
    if (mesh.has_cells() || views_[part].is_empty()) continue;
    std::vector<int> no_places;
    for (int node = 0; node < mesh.n_nodes(); ++node)
      if (!mesh.inside->is_place(node)) no_places.push_back(node);
    nodes_.clear(static_cast<int>(part), no_places);
  }
}

}  // namespace dygita

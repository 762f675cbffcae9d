#include "partition/cut.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "interfaces/surfaces.hpp"
#include "partition/cut_mesh.hpp"
#include "partition/share_out.hpp"

namespace dygita {

namespace {

// The automatic cut (manual, cutting): a substructure that holds more than half of all unknowns would leave other
// threads idle, one too large would take long to factorise and much memory. Others are left whole: products with what a
// cut adds to the interface cost more than the cut spares.
constexpr double largest_piece = 150e3;  // unknowns
constexpr int pieces_of_the_dominant = 4;

// Nodes of each side of an interface whose faces do not match.
std::vector<std::vector<int>> together(const std::vector<Surface>* surfaces, int part) {
  std::vector<std::vector<int>> sets;
  for (size_t s = 0; surfaces && s < surfaces->size(); ++s) {
    const Surface& surface = (*surfaces)[s];
    if (surface.facing.matches()) continue;
    if (surface.wall && surface.facing.is_of_sums()) {
      for (const auto& [own, trace] :
           {std::pair{surface.part_1, &surface.facing.side_1}, std::pair{surface.part_2, &surface.facing.side_2}})
        if (own == part) sets.push_back(trace->on_its_nodes().second);
      continue;
    }
    if (surface.part_1 == part) sets.push_back(nodes_of(surface.facing.facets_1));
    if (surface.part_2 == part) sets.push_back(nodes_of(surface.facing.facets_2));
  }
  return sets;
}

}  // namespace

NodesOnCuts::NodesOnCuts(std::vector<std::pair<int, Copy>> copies) {
  std::stable_sort(copies.begin(), copies.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  nodes_.reserve(copies.size());
  first_.clear();
  copies_.reserve(copies.size());
  for (const auto& [node, copy] : copies) {
    if (nodes_.empty() || nodes_.back() != node) {
      nodes_.push_back(node);
      first_.push_back(copies_.size());
    }
    copies_.push_back(copy);
  }
  first_.push_back(copies_.size());
}

std::span<const Copy> NodesOnCuts::others_of(int node) const {
  const auto at = std::lower_bound(nodes_.begin(), nodes_.end(), node);
  if (at == nodes_.end() || *at != node) return {};
  return others(static_cast<size_t>(at - nodes_.begin()));
}

Cut::Cut(const Problem& problem, const std::vector<int>& n_pieces, const std::vector<Surface>* surfaces) {
  const int n = static_cast<int>(problem.substructures.size());
  owner_.resize(n);
  on_cuts_.resize(n);
  for (int part = 0; part < n; ++part) {
    first_.push_back(static_cast<int>(pieces_.size()));
    const SubstructurePtr& body = problem.substructures[part];
    std::vector<int> piece_of_cell;
    if (n_pieces[part] > 1) piece_of_cell = piece_of_cells(*body->mesh, n_pieces[part], together(surfaces, part));
    if (n_pieces[part] > 1 && *std::max_element(piece_of_cell.begin(), piece_of_cell.end()) > 0)
      add_cut(part, body, piece_of_cell);
    else
      pieces_.push_back({part, body, {}, {}, {}});
  }
  first_.push_back(static_cast<int>(pieces_.size()));
}

void Cut::add_cut(int part, const SubstructurePtr& body, const std::vector<int>& piece_of_cell) {
  std::vector<MeshPiece> meshes = cut_mesh(*body->mesh, piece_of_cell);
  const int n_nodes = body->mesh->n_nodes(), first = first_[part];
  std::vector<double> n_cells(n_nodes, 0.0);
  for (const CellBlock& block : body->mesh->blocks)
    for (const int node : block.nodes) n_cells[node] += 1.0;
  owner_[part].assign(n_nodes, Copy{-1, -1, 0.0});
  std::vector<std::pair<int, Copy>> others;
  for (size_t m = 0; m < meshes.size(); ++m) {
    MeshPiece& mesh = meshes[m];
    auto own = std::make_shared<Substructure>(*body);
    own->mesh = mesh.mesh;
    std::vector<double> share(mesh.nodes.size(), 0.0);
    for (const CellBlock& block : mesh.mesh->blocks)
      for (const int node : block.nodes) share[node] += 1.0 / n_cells[mesh.nodes[node]];
    std::vector<char> is_owner(mesh.nodes.size(), 0);
    for (size_t i = 0; i < mesh.nodes.size(); ++i) {
      const Copy copy{first + static_cast<int>(m), static_cast<int>(i), share[i]};
      Copy& owner = owner_[part][mesh.nodes[i]];
      is_owner[i] = owner.piece < 0;
      if (is_owner[i])
        owner = copy;
      else
        others.emplace_back(mesh.nodes[i], copy);
    }
    pieces_.push_back({part, std::move(own), std::move(mesh.nodes), std::move(is_owner), std::move(mesh.cut_areas)});
  }
  on_cuts_[part] = NodesOnCuts(std::move(others));
  // A piece may touch another in an edge or a corner alone: an area as of a cell's side.
  for (size_t p = first; p < pieces_.size(); ++p) {
    CutPiece& piece = pieces_[p];
    double side = 0.0;
    for (size_t i = 0; i < piece.nodes.size(); ++i) {
      double& area = piece.cut_areas[static_cast<Eigen::Index>(i)];
      if (area != 0.0 || on_cuts_[part].others_of(piece.nodes[i]).empty()) continue;
      if (side == 0.0) side = std::pow(volume(*piece.body->mesh) / piece.body->mesh->n_nodes(), 2.0 / 3.0);
      area = side;
    }
  }
}

std::vector<int> Cut::counts() const {
  std::vector<int> counts;
  for (size_t part = 0; part + 1 < first_.size(); ++part) counts.push_back(n_pieces(static_cast<int>(part)));
  return counts;
}

std::vector<MachineArray> Cut::arrays() const {
  std::vector<MachineArray> arrays;
  for (const std::vector<Copy>& owners : owner_) arrays.push_back(machine_array(owners));
  for (const CutPiece& piece : pieces_)
    for (const MachineArray& array :
         {machine_array(piece.nodes), machine_array(piece.is_owner), machine_array(piece.cut_areas)})
      arrays.push_back(array);
  for (const NodesOnCuts& nodes : on_cuts_)
    for (const MachineArray& array : nodes.arrays()) arrays.push_back(array);
  return arrays;
}

std::vector<Copy> Cut::copies(int part, int node) const {
  std::vector<Copy> copies{owner(part, node)};
  const std::span<const Copy> others = on_cuts_[part].others_of(node);
  copies.insert(copies.end(), others.begin(), others.end());
  return copies;
}

std::map<int, Cut::OnOwner> Cut::on_owners(int part, const std::vector<int>& nodes) const {
  std::map<int, OnOwner> on;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const Copy copy = owner(part, nodes[i]);
    OnOwner& piece = on[copy.piece];
    piece.nodes.push_back(copy.node);
    piece.at.push_back(static_cast<int>(i));
  }
  return on;
}

Points Cut::on_piece(int piece, const Points& nodal) const {
  const CutPiece& p = pieces_[piece];
  if (p.is_whole()) return nodal;
  Points own(3, static_cast<Eigen::Index>(p.nodes.size()));
  for (Eigen::Index i = 0; i < own.cols(); ++i) own.col(i) = nodal.col(p.nodes[i]);
  return own;
}

Points Cut::on_owners(int piece, const Points& nodal) const {
  Points own = on_piece(piece, nodal);
  keep_owned(piece, own);
  return own;
}

void Cut::keep_owned(int piece, Points& on_piece) const {
  const CutPiece& p = pieces_[piece];
  for (Eigen::Index i = 0; i < on_piece.cols() && !p.is_whole(); ++i)
    if (!p.is_owner[i]) on_piece.col(i).setZero();
}

CutPtr no_cut(const Problem& problem) {
  return std::make_shared<const Cut>(problem, std::vector<int>(problem.substructures.size(), 1));
}

int most_pieces(const Problem& problem, int part) {
  constexpr int least_cells = 8;
  // Mass that contact nodes give to those behind them would have to cross the cut.
  if (problem.mass().is_moved_from_contact) return 1;
  return std::max(1, problem.substructures[part]->mesh->n_cells() / least_cells);
}

std::vector<int> usual_pieces(const Problem& problem) {
  double all = 0.0;
  for (const SubstructurePtr& part : problem.substructures) all += 3.0 * part->mesh->n_nodes();
  std::vector<int> n_pieces;
  for (size_t i = 0; i < problem.substructures.size(); ++i) {
    const double unknowns = 3.0 * problem.substructures[i]->mesh->n_nodes();
    int wanted = problem.solver.pieces;
    if (wanted == 0 && unknowns >= smallest_cut) {
      wanted = static_cast<int>(std::ceil(unknowns / largest_piece));
      if (unknowns > 0.5 * all) wanted = std::max(pieces_of_the_dominant, wanted);
    }
    n_pieces.push_back(std::min(std::max(1, wanted), most_pieces(problem, static_cast<int>(i))));
  }
  return n_pieces;
}

CutPtr make_cut(const Problem& problem, const std::vector<Surface>& surfaces, const SharePlan& plan) {
  auto cut = std::make_shared<Cut>(problem, plan.n_pieces.empty() ? usual_pieces(problem) : plan.n_pieces, &surfaces);
  share_out(problem, surfaces, plan, *cut);
  return cut;
}

}  // namespace dygita

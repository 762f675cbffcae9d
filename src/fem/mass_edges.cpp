#include "fem/mass_edges.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "fem/cell_loop.hpp"
#include "numerics/panel_choice.hpp"

namespace dygita {

namespace {

constexpr std::array<std::array<int, 2>, 12> hex8_edges{
    {{0, 1}, {3, 2}, {4, 5}, {7, 6}, {0, 3}, {1, 2}, {4, 7}, {5, 6}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

struct Edge {
  int from, to;
  double mass;
};

// Along an edge, between two halves of the mass that the cell has there, consistent mass takes a sixth of it.
void add_edges(const Mesh& mesh, const CellBlock& block, const Elastic& material, const std::vector<char>& keeps_lumped,
               std::vector<Edge>& edges) {
  for (int i = 0; i < block.n_cells(); ++i) {
    const int* nodes = block.cell(i);
    if (!keeps_lumped.empty() && std::any_of(nodes, nodes + 8, [&](int node) { return keeps_lumped[node]; })) continue;
    const Eigen::Matrix<double, 8, 1> mass = material.density * node_volumes<Hex8>(gather<8>(mesh.nodes, nodes));
    for (const auto& [a, b] : hex8_edges) {
      const auto [from, to] = std::minmax(nodes[a], nodes[b]);
      edges.push_back({from, to, (mass[a] + mass[b]) / 6.0});
    }
  }
}

}  // namespace

CellEdges::CellEdges(const Mesh& mesh, const Elastic& material, const std::vector<char>& keeps_lumped) {
  std::vector<Edge> of_cells;
  for (const CellBlock& block : mesh.blocks)
    if (block.type == CellType::hex8) add_edges(mesh, block, material, keeps_lumped, of_cells);
  // By their lower node, where those of several cells are added up in the order of the cells.
  std::vector<size_t> ends(static_cast<size_t>(mesh.n_nodes()) + 1, 0);
  for (const Edge& edge : of_cells) ++ends[static_cast<size_t>(edge.from) + 1];
  for (size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  std::vector<Edge> sorted(of_cells.size());
  std::vector<size_t> next(ends.begin(), ends.end() - 1);
  for (const Edge& edge : of_cells) sorted[next[static_cast<size_t>(edge.from)]++] = edge;
  starts.push_back(0);
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    const auto begin = sorted.begin() + static_cast<long>(ends[static_cast<size_t>(node)]),
               end = sorted.begin() + static_cast<long>(ends[static_cast<size_t>(node) + 1]);
    std::stable_sort(begin, end, [](const Edge& a, const Edge& b) { return a.to < b.to; });
    for (auto it = begin; it != end; ++it) {
      if (it != begin && it->to == others.back()) {
        masses.back() += it->mass;
        continue;
      }
      others.push_back(it->to);
      lengths.push_back((mesh.nodes.col(node) - mesh.nodes.col(it->to)).norm());
      masses.push_back(it->mass);
    }
    starts.push_back(static_cast<int>(others.size()));
  }
}

// Linear cells with lumped mass turn a wave by (k h)^2 / 24 too little along an edge, those with consistent mass by as
// much too much, an explicit increment by (w dt)^2 / 24 too much.
MassEdges::MassEdges(const CellEdges& edges, double speed, double dt) {
  const size_t n = edges.starts.size() - 1;
  starts_.assign(n + 1, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (size_t a = 0; a < n; ++a)
      for (int e = edges.starts[a]; e < edges.starts[a + 1]; ++e)
        visit(static_cast<int>(a), edges.others[static_cast<size_t>(e)], static_cast<size_t>(e));
  };
  for_each_edge([&](int a, int b, size_t) {
    ++starts_[static_cast<size_t>(a) + 1];
    ++starts_[static_cast<size_t>(b) + 1];
  });
  for (size_t a = 0; a < n; ++a) starts_[a + 1] += starts_[a];
  others_.resize(2 * edges.others.size());
  values_.resize(others_.size());
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  for_each_edge([&](int a, int b, size_t e) {
    const double cfl = speed * dt / edges.lengths[e];
    const auto value = static_cast<float>(std::max(0.0, 0.5 - 0.5 * cfl * cfl) * edges.masses[e]);
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      const auto at = static_cast<size_t>(next[static_cast<size_t>(from)]++);
      others_[at] = to;
      values_[at] = value;
    }
  });
}

void MassEdges::add_product(const double* x, double* y) const {
  if (!empty()) panel_kernels().add_scalar_edge_product(view(), x, y);
}

void MassEdges::move_nodes(const NodeMotion& motion, const double* x, double* product) const {
  panel_kernels().move_nodes(motion, view(), x, product);
}

}  // namespace dygita

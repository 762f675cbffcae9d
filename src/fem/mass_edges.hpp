// What a tuned mass has beyond the lumped one in explicit increments, by the edges of hexahedra: C of the manual's
// eq. S13, a mass for the difference of the two ends of each edge.
#pragma once

#include <vector>

#include "material/elastic.hpp"
#include "mesh/mesh.hpp"
#include "numerics/panel_kernels.hpp"

namespace dygita {

// Edges of hexahedra, each once, at the lower of its two nodes.
struct CellEdges {
  std::vector<int> starts, others;
  std::vector<double> lengths, masses;  // m; kg: what consistent mass would take, over the cells around the edge

  // keeps_lumped: one entry a node, or empty; cells with such a node count for nothing.
  CellEdges(const Mesh& mesh, const Elastic& material, const std::vector<char>& keeps_lumped);
};

// In single precision; a translation has none, as in EdgeBlocks, whose fields these are.
class MassEdges {
 public:
  MassEdges() = default;  // none: the mass is lumped
  // Tuned to waves of that speed (m/s), in increments of dt (s).
  MassEdges(const CellEdges& edges, double speed, double dt);

  bool empty() const { return others_.empty(); }
  // y += C x, both 4 n long.
  void add_product(const double* x, double* y) const;
  // Moves the nodes by it, too: in one pass over them. product: C x.
  void move_nodes(const NodeMotion& motion, const double* x, double* product) const;
  double bytes() const { return 4.0 * static_cast<double>(starts_.size() + others_.size() + values_.size()); }
  // For about as many edges as a mesh of hexahedra has.
  static double bytes_of(double n_nodes) { return 4.0 * (1.0 + 2.0 * 6.0) * n_nodes; }

 private:
  NodeEdgeView view() const {
    return {starts_.data(), others_.data(), values_.data(), static_cast<int>(starts_.size()) - 1};
  }

  // Each edge at both of its nodes.
  std::vector<int> starts_, others_;
  std::vector<float> values_;  // kg
};

}  // namespace dygita

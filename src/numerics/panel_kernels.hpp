// The arithmetic of panels (panels.hpp) and of products by edges, compiled once for each kind of processor and chosen
// at its start (panel_choice.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace dygita {

namespace panel {
constexpr int width = 8;      // most columns of a panel
constexpr int height = 16;    // rows of a tile
constexpr int together = 16;  // most right-hand sides side by side
enum Kind { full, float_32, int_16, int_8, n_kinds };

struct Tile {
  int row;      // of the panel, where it starts
  float scale;  // of the integers
};

// One panel, as it lies in memory: tiles kind by kind, each column-major, without gaps.
struct View {
  const std::byte* data;
  const Tile* tiles;
  int n_columns;
  const int* count;                 // tiles of each kind, in this order; the first tile of the panel leads
  const std::byte* next = nullptr;  // of the panel that is read after this one, where that is not the one behind it
};
}  // namespace panel

// A symmetric matrix of 3x3 blocks whose rows add up to zero, without its diagonal blocks: those above it, node by
// node, row-major and followed by two numbers that are read and not used.
struct EdgeView {
  const int* starts;  // of the blocks of each node
  const int* others;  // the node at the other end of each
  const float* blocks;
  int n_nodes;
};

// The same with one number an edge for a block, and each edge at both of its nodes.
struct NodeEdgeView {
  const int* starts;
  const int* others;
  const float* values;
  int n_nodes;
};

// Velocities and displacements of nodes in an increment, four numbers each: V = keep V - (pull + C x) / D, U += dt V.
struct NodeMotion {
  double keep, dt;
  const double* inverse;  // of D, one number a node
  const double* pull;
  double *v, *d;
};

// What is done with a panel; see the functions of Panels for what each means.
struct PanelKernels {
  const char* name;  // "avx512", "avx2" or "generic"
  void (*forward)(const panel::View&, double* y);
  void (*backward)(const panel::View&, double* y);
  // n = 1 or 2: 8 n right-hand sides
  void (*forward_many)(const panel::View&, double* y, int n);
  void (*backward_many)(const panel::View&, double* y, int n);
  void (*multiply_double)(const panel::View&, const double* x, double* y);
  void (*multiply_single)(const panel::View&, const float* x, double* y);
  // 16 right-hand sides, of panels in single precision: what is to be added to y, or y itself, is in single precision
  // too (Panels)
  void (*forward_sixteen)(const panel::View&, double* y, float* below);
  void (*backward_sixteen)(const panel::View&, double* y, float* rows);
  void (*multiply_double_sixteen)(const panel::View&, const double* x, double* y);
  void (*multiply_single_sixteen)(const panel::View&, const float* x, float* below, double* y);
  // y += K x, four numbers a node, of which the last of x is zero and of y is left alone
  void (*add_edge_product)(const EdgeView&, const double* x, double* y);
  // y += C x, of a matrix of one number an edge
  void (*add_scalar_edge_product)(const NodeEdgeView&, const double* x, double* y);
  // the same with nodes that move by it, in one pass; product: C x
  void (*move_nodes)(const NodeMotion&, const NodeEdgeView&, const double* x, double* product);
};

}  // namespace dygita

// The arithmetic of panels (panels.hpp), compiled once for each kind of processor and chosen at its start
// (panel_choice.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace dygita {

namespace panel {
constexpr int width = 8;    // most columns of a panel
constexpr int height = 16;  // rows of a tile
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
  const int* count;  // tiles of each kind, in this order; the first tile of the panel leads
};
}  // namespace panel

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
};

}  // namespace dygita

// Dense panels of a triangular or symmetric matrix, cut into tiles that each take as few bytes as their size asks for.
#pragma once

#include <cstddef>
#include <vector>

#include "numerics/huge_pages.hpp"
#include "numerics/panel_kernels.hpp"
#include "numerics/types.hpp"

namespace dygita {

// Memory that grows without being moved: what has been written is not copied, and nobody clears what is not written.
class Chunks {
 public:
  // Room for n bytes behind what is in use, which the next call gives again unless they are taken.
  std::byte* room(size_t n);
  void take(size_t n) { used_ += n, taken_ += n; }
  size_t size() const { return taken_; }  // bytes taken
  // Gives all back, but for room for as much in one piece.
  void clear();

 private:
  std::vector<UntouchedPages> chunks_;
  size_t capacity_ = 0, used_ = 0, taken_ = 0;  // of the last chunk; of all
};

// A panel has up to 8 columns and any number of rows; its tiles are 16 rows of it, column-major. The first tile, with
// the triangle, is stored in full. Of the others, in single precision, each is stored in float, in 16 or 8 bits with a
// scale, or not at all, whichever is the shortest that keeps the error of every entry below the tolerance of its rows:
// entries far from the diagonal are small (manual, what is stored). There products of 16 tiles at most are summed in
// single precision, all longer sums in double.
class Panels {
 public:
  static constexpr int width = panel::width, height = panel::height, together = panel::together;

  explicit Panels(Precision precision = Precision::double_precision) : precision_(precision) {}

  // values: column-major, n_rows x n_columns, `stride` apart; top: the first n_columns rows of it, `n_columns` apart,
  // which are not read in `values`. tolerance: largest error allowed in each row (single precision).
  void add(const double* top, const double* values, int stride, int n_rows, int n_columns, const double* tolerance);
  size_t size() const { return panels_.size(); }
  void clear();
  Precision precision() const { return precision_; }
  double bytes() const;

  // All vectors are of the panel's rows and have room for `height` more behind them.
  // Forward substitution: solves with the triangle for the first n_columns of y (pivots are stored inverted), takes the
  // rows below off.
  void forward(size_t panel, double* y) const;
  // Backward substitution: the first n_columns of y from the rows below. next: the panel that is read after this one.
  void backward(size_t panel, size_t next, double* y) const;
  // The same for 8 n right-hand sides at once (n = 1 or 2): y holds 8 n values per row.
  void forward(size_t panel, double* y, int n) const;
  void backward(size_t panel, double* y, int n) const;
  // y += A x and, for what lies below the first tile, the transposed part: y[0..n_columns) += A^T x. The first tile is
  // square in effect: it must hold both triangles.
  void multiply_symmetric(size_t panel, const double* x, double* y) const;
  // The same in single precision, for panels stored so; sums of more than 16 tiles are in double.
  void multiply_symmetric(size_t panel, const float* x, double* y) const;
  // Sixteen right-hand sides at once, 16 values per row, of panels in single precision. below: what other panels have
  // left to be added to y and this one leaves, so that the sums of at most 16 panels are in single precision; rows: y
  // in single precision, where the columns of this panel are added.
  void forward(size_t panel, double* y, float* below) const;
  void backward(size_t panel, double* y, float* rows) const;
  // y, or y and what is left to be added to it, += A x; in double or in single precision.
  void multiply_together(size_t panel, const double* x, double* y) const;
  void multiply_together(size_t panel, const float* x, float* below, double* y) const;
  // The panel as a dense matrix, column-major, `stride` apart.
  void unpack(size_t panel, double* values, int stride) const;

 private:
  struct Panel {
    const std::byte* data;
    size_t tiles;
    int n_rows, n_columns;
    int count[panel::n_kinds];
  };
  panel::View view(const Panel& panel) const {
    return {panel.data, tiles_.data() + panel.tiles, panel.n_columns, panel.count};
  }
  panel::Kind kind_of(double largest, double tolerance) const;

  Precision precision_;
  std::vector<Panel> panels_;
  std::vector<panel::Tile> tiles_;
  Chunks data_;
};

// Bytes of a panel in double precision.
double panel_bytes(int n_rows, int n_columns);

}  // namespace dygita

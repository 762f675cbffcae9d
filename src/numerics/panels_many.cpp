// Substitutions with several right-hand sides side by side.
#include "numerics/panel_tiles.hpp"
#include "numerics/panels.hpp"

namespace dygita {

namespace {

// With several right-hand sides a tile keeps the processor busy for so long that it does not look ahead by itself.
template <class T>
void fetch_ahead(const T* tile, int n) {
  const auto* next = reinterpret_cast<const char*>(tile + 2 * Panels::height * n);
  for (size_t i = 0; i < sizeof(T) * Panels::height * n; i += 64) __builtin_prefetch(next + i);
}

// A tile in double precision, scale included.
template <class T>
const double* decoded(const T* tile, double scale, int n, double* buffer) {
  if constexpr (std::is_same_v<T, double>) return tile;
  for (int i = 0; i < n * Panels::height; i += lanes) store(scale * load(tile + i), buffer + i);
  return buffer;
}

}  // namespace

void Panels::forward(size_t i_panel, double* y, int n_vectors) const {
  const auto solve = [&](auto n, auto vectors) {
    constexpr int columns = n, m = vectors, stride = m * lanes;
    Lanes x[columns][m];
    alignas(64) double buffer[width * height];
    for_each_tile(panels_[i_panel], [&](const auto* entries, const Tile& tile) {
      fetch_ahead(entries, columns);
      const double* a = decoded(entries, tile.scale, columns, buffer);
      double* rows = y + static_cast<size_t>(tile.row) * stride;
      if (tile.row == 0) {
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) x[c][v] = load(rows + c * stride + v * lanes);
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) {
            x[c][v] *= a[c * height + c];
            for (int r = c + 1; r < columns; ++r) x[r][v] -= a[c * height + r] * x[c][v];
          }
      }
      constexpr int together = 4;
      Lanes at[columns][m];  // a copy that can stay in registers
      for (int c = 0; c < columns; ++c)
        for (int v = 0; v < m; ++v) at[c][v] = x[c][v];
      for (int r = 0; r < height; r += together) {
        Lanes sums[together][m];
        for (int i = 0; i < together; ++i)
          for (int v = 0; v < m; ++v) sums[i][v] = load(rows + (r + i) * stride + v * lanes);
        for (int c = 0; c < columns; ++c)
          for (int i = 0; i < together; ++i)
            for (int v = 0; v < m; ++v) sums[i][v] -= a[c * height + r + i] * at[c][v];
        for (int i = 0; i < together; ++i)
          for (int v = 0; v < m; ++v) store(sums[i][v], rows + (r + i) * stride + v * lanes);
      }
      if (tile.row == 0)
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) store(x[c][v], rows + c * stride + v * lanes);
    });
  };
  with_width(panels_[i_panel].n_columns, [&](auto n) {
    if (n_vectors == 1)
      solve(n, std::integral_constant<int, 1>{});
    else
      solve(n, std::integral_constant<int, 2>{});
  });
}

void Panels::backward(size_t i_panel, double* y, int n_vectors) const {
  const auto solve = [&](auto n, auto vectors) {
    constexpr int columns = n, m = vectors, stride = m * lanes;
    Lanes sums[columns][m] = {};
    alignas(64) double buffer[width * height], first[width * height];
    const double* triangle = nullptr;
    for_each_tile(panels_[i_panel], [&](const auto* entries, const Tile& tile) {
      fetch_ahead(entries, columns);
      if (tile.row == 0) triangle = decoded(entries, 1.0, columns, first);
      const double* a = tile.row == 0 ? triangle : decoded(entries, tile.scale, columns, buffer);
      const double* rows = y + static_cast<size_t>(tile.row) * stride;
      Lanes own[columns][m] = {};  // sums that can stay in registers
      for (int r = tile.row == 0 ? columns : 0; r < height; ++r) {
        Lanes here[m];
        for (int v = 0; v < m; ++v) here[v] = load(rows + r * stride + v * lanes);
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) own[c][v] += a[c * height + r] * here[v];
      }
      for (int c = 0; c < columns; ++c)
        for (int v = 0; v < m; ++v) sums[c][v] += own[c][v];
    });
    for (int c = columns; c-- > 0;)
      for (int v = 0; v < m; ++v) {
        Lanes x = load(y + c * stride + v * lanes) - sums[c][v];
        for (int r = c + 1; r < columns; ++r) x -= triangle[c * height + r] * load(y + r * stride + v * lanes);
        store(triangle[c * height + c] * x, y + c * stride + v * lanes);
      }
  };
  with_width(panels_[i_panel].n_columns, [&](auto n) {
    if (n_vectors == 1)
      solve(n, std::integral_constant<int, 1>{});
    else
      solve(n, std::integral_constant<int, 2>{});
  });
}

}  // namespace dygita

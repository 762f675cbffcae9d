// The tiles of a panel, one after the other. Part of panel_arithmetic.hpp: the same rules hold.
#pragma once

#include <type_traits>

#include "numerics/kernels/registers.hpp"

namespace dygita::DYGITA_ISA {

namespace {

// Calls f with the number of columns as a constant.
template <class Function>
inline void with_width(int n, Function&& f) {
  switch (n) {
    case 1:
      return f(std::integral_constant<int, 1>{});
    case 2:
      return f(std::integral_constant<int, 2>{});
    case 3:
      return f(std::integral_constant<int, 3>{});
    case 4:
      return f(std::integral_constant<int, 4>{});
    case 5:
      return f(std::integral_constant<int, 5>{});
    case 6:
      return f(std::integral_constant<int, 6>{});
    case 7:
      return f(std::integral_constant<int, 7>{});
    default:
      return f(std::integral_constant<int, 8>{});
  }
}

// The tiles of a panel after its first, kind by kind: f(entries, tile).
template <int n, class Function>
inline void for_each_below(const View& view, Function&& f) {
  const std::byte* at = view.data;
  const Tile* tile = view.tiles;
  const auto run = [&](int count, bool has_first, auto zero) {
    using T = decltype(zero);
    constexpr size_t bytes = sizeof(T) * height * n;
    for (int i = 0; i < count; ++i, ++tile, at += bytes)
      if (i > 0 || !has_first) f(reinterpret_cast<const T*>(at), *tile);
  };
  run(view.count[panel::full], true, 0.0);
  run(view.count[panel::float_32], view.count[panel::full] == 0, 0.0f);
  run(view.count[panel::int_16], false, std::int16_t{0});
  run(view.count[panel::int_8], false, std::int8_t{0});
}

// The first tile, which holds the triangle: f(entries), of double or float.
template <class Function>
inline void with_first(const View& view, Function&& f) {
  if (view.count[panel::full] > 0)
    f(reinterpret_cast<const double*>(view.data));
  else
    f(reinterpret_cast<const float*>(view.data));
}

}  // namespace

}  // namespace dygita::DYGITA_ISA

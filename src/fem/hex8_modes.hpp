// How many enhanced strain modes a Hex8 has: 9 amplitudes a_j and 3 amplitudes b (hex8.cpp).
#pragma once

namespace dygita {

inline constexpr int n_hex8_modes = 12;

}  // namespace dygita

// Numbers of several cells side by side, as wide as the processor's registers.
#pragma once

namespace dygita {

#if defined(__AVX512F__)
constexpr int n_lanes = 8;
#elif defined(__AVX__)
constexpr int n_lanes = 4;
#else
constexpr int n_lanes = 2;
#endif
typedef double Lanes __attribute__((vector_size(8 * n_lanes)));

// values[at[lane]] side by side.
inline Lanes load_lanes(const double* values, const int* at) {
#if defined(__AVX512F__)
  return Lanes{values[at[0]], values[at[1]], values[at[2]], values[at[3]],
               values[at[4]], values[at[5]], values[at[6]], values[at[7]]};
#elif defined(__AVX__)
  return Lanes{values[at[0]], values[at[1]], values[at[2]], values[at[3]]};
#else
  return Lanes{values[at[0]], values[at[1]]};
#endif
}

}  // namespace dygita

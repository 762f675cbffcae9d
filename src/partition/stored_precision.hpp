// In which precision the factors and interface operators of dynamic steps are stored.
#pragma once

#include "model/model.hpp"

namespace dygita {

// Of a substructure of so many unknowns: what the deck asks for, or single where that is faster and the tolerance
// and the window allow it. A solve then reads a third from memory, and an interface product less; nothing is gained in
// a substructure that the nearest caches hold. Within a window what rounding leaves of an increment continues to the
// next.
inline Precision stored_precision(const LatinSettings& solver, double n_unknowns) {
  constexpr double large = 1000.0, finest_tolerance = 1e-7;
  constexpr int longest_window = 5;
  if (solver.precision) return *solver.precision;
  const bool is_long = solver.window == 0 || solver.window > longest_window;  // 0: the whole step
  return n_unknowns > large && solver.tolerance >= finest_tolerance && !is_long ? Precision::single_precision
                                                                                : Precision::double_precision;
}

}  // namespace dygita

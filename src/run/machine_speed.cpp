#include "run/machine_speed.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/team.hpp"
#include "base/thread_time.hpp"
#include "numerics/repeated_factor.hpp"

namespace dygita {

namespace {

// Like a cube of hexahedra: three unknowns a node, each node coupled with its 26 neighbours.
SparseMatrix cube_matrix(int side, std::vector<int>& node_of_dof) {
  const int n = side * side * side;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(n) * 27 * 9);
  const auto node_at = [&](int i, int j, int k) { return (k * side + j) * side + i; };
  for (int k = 0; k < side; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        for (int c = std::max(0, k - 1); c <= std::min(side - 1, k + 1); ++c)
          for (int b = std::max(0, j - 1); b <= std::min(side - 1, j + 1); ++b)
            for (int a = std::max(0, i - 1); a <= std::min(side - 1, i + 1); ++a)
              for (int d = 0; d < 9; ++d) {
                const int row = 3 * node_at(i, j, k) + d / 3, column = 3 * node_at(a, b, c) + d % 3;
                entries.emplace_back(row, column, row == column ? 100.0 : -1.0);
              }
  for (int node = 0; node < n; ++node) node_of_dof.insert(node_of_dof.end(), 3, node);
  SparseMatrix matrix(3 * n, 3 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double operations_a_second() {
  constexpr int side = 13;
  std::vector<int> nodes;
  const SparseMatrix matrix = cube_matrix(side, nodes);
  RepeatedFactor factor(matrix, nodes, "measurement");
  factor.factorise(matrix);  // brings pages and kernels
  const double start = thread_seconds();
  factor.factorise(matrix);
  return factor.operations() / (thread_seconds() - start);
}

double bytes_a_second() {
  constexpr size_t n = 1 << 22;  // more than caches hold
  constexpr int times = 4;
  const std::vector<double> values(n, 1.0);
  double sum = 0.0;
  const double start = thread_seconds();
  for (int i = 0; i < times; ++i) sum += Eigen::Map<const Vec>(values.data(), static_cast<Eigen::Index>(n)).sum();
  const double taken = thread_seconds() - start;
  return sum > 0.0 ? 8.0 * n * times / taken : 0.0;
}

}  // namespace

const MachineSpeed& machine_speed() {
  static const MachineSpeed speed = [] {
    const int threads = thread_limit();
    set_thread_limit(1);
    const MachineSpeed alone{operations_a_second(), bytes_a_second()};
    set_thread_limit(threads);
    return alone;
  }();
  return speed;
}

std::pair<double, double> time_of(const StepCost& cost, const MachineSpeed& speed, int n_threads) {
  const auto seconds = [&](const Cost& e) { return e.operations / speed.operations + e.bytes / speed.bytes; };
  const double share = 1.0 / std::pow(n_threads, 0.8);  // of a thread, of what they wait for each other less
  const double once = seconds(cost.once), a_round = seconds(cost.a_round);
  return {share * (once + cost.fewest * a_round), share * (once + cost.most * a_round)};
}

std::string in_words(const std::pair<double, double>& seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  const auto [least, most] = seconds;
  const double unit = most < 2.0 * minute ? 1.0 : most < 2.0 * hour ? minute : hour;
  const char* const name = unit == 1.0 ? "s" : unit == minute ? "min" : "h";
  const auto rounded = [&](double s) { return fmt::format("{:.2g}", s / unit); };
  if (rounded(least) == rounded(most)) return fmt::format("about {} {}", rounded(most), name);
  return fmt::format("about {} to {} {}", rounded(least), rounded(most), name);
}

}  // namespace dygita

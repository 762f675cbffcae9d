// Loops over things of which few may cost more than all others together.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/parallel.hpp"

namespace dygita {

// body(i) for all i, of which the costs are known to some degree (any unit): side by side, but for those that would
// keep one thread busy when all others have ended. These are done first, one after the other, by bodies that share
// their own loops among the threads.
template <class Body>
void parallel_by_cost(const std::vector<double>& cost, Body&& body) {
  constexpr double share_of_serial = 1.5;  // what a loop within a body loses beside loops of whole bodies
  std::vector<int> order(cost.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cost[a] > cost[b]; });
  double rest = std::accumulate(cost.begin(), cost.end(), 0.0);
  size_t first = 0;
  for (; first < order.size() && thread_limit() > 1; ++first) {
    const double own = cost[order[first]];
    if (own * thread_limit() <= share_of_serial * rest) break;
    body(order[first]);
    rest -= own;
  }
  parallel_for(static_cast<int>(order.size() - first), [&](int i) { body(order[first + static_cast<size_t>(i)]); });
}

}  // namespace dygita

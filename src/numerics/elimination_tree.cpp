#include "numerics/elimination_tree.hpp"

#include <algorithm>

namespace dygita {

EliminationTree::EliminationTree(const std::vector<SupernodeView>& supernodes, int n_interior)
    : parent(supernodes.size(), -1), children(supernodes.size()) {
  std::vector<int> supernode_of(n_interior);
  const int n = static_cast<int>(supernodes.size());
  for (int s = 0; s < n; ++s) std::fill_n(supernode_of.begin() + supernodes[s].first, supernodes[s].n_columns, s);
  for (int s = 0; s < n; ++s)
    if (supernodes[s].n_below > 0 && supernodes[s].below[0] < n_interior) {
      parent[s] = supernode_of[supernodes[s].below[0]];
      children[parent[s]].push_back(s);
    }
  // From the roots down and children from the last on, read backwards.
  std::vector<int> open;
  for (int s = 0; s < n; ++s)
    if (parent[s] < 0) open.push_back(s);
  while (!open.empty()) {
    const int s = open.back();
    open.pop_back();
    order.push_back(s);
    open.insert(open.end(), children[s].begin(), children[s].end());
  }
  std::reverse(order.begin(), order.end());
}

namespace {

// Each column of the last child's update then goes to one that lies no further on, and so do its rows. Of two children
// the sum is the same whichever comes first; of more it is not.
bool fits_over_last_child(const std::vector<SupernodeView>& supernodes, int s, const std::vector<int>& children) {
  const SupernodeView &own = supernodes[s], &last = supernodes[children.back()];
  if (children.size() > 2 || own.n_below > last.n_below) return false;
  for (int i = 0, at = 0; i < last.n_below; ++i) {
    if (last.below[i] < own.first + own.n_columns) continue;
    while (own.below[at] < last.below[i]) ++at;
    if (at > i) return false;
  }
  return true;
}

}  // namespace

RoomForFronts::RoomForFronts(const EliminationTree& tree, const std::vector<SupernodeView>& supernodes,
                             const std::vector<int>& places, const std::function<size_t(int)>& update_size)
    : is_own(supernodes.size(), 0), is_over_child(supernodes.size(), 0) {
  for (const int place : places) is_own[tree.order[place]] = 1;
  size_t depth = 0;
  for (const int place : places) {
    const int s = tree.order[place];
    const std::vector<int>& children = tree.children[s];
    const SupernodeView& own = supernodes[s];
    columns = std::max(columns, static_cast<size_t>(own.n_columns + own.n_below) * static_cast<size_t>(own.n_columns));
    is_over_child[s] = update_size(s) > 0 && !children.empty() && is_own[children.back()] &&
                       fits_over_last_child(supernodes, s, children);
    waiting = std::max(waiting, depth + (is_over_child[s] ? 0 : update_size(s)));
    for (const int child : children)
      if (is_own[child]) depth -= update_size(child);
    if (tree.parent[s] >= 0) depth += update_size(s);
  }
}

std::vector<TreeBranch> branches_of(const EliminationTree& tree, const std::vector<SupernodeView>& supernodes) {
  constexpr double least_operations = 2e8, largest_share = 0.06, smallest_share = 1e-4;
  const int n = static_cast<int>(tree.order.size());
  std::vector<double> operations(n, 0.0);  // of the subtree
  std::vector<int> size(n, 1), place(n);
  double all = 0.0;
  for (int i = 0; i < n; ++i) {
    const int s = tree.order[i], parent = tree.parent[s];
    const double k = supernodes[s].n_columns, m = supernodes[s].n_below;
    place[s] = i;
    operations[s] += k * (k * k / 3.0 + m * (k + m));
    if (parent < 0) all += operations[s];
    if (parent >= 0) operations[parent] += operations[s], size[parent] += size[s];
  }
  std::vector<TreeBranch> branches;
  if (all < least_operations) return branches;
  std::vector<char> is_taken(n, 0);
  // Roots are left out: what they leave of the rest of the matrix is added in their order.
  for (int i = n; i-- > 0;) {
    const int s = tree.order[i], parent = tree.parent[s];
    const bool is_in_branch = parent >= 0 && is_taken[parent];
    const bool is_branch =
        parent >= 0 && !is_in_branch && operations[s] <= largest_share * all && operations[s] >= smallest_share * all;
    is_taken[s] = is_in_branch || is_branch;
    if (is_branch) branches.push_back({s, place[s] - size[s] + 1, place[s] + 1, operations[s]});
  }
  std::stable_sort(branches.begin(), branches.end(),
                   [](const TreeBranch& a, const TreeBranch& b) { return a.operations > b.operations; });
  return branches;
}

}  // namespace dygita

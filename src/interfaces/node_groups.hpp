// Copies of nodes that move together.
#pragma once

#include <map>
#include <utility>
#include <vector>

namespace dygita {

using NodeKey = std::pair<int, int>;  // (piece, node of the piece)

// Union-find.
class NodeGroups {
 public:
  int add(const NodeKey& key) {
    const auto [it, is_new] = index_.emplace(key, static_cast<int>(parent_.size()));
    if (is_new) {
      parent_.push_back(it->second);
      keys_.push_back(key);
    }
    return it->second;
  }
  void tie(const NodeKey& a, const NodeKey& b) { parent_[root(add(a))] = root(add(b)); }
  int of(const NodeKey& key) { return root(add(key)); }
  const std::vector<NodeKey>& keys() const { return keys_; }

 private:
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::map<NodeKey, int> index_;
  std::vector<int> parent_;
  std::vector<NodeKey> keys_;
};

}  // namespace dygita

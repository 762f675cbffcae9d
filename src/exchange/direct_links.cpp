#include "exchange/direct_links.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "interfaces/node_groups.hpp"

namespace dygita {

void find_direct(const Cut& cut, const std::vector<char>& explicit_pieces, Exchange& exchange) {
  NodeGroups linked;
  std::vector<NodeKey> any(exchange.points.size(), NodeKey{-1, -1});
  const auto is_explicit = [&](const Port& port) { return explicit_pieces[port.piece] != 0; };
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = exchange.ports[p];
      if (!is_explicit(port)) continue;
      for (const int node : piece_nodes(cut, port)) {
        const NodeKey key{port.piece, node};
        if (any[i].first < 0) any[i] = key;
        linked.tie(any[i], key);
      }
    }
  }
  std::map<int, bool> has_implicit;
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    if (any[i].first < 0) continue;
    bool& found = has_implicit[linked.of(any[i])];
    for (int p = point.first_port; p < point.end_port; ++p) found |= !is_explicit(exchange.ports[p]);
  }
  for (size_t i = 0; i < exchange.points.size(); ++i)
    exchange.points[i].is_direct = any[i].first >= 0 && !has_implicit.at(linked.of(any[i]));
}

NearDirect near_direct(const Cut& cut, const Exchange& exchange) {
  const int n = static_cast<int>(exchange.points.size());
  std::vector<int> root(exchange.points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<int, int>, int> first_at;  // by piece and node
  const auto for_each_port = [&](int i, const auto& visit) {
    const Point& point = exchange.points[i];
    for (int p = point.first_port; p < point.end_port && point.is_direct; ++p) visit(exchange.ports[p]);
  };
  for (int i = 0; i < n; ++i)
    for_each_port(i, [&](const Port& port) {
      for (const int node : piece_nodes(cut, port))
        root[find(i)] = find(first_at.emplace(std::pair(port.piece, node), i).first->second);
    });
  std::vector<char> is_near(exchange.points.size(), 0);
  for (int i = 0; i < n; ++i) for_each_port(i, [&](const Port& port) { is_near[find(i)] |= cut.is_here(port.piece); });
  std::map<int, std::set<int>> solving;  // ranks, of near points that share nodes
  for (int i = 0; i < n; ++i)
    for_each_port(i, [&](const Port& port) {
      if (is_near[find(i)]) solving[find(i)].insert(cut.piece(port.piece).rank);
    });
  NearDirect near;
  for (int i = 0; i < n; ++i) near.points.push_back(is_near[find(i)]);
  for (const auto& [at, point] : first_at)
    if (is_near[find(point)]) {
      const std::set<int>& readers = solving.at(find(point));
      near.nodes.push_back({at.first, at.second, {readers.begin(), readers.end()}});
    }
  return near;
}

const std::vector<int>& NearDirect::readers_at(int piece, int node) const {
  const auto at = std::lower_bound(nodes.begin(), nodes.end(), std::pair(piece, node),
                                   [](const Node& a, const auto& b) { return std::pair(a.piece, a.node) < b; });
  CHECK(at != nodes.end() && at->piece == piece && at->node == node, "a node at a point that this rank solves");
  return at->readers;
}

std::vector<int> NearDirect::nodes_of(int piece) const {
  std::vector<int> of_piece;
  auto node = std::lower_bound(nodes.begin(), nodes.end(), piece, [](const Node& a, int b) { return a.piece < b; });
  for (; node != nodes.end() && node->piece == piece; ++node) of_piece.push_back(node->node);
  return of_piece;
}

}  // namespace dygita

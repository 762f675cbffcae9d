#include "solution/direct_links.hpp"

#include <algorithm>
#include <map>

#include "solution/node_groups.hpp"

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

std::vector<int> direct_nodes(const Cut& cut, const Exchange& exchange, int piece) {
  std::vector<int> nodes;
  for (const Point& point : exchange.points)
    for (int p = point.first_port; p < point.end_port && point.is_direct; ++p)
      if (exchange.ports[p].piece == piece)
        for (const int node : piece_nodes(cut, exchange.ports[p])) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace dygita

#include "exchange/near_points.hpp"

#include <algorithm>
#include <numeric>

#include "exchange/direct_links.hpp"
#include "partition/all_pieces.hpp"
#include "ranks/neighbours.hpp"

namespace dygita {

std::vector<int> ranks_at(const Cut& cut, const Exchange& exchange, const Point& point) {
  std::vector<int> ranks;
  if (point.is_everywhere) {
    ranks.resize(static_cast<size_t>(ranks::count()));
    std::iota(ranks.begin(), ranks.end(), 0);
    return ranks;
  }
  for (int p = point.first_port; p < point.end_port; ++p)
    ranks.push_back(cut.piece(exchange.ports[static_cast<size_t>(p)].piece).rank);
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

namespace {

// Of each point: does this rank solve it?
std::vector<char> solved_here(const Cut& cut, const Exchange& exchange) {
  std::vector<char> is_here = near_direct(cut, exchange).points;
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    if (point.is_direct) continue;
    is_here[i] = point.is_everywhere;
    for (int p = point.first_port; p < point.end_port; ++p)
      is_here[i] |= cut.is_here(exchange.ports[static_cast<size_t>(p)].piece);
  }
  return is_here;
}

// What those who have the pieces have numbered.
void receive_numbers(const Cut& cut, Exchange& exchange) {
  std::vector<double> numbers;
  for (const Port& port : exchange.ports) numbers.insert(numbers.end(), port.unknown.begin(), port.unknown.end());
  receive_ports(cut, exchange, 3, numbers.data());
  const double* number = numbers.data();
  for (Port& port : exchange.ports)
    for (int& unknown : port.unknown) unknown = static_cast<int>(*number++);
  const std::vector<double> of_all =
      of_all_pieces(cut, 1, [&](int i, double* to) { *to = exchange.n_unknowns[static_cast<size_t>(i)]; });
  exchange.n_unknowns.assign(of_all.begin(), of_all.end());
}

}  // namespace

void keep_near(const Cut& cut, Exchange& exchange) {
  const std::vector<char> is_kept = solved_here(cut, exchange);
  size_t n_points = 0;
  int n_ports = 0, n_ties = 0;
  for (size_t i = 0; i < is_kept.size(); ++i) {
    if (!is_kept[i]) continue;
    Point point = std::move(exchange.points[i]);
    const int down = point.first_port - n_ports, ties_down = point.first_tie - n_ties;
    for (int p = point.first_port; p < point.end_port; ++p)
      exchange.ports[static_cast<size_t>(n_ports++)] = exchange.ports[static_cast<size_t>(p)];
    for (int t = point.first_tie; t < point.end_tie; ++t) {
      Tie tie = exchange.ties[static_cast<size_t>(t)];
      tie.point = static_cast<int>(n_points);
      tie.port_1 -= down;
      tie.port_2 -= down;
      exchange.ties[static_cast<size_t>(n_ties++)] = tie;
    }
    for (int* at : {&point.first_port, &point.first_port_2, &point.end_port}) *at -= down;
    for (int* at : {&point.first_tie, &point.end_tie}) *at -= ties_down;
    exchange.points[n_points++] = std::move(point);
  }
  exchange.points.resize(n_points);
  exchange.ports.resize(static_cast<size_t>(n_ports));
  exchange.ties.resize(static_cast<size_t>(n_ties));
}

// Ports of points that several ranks solve stand in the same order in each of them.
void receive_ports(const Cut& cut, const Exchange& exchange, int width, double* values) {
  const NearDirect direct = near_direct(cut, exchange);
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (const Point& point : exchange.points) {
    std::vector<int> ranks;
    if (!point.is_direct) ranks = ranks_at(cut, exchange, point);
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = exchange.ports[static_cast<size_t>(p)];
      owner.push_back(cut.piece(port.piece).rank);
      readers.push_back(point.is_direct ? direct.readers_at(port.piece, piece_nodes(cut, port).front()) : ranks);
    }
  }
  ranks::Neighbours(owner, readers, width).exchange(values);
}

void number_unknowns(const Cut& cut, bool is_all, Exchange& exchange) {
  for (const Point& point : exchange.points)
    for (int d = 0; d < 3; ++d) {
      if (!point.is_active[d] || point.is_direct) continue;
      for (int p = point.first_port; p < point.end_port; ++p) {
        Port& port = exchange.ports[p];
        if (!port.is_held[d] && (is_all || cut.is_here(port.piece)))
          port.unknown[d] = exchange.n_unknowns[port.piece]++;
      }
    }
  if (!is_all && !ranks::is_alone()) receive_numbers(cut, exchange);
}

}  // namespace dygita

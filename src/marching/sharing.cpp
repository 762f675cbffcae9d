#include "marching/sharing.hpp"

#include <spdlog/fmt/fmt.h>

#include <numeric>

#include "base/log.hpp"
#include "base/memory.hpp"
#include "partition/all_pieces.hpp"
#include "partition/share_out.hpp"
#include "ranks/machine_copies.hpp"

namespace dygita {

namespace {

// Of the ranks, one after the other: messages, bytes, seconds, memory now and at most, and of it what is
// there once on a machine.
std::vector<double> traffic_of_all(const ranks::Traffic& before) {
  constexpr size_t n = 2 * ranks::n_receivers + 4;
  const ranks::Traffic now = ranks::traffic();
  std::vector<double> all(n * static_cast<size_t>(ranks::count()), 0.0);
  double* const own = all.data() + n * static_cast<size_t>(ranks::me());
  for (size_t i = 0; i < ranks::n_receivers; ++i) {
    own[i] = now.messages[i] - before.messages[i];
    own[ranks::n_receivers + i] = now.bytes[i] - before.bytes[i];
  }
  own[n - 4] = now.seconds_waited - before.seconds_waited;
  own[n - 3] = resident_memory();
  own[n - 2] = peak_memory();
  own[n - 1] = bytes_shared_on_machine();
  return ranks::sums(all);
}

void tell_pieces(const std::vector<Surface>& surfaces, const Cut& cut, std::vector<SharedPiece>& pieces) {
  pieces.resize(static_cast<size_t>(cut.n_pieces()));
  const std::vector<double> seconds =
      of_all_pieces(cut, 1, [&](int i, double* to) { *to = pieces[static_cast<size_t>(i)].seconds; });
  for (size_t i = 0; i < pieces.size(); ++i) {
    const CutPiece& piece = cut.piece(static_cast<int>(i));
    pieces[i] = {piece.part, piece.rank, 3L * piece.body->mesh->n_nodes(), seconds[i], {}};
  }
  for (const auto& [pair, n] : shared_points(surfaces, cut)) {
    pieces[static_cast<size_t>(pair.first)].neighbours.emplace_back(pair.second, n);
    pieces[static_cast<size_t>(pair.second)].neighbours.emplace_back(pair.first, n);
  }
}

void say_rank(int rank, const RankFigures& of) {
  const auto sum = [](const std::array<double, ranks::n_receivers>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  say(
      fmt::format("  rank {}: {} piece{}, {} unknowns; sent {:.0f} messages, {:.4g} MB; waited {:.2f} s; {:.0f} MB of "
                  "memory at most",
                  rank, of.pieces, of.pieces == 1 ? "" : "s", of.unknowns, sum(of.messages), 1e-6 * sum(of.bytes),
                  of.seconds_waited, 1e-6 * of.peak_memory));
}

}  // namespace

void tell_ranks(const std::vector<Surface>& surfaces, const Cut& cut, const ranks::Traffic& before,
                SolverFigures& figures) {
  if (ranks::is_alone()) return;
  Sharing& sharing = figures.sharing;
  const std::vector<double> traffic = traffic_of_all(before);
  tell_pieces(surfaces, cut, sharing.pieces);
  sharing.ranks.assign(static_cast<size_t>(ranks::count()), {});
  for (const SharedPiece& piece : sharing.pieces) {
    RankFigures& rank = sharing.ranks[static_cast<size_t>(piece.rank)];
    ++rank.pieces;
    rank.unknowns += piece.unknowns;
  }
  const double* at = traffic.data();
  for (int i = 0; i < ranks::count(); ++i) {
    RankFigures& rank = sharing.ranks[static_cast<size_t>(i)];
    for (double& n : rank.messages) n = *at++;
    for (double& n : rank.bytes) n = *at++;
    rank.seconds_waited = *at++;
    rank.memory = *at++;
    rank.peak_memory = *at++;
    rank.shared_meshes = *at++;
    say_rank(i, rank);
  }
  figures.seconds["waiting for other ranks"] += sharing.ranks[static_cast<size_t>(ranks::me())].seconds_waited;
}

}  // namespace dygita

#include "run/share_plan.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>

#include "base/log.hpp"
#include "files/run_record.hpp"
#include "partition/share_out.hpp"
#include "ranks/ranks.hpp"
#include "run/part_lines.hpp"

namespace dygita {

namespace {

constexpr char before_pieces = '/';  // in the digest of a mesh, whose own are hexadecimal

// Rank 0's, on all.
void recall(const std::filesystem::path& folder, SharePlan& plan) {
  std::vector<RecordedPiece> pieces;
  if (ranks::is_first()) pieces = read_recorded_pieces(folder);
  std::vector<double> numbers;
  for (const RecordedPiece& piece : pieces) numbers.insert(numbers.end(), {double(piece.unknowns), piece.seconds});
  numbers = ranks::shared(std::move(numbers));
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) {
    plan.unknowns.push_back(static_cast<long>(numbers[i]));
    plan.seconds.push_back(numbers[i + 1]);
  }
}

}  // namespace

SharePlan plan_of(const Problem& problem, const RunRequest& request, const std::filesystem::path& folder) {
  SharePlan plan;
  if (problem.monolithic || problem.explicit_dynamics) return plan;
  plan.n_pieces = request.pieces.empty() ? pieces_for_ranks(problem, ranks::count()) : request.pieces;
  if (plan.n_pieces != usual_pieces(problem))
    warn(
        fmt::format("substructures are divided to balance MPI load ({}); a single-process run partitions differently: "
                    "explicit ones agree with it to round-off, iterated increments to the tolerance; solver.latin{{ "
                    "pieces = 1 }} keeps them whole",
                    list_pieces(problem, plan.n_pieces)));
  if (!ranks::is_alone()) recall(folder, plan);
  return plan;
}

std::string digest_and_pieces(const std::string& digest, int n_pieces, int usual) {
  return n_pieces == usual ? digest : fmt::format("{}{}{}", digest, before_pieces, n_pieces);
}

std::string digest_alone(const std::string& kept) { return kept.substr(0, kept.find(before_pieces)); }

std::vector<int> kept_pieces(const Problem& problem, const RunState& state) {
  std::vector<int> pieces = usual_pieces(problem);
  for (const auto& [name, kept] : state.mesh_digests)
    if (const size_t at = kept.find(before_pieces); at != std::string::npos)
      for (size_t i = 0; i < pieces.size(); ++i)
        if (problem.substructures[i]->name == name) pieces[i] = std::max(1, std::atoi(kept.c_str() + at + 1));
  return pieces;
}

}  // namespace dygita

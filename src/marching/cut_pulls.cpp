#include "marching/cut_pulls.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace dygita {

CutPulls::CutPulls(const StepModel& model) : concerned_(model.pieces.size(), 0) {
  const Cut& cut = *model.cut;
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  std::vector<double> masses;
  for (int part = 0; part < cut.n_parts() && model.has_explicit(); ++part) {
    for (const int node : cut.on_cuts(part).nodes()) {
      const std::vector<Copy> copies = cut.copies(part, node);
      const auto piece_of = [&](const Copy& copy) { return model.pieces[copy.piece]->as_explicit(); };
      const auto is_concerned = [&](const Copy& copy) {
        const ExplicitPiece* piece = piece_of(copy);
        return piece && piece->is_coupled(copy.node);
      };
      if (std::none_of(copies.begin(), copies.end(), is_concerned)) continue;
      nodes_.push_back(static_cast<int>(copies_.size()));
      std::vector<int> ranks_of;
      for (const Copy& copy : copies) ranks_of.push_back(cut.piece(copy.piece).rank);
      for (size_t c = 0; c < copies.size(); ++c) {
        ExplicitPiece* piece = piece_of(copies[c]);
        copies_.push_back({piece, copies[c].node, 0.0});
        if (piece) concerned_[static_cast<size_t>(copies[c].piece)] = 1;
        masses.push_back(piece ? piece->node_masses()[copies[c].node] : 0.0);
        owner.push_back(ranks_of[c]);
        readers.push_back(ranks_of);
        std::sort(readers.back().begin(), readers.back().end());
        readers.back().erase(std::unique(readers.back().begin(), readers.back().end()), readers.back().end());
      }
    }
  }
  if (nodes_.empty()) return;
  nodes_.push_back(static_cast<int>(copies_.size()));
  ranks::Neighbours(owner, readers, 1).exchange(masses.data());
  of_pulls_ = ranks::Neighbours(owner, readers, 3);
  pulls_.assign(3 * copies_.size(), 0.0);
  for (size_t i = 0; i + 1 < nodes_.size(); ++i) {
    double all = 0.0;
    for (int c = nodes_[i]; c < nodes_[i + 1]; ++c) all += masses[static_cast<size_t>(c)];
    for (int c = nodes_[i]; c < nodes_[i + 1]; ++c)
      copies_[static_cast<size_t>(c)].share = masses[static_cast<size_t>(c)] / all;
  }
}

void CutPulls::share(int most_threads) {
  constexpr std::ptrdiff_t together = 256;
  const auto for_copies = [&](auto&& visit) {
    parallel_for_ranges(
        static_cast<std::ptrdiff_t>(nodes_.size()) - 1,
        [&](std::ptrdiff_t first, std::ptrdiff_t n) {
          visit(static_cast<size_t>(first), static_cast<size_t>(first + n));
        },
        together, most_threads);
  };
  for_copies([&](size_t first, size_t end) {
    for (auto c = static_cast<size_t>(nodes_[first]); c < static_cast<size_t>(nodes_[end]); ++c)
      if (copies_[c].piece) Eigen::Map<Vec3>(pulls_.data() + 3 * c) = copies_[c].piece->pull_at(copies_[c].node);
  });
  of_pulls_.begin(pulls_.data());
  of_pulls_.end(pulls_.data());
  for_copies([&](size_t first, size_t end) {
    for (size_t i = first; i < end; ++i) {
      Vec3 all = Vec3::Zero();
      for (auto c = static_cast<size_t>(nodes_[i]); c < static_cast<size_t>(nodes_[i + 1]); ++c)
        all += Eigen::Map<const Vec3>(pulls_.data() + 3 * c);
      for (auto c = static_cast<size_t>(nodes_[i]); c < static_cast<size_t>(nodes_[i + 1]); ++c)
        if (copies_[c].piece) copies_[c].piece->pull_at(copies_[c].node) = copies_[c].share * all;
    }
  });
}

}  // namespace dygita

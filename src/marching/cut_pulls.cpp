#include "marching/cut_pulls.hpp"

namespace dygita {

CutPulls::CutPulls(const StepModel& model) : concerned_(model.pieces.size(), 0) {
  if (model.scheme.is_static || !model.has_explicit()) return;
  sums_ = TiedSums(model, TiedNodes(model).groups());
  if (is_empty()) return;
  std::vector<double> masses;
  for (const TiedSums::Entry& entry : sums_.entries()) {
    const auto piece = static_cast<size_t>(entry.node.piece);
    OwnNode& own = nodes_.emplace_back();
    if (entry.is_here) own.piece = model.pieces[piece]->as_explicit();
    if (own.piece) concerned_[piece] = 1;
    masses.push_back(own.piece ? own.piece->node_masses()[entry.node.node] : 0.0);
  }
  std::vector<std::vector<int>> sharing(model.pieces.size());
  for (size_t e = 0; e < nodes_.size(); ++e) {
    std::vector<int>& of_piece = sharing[static_cast<size_t>(sums_.entries()[e].node.piece)];
    nodes_[e].at = static_cast<Eigen::Index>(of_piece.size());
    of_piece.push_back(sums_.entries()[e].node.node);
  }
  std::vector<Points*> fields(sharing.size(), nullptr);
  for (size_t i = 0; i < fields.size(); ++i)
    if (concerned_[i]) fields[i] = &model.pieces[i]->as_explicit()->share_pulls(std::move(sharing[i]));
  const std::vector<double> all = sums_.sum(masses);
  for (size_t e = 0; e < nodes_.size(); ++e) {
    nodes_[e].to = fields[static_cast<size_t>(sums_.entries()[e].node.piece)];
    if (nodes_[e].piece) nodes_[e].share = masses[e] / all[e];
  }
}

void CutPulls::share(int most_threads) {
  sums_.sum([&](size_t e) { return nodes_[e].piece->pull_at(sums_.entries()[e].node.node); },
            [&](size_t e, const Vec3& all) { nodes_[e].to->col(nodes_[e].at) = nodes_[e].share * all; }, most_threads);
}

}  // namespace dygita

#include "step/cut_momenta.hpp"

#include <algorithm>

#include "pieces/explicit_piece.hpp"
#include "step/tied_nodes.hpp"

namespace dygita {

namespace {

// Fields of all pieces that are here; those of others than the pieces concerned are zero.
using PieceFields = std::vector<Points>;

class CutMomenta {
 public:
  explicit CutMomenta(const StepModel& model) : model_(model), pieces_(model.pieces.size(), nullptr) {
    sums_ = TiedSums(model, TiedNodes(model).groups());
    for (const TiedSums::Entry& entry : sums_.entries())
      if (const auto piece = static_cast<size_t>(entry.node.piece); entry.is_here)
        pieces_[piece] = model.pieces[piece]->as_explicit();
    for (size_t i = 0; i < pieces_.size(); ++i)
      counts_.emplace_back(pieces_[i] ? static_cast<size_t>(pieces_[i]->node_masses().size()) : 0, 1);
    for (size_t e = 0; e < sums_.entries().size(); ++e) {
      const TiedSums::Entry& entry = sums_.entries()[e];
      if (entry.is_here && !sums_.is_first(e))
        counts_[static_cast<size_t>(entry.node.piece)][static_cast<size_t>(entry.node.node)] = 0;
    }
  }

  void start();

 private:
  PieceFields empty() const {
    PieceFields fields;
    for (size_t i = 0; i < pieces_.size(); ++i)
      fields.push_back(
          Points::Zero(3, model_.solves(static_cast<int>(i)) ? model_.pieces[i]->node_masses().size() : 0));
    return fields;
  }
  template <class Of>
  PieceFields each(Of&& of) const {
    PieceFields fields = empty();
    for (size_t i = 0; i < pieces_.size(); ++i)
      if (pieces_[i]) fields[i] = of(static_cast<int>(i), *pieces_[i]);
    return fields;
  }
  // Sums over the groups, at all of their nodes.
  PieceFields assembled(PieceFields fields) {
    const auto at = [&](size_t e) {
      const TiedNode& node = sums_.entries()[e].node;
      return fields[static_cast<size_t>(node.piece)].col(node.node);
    };
    sums_.sum(
        at, [&](size_t e, const Vec3& sum) { at(e) = sum; }, 1);
    return fields;
  }
  PieceFields masses() {
    PieceFields fields =
        each([](int, const ExplicitPiece& piece) { return Points(piece.node_masses().transpose().replicate(3, 1)); });
    const auto at = [&](size_t e) {
      const TiedNode& node = sums_.entries()[e].node;
      return fields[static_cast<size_t>(node.piece)].col(node.node);
    };
    std::vector<double> own;
    for (size_t e = 0; e < sums_.entries().size(); ++e) own.push_back(sums_.entries()[e].is_here ? at(e)[0] : 0.0);
    const std::vector<double> all = sums_.sum(own);
    for (size_t e = 0; e < all.size(); ++e)
      if (sums_.entries()[e].is_here) at(e).setConstant(all[e]);
    return fields;
  }
  double product(const PieceFields& a, const PieceFields& b) const {
    double sum = 0.0;
    for (size_t i = 0; i < pieces_.size(); ++i)
      for (int node = 0; pieces_[i] && node < a[i].cols(); ++node)
        if (counts_[i][static_cast<size_t>(node)]) sum += a[i].col(node).dot(b[i].col(node));
    return ranks::is_alone() ? sum : ranks::shared(ranks::sums({sum}))[0];
  }

  const StepModel& model_;
  TiedSums sums_;
  std::vector<ExplicitPiece*> pieces_;     // null: not concerned
  std::vector<std::vector<char>> counts_;  // of each of their nodes: it is the one of its group that counts
};

// As a piece by itself does (ExplicitPiece::start_momentum), on the substructures.
void CutMomenta::start() {
  if (!ranks::any(std::any_of(pieces_.begin(), pieces_.end(), [](const auto* piece) { return piece; }))) return;
  constexpr int most_products = 200;
  const PieceFields mass = masses();
  const auto over_mass = [&](const PieceFields& x) {
    return each([&](int i, const ExplicitPiece&) { return Points(x[i].cwiseQuotient(mass[i])); });
  };
  PieceFields z = each([](int, const ExplicitPiece& piece) { return piece.velocity(); });
  PieceFields residual =
      assembled(each([&](int i, const ExplicitPiece& piece) { return Points(-piece.coupled(z[i])); }));
  PieceFields along = over_mass(residual);
  double size = product(residual, along);
  const double enough =
      1e-30 * product(z, each([&](int i, const ExplicitPiece&) { return Points(mass[i].cwiseProduct(z[i])); }));
  for (int n = 0; n < most_products && size > enough; ++n) {
    const PieceFields image = assembled(each([&](int i, const ExplicitPiece& piece) {
      return Points(along[i] * piece.node_masses().asDiagonal() + piece.coupled(along[i]));
    }));
    const double step = size / product(along, image);
    for (size_t i = 0; i < z.size(); ++i) {
      z[i] += step * along[i];
      residual[i] -= step * image[i];
    }
    const PieceFields next = over_mass(residual);
    const double next_size = product(residual, next);
    for (size_t i = 0; i < z.size(); ++i) along[i] = next[i] + next_size / size * along[i];
    size = next_size;
  }
  for (size_t i = 0; i < pieces_.size(); ++i)
    if (pieces_[i]) pieces_[i]->set_momenta(z[i]);
}

}  // namespace

void start_cut_momenta(const StepModel& model) {
  if (!model.scheme.is_static && model.has_explicit()) CutMomenta(model).start();
}

}  // namespace dygita

#include "step/shared_operators.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "law/law.hpp"
#include "pieces/central_differences.hpp"
#include "pieces/equal_pieces.hpp"

namespace dygita {

namespace {

// To the bit: what the same places make of the same parts.
bool are_same(const InterfaceRow& a, const InterfaceRow& b) {
  return a.reference_stiffness == b.reference_stiffness && a.static_stiffness == b.static_stiffness &&
         a.n_sharing == b.n_sharing && a.side == b.side &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [](const NodeAlong& u, const NodeAlong& v) { return u.node == v.node && u.along == v.along; });
}

bool are_same(const std::vector<InterfaceRow>& a, const std::vector<InterfaceRow>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const InterfaceRow& one, const InterfaceRow& other) { return are_same(one, other); });
}

std::vector<char> massless_of(const Problem& problem, const std::vector<Surface>& surfaces) {
  std::vector<char> massless;
  if (problem.mass().is_moved_from_contact)
    for (const Surface& surface : surfaces) massless.push_back(surface.declared_law().allows_massless_nodes());
  return massless;
}

}  // namespace

std::vector<Vec3> law_springs(const StepModel& model) {
  constexpr double pressed = 5e-6;  // m
  if (!model.scheme.is_static) return {};
  std::vector<Vec3> stiffness(model.exchange.ports.size(), Vec3::Zero());
  for (const Point& point : model.exchange.points) {
    if (!point.law) continue;
    LawState state = point.law->initial();
    state.gap = -pressed;
    const Vec3 of_law = point.area * point.law->tangent(state, true).stiffness;
    for (int p = point.first_port; p < point.end_port; ++p) stiffness[static_cast<size_t>(p)] = of_law;
  }
  return stiffness;
}

void SharedOperators::make_for(const Problem& problem, const std::vector<Surface>& surfaces, CutPtr cut) {
  CHECK(!are_made(), "those of the first run serve the others");
  cut_ = std::move(cut);
  bodies_ = make_bodies(problem, surfaces, *cut_);
  massless_ = massless_of(problem, surfaces);
  steps_.resize(problem.steps.size());
  coarse_.resize(problem.steps.size());
}

bool SharedOperators::serve(const Problem& problem, const std::vector<Surface>& surfaces) const {
  return !are_made() || massless_ == massless_of(problem, surfaces);
}

const StepOperators* SharedOperators::of_step(size_t i_step) const {
  return i_step < steps_.size() && !steps_[i_step].pieces.empty() ? &steps_[i_step] : nullptr;
}

std::shared_ptr<const CoarseCorrection>& SharedOperators::coarse_of_step(size_t i_step) {
  if (!of_step(i_step)) coarse_[i_step].reset();
  return coarse_[i_step];
}

bool SharedOperators::have_all() const {
  return are_made() && std::all_of(steps_.begin(), steps_.end(),
                                   [](const StepOperators& step) { return step.is_assembled || !step.pieces.empty(); });
}

bool leave_room(double kept, double available) { return available == 0.0 || 2.0 * kept <= available; }

void SharedOperators::keep(size_t i_step, StepModel& model) {
  steps_[i_step].is_assembled = model.is_assembled;
  if (model.is_assembled || of_step(i_step)) return;
  double bytes = 0.0, all = 0.0;
  for (const auto& piece : model.pieces) bytes += piece->figures().bytes;
  for (const StepOperators& step : steps_) all += step.bytes;
  if (!leave_room(ranks::count_on_machine() * (all + bytes), available_memory())) return;
  steps_[i_step] = {std::move(model.pieces), model.integration, law_springs(model), bytes, false};
}

// The Schur complement that search directions were added to is gone, so they must be the same too; they follow from
// rows, masses, scheme and springs of laws.
const ImplicitPiece* same_implicit(const PieceSetup& setup, const Piece& earlier) {
  const auto* piece = dynamic_cast<const ImplicitPiece*>(&earlier);
  if (!piece || (!piece->condensation() && !dynamic_cast<const FullPiece*>(piece))) return nullptr;
  const PieceSetup& own = piece->op().setup();
  const bool is_made_alike = own.scheme.is_static == setup.scheme.is_static && own.scheme.dt == setup.scheme.dt &&
                             own.storage_error == setup.storage_error && own.half_error == setup.half_error &&
                             own.rough_error == setup.rough_error && are_same(own.rows, setup.rows);
  if (!is_made_alike) return nullptr;
  const auto turn = turn_between(own, piece->op().unknowns(), setup);
  return turn && turn->isIdentity(0.0) ? piece : nullptr;
}

std::shared_ptr<const ExplicitOperator> same_explicit(const PieceSetup& setup, const Piece& earlier) {
  const auto* piece = dynamic_cast<const CentralDifferences*>(&earlier);
  if (!piece) return nullptr;
  const PieceSetup& own = piece->setup();
  const bool is_same = own.body == setup.body && own.scheme.dt == setup.scheme.dt &&
                       own.tuned_speed == setup.tuned_speed && own.keeps_lumped == setup.keeps_lumped;
  return is_same ? piece->op() : nullptr;
}

}  // namespace dygita

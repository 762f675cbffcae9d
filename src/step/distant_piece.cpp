#include "step/distant_piece.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "exchange/direct_links.hpp"
#include "partition/all_pieces.hpp"
#include "step/step_model.hpp"

namespace dygita {

namespace {

std::vector<double> as_vector(const Points& points) { return {points.data(), points.data() + points.size()}; }

std::span<const double> as_span(const Points& points) { return {points.data(), static_cast<size_t>(points.size())}; }

Points as_points(std::span<const double> values) {
  return Eigen::Map<const Points>(values.data(), 3, static_cast<Eigen::Index>(values.size() / 3));
}

// Numbers of nodes, which pass as all else does.
std::vector<int> as_nodes(std::span<const double> values) { return {values.begin(), values.end()}; }

Vec as_vec(const std::vector<double>& values) {
  return Eigen::Map<const Vec>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

DistantPiece::DistantPiece(int piece, int rank, const Mass& mass, bool has_motions)
    : piece_(piece), rank_(rank), mass_(&mass), has_motions_(has_motions) {}

std::vector<double> DistantPiece::ask(What what, std::span<const double> with) const {
  CHECK(ranks::is_first(), "a piece is asked for on a rank that does not have it");
  return ranks::ask(rank_, {what, piece_}, with);
}

Points DistantPiece::ask_nodal(What what, std::span<const double> with) const { return as_points(ask(what, with)); }

Points DistantPiece::ask_at(What what, const std::vector<int>& nodes) const {
  return nodes.empty() ? Points(3, 0) : ask_nodal(what, std::vector<double>(nodes.begin(), nodes.end()));
}

const Vec& DistantPiece::unknown_masses() const {
  if (unknown_masses_.size() == 0) unknown_masses_ = as_vec(ask(masses));
  return unknown_masses_;
}

Points DistantPiece::unknown_directions() const { return ask_nodal(directions); }

Points DistantPiece::elastic_force(const Points& displacement) const {
  return ask_nodal(force_of_u, as_span(displacement));
}

// Velocities alone: what results ask of it.
const PieceState& DistantPiece::state() const {
  shown_.v = as_vec(ask(state_v));
  return shown_;
}

Points DistantPiece::displacement() const { return ask_nodal(u); }

Points DistantPiece::velocity() const { return ask_nodal(v); }

Points DistantPiece::acceleration() const { return ask_nodal(a); }

Points DistantPiece::reactions(const Points& interface_force) const {
  return ask_nodal(held, as_span(interface_force));
}

Points DistantPiece::absorbing_force() const { return ask_nodal(absorbed); }

std::vector<double> answer_for(const Piece& piece, int what, std::span<const double> with) {
  switch (what) {
    case DistantPiece::u:
      return as_vector(with.empty() ? piece.displacement() : piece.displacement(as_nodes(with)));
    case DistantPiece::v:
      return as_vector(with.empty() ? piece.velocity() : piece.velocity(as_nodes(with)));
    case DistantPiece::a:
      return as_vector(with.empty() ? piece.acceleration() : piece.acceleration(as_nodes(with)));
    case DistantPiece::force_of_u:
      return as_vector(piece.elastic_force(as_points(with)));
    case DistantPiece::held:
      return as_vector(piece.reactions(as_points(with)));
    case DistantPiece::absorbed:
      return as_vector(piece.absorbing_force());
    case DistantPiece::state_v: {
      const Vec& velocity = piece.state().v;
      return {velocity.begin(), velocity.end()};
    }
    case DistantPiece::masses: {
      const Vec& all = piece.unknown_masses();
      return {all.begin(), all.end()};
    }
    case DistantPiece::directions:
      return as_vector(piece.unknown_directions());
    default:
      CHECK(false, "a question that no rank can answer");
  }
  return {};
}

DistantNodes::DistantNodes(DistantPiece piece, std::vector<int> nodes, double dt)
    : DistantPiece(std::move(piece)), nodes_(std::move(nodes)) {
  dt_ = dt;
  compliances_.resize(nodes_.size(), Mat3::Zero());
  for (std::vector<double>* field : {&d_, &v_, &start_}) field->assign(4 * nodes_.size(), 0.0);
}

int DistantNodes::index_of(int node) const {
  const auto it = std::lower_bound(nodes_.begin(), nodes_.end(), node);
  CHECK(it != nodes_.end() && *it == node, "a node without a law");
  return static_cast<int>(it - nodes_.begin());
}

void add_distant(const StepModel& model, const std::vector<Body>& bodies, std::vector<std::unique_ptr<Piece>>& pieces) {
  if (ranks::is_alone()) return;
  const std::vector<double> has_motions =
      of_all_pieces(*model.cut, 1, [&](int i, double* to) { *to = pieces[i]->has_motions(); });
  const NearDirect near = near_direct(*model.cut, model.exchange);
  for (int i = 0; i < static_cast<int>(pieces.size()); ++i) {
    if (model.cut->is_here(i)) continue;
    const DistantPiece piece(i, model.cut->piece(i).rank, *bodies[i].mass, has_motions[i] != 0.0);
    if (model.integration.is_explicit_piece(i))
      pieces[i] = std::make_unique<DistantNodes>(piece, near.nodes_of(i), model.scheme.dt);
    else
      pieces[i] = std::make_unique<DistantPiece>(piece);
  }
}

}  // namespace dygita

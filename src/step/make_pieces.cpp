#include "step/make_pieces.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "base/parallel_by_cost.hpp"
#include "base/task.hpp"
#include "exchange/rigid_motions.hpp"
#include "fem/cell_tensor.hpp"
#include "meeting/facing.hpp"
#include "model/extent.hpp"
#include "numerics/scratch_pages.hpp"
#include "partition/stored_precision.hpp"
#include "pieces/absorbing_impedance.hpp"
#include "pieces/central_differences.hpp"
#include "pieces/equal_pieces.hpp"
#include "pieces/longest_step.hpp"
#include "pieces/row_stiffness.hpp"
#include "step/distant_piece.hpp"
#include "step/joint_solves.hpp"
#include "step/shared_operators.hpp"
#include "step/tied_nodes.hpp"

namespace dygita {

namespace {

// Held directions of a piece's nodes: every copy of a node is held as the node is.
std::unordered_map<int, Held> held_of_piece(const StepModel& model, int piece) {
  const CutPiece& own = model.cut->piece(piece);
  const std::unordered_map<int, Held>& of_part = model.conditions.held[own.part];
  if (own.is_whole()) return of_part;
  std::unordered_map<int, Held> held;
  for (size_t i = 0; i < own.nodes.size(); ++i)
    if (const auto it = of_part.find(own.nodes[i]); it != of_part.end()) held.emplace(static_cast<int>(i), it->second);
  return held;
}

std::unordered_map<int, Mat3> absorbing_of_piece(const Cut& cut, int piece,
                                                 const std::unordered_map<int, Mat3>& of_part) {
  std::unordered_map<int, Mat3> own;
  for (const auto& [node, impedance] : of_part)
    if (const Copy owner = cut.owner(cut.piece(piece).part, node); owner.piece == piece)
      own.emplace(owner.node, impedance);
  return own;
}

// Of the first piece that has both nodes: that of the facet they are on.
std::vector<NodePairImpedance> absorbing_pairs_of_piece(const Cut& cut, int piece,
                                                        const std::vector<NodePairImpedance>& of_part) {
  const int part = cut.piece(piece).part;
  if (!cut.is_cut(part)) return of_part;
  std::vector<NodePairImpedance> own;
  for (const NodePairImpedance& pair : of_part) {
    int first = std::numeric_limits<int>::max(), node = -1, other = -1;
    for (const Copy& a : cut.copies(part, pair.node))
      for (const Copy& b : cut.copies(part, pair.other))
        if (a.piece == b.piece && a.piece < first) first = a.piece, node = a.node, other = b.node;
    if (first == piece) own.push_back({node, other, pair.impedance});
  }
  return own;
}

struct PortAt {
  int point, port;
};

// Of each piece.
std::vector<std::vector<PortAt>> ports_of_pieces(const StepModel& model) {
  std::vector<std::vector<PortAt>> ports(static_cast<size_t>(model.cut->n_pieces()));
  const Exchange& exchange = model.exchange;
  for (int i = 0; i < static_cast<int>(exchange.points.size()); ++i)
    for (int p = exchange.points[i].first_port; p < exchange.points[i].end_port; ++p)
      ports[static_cast<size_t>(exchange.ports[p].piece)].push_back({i, p});
  return ports;
}

std::vector<InterfaceRow> rows_of(const StepModel& model, int piece, const std::vector<PortAt>& ports,
                                  const std::unordered_map<int, Held>& held) {
  std::vector<InterfaceRow> rows(model.exchange.n_unknowns[piece]);
  const Substructure& body = *model.cut->piece(piece).body;
  double total_area = 0.0;
  for (const PortAt& at : ports) total_area += model.exchange.ports[at.port].area;
  const bool needs_reference = model.scheme.is_static && is_floating(body, held);
  const double length = !body.mesh->has_cells() ? extent_of(body).size().norm()
                        : total_area > 0.0      ? volume(*body.mesh) / total_area
                                                : 1.0;
  const ElasticTensor tensor = mean_tensor(body.material, *body.mesh);
  for (const PortAt& at : ports) {
    const Port& port = model.exchange.ports[at.port];
    const Mat3& frame = model.exchange.points[at.point].frame;
    for (int d = 0; d < 3; ++d) {
      if (port.unknown[d] < 0) continue;
      const double modulus = d == 0 ? tensor.young(frame.col(0)) : tensor.wave_modulus(frame.col(0), frame.col(d));
      const double stiffness = modulus * port.area / length;
      InterfaceRow& row = rows[port.unknown[d]];
      row = {{}, needs_reference ? stiffness : 0.0, stiffness, 1.0, port.side};
      port.for_each_node([&](int node, const Mat3& block) {
        const Vec3 along = block.transpose() * frame.col(d);
        if (!along.isZero(0.0))
          row.nodes.push_back({port.trace ? model.cut->owner(port.part, node).node : port.piece_node, along});
      });
    }
  }
  share_nodes(rows);
  return rows;
}

// A static step has no mass that would bound what rounding does to soft motions, and nodes without mass have a
// recurrence of their own.
Precision precision_of(const StepModel& model, int part, const Body& body) {
  if (model.scheme.is_static || !body.mass->is_massless.empty() || !body.part->mesh->has_cells())
    return Precision::double_precision;
  return stored_precision(model.problem->solver, 3.0 * model.problem->substructures[part]->mesh->n_nodes());
}

void tune_explicitly(const StepModel& model, int piece, const TiedNodes& tied, PieceSetup& setup) {
  const CutPiece& own = model.cut->piece(piece);
  setup.tuned_speed = tuned_wave_speed(*model.problem->substructures[static_cast<size_t>(own.part)],
                                       model.conditions.held[static_cast<size_t>(own.part)]);
  for (int node = 0; node < setup.n_nodes(); ++node)
    setup.keeps_lumped.push_back(tied.keeps_lumped(own.part)[static_cast<size_t>(own.node(node))]);
}

std::vector<PieceSetup> setups_of(const StepModel& model, const std::vector<Body>& bodies) {
  constexpr double rough_error = 5e-3;       // of H in inner iterations: near entries remain
  constexpr double half_error = 0x1p-16;     // of H for changes within an increment
  constexpr size_t fits_a_cache = 1000;      // rows of an H that is read faster than it is worth keeping twice
  constexpr double usual_iterations = 40.0;  // of an increment of a static step
  const int n = model.cut->n_pieces();
  CHECK(static_cast<int>(bodies.size()) == n, "one body a piece");
  std::vector<AbsorbingImpedance> absorbing;
  for (size_t part = 0; part < model.problem->substructures.size(); ++part)
    absorbing.push_back(
        absorbing_impedance(*model.problem, *model.step, *model.problem->substructures[part],
                            model.integration.is_explicit_piece(model.cut->first(static_cast<int>(part)))));
  const std::vector<std::vector<PortAt>> ports = ports_of_pieces(model);
  std::optional<TiedNodes> tied;
  if (model.has_explicit()) tied.emplace(model);
  std::vector<PieceSetup> setups(n);
  const auto set_up = [&](int at) {
    const int i = model.here[at];
    const int part = model.cut->piece(i).part, n_cut = model.cut->n_pieces(part);
    PieceSetup& setup = setups[i];
    setup.body = &bodies[i];
    setup.scheme = model.scheme;
    setup.held = held_of_piece(model, i);
    setup.absorbing = absorbing_of_piece(*model.cut, i, absorbing[part].of_nodes);
    setup.absorbing_pairs = absorbing_pairs_of_piece(*model.cut, i, absorbing[part].of_pairs);
    setup.rows = rows_of(model, i, ports[static_cast<size_t>(i)], setup.held);
    setup.n_motions = static_cast<int>(model.conditions.motions.size());
    setup.what = (n_cut > 1 ? fmt::format("piece {} of {} of ", i - model.cut->first(part) + 1, n_cut) : "") +
                 "substructure '" + bodies[i].part->name + "' in step '" + model.step->name + "'";
    if (model.integration.is_explicit_piece(i) && model.integration.parts[static_cast<size_t>(part)].is_tuned)
      tune_explicitly(model, i, *tied, setup);
    setup.precision = precision_of(model, part, bodies[i]);
    if (model.scheme.is_static) setup.n_products = usual_iterations * model.step->increments;
    // Far below what the tolerance leaves of a step; what is stored of an entry follows.
    if (model.has_inner_iterations()) setup.rough_error = rough_error;
    // Runs side by side read H once for all.
    const bool is_long = setup.rows.size() > fits_a_cache && setup.precision == Precision::single_precision;
    if (model.has_inner_iterations() && is_long && !joint::is_joint()) setup.half_error = half_error;
    setup.storage_error = std::clamp(model.problem->solver.tolerance / 64.0, 0x1p-27, 0x1p-21);
  };
  parallel_for(static_cast<int>(model.here.size()), set_up);
  return setups;
}

// The first piece that another is equal to, and how the other is turned to it; none before it: -1. Or what an earlier
// run has of the piece itself.
struct EqualTo {
  int piece = -1;
  Mat3 turn = Mat3::Identity();
  const ImplicitPiece* same = nullptr;
  std::shared_ptr<const ExplicitOperator> op = nullptr;

  bool is_made() const { return same || op; }
};

// Empty: nothing of an earlier run is as this step would make it.
std::vector<EqualTo> same_pieces(const StepModel& model, const std::vector<PieceSetup>& setups,
                                 const StepOperators* earlier) {
  if (!earlier || model.problem->solver.plain || earlier->springs != law_springs(model) ||
      earlier->integration.is_explicit != model.integration.is_explicit ||
      earlier->integration.n_substeps != model.integration.n_substeps)
    return {};
  std::vector<EqualTo> same(setups.size());
  bool has_other = false;
  for (const int i : model.here) {
    const Piece& piece = *earlier->pieces[static_cast<size_t>(i)];
    if (model.integration.is_explicit_piece(i))
      same[i].op = same_explicit(setups[i], piece);
    else
      has_other |= !(same[i].same = same_implicit(setups[i], piece));
  }
  // Search directions of bonded sides follow the piece on the other side in dynamic steps, and operators follow them.
  if (!model.scheme.is_static && ranks::any(has_other))
    for (EqualTo& of_piece : same) of_piece.same = nullptr;
  return same;
}

// Explicit ones are equal by their stiffness as it is, and by what tunes their mass.
std::vector<EqualTo> twins_of(const StepModel& model, const std::vector<PieceSetup>& setups,
                              const StepOperators* earlier = nullptr) {
  std::map<std::tuple<const StoredMatrices*, double, std::vector<char>>, int> known_explicit;
  std::map<const Mass*, std::vector<std::pair<int, FreeUnknowns>>> known;
  std::vector<EqualTo> twins = same_pieces(model, setups, earlier);
  twins.resize(setups.size());
  for (const int i : model.here) {
    if (twins[i].is_made()) continue;
    const PieceSetup& setup = setups[i];
    if (model.integration.is_explicit_piece(i)) {
      const auto [at, is_new] =
          known_explicit.try_emplace({setup.body->matrices.get(), setup.tuned_speed, setup.keeps_lumped}, i);
      if (!is_new) twins[i].piece = at->second;
      continue;
    }
    auto& before = known[setup.body->mass.get()];
    for (const auto& [first, unknowns] : before)
      if (const auto turn = turn_between(setups[first], unknowns, setup)) {
        twins[i].piece = first;
        twins[i].turn = *turn;
        break;
      }
    if (twins[i].piece < 0) before.emplace_back(i, unknowns_of(setup));
  }
  return twins;
}

}  // namespace

Pieces make_pieces(const StepModel& model, const std::vector<Body>& bodies, const StepOperators* earlier) {
  std::vector<PieceSetup> setups = setups_of(model, bodies);
  const std::vector<EqualTo> twins = twins_of(model, setups, earlier);
  const int n = static_cast<int>(setups.size());
  std::vector<std::unique_ptr<ImplicitPiece>> built(n);
  std::vector<std::shared_ptr<const ExplicitOperator>> operators(n);
  prepare_thread();
  const KeepScratch kept_for_the_next;
  // An implicit one costs a factor, of so many operations where its graph is that of a solid.
  std::vector<double> cost;
  for (const int i : model.here)
    cost.push_back(model.integration.is_explicit_piece(i) || twins[i].piece >= 0 || twins[i].is_made()
                       ? 0.0
                       : std::pow(setups[i].n_nodes(), 2));
  Task task("factors of step '" + model.step->name + "'", static_cast<int>(model.here.size()), Task::Interrupts::wait);
  for (const bool has_twin : {false, true})
    parallel_by_cost(cost, [&](int at) {
      const int i = model.here[at];
      if ((twins[i].piece >= 0) != has_twin) return;
      if (model.integration.is_explicit_piece(i))
        operators[i] = twins[i].op ? twins[i].op
                       : has_twin  ? operators[twins[i].piece]
                                   : std::make_shared<const ExplicitOperator>(setups[i]);
      else
        built[i] = make_piece(setups[i], model.problem->solver.plain,
                              twins[i].same ? Twin{twins[i].same, Mat3::Identity(), true}
                              : has_twin    ? Twin{built[twins[i].piece].get(), twins[i].turn}
                                            : Twin());
      task.done("'" + model.problem->substructures[static_cast<size_t>(model.cut->piece(i).part)]->name + "'");
    });
  Pieces pieces(std::make_move_iterator(built.begin()), std::make_move_iterator(built.end()));
  parallel_for(n, [&](int i) {
    if (operators[i]) pieces[i] = std::make_unique<CentralDifferences>(std::move(setups[i]), operators[i]);
  });
  add_distant(model, bodies, pieces);
  return pieces;
}

Pieces make_assembled_pieces(const StepModel& model, const std::vector<Body>& bodies) {
  Pieces pieces;
  for (const PieceSetup& setup : setups_of(model, bodies))
    pieces.push_back(std::make_unique<AssembledPiece>(PieceOperator(setup, unknowns_of(setup))));
  return pieces;
}

AssembledPiece& assembled_piece(const StepModel& model, int i) {
  auto* piece = dynamic_cast<AssembledPiece*>(model.pieces[i].get());
  CHECK(piece, "the step's pieces are made to be solved one by one");
  return *piece;
}

// Sixteen right-hand sides are as many as one pass over a factor takes.
std::vector<std::vector<int>> group_equal(const Pieces& pieces) {
  std::vector<std::vector<int>> groups;
  std::map<const void*, size_t> open;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (!pieces[i]->is_here()) continue;
    const void* key = pieces[i]->shared_key();
    const auto it = key ? open.find(key) : open.end();
    if (it != open.end() && groups[it->second].size() < 16) {
      groups[it->second].push_back(static_cast<int>(i));
      continue;
    }
    if (key) open[key] = groups.size();
    groups.push_back({static_cast<int>(i)});
  }
  return groups;
}

double predicted_bytes(const StepModel& model, const std::vector<Body>& bodies) {
  const std::vector<PieceSetup> setups = setups_of(model, bodies);
  const std::vector<EqualTo> twins = twins_of(model, setups);
  std::vector<double> bytes(setups.size());
  parallel_for(static_cast<int>(setups.size()), [&](int i) {
    bytes[i] = model.integration.is_explicit_piece(i) ? explicit_bytes(setups[i], twins[i].piece >= 0)
                                                      : predicted_bytes(setups[i], twins[i].piece >= 0);
  });
  double sum = 0.0;
  for (const double own : bytes) sum += own;
  return sum;
}

}  // namespace dygita

#include "latin/search_direction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "base/parallel_by_cost.hpp"
#include "fem/cell_tensor.hpp"
#include "step/shared_operators.hpp"

namespace dygita {

namespace {

// Areas (m^2) of the nodes of each side of interfaces whose faces do not match, by the port's side.
struct SideAreas {
  std::unordered_map<int, double> of_nodes;
  double all = 0.0;
  // The point of a rigid face has all of it.
  double at(int node) const {
    const auto found = of_nodes.find(node);
    return found == of_nodes.end() ? all : found->second;
  }
};
using NodeAreas = std::map<int, SideAreas>;

NodeAreas node_areas(const StepModel& model) {
  NodeAreas areas;
  for (size_t s = 0; s < model.surfaces->size(); ++s) {
    const Surface& surface = (*model.surfaces)[s];
    if (surface.facing.matches()) continue;
    for (const int which : {0, 1}) {
      const int part = which == 0 ? surface.part_1 : surface.part_2;
      if (part < 0) continue;
      const FaceNodes nodes = face_nodes(*model.problem->substructures[part]->mesh,
                                         which == 0 ? surface.facing.facets_1 : surface.facing.facets_2);
      SideAreas& side = areas[2 * static_cast<int>(s) + which];
      side.all = nodes.areas.sum();
      for (size_t i = 0; i < nodes.nodes.size(); ++i)
        side.of_nodes[nodes.nodes[i]] = nodes.areas[static_cast<Eigen::Index>(i)];
    }
  }
  return areas;
}

// kg, what a force on a sum moves along the normal of its point: 1/m is the sum of t^2/m over its nodes.
double mass_of_sum(const StepModel& model, const Surface& surface, const Port& port) {
  const Vec3 normal = surface.facing.normals.col(port.point);
  const Vec& masses = model.pieces[port.piece]->node_masses();
  double inverse = 0.0;
  for (int k = 0; k < port.trace->n_shares(port.point); ++k) {
    const double mass = masses[model.cut->owner(port.part, port.trace->share(port.point, k).node).node];
    if (mass > 0.0) inverse += (port.trace->block(port.point, k).transpose() * normal).squaredNorm() / mass;
  }
  return inverse > 0.0 ? 1.0 / inverse : 0.0;
}

// Mass (kg) behind a port: the node's, or the mean of the nodes' masses per area on the area of the point.
double mass_at(const StepModel& model, const Port& port, const NodeAreas& areas) {
  const Vec& masses = model.pieces[port.piece]->node_masses();
  if (!port.trace) return masses[port.piece_node];
  const Surface& surface = (*model.surfaces)[static_cast<size_t>(port.side / 2)];
  if (surface.facing.is_of_sums()) return mass_of_sum(model, surface, port);
  double sum = 0.0, weights = 0.0;
  for (int k = 0; k < port.trace->n_shares(port.point); ++k) {
    const SideTrace::Share& share = port.trace->share(port.point, k);
    const double weight = std::abs(share.weight);
    sum += weight * masses[model.cut->owner(port.part, share.node).node] / areas.at(port.side).at(share.node);
    weights += weight;
  }
  return port.area * sum / weights;
}

// Of a piece without a Schur complement: the diagonal that others of the like have, in the mean (manual, eq. K13).
double from_area(const StepModel& model, const Port& port, double modulus) {
  const Damping& damping = model.cut->piece(port.piece).body->material.damping;
  return 1.5 * model.scheme.c1(damping) * modulus * std::sqrt(port.area);
}

// Of each piece that is solved here.
std::vector<ElasticTensor> mean_tensors(const StepModel& model) {
  std::vector<ElasticTensor> tensors(static_cast<size_t>(model.cut->n_pieces()));
  for (int i = 0; i < model.cut->n_pieces(); ++i)
    if (const Substructure& body = *model.cut->piece(i).body; model.solves(i))
      tensors[static_cast<size_t>(i)] = mean_tensor(body.material, *body.mesh);
  return tensors;
}

bool is_bonded_between_implicit(const StepModel& model, const Point& point) {
  if (!point.law || !point.law->is_tie() || point.is_wall) return false;
  for (int p = point.first_port; p < point.end_port; ++p)
    if (model.integration.is_explicit_piece(model.exchange.ports[static_cast<size_t>(p)].piece)) return false;
  return true;
}

// Both sides of a bonded point come together to their geometric mean, by a factor of four at most (manual, eq. K14);
// rounded so that equal pieces beside equal ones stay equal.
void bring_bonded_sides_together(const StepModel& model, Vec& k) {
  constexpr double steps = 32.0, most = 2.0;  // steps in a factor of two; factors of two
  const Exchange& exchange = model.exchange;
  const Vec own = k;
  for (const Point& point : exchange.points) {
    if (!is_bonded_between_implicit(model, point)) continue;
    for (int d = 0; d < 3; ++d) {
      const auto for_each_port = [&](auto&& visit) {
        for (int p = point.first_port; p < point.end_port; ++p)
          if (const Port& port = exchange.ports[static_cast<size_t>(p)]; port.unknown[d] >= 0)
            visit(port, model.assembled_unknown(port, d), p < point.first_port_2);
      };
      double sums[2] = {0.0, 0.0};
      for_each_port([&](const Port&, int at, bool is_first) { sums[is_first ? 0 : 1] += own[at]; });
      if (!(sums[0] > 0.0 && sums[1] > 0.0)) continue;
      const double half = std::clamp(std::round(steps * std::log2(sums[1] / sums[0]) / 2.0) / steps, -most, most);
      for_each_port([&](const Port& port, int at, bool is_first) {
        if (model.solves(port.piece)) k[at] *= std::exp2(is_first ? half : -half);
      });
    }
  }
}

// The axes of the point that each port is at, the normal first.
std::vector<const Mat3*> frames_of_ports(const Exchange& exchange) {
  std::vector<const Mat3*> frames(exchange.ports.size(), nullptr);
  for (const auto& point : exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) frames[static_cast<size_t>(p)] = &point.frame;
  return frames;
}

}  // namespace

Vec search_directions(const StepModel& model, double multiplier, int n_window) {
  Vec k = Vec::Zero(model.n_q());
  const NodeAreas areas = node_areas(model);
  const std::vector<ElasticTensor> tensors = mean_tensors(model);
  const std::vector<const Mat3*> frames = frames_of_ports(model.exchange);
  const std::vector<Vec3> springs = law_springs(model);
  for (size_t p = 0; p < model.exchange.ports.size(); ++p) {
    const Port& port = model.exchange.ports[p];
    if (!model.solves(port.piece)) continue;
    const Piece& piece = *model.pieces[port.piece];
    const ElasticTensor& tensor = tensors[static_cast<size_t>(port.piece)];
    const double density = model.cut->piece(port.piece).body->material.density;
    const Vec3 normal = frames[p]->col(0);
    const bool has_schur = piece.schur_diagonal().size() > 0;
    for (int d = 0; d < 3; ++d) {
      if (port.unknown[d] < 0) continue;
      const InterfaceRow& row = piece.rows()[port.unknown[d]];
      const double schur = has_schur ? piece.schur_diagonal()[port.unknown[d]] : 0.0;
      double& direction = k[model.assembled_unknown(port, d)];
      if (piece.is_explicit()) {  // its answer is known, whatever q is
        direction = schur;
        continue;
      }
      const double modulus = d == 0 ? tensor.young(normal) : tensor.wave_modulus(normal, frames[p]->col(d));
      if (model.scheme.is_static) {
        // A body that only this unknown could hold has no stiffness of its own there.
        direction = has_schur            ? std::max(schur, 1e-3 * row.reference_stiffness)
                    : model.is_assembled ? 0.3 * modulus * std::sqrt(port.area)  // of cells under the point alone
                                         : row.static_stiffness;
        // A soft spring is all that such a side can feel of the other one.
        if (const double spring = springs[p][d]; spring > 0.0) direction = 1.0 / (1.0 / direction + 1.0 / spring);
        continue;
      }
      const double mass = mass_at(model, port, areas);
      const double speed = std::sqrt(tensor.wave_modulus(normal, frames[p]->col(d)) / density);
      const double impedance = density * speed * port.area;
      if (n_window > 5) {
        direction = impedance;
        continue;
      }
      const double k_step = std::hypot(model.scheme.from_end(impedance), mass / model.scheme.dt);
      const double stiffness = has_schur ? schur : std::max(k_step, from_area(model, port, modulus));
      direction = std::pow(stiffness, 0.75) * std::pow(k_step, 0.25);
    }
  }
  model.unknowns.complete(k.data());
  if (!model.scheme.is_static && n_window <= 5) {
    bring_bonded_sides_together(model, k);
    model.unknowns.complete(k.data());
  }
  return multiplier * k;
}

void fix_search_directions(StepModel& model, const Vec& k) {
  std::vector<double> cost;  // of a dense factor
  for (const int i : model.here) {
    const Piece& piece = *model.pieces[i];
    cost.push_back(piece.shares_operator() || model.integration.is_explicit_piece(i) ? 0.0
                                                                                     : std::pow(piece.n_rows(), 3));
  }
  for (const bool shares : {false, true})  // those whose operators others share come first
    parallel_by_cost(cost, [&](int at) {
      const int i = model.here[at];
      Piece& piece = *model.pieces[i];
      if (piece.shares_operator() == shares) piece.set_search_directions(k.segment(model.offset[i], piece.n_rows()));
    });
}

}  // namespace dygita

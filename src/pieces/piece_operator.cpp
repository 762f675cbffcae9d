#include "pieces/piece_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dygita {

namespace {

std::vector<std::pair<int, Mat3>> by_node(const std::unordered_map<int, Mat3>& impedance) {
  std::vector<std::pair<int, Mat3>> sorted(impedance.begin(), impedance.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return sorted;
}

}  // namespace

double PieceSetup::mass_share() const { return scheme.inertia_of_end(body->part->material.damping); }

FreeUnknowns unknowns_of(const PieceSetup& setup) { return {setup.n_nodes(), setup.rows, setup.held, setup.inside()}; }

namespace {

void add_block(const FreeUnknowns& unknowns, int node, int other, const Mat3& block, SparseMatrix& a) {
  const Mat3 left = unknowns.basis(node), right = unknowns.basis(other);
  for (int r = 0; r < unknowns.count(node); ++r)
    for (int c = 0; c < unknowns.count(other); ++c)
      a.coeffRef(unknowns.first(node) + r, unknowns.first(other) + c) += left.col(r).dot(block * right.col(c));
}

// T^T k T of the rows over several nodes.
SparseMatrix coupling_of_rows(const PieceSetup& setup, const FreeUnknowns& unknowns, const Vec& row_stiffness) {
  std::vector<Eigen::Triplet<double>> entries;
  const Traces traces = unknowns.traces(setup.rows);
  std::vector<int> number(unknowns.size());  // of the unknown at each position
  for (int i = 0; i < unknowns.size(); ++i) number[unknowns.position(i)] = i;
  for (int i = 0; i < row_stiffness.size(); ++i) {
    if (setup.rows[i].is_of_one_node() || row_stiffness[i] == 0.0) continue;
    const Trace t = traces[i];
    for (int a = 0; a < t.n; ++a)
      for (int b = 0; b < t.n; ++b)
        entries.emplace_back(number[t.at[a]], number[t.at[b]], row_stiffness[i] * t.value[a] * t.value[b]);
  }
  SparseMatrix coupling(unknowns.size(), unknowns.size());
  coupling.setFromTriplets(entries.begin(), entries.end());
  return coupling;
}

// The block of a node that begins at entry e of its rows; all matrices of a body without cells have one pattern.
Mat3 block_at(const SparseMatrix& matrix, int node, int e) {
  Mat3 block;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) block(r, c) = matrix.valuePtr()[matrix.outerIndexPtr()[3 * node + r] + e + c];
  return block;
}

SparseMatrix matrix_without_rows(const PieceSetup& setup, const FreeUnknowns& unknowns) {
  const StiffnessPtr stiffness = setup.body->matrices->stiffness();
  const SparseMatrix& k = *stiffness;
  const TimeScheme& scheme = setup.scheme;
  const Mass& mass = *setup.body->mass;
  const double mass_factor = setup.mass_share(), c1 = scheme.c1(setup.body->part->material.damping);
  const SparseMatrix* const full = !scheme.is_static && mass.full.size() > 0 ? &mass.full : nullptr;
  const SparseMatrix* const damping = setup.damping();
  SparseMatrix a(unknowns.size(), unknowns.size());
  std::vector<int> count(unknowns.size());
  const auto neighbours = [&](int node) {  // blocks of three columns
    const int begin = k.outerIndexPtr()[3 * node], end = k.outerIndexPtr()[3 * node + 1];
    return std::pair{begin, end};
  };
  for (int node = 0; node < unknowns.n_nodes(); ++node) {
    int columns = 0;
    const auto [begin, end] = neighbours(node);
    for (int e = begin; e < end; e += 3) columns += unknowns.count(k.innerIndexPtr()[e] / 3);
    for (int j = 0; j < unknowns.count(node); ++j) count[unknowns.first(node) + j] = columns;
  }
  a.reserve(count);
  const auto scale = [&](int at) {
    const bool is_massless = !scheme.is_static && !mass.is_massless.empty() && mass.is_massless[at];
    return is_massless ? 1.0 / scheme.from_end(1.0) : 1.0;
  };
  for (int node = 0; node < unknowns.n_nodes(); ++node) {
    const auto [begin, end] = neighbours(node);
    for (int e = 0; e < end - begin; e += 3) {
      const int other = k.innerIndexPtr()[begin + e] / 3;
      Mat3 block;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block(r, c) = c1 * k.valuePtr()[k.outerIndexPtr()[3 * node + r] + e + c];
      block *= scale(node) * scale(other);
      if (full)
        block += mass_factor * block_at(*full, node, e);
      else if (!scheme.is_static && mass.matrix.size() > 0)
        block.diagonal().array() += mass_factor * mass.matrix.valuePtr()[mass.matrix.outerIndexPtr()[node] + e / 3];
      else if (!scheme.is_static && other == node)
        block.diagonal().array() += mass_factor * mass.lumped[node];
      if (damping) block += scheme.from_end(block_at(*damping, node, e));
      if (!unknowns.is_plain(node)) block = (unknowns.basis(node).transpose() * block).eval();
      if (!unknowns.is_plain(other)) block = (block * unknowns.basis(other)).eval();
      for (int r = 0; r < unknowns.count(node); ++r)
        for (int c = 0; c < unknowns.count(other); ++c)
          a.insertBackUncompressed(unknowns.first(node) + r, unknowns.first(other) + c) = block(r, c);
    }
  }
  a.makeCompressed();
  for (const auto& [node, impedance] : by_node(setup.absorbing))
    add_block(unknowns, node, node, scheme.from_end(impedance), a);
  for (const auto& [node, other, impedance] : setup.absorbing_pairs)
    add_block(unknowns, node, other, scheme.from_end(impedance), a);
  return a;
}

}  // namespace

SparseMatrix piece_matrix(const PieceSetup& setup, const FreeUnknowns& unknowns, const Vec& row_stiffness) {
  SparseMatrix a = matrix_without_rows(setup, unknowns);
  bool is_coupled = false;
  for (int i = 0; i < row_stiffness.size(); ++i) {
    if (row_stiffness[i] == 0.0) continue;
    const InterfaceRow& row = setup.rows[i];
    if (row.is_of_one_node())
      add_block(unknowns, row.nodes[0].node, row.nodes[0].node,
                row_stiffness[i] * row.nodes[0].along * row.nodes[0].along.transpose(), a);
    else
      is_coupled = true;
  }
  if (is_coupled) a = SparseMatrix(a + coupling_of_rows(setup, unknowns, row_stiffness));
  return a;
}

Mat3 reference_spring(const InterfaceRow& row, const NodeAlong& on) {
  const double size = row.is_of_one_node() ? 1.0 : std::max(on.along.norm(), std::numeric_limits<double>::min());
  return row.reference_stiffness / size * on.along * on.along.transpose();
}

SparseMatrix matrix_with_reference(const PieceSetup& setup, const FreeUnknowns& unknowns) {
  SparseMatrix a = matrix_without_rows(setup, unknowns);
  for (const InterfaceRow& row : setup.rows)
    for (const NodeAlong& on : row.nodes)
      if (row.reference_stiffness != 0.0) add_block(unknowns, on.node, on.node, reference_spring(row, on), a);
  return a;
}

PieceOperator::PieceOperator(PieceSetup setup, FreeUnknowns unknowns)
    : setup_(std::move(setup)),
      stiffness_(setup_.body->matrices->stiffness()),
      unknowns_(std::move(unknowns)),
      mass_(*setup_.body, setup_.scheme, unknowns_),
      absorbing_(by_node(setup_.absorbing)),
      c0_(setup_.scheme.c0(damping())),
      c1_(setup_.scheme.c1(damping())) {
  traces_ = unknowns_.traces(setup_.rows);
  held_traces_ = unknowns_.held_traces(setup_.rows);
  for (int i = 0; i < held_traces_.size(); ++i) has_held_rows_ |= held_traces_[i].n > 0;
  make_couplings();
}

void PieceOperator::make_couplings() {
  coupling_.resize(setup_.n_motions);
  mass_coupling_.resize(setup_.n_motions);
  damping_coupling_.resize(setup_.n_motions);
  std::vector<Points> unit(setup_.n_motions);
  for (const HeldDirection& held : unknowns_.held())
    for (const auto& [motion, factor] : held.motion) {
      if (unit[motion].size() == 0) unit[motion] = Points::Zero(3, unknowns_.n_nodes());
      unit[motion].col(held.node) += factor * held.direction;
      has_motions_ = true;
    }
  for (int m = 0; m < setup_.n_motions; ++m) {
    if (unit[m].size() == 0) continue;
    coupling_[m] = stiffness_times(unit[m]);
    for (const int i : mass_.massless())
      coupling_[m][i] /= scheme().from_end(1.0);  // their force is that of the step's end
    if (setup_.damping()) damping_coupling_[m] = unknowns_.restrict_nodal(damping_force(unit[m]));
    if (mass_.is_matrix()) mass_coupling_[m] = unknowns_.restrict_nodal(mass_.times_nodal(unit[m]));
  }
}

Vec PieceOperator::at_rows(const Vec& x) const {
  Vec values = Vec::Zero(n_rows());
  for (int i = 0; i < n_rows(); ++i) values[i] = traces_[i].of(x);
  return values;
}

Vec PieceOperator::held_at_rows(const std::vector<double>& held) const {
  const Vec values = Eigen::Map<const Vec>(held.data(), static_cast<Eigen::Index>(held.size()));
  Vec at_rows(n_rows());
  for (int i = 0; i < n_rows(); ++i) at_rows[i] = held_traces_[i].of(values);
  return at_rows;
}

Points PieceOperator::elastic_force(const Points& nodal) const {
  Points result(3, nodal.cols());
  Eigen::Map<Vec>(result.data(), result.size()) = *stiffness_ * Eigen::Map<const Vec>(nodal.data(), nodal.size());
  return result;
}

std::vector<double> PieceOperator::stiffness_times_held(const Points& nodal) const {
  const SparseMatrix& k = *stiffness_;
  const Eigen::Map<const Vec> flat(nodal.data(), nodal.size());
  const std::vector<HeldDirection>& held = unknowns_.held();
  std::vector<double> values(held.size(), 0.0);
  for (size_t i = 0; i < held.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (held[i].direction[axis] != 0.0)
        values[i] += held[i].direction[axis] * k.row(3 * held[i].node + axis).dot(flat);
  return values;
}

Vec PieceOperator::momentum(const Vec& v, const std::vector<double>& held_v) const {
  if (has_motions_ && mass_.is_matrix())
    return unknowns_.restrict_nodal(mass_.times_nodal(unknowns_.expand(v, held_v)));
  return mass_.times(v);
}

Vec PieceOperator::pull_of_held(const std::vector<double>& held_v) const {
  const Points nodal = unknowns_.expand(Vec::Zero(n_free()), held_v);
  Vec pull = c1_ * stiffness_times(nodal);
  if (setup_.damping()) pull += scheme().from_end(1.0) * unknowns_.restrict_nodal(damping_force(nodal));
  if (mass_.is_matrix()) pull += mass_share() * unknowns_.restrict_nodal(mass_.times_nodal(nodal));
  return pull;
}

Vec PieceOperator::pull_of_motions(const std::vector<double>& motion_velocity) const {
  Vec pull = Vec::Zero(n_free());
  for (size_t m = 0; m < coupling_.size(); ++m) {
    if (coupling_[m].size() > 0) pull += c1_ * motion_velocity[m] * coupling_[m];
    if (mass_coupling_[m].size() > 0) pull += mass_share() * motion_velocity[m] * mass_coupling_[m];
    if (damping_coupling_[m].size() > 0) pull += scheme().from_end(motion_velocity[m]) * damping_coupling_[m];
  }
  return pull;
}

Points PieceOperator::damping_force(const Points& nodal) const {
  Points force(3, nodal.cols());
  force.reshaped() = *setup_.damping() * nodal.reshaped();
  return force;
}

void PieceOperator::apply_rates(const Vec& v, const std::vector<double>& held_v, double factor, Vec& out) const {
  apply_absorbing(v, factor, out);
  if (setup_.damping()) out += factor * unknowns_.restrict_nodal(damping_force(unknowns_.expand(v, held_v)));
}

void PieceOperator::apply_absorbing(const Vec& v, double factor, Vec& out) const {
  const auto add = [&](int node, int other, const Mat3& impedance) {
    const Mat3 left = unknowns_.basis(node), right = unknowns_.basis(other);
    Vec3 nodal = Vec3::Zero();
    for (int j = 0; j < unknowns_.count(other); ++j) nodal += v[unknowns_.at(other, j)] * right.col(j);
    const Vec3 force = factor * (impedance * nodal);
    for (int j = 0; j < unknowns_.count(node); ++j) out[unknowns_.at(node, j)] += left.col(j).dot(force);
  };
  for (const auto& [node, impedance] : absorbing_) add(node, node, impedance);
  for (const auto& [node, other, impedance] : setup_.absorbing_pairs) add(node, other, impedance);
}

}  // namespace dygita

// The assembly at an instant as one linear system: what laws, supports and rigid faces leave free, and its matrices.
// One file, since all of it fills the same maps from nodes to unknowns, in this order.
#include "reduction/linear_assembly.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "exchange/rigid_motions.hpp"
#include "fem/mass.hpp"
#include "law/law.hpp"
#include "numerics/dense.hpp"
#include "numerics/frame_along.hpp"

namespace dygita {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// Disjoint sets of nodes.
struct Places {
  std::vector<int> parent;
  explicit Places(int n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
  int of(int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(int a, int b) { parent[of(a)] = of(b); }
};

void add_condition(LinearAssembly& assembly, int a, int b, const Vec3& direction) {
  assembly.conditions.push_back({{a, b}, {direction, Vec3(-direction)}});
}

// Counts a point of contact by what it does along the normal and the tangents.
void count_contact(const Tangent& tangent, LinearAssembly& assembly) {
  const auto carries = [&](int d) { return tangent.holds[d] || tangent.stiffness[d] > 0.0; };
  ++(!carries(0) ? assembly.n_open : carries(1) && carries(2) ? assembly.n_tied : assembly.n_normal);
}

// A point between faces that do not match: each direction of its law is a sum over nodes.
void add_spread_point(const Instant& instant, int s, int i, bool ties_sliding, LinearAssembly& assembly) {
  const Surface& surface = (*instant.model.surfaces)[s];
  const Tangent tangent = surface.declared_law().tangent(instant.surface(s).points[i], ties_sliding);
  const Mat3 frame = surface.facing.is_of_sums() ? surface.facing.frames[static_cast<size_t>(i)]
                                                 : frame_along(surface.facing.normals.col(i), surface.facing.tangent);
  for (int d = 0; d < 3; ++d) {
    if (!surface.facing.acts_along(i, d)) continue;
    if (!tangent.holds[d] && tangent.damping[d] == 0.0 && tangent.stiffness[d] == 0.0) continue;
    const double area = surface.facing.areas[i];
    SpreadSum sum{{}, tangent.holds[d], area * tangent.damping[d], area * tangent.stiffness[d]};
    for (const auto& [trace, part, sign] : {std::tuple{&surface.facing.side_1, surface.part_1, -1.0},
                                            std::tuple{&surface.facing.side_2, surface.part_2, 1.0}})
      for (int k = 0; part >= 0 && k < trace->n_shares(i); ++k)
        sum.nodes.emplace_back(assembly.first_node[part] + trace->share(i, k).node,
                               sign * (trace->block(i, k).transpose() * frame.col(d)));
    assembly.sums.push_back(std::move(sum));
  }
  if (surface.declared_law().shown().gap) count_contact(tangent, assembly);
}

// Interfaces and walls: what each point does at this instant.
void add_surfaces(const Instant& instant, bool ties_sliding, LinearAssembly& assembly) {
  const auto& supports = supports_of(*instant.model.problem, *instant.model.step);
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (instant.state.released[s] || (surface.wall && index_of(supports, surface.wall) < 0)) continue;
    const Law& law = surface.declared_law();
    const bool is_contact = law.shown().gap;
    for (int i = 0; i < surface.n_points(); ++i) {
      if (!surface.facing.matches()) {
        add_spread_point(instant, static_cast<int>(s), i, ties_sliding, assembly);
        continue;
      }
      const int a = assembly.first_node[surface.part_1] + surface.facing.side_1.main_node(i);
      const int b = surface.part_2 >= 0 ? assembly.first_node[surface.part_2] + surface.facing.side_2.main_node(i) : -1;
      const Tangent tangent = law.tangent(instant.surface(s).points[i], ties_sliding);
      const Mat3 frame = frame_along(surface.facing.normals.col(i));
      const auto n_held = std::count(tangent.holds.begin(), tangent.holds.end(), true);
      for (int d = 0; d < 3; ++d)
        if (tangent.holds[d]) add_condition(assembly, a, b, n_held == 3 ? Vec3(Vec3::Unit(d)) : Vec3(frame.col(d)));
      if (!tangent.damping.isZero(0.0) || !tangent.stiffness.isZero(0.0))
        assembly.springs_of_laws.push_back(
            {{a, b}, frame, surface.facing.areas[i] * tangent.damping, surface.facing.areas[i] * tangent.stiffness});
      if (is_contact) count_contact(tangent, assembly);
    }
  }
}

void add_supports(const Instant& instant, LinearAssembly& assembly) {
  Step bare = *instant.model.step;
  bare.loads.clear();
  const Conditions conditions = make_conditions(*instant.model.problem, bare, instant.state);
  for (size_t part = 0; part < conditions.held.size(); ++part) {
    const std::map<int, Held> by_node(conditions.held[part].begin(), conditions.held[part].end());
    for (const auto& [node, held] : by_node)
      for (int j = 0; j < held.n; ++j)
        add_condition(assembly, assembly.first_node[part] + node, -1, held.directions.col(j));
  }
  // The last amplitudes of a body of matrices share a node with directions that are none.
  const auto& parts = instant.model.problem->substructures;
  for (size_t part = 0; part < parts.size(); ++part)
    for (const auto& [node, direction] : parts[part]->mesh->inside->absent)
      add_condition(assembly, assembly.first_node[part] + node, -1, direction);
}

// Basis of the displacements (3 per node) that the conditions of a place leave: an orthonormal one of their null space.
Mat free_basis(const std::vector<int>& nodes, const std::vector<const NodeCondition*>& conditions) {
  const int m = static_cast<int>(nodes.size());
  if (conditions.empty()) return Mat::Identity(3, 3);
  Mat transposed = Mat::Zero(3 * m, static_cast<int>(conditions.size()));
  for (size_t c = 0; c < conditions.size(); ++c)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < m; ++i)
        if (conditions[c]->node[side] == nodes[i]) transposed.block(3 * i, c, 3, 1) += conditions[c]->coefficient[side];
  const auto [q, rank] = ranked_basis(transposed, 1e-8);
  Mat basis = q.rightCols(3 * m - rank);
  // All copies tied and nothing else: their common motion, along the axes.
  if (basis.cols() == 3 && rank == 3 * (m - 1)) {
    Mat common(3 * m, 3);
    for (int i = 0; i < m; ++i) common.middleRows(3 * i, 3) = Mat3::Identity();
    if ((transposed.transpose() * common).norm() < 1e-12) basis = common;
  }
  return basis;
}

// Nodes of rigid faces from the unknowns of the point and the turn that they follow.
void make_followers(const Problem& problem, LinearAssembly& assembly) {
  Triplets entries;
  const auto add = [&](int row, int from, double factor) {
    for (SparseMatrix::InnerIterator e(assembly.map, from); e; ++e)
      entries.emplace_back(row, static_cast<int>(e.col()), factor * e.value());
  };
  for (size_t part = 0; part < problem.substructures.size(); ++part)
    for (const Interior::Follower& own : problem.substructures[part]->mesh->inside->followers) {
      const int first = assembly.first_node[part];
      for (int d = 0; d < 3; ++d) {
        const int row = 3 * (first + own.node) + d, j = (d + 1) % 3, k = (d + 2) % 3;
        add(row, 3 * (first + own.point) + d, 1.0);
        if (own.turn < 0) continue;
        add(row, 3 * (first + own.turn) + j, own.arm[k] / own.size);
        add(row, 3 * (first + own.turn) + k, -own.arm[j] / own.size);
      }
    }
  assembly.followers.resize(assembly.map.rows(), assembly.map.cols());
  assembly.followers.setFromTriplets(entries.begin(), entries.end());
}

void make_map(const Problem& problem, LinearAssembly& assembly) {
  const int n_nodes = assembly.first_node.back();
  Places places(n_nodes);
  for (const NodeCondition& condition : assembly.conditions)
    if (condition.node[1] >= 0) places.join(condition.node[0], condition.node[1]);
  std::vector<std::vector<int>> nodes(n_nodes);
  std::vector<std::vector<const NodeCondition*>> conditions(n_nodes);
  for (int i = 0; i < n_nodes; ++i) nodes[places.of(i)].push_back(i);
  for (const NodeCondition& condition : assembly.conditions)
    conditions[places.of(condition.node[0])].push_back(&condition);
  for (size_t part = 0; part < problem.substructures.size(); ++part)
    for (const Interior::Follower& own : problem.substructures[part]->mesh->inside->followers)
      nodes[assembly.first_node[part] + own.node].clear();  // they have no unknowns, and no condition
  Triplets entries;
  int n = 0;
  for (int place = 0; place < n_nodes; ++place) {
    if (nodes[place].empty()) continue;
    const Mat basis = free_basis(nodes[place], conditions[place]);
    for (int column = 0; column < basis.cols(); ++column) {
      for (int row = 0; row < basis.rows(); ++row)
        if (std::abs(basis(row, column)) > 1e-14)
          entries.emplace_back(3 * nodes[place][row / 3] + row % 3, n, basis(row, column));
      assembly.place_of_unknown.push_back(place);
      ++n;
    }
  }
  assembly.map.resize(3 * n_nodes, n);
  assembly.map.setFromTriplets(entries.begin(), entries.end());
}

// Adds what the springs of laws have of a kind, between their nodes, to a matrix of the unknowns.
void add_between_nodes(const LinearAssembly& assembly, Vec3 Spring::*coefficient, SparseMatrix& matrix) {
  Triplets entries;
  for (const Spring& spring : assembly.springs_of_laws) {
    const Mat3 block = spring.frame * (spring.*coefficient).asDiagonal() * spring.frame.transpose();
    if (block.isZero(0.0)) continue;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        for (int row = 0; row < 3 && spring.node[p] >= 0 && spring.node[q] >= 0; ++row)
          for (int column = 0; column < 3; ++column)
            entries.emplace_back(3 * spring.node[p] + row, 3 * spring.node[q] + column,
                                 (p == q ? 1.0 : -1.0) * block(row, column));
  }
  if (entries.empty()) return;
  SparseMatrix nodal(assembly.map.rows(), assembly.map.rows());
  nodal.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix transposed = assembly.map.transpose(), product = nodal * assembly.map;
  if (matrix.rows() == 0) matrix.resize(assembly.map.cols(), assembly.map.cols());
  matrix += SparseMatrix(transposed * product);
}

SparseMatrix sparse_of(Eigen::Index n_rows, Eigen::Index n_columns, const Triplets& entries) {
  SparseMatrix matrix(n_rows, n_columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// n x n, kg: as the cells of the body have it in a step.
SparseMatrix nodal_mass(const Substructure& body, const BodyMatrices& matrices) {
  if (has_consistent_mass(*body.mesh)) return consistent_mass(*body.mesh, body.material);
  SparseMatrix lumped(matrices.mass.size(), matrices.mass.size());
  lumped.reserve(Eigen::VectorXi::Constant(lumped.rows(), 1));
  for (int i = 0; i < lumped.rows(); ++i) lumped.insert(i, i) = matrices.mass[i];
  return lumped;
}

// The same for each of the three directions: 3n x 3n.
SparseMatrix by_axis(const SparseMatrix& nodal) {
  Triplets entries;
  entries.reserve(static_cast<size_t>(3 * nodal.nonZeros()));
  for (int row = 0; row < nodal.outerSize(); ++row)
    for (SparseMatrix::InnerIterator entry(nodal, row); entry; ++entry)
      for (int d = 0; d < 3; ++d)
        entries.emplace_back(3 * static_cast<int>(entry.row()) + d, 3 * static_cast<int>(entry.col()) + d,
                             entry.value());
  SparseMatrix all(3 * nodal.rows(), 3 * nodal.cols());
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

// A sum on the unknowns.
std::map<int, double> row_of(const LinearAssembly& assembly, const SpreadSum& sum) {
  std::map<int, double> row;
  for (const auto& [node, coefficient] : sum.nodes)
    for (int d = 0; d < 3; ++d)
      for (SparseMatrix::InnerIterator e(assembly.map, 3 * node + d); e; ++e)
        row[static_cast<int>(e.col())] += coefficient[d] * e.value();
  return row;
}

// Rows times the root of their factor, of the sums that have one.
template <typename Factor>
SparseMatrix rooted_sums(const LinearAssembly& assembly, Factor&& factor) {
  Triplets entries;
  int n = 0;
  for (const SpreadSum& sum : assembly.sums) {
    const std::map<int, double> row = row_of(assembly, sum);
    const double root = std::sqrt(factor(sum, row));
    if (root == 0.0) continue;
    for (const auto& [i, a] : row) entries.emplace_back(n, i, root * a);
    ++n;
  }
  return sparse_of(n, assembly.map.cols(), entries);
}

void add_sums(LinearAssembly& assembly) {
  constexpr double stiff = 1e6;
  if (assembly.sums.empty()) return;
  const auto add = [&](double SpreadSum::*coefficient, SparseMatrix& matrix) {
    const SparseMatrix rows =
        rooted_sums(assembly, [&](const SpreadSum& sum, const auto&) { return sum.*coefficient; });
    if (rows.rows() == 0) return;
    if (matrix.rows() == 0) matrix.resize(assembly.map.cols(), assembly.map.cols());
    matrix += SparseMatrix(SparseMatrix(rows.transpose()) * rows);
  };
  add(&SpreadSum::damping, assembly.damping);
  add(&SpreadSum::stiffness, assembly.stiffness);
  const Vec diagonal = assembly.stiffness.diagonal();
  assembly.cells = assembly.stiffness;
  assembly.springs = rooted_sums(assembly, [&](const SpreadSum& sum, const std::map<int, double>& row) {
    double stiffest = 0.0;
    for (const auto& [i, a] : row) stiffest = std::max(stiffest, diagonal[i]);
    return sum.is_held ? stiff * stiffest : 0.0;
  });
  assembly.stiffness += SparseMatrix(SparseMatrix(assembly.springs.transpose()) * assembly.springs);
}

void add_relaxing(const Damping& damping, const SparseMatrix& stiffness, LinearAssembly& assembly) {
  for (auto& [known, sum] : assembly.relaxing)
    if (known == damping) {
      sum += stiffness;
      return;
    }
  assembly.relaxing.emplace_back(damping, stiffness);
}

void add_matrices(const Problem& problem, LinearAssembly& assembly) {
  const int n = static_cast<int>(assembly.map.cols());
  assembly.stiffness.resize(n, n);
  assembly.mass.resize(n, n);
  std::map<std::pair<std::string, MaterialKey>, BodyMatrices> known;
  for (size_t part = 0; part < problem.substructures.size(); ++part) {
    const Substructure& body = *problem.substructures[part];
    const Elastic& material = body.material;
    const auto [it, is_new] = known.try_emplace({body.mesh->digest, material.key()});
    if (is_new) it->second = assemble(*body.mesh, material);
    const BodyMatrices& own = it->second;
    const SparseMatrix map = assembly.map.middleRows(3 * assembly.first_node[part], 3 * body.mesh->n_nodes());
    const SparseMatrix transposed = map.transpose();
    const CondensedBody* matrices = body.mesh->inside->matrices();
    assembly.nodal_masses.push_back(matrices ? matrices->mass_matrix : by_axis(nodal_mass(body, own)));
    const SparseMatrix k_map = own.stiffness * map, m_map = assembly.nodal_masses.back() * map;
    const SparseMatrix k = transposed * k_map, m = transposed * m_map;
    assembly.stiffness += k;
    assembly.mass += m;
    assembly.mass_of_parts += own.mass.sum();
    if (const SparseMatrix& inside = body.mesh->inside->damping; inside.size() > 0) {
      if (assembly.damping.rows() == 0) assembly.damping.resize(n, n);
      const SparseMatrix c_map = inside * map;
      assembly.damping += SparseMatrix(transposed * c_map);
    }
    const Damping& damping = material.damping;
    if (!damping.branches.empty()) add_relaxing(damping, k, assembly);
    if (damping.mass == 0.0 && damping.stiffness == 0.0) continue;
    if (assembly.damping.rows() == 0) assembly.damping.resize(n, n);
    assembly.damping += damping.mass * m + damping.stiffness * k;
  }
  add_between_nodes(assembly, &Spring::damping, assembly.damping);
  add_between_nodes(assembly, &Spring::stiffness, assembly.stiffness);
  add_sums(assembly);
  assembly.stiffness.makeCompressed();
  assembly.mass.makeCompressed();
  assembly.damping.makeCompressed();
}

}  // namespace

int LinearAssembly::n_damped() const {
  return static_cast<int>(std::count_if(springs_of_laws.begin(), springs_of_laws.end(),
                                        [](const Spring& spring) { return !spring.damping.isZero(0.0); }));
}

Mat LinearAssembly::energies(const Mat& x) const {
  if (springs.rows() == 0) return x.transpose() * (stiffness * x);
  const Mat felt = springs * x;
  return x.transpose() * (cells * x) + felt.transpose() * felt;
}

LinearAssembly linearise(const Instant& instant, bool ties_sliding) {
  const Problem& problem = *instant.model.problem;
  LinearAssembly assembly;
  assembly.first_node.push_back(0);
  for (const SubstructurePtr& part : problem.substructures)
    assembly.first_node.push_back(assembly.first_node.back() + part->mesh->n_nodes());
  add_surfaces(instant, ties_sliding, assembly);
  add_supports(instant, assembly);
  make_map(problem, assembly);
  make_followers(problem, assembly);
  add_matrices(problem, assembly);
  return assembly;
}

std::string free_motion(const LinearAssembly& assembly, const Problem& problem, const std::vector<int>& held_nodes) {
  const int n = static_cast<int>(problem.substructures.size());
  std::vector<Vec3> centre;
  std::vector<double> size;
  for (const SubstructurePtr& part : problem.substructures) {
    const Vec3 low = part->mesh->nodes.rowwise().minCoeff(), high = part->mesh->nodes.rowwise().maxCoeff();
    centre.push_back(0.5 * (low + high));
    size.push_back((high - low).norm());
  }
  // Sum of squares of all conditions on the rigid motions, rotations times the size of their body.
  Mat gram = Mat::Zero(6 * n, 6 * n);
  const auto add_sum = [&](const std::vector<std::pair<int, Vec3>>& nodes) {
    std::vector<std::pair<int, Eigen::Matrix<double, 6, 1>>> rows;
    for (const auto& [node, coefficient] : nodes) {
      if (node < 0) continue;
      const int part = static_cast<int>(std::upper_bound(assembly.first_node.begin(), assembly.first_node.end(), node) -
                                        assembly.first_node.begin()) -
                       1;
      const Vec3 x = problem.substructures[part]->mesh->nodes.col(node - assembly.first_node[part]);
      Eigen::Matrix<double, 6, 1> row;
      row << coefficient, (x - centre[part]).cross(coefficient) / size[part];
      const auto same = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.first == 6 * part; });
      if (same == rows.end())
        rows.emplace_back(6 * part, row);
      else
        same->second += row;
    }
    for (const auto& [i, a] : rows)
      for (const auto& [j, b] : rows) gram.block<6, 6>(i, j) += a * b.transpose();
  };
  const auto add = [&](const NodeCondition& condition) {
    add_sum({{condition.node[0], condition.coefficient[0]}, {condition.node[1], condition.coefficient[1]}});
  };
  for (const SpreadSum& sum : assembly.sums)
    if (sum.is_held || sum.stiffness > 0.0) add_sum(sum.nodes);
  for (const Spring& spring : assembly.springs_of_laws)
    for (int d = 0; d < 3; ++d)
      if (spring.stiffness[d] > 0.0) add({spring.node, {Vec3(spring.frame.col(d)), Vec3(-spring.frame.col(d))}});
  for (const NodeCondition& condition : assembly.conditions) add(condition);
  for (const int node : held_nodes)
    for (int d = 0; d < 3; ++d) add({{node, -1}, {Vec3::Unit(d), Vec3::Zero()}});
  Vec weight(6 * n);
  for (int i = 0; i < n; ++i)
    weight.segment<6>(6 * i).setConstant(1.0 / std::sqrt(std::max(1.0, gram.block<6, 6>(6 * i, 6 * i).trace())));
  const EigenPairs eigen = symmetric_eigen(weight.asDiagonal() * gram * weight.asDiagonal());
  if (eigen.values[0] >= 1e-9) return "";
  const Vec motion = weight.cwiseProduct(eigen.vectors.col(0));
  int at = 0;
  motion.cwiseAbs().maxCoeff(&at);
  const RigidMotion of_part = motion.segment<6>(6 * (at / 6));
  return name_of(of_part) + " of substructure '" + problem.substructures[static_cast<size_t>(at / 6)]->name + "'";
}

const Step* step_about(const Problem& problem, const StepPtr& named) {
  const Step* step = named.get();
  for (const StepPtr& other : problem.steps)
    if (!named && other->is_static) step = other.get();
  return step;
}

}  // namespace dygita

#include "reduction/free_motions.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "base/union_find.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr int most_free_motions = 600;

SparseMatrix diagonal_matrix(const Vec& values) {
  SparseMatrix matrix(values.size(), values.size());
  matrix.reserve(Eigen::VectorXi::Constant(values.size(), 1));
  for (Eigen::Index i = 0; i < values.size(); ++i) matrix.insert(i, i) = values[i];
  return matrix;
}

// Nodes of a mesh that its cells join, lump by lump. A body of matrices is one.
std::vector<std::vector<int>> lumps_of(const Mesh& mesh) {
  UnionFind joined(mesh.n_nodes());
  if (!mesh.has_cells())
    for (int i = 1; i < mesh.n_nodes(); ++i) joined.join(0, i);
  for (const CellBlock& block : mesh.blocks) {
    const size_t n = cell_shape(block.type).shape.nodes.size();
    for (int i = 0; i < block.n_cells(); ++i)
      for (size_t k = 1; k < n; ++k) joined.join(block.cell(i)[0], block.cell(i)[k]);
  }
  std::map<int, std::vector<int>> nodes;
  for (int i = 0; i < mesh.n_nodes(); ++i) nodes[joined.root(i)].push_back(i);
  std::vector<std::vector<int>> lumps;
  for (auto& [root, lump] : nodes) lumps.push_back(std::move(lump));
  return lumps;
}

// Translations along the axes and rotations about them through `centre`, by an angle of one over `size`, of some nodes
// (all of a body of matrices): 3 n x 6.
Mat rigid_motions_of(const Mesh& mesh, const Points& x, const Vec3& centre, double size) {
  Mat motions(3 * x.cols(), 6);
  for (int d = 0; d < 3; ++d) {
    motions.col(d) = mesh.inside->rigid_motion(x, Vec3::Unit(d), Vec3::Zero()).reshaped();
    motions.col(3 + d) = mesh.inside->rigid_motion(x, centre, Vec3::Zero(), Vec3::Unit(d) / size).reshaped();
  }
  return motions;
}

// Rigid motions of a lump on its nodes, orthonormal: 3 n x 6, fewer columns where its nodes lie on a line.
Mat motions_of(const Mesh& mesh, const std::vector<int>& lump) {
  const Points x = mesh.nodes(Eigen::all, lump);
  const Vec3 centre = x.rowwise().mean();
  const double size = std::sqrt((x.colwise() - centre).colwise().squaredNorm().mean());
  const Mat motions = rigid_motions_of(mesh, x, centre, size > 0.0 ? size : 1.0);
  const EigenPairs gram = symmetric_eigen(motions.transpose() * motions);
  const auto rank = (gram.values.array() > 1e-12 * gram.values.tail(1)[0]).count();
  return motions * (gram.vectors.rightCols(rank) * gram.values.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal());
}

// The same of all lumps, on the nodes of the assembly.
SparseMatrix motions_of_lumps(const LinearAssembly& assembly, const Problem& problem) {
  std::vector<Eigen::Triplet<double>> entries;
  std::map<const Mesh*, std::vector<std::pair<std::vector<int>, Mat>>> known;
  int column = 0;
  for (size_t part = 0; part < problem.substructures.size(); ++part) {
    const Mesh& mesh = *problem.substructures[part]->mesh;
    const auto [own, is_new] = known.try_emplace(&mesh);
    if (is_new)
      for (std::vector<int>& lump : lumps_of(mesh)) {
        Mat motions = motions_of(mesh, lump);
        own->second.emplace_back(std::move(lump), std::move(motions));
      }
    for (const auto& [lump, motions] : own->second) {
      for (Eigen::Index m = 0; m < motions.cols(); ++m)
        for (size_t i = 0; i < lump.size(); ++i)
          for (int d = 0; d < 3 && !mesh.inside->follower(lump[i]); ++d)
            entries.emplace_back(3 * (assembly.first_node[part] + lump[i]) + d, column + static_cast<int>(m),
                                 motions(3 * static_cast<Eigen::Index>(i) + d, m));
      column += static_cast<int>(motions.cols());
    }
  }
  SparseMatrix all(assembly.map.rows(), column);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

// Combinations of columns whose square is nothing: the null space of a matrix whose entries are of the order of one.
Mat null_space(const Mat& gram, double nothing) {
  const EigenPairs eigen = symmetric_eigen(gram);
  return eigen.vectors.leftCols((eigen.values.array() < nothing).count());
}

const CyclicSymmetry* cyclic_symmetry_of(const Problem& problem) {
  for (const InterfacePtr& interface : problem.interfaces)
    if (interface->cyclic) return &*interface->cyclic;
  return nullptr;
}

// The translation along the axis of a ring and the turn about it, as combinations of the motions of the lumps: of a
// sector whose cut faces fit each other to the digits of a file they break the ties by as much. Others: none.
Mat motions_of_ring(const LinearAssembly& assembly, const Problem& problem, const SparseMatrix& lumps) {
  const CyclicSymmetry* ring = cyclic_symmetry_of(problem);
  if (!ring) return Mat(lumps.cols(), 0);
  Mat rigid(lumps.rows(), 2);
  for (size_t part = 0; part < problem.substructures.size(); ++part) {
    const Mesh& mesh = *problem.substructures[part]->mesh;
    const Vec3 about = ring->through - problem.substructures[part]->place;
    const auto rows = Eigen::seqN(3 * assembly.first_node[part], 3 * mesh.n_nodes());
    rigid(rows, 0) = mesh.inside->rigid_motion(mesh.nodes, about, ring->along, Vec3::Zero()).reshaped();
    rigid(rows, 1) = mesh.inside->rigid_motion(mesh.nodes, about, Vec3::Zero(), ring->along).reshaped();
  }
  return lumps.transpose() * (rigid * rigid.colwise().norm().cwiseInverse().asDiagonal());
}

// As much of a motion as faces that meet node for node may be apart, of their smallest edge; its square.
constexpr double rounded = 1e-12;

// Motions of the lumps in which no condition is broken, on the unknowns.
Mat unbroken_motions(const LinearAssembly& assembly, const Problem& problem, const std::string& what) {
  constexpr double nothing = 1e-14;  // square of what conditions have of a motion of norm one
  const SparseMatrix lumps = motions_of_lumps(assembly, problem), transposed = assembly.map.transpose();
  // The columns of the map are orthogonal.
  const Vec squares = (assembly.map.cwiseProduct(assembly.map)).transpose() * Vec::Ones(assembly.map.rows());
  const SparseMatrix z = diagonal_matrix(squares.cwiseInverse()) * SparseMatrix(transposed * lumps);
  const SparseMatrix broken = lumps - SparseMatrix(assembly.map * z);
  Mat gram = Mat(SparseMatrix(broken.transpose()) * broken);
  if (assembly.springs.rows() > 0) {
    // Where supports hold nearly all nodes of a sum, what is left of it may be rounding.
    constexpr double little = 1e-3;
    const Vec norms =
        (assembly.springs.cwiseProduct(assembly.springs) * Vec::Ones(assembly.springs.cols())).cwiseSqrt();
    const Vec sizes = norms.cwiseMax(little * norms.maxCoeff());
    const SparseMatrix felt = diagonal_matrix(sizes.cwiseInverse()) * SparseMatrix(assembly.springs * z);
    gram += Mat(SparseMatrix(felt.transpose()) * felt);
  }
  const Mat of_ring = motions_of_ring(assembly, problem, lumps);
  for (Eigen::Index m = 0; m < of_ring.cols(); ++m) {
    const Vec motion = of_ring.col(m), broken_by_it = gram * motion;
    const double square = motion.dot(broken_by_it);
    if (square < rounded)
      gram +=
          square * motion * motion.transpose() - motion * broken_by_it.transpose() - broken_by_it * motion.transpose();
  }
  const Mat kept = null_space(gram, nothing);
  if (kept.cols() > most_free_motions)
    throw NumericalError(fmt::format("{}: {} motions are free, at most {} are computed: most bodies are loose", what,
                                     kept.cols(), most_free_motions));
  return z * kept;
}

// Columns of x made orthonormal in the mass.
Mat orthonormal(const Mat& x, const SparseMatrix& mass) {
  if (x.cols() == 0) return x;
  const EigenPairs gram = symmetric_eigen(x.transpose() * (mass * x));
  return x * (gram.vectors * gram.values.cwiseSqrt().cwiseInverse().asDiagonal());
}

}  // namespace

Mat WholeInertia::sorted(const Mat& of_vectors) const {
  constexpr double nothing = 1e-3;
  const Eigen::Index k = of_vectors.rows();
  Mat candidates(k, 6 + k), basis(k, k);
  candidates << of_vectors, Mat::Identity(k, k);
  Eigen::Index n = 0;
  for (Eigen::Index c = 0; c < candidates.cols() && n < k; ++c) {
    Vec column = candidates.col(c);
    for (int pass = 0; pass < 2; ++pass) column -= basis.leftCols(n) * (basis.leftCols(n).transpose() * column);
    const double whole = c < 3 ? mass : c < 6 ? moments[c - 3] : 1.0 / static_cast<double>(k);
    if (column.norm() > nothing * std::sqrt(whole)) basis.col(n++) = column.normalized();
  }
  return basis.leftCols(n);
}

namespace {

// A sector's share of what its ring is: about a centre on the axis, and without motions across it, which differ from
// sector to sector.
void take_share_of_ring(const CyclicSymmetry& ring, const Mat3& inertia, WholeInertia& whole) {
  Mat3 mean = Mat3::Zero(), turn = Mat3::Identity();
  for (int i = 0; i < ring.n; ++i, turn = (ring.turn * turn).eval())
    mean += turn * inertia * turn.transpose() / static_cast<double>(ring.n);
  whole.moments = mean.diagonal();
  const Mat3 along = ring.along * ring.along.transpose();
  for (const int first : {0, 3})
    whole.momenta.middleCols(first, 3) = (whole.momenta.middleCols(first, 3) * along).eval();
}

}  // namespace

WholeInertia whole_inertia(const LinearAssembly& assembly, const Problem& problem) {
  using SpatialInertia = Eigen::Matrix<double, 6, 6>;
  const auto& parts = problem.substructures;
  Vec3 near = Vec3::Zero();  // arms are short about it, wherever the assembly stands
  for (const SubstructurePtr& part : parts)
    near += (part->mesh->nodes.rowwise().mean() + part->place) / static_cast<double>(parts.size());
  Mat of_nodes(assembly.map.rows(), 6);
  SpatialInertia inertia = SpatialInertia::Zero();
  for (size_t p = 0; p < parts.size(); ++p) {
    const Mesh& mesh = *parts[p]->mesh;
    const Mat motions = rigid_motions_of(mesh, mesh.nodes, near - parts[p]->place, 1.0);
    auto own = of_nodes.middleRows(3 * assembly.first_node[p], motions.rows());
    own = assembly.nodal_masses[p] * motions;
    inertia += motions.transpose() * own;
  }
  WholeInertia whole;
  whole.mass = inertia(0, 0);
  Vec3 arm = Vec3(inertia(1, 5), inertia(2, 3), inertia(0, 4)) / whole.mass;
  const CyclicSymmetry* ring = cyclic_symmetry_of(problem);
  if (ring) arm = ring->through + ring->along.dot(near + arm - ring->through) * ring->along - near;
  whole.centre = near + arm;
  SpatialInertia shift = SpatialInertia::Identity();
  for (int d = 0; d < 3; ++d) shift.block<3, 1>(0, 3 + d) = -Vec3::Unit(d).cross(arm);
  const Mat3 about = (shift.transpose() * inertia * shift).bottomRightCorner<3, 3>();
  whole.moments = about.diagonal();
  whole.momenta = assembly.map.transpose() * (of_nodes * shift);
  if (ring) take_share_of_ring(*ring, about, whole);
  return whole;
}

Mat free_motions(const LinearAssembly& assembly, const Problem& problem, const WholeInertia& whole,
                 const std::string& what) {
  // Of the square of the highest frequency; the rounding of x^T K x is a hundredth of it.
  constexpr double nothing_stored = 1e-14;
  const Mat motions = orthonormal(unbroken_motions(assembly, problem, what), assembly.mass);
  if (motions.cols() == 0) return motions;
  const SparseMatrix& elastic = assembly.springs.rows() > 0 ? assembly.cells : assembly.stiffness;
  const double highest = elastic.diagonal().cwiseQuotient(assembly.mass.diagonal()).maxCoeff();
  // What a sector's rounded places break of its ties is no energy, however stiff they are.
  const Mat stored = cyclic_symmetry_of(problem)
                         ? Mat(motions.transpose() * (elastic * motions) * (nothing_stored / rounded))
                         : assembly.energies(motions);
  const Mat unresisted = motions * null_space(stored / highest, nothing_stored);
  return unresisted * whole.sorted(unresisted.transpose() * whole.momenta);
}

}  // namespace dygita

// Hex8: the trilinear hexahedron and its 12 enhanced strain modes, condensed cell by cell.
//
// Enhanced displacement gradient at a point of reference coordinates xi, Jacobian j (j_0 and columns g_j of the inverse
// transposed Jacobian at the centre): (j_0 / j) (sum_j xi_j a_j (x) g_j + (b_1 xi_2 xi_3 + b_2 xi_3 xi_1 + b_3 xi_1
// xi_2) I), 9 amplitudes a_j and 3 amplitudes b. Its integral over the cell is zero: a state of constant stress leaves
// the modes at rest, which is the patch test.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "fem/cells.hpp"
#include "fem/hex8_modes.hpp"

namespace dygita {

namespace {

using Column8 = Eigen::Matrix<double, 8, 1>;
using Square8 = Eigen::Matrix<double, 8, 8>;
using ByNode = Eigen::Matrix<double, 8, 6>;                // one column a mode function
using Coupling = Eigen::Matrix<double, 24, n_hex8_modes>;  // row 8 axis + node: whole vectors for the processor
using ModeMatrix = Eigen::Matrix<double, n_hex8_modes, n_hex8_modes>;  // mode 3 j + axis for a_j, 9 + k for b

struct Geometry {
  Square8 gradient[3];  // (node, point): d N / d x_p, 1/m
  Column8 volume;       // of each point, m^3
  Mat3 centre;          // column j: gradient of xi_j at the centre, 1/m
  double j_centre;      // m^3
};

// Columns: xi_1 xi_2 xi_3 xi_2 xi_3 xi_3 xi_1 xi_1 xi_2; rows: points.
const ByNode& mode_functions() {
  static const ByNode table = [] {
    ByNode functions;
    for (int i = 0; i < 8; ++i) {
      const Vec3 xi = Hex8::shapes().points.col(i);
      functions.row(i) << xi[0], xi[1], xi[2], xi[1] * xi[2], xi[2] * xi[0], xi[0] * xi[1];
    }
    return functions;
  }();
  return table;
}

Geometry geometry_of(const Nodes<8>& x) {
  const ShapeTable<8, 8>& shapes = Hex8::shapes();
  Geometry cell;
  Mat3 mean = Mat3::Zero();  // the Jacobian at the centre is the mean over the points
  for (int i = 0; i < 8; ++i) {
    const Mat3 jacobian = jacobian_at(shapes, x, i);
    mean += jacobian / 8;
    // Adjugate by cross products, one division.
    const Vec3 r0 = jacobian.row(0), r1 = jacobian.row(1), r2 = jacobian.row(2);
    Mat3 adjugate;
    adjugate << r1.cross(r2), r2.cross(r0), r0.cross(r1);
    const double determinant = r0.dot(adjugate.col(0));
    check_point_volume(determinant);
    cell.volume[i] = determinant;
    adjugate /= determinant;
    for (int p = 0; p < 3; ++p) cell.gradient[p].col(i) = shapes.slopes[i].lazyProduct(adjugate.col(p));
  }
  cell.centre = mean.inverse().transpose();
  cell.j_centre = mean.determinant();
  return cell;
}

// a b^T; two columns at a time stay in registers.
template <class A, class B>
Square8 outer_sum(const A& a, const B& b) {
  Square8 sum;
  for (int j = 0; j < 8; j += 2) {
    Column8 first = a.col(0) * b(j, 0), second = a.col(0) * b(j + 1, 0);
    for (int k = 1; k < A::ColsAtCompileTime; ++k) {
      first += a.col(k) * b(j, k);
      second += a.col(k) * b(j + 1, k);
    }
    sum.col(j) = first;
    sum.col(j + 1) = second;
  }
  return sum;
}

// Stiffness between modes and nodes.
Coupling couple(const Geometry& cell, double lambda, double mu) {
  ByNode by_axis[3];  // integral of each mode function times d N / d x_p
  for (int p = 0; p < 3; ++p) by_axis[p] = cell.j_centre * cell.gradient[p].lazyProduct(mode_functions());

  Coupling coupling;
  for (int j = 0; j < 3; ++j) {
    const Vec3 g = cell.centre.col(j);
    const Column8 along = mu * (g[0] * by_axis[0].col(j) + g[1] * by_axis[1].col(j) + g[2] * by_axis[2].col(j));
    for (int i = 0; i < 3; ++i) {
      for (int q = 0; q < 3; ++q)
        coupling.col(3 * j + i).segment<8>(8 * q) = lambda * g[i] * by_axis[q].col(j) + mu * g[q] * by_axis[i].col(j);
      coupling.col(3 * j + i).segment<8>(8 * i) += along;
    }
  }
  for (int k = 0; k < 3; ++k)
    for (int q = 0; q < 3; ++q) coupling.col(9 + k).segment<8>(8 * q) = (3 * lambda + 2 * mu) * by_axis[q].col(3 + k);
  return coupling;
}

// Stiffness of the modes, lower triangle.
ModeMatrix mode_stiffness(const Geometry& cell, double lambda, double mu) {
  const ByNode& functions = mode_functions();
  const ByNode weighted = (cell.j_centre * cell.j_centre * cell.volume.cwiseInverse()).asDiagonal() * functions;
  const Eigen::Matrix<double, 6, 6> products = weighted.transpose().lazyProduct(functions);
  const Mat3 metric = cell.centre.transpose() * cell.centre;

  ModeMatrix stiffness;
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l <= j; ++l) {
      const Vec3 g = cell.centre.col(j), h = cell.centre.col(l);
      Mat3 block = lambda * g * h.transpose() + mu * h * g.transpose();
      block.diagonal().array() += mu * metric(j, l);
      stiffness.block<3, 3>(3 * j, 3 * l) = products(j, l) * block;
    }
  const double bulk = 3 * lambda + 2 * mu;
  for (int j = 0; j < 3; ++j)
    stiffness.block<3, 3>(9, 3 * j) = bulk * products.col(j).tail<3>() * cell.centre.col(j).transpose();
  stiffness.block<3, 3>(9, 9) = 3 * bulk * products.bottomRightCorner<3, 3>();
  return stiffness;
}

// Forward elimination of the modes: on return the condensed stiffness is that of the nodes minus
// sum_m coupling_m coupling_m^T / pivot_m. Returns 1 / pivot.
Eigen::Matrix<double, n_hex8_modes, 1> eliminate(ModeMatrix& modes, Coupling& coupling) {
  Eigen::Matrix<double, n_hex8_modes, 1> inverse_pivots;
  for (int m = 0; m < n_hex8_modes; ++m) {
    inverse_pivots[m] = 1 / modes(m, m);
    for (int r = m + 1; r < n_hex8_modes; ++r) {
      const double factor = modes(r, m) * inverse_pivots[m];
      for (int c = r; c < n_hex8_modes; ++c) modes(c, r) -= factor * modes(c, m);
      coupling.col(r) -= factor * coupling.col(m);
    }
  }
  return inverse_pivots;
}

// Places an 8 x 8 block of axes p, q, and its transpose, in the matrix by node.
void place(const Square8& block, int p, int q, Stiffness<8>& stiffness) {
  for (int b = 0; b < 8; ++b)
    for (int a = 0; a < 8; ++a) {
      stiffness(3 * a + p, 3 * b + q) = block(a, b);
      stiffness(3 * b + q, 3 * a + p) = block(a, b);
    }
}

// Strains of the modes at a point, one column a mode, of any material.
Eigen::Matrix<double, 6, n_hex8_modes> strain_of_modes(const Geometry& cell, int point) {
  const auto functions = mode_functions().row(point);
  const double scale = cell.j_centre / cell.volume[point];
  Eigen::Matrix<double, 6, n_hex8_modes> strain;
  for (int j = 0; j < 3; ++j) strain.middleCols<3>(3 * j) = strain_of_node(scale * functions[j] * cell.centre.col(j));
  for (int k = 0; k < 3; ++k) strain.col(9 + k) = strain_of(scale * functions[3 + k] * Mat3::Identity());
  return strain;
}

// What the modes have of any material: their own stiffness, and that between them and the dofs of the nodes.
struct GeneralModes {
  ModeMatrix own = ModeMatrix::Zero();
  Eigen::Matrix<double, n_hex8_modes, 24> coupling = Eigen::Matrix<double, n_hex8_modes, 24>::Zero();

  GeneralModes(const Geometry& cell, const Mat6& d) {
    for (int i = 0; i < 8; ++i) {
      const Eigen::Matrix<double, n_hex8_modes, 6> stress = cell.volume[i] * strain_of_modes(cell, i).transpose() * d;
      own += stress * strain_of_modes(cell, i);
      for (int a = 0; a < 8; ++a) coupling.middleCols<3>(3 * a) += stress * strain_of_node(gradient_at(cell, a, i));
    }
  }

  static Vec3 gradient_at(const Geometry& cell, int node, int point) {
    return {cell.gradient[0](node, point), cell.gradient[1](node, point), cell.gradient[2](node, point)};
  }
};

Stiffness<8> general_stiffness(const Nodes<8>& x, const Mat6& d) {
  const GeneralModes modes(geometry_of(x), d);
  const Eigen::Matrix<double, n_hex8_modes, 24> yielding = modes.own.llt().solve(modes.coupling);
  Stiffness<8> stiffness = stiffness_of_points(Hex8::shapes(), x, d);
  stiffness.noalias() -= modes.coupling.transpose() * yielding;
  stiffness.triangularView<Eigen::StrictlyLower>() = stiffness.transpose();
  return stiffness;
}

}  // namespace

Stiffness<8> Hex8::stiffness(const Nodes<8>& x, const ElasticTensor& tensor) {
  if (!tensor.is_isotropic()) return general_stiffness(x, tensor.stiffness());
  const double mu = tensor.mu(), lambda = tensor.lambda();
  const Geometry cell = geometry_of(x);

  // Condense the modes.
  Coupling coupling = couple(cell, lambda, mu);
  ModeMatrix modes = mode_stiffness(cell, lambda, mu);
  const auto inverse_pivots = eliminate(modes, coupling);
  const Coupling scaled = coupling * inverse_pivots.asDiagonal();

  // Sum over the points, axis by axis: lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) I.
  Stiffness<8> stiffness;
  Square8 diagonal[3], shear = Square8::Zero();
  for (int p = 0; p < 3; ++p) {
    const Square8 weighted = cell.gradient[p] * cell.volume.asDiagonal();
    diagonal[p] = outer_sum(weighted, cell.gradient[p]);
    shear += mu * diagonal[p];
    for (int q = p + 1; q < 3; ++q) {
      const Square8 product = outer_sum(weighted, cell.gradient[q]);
      const Square8 condensed = outer_sum(scaled.middleRows<8>(8 * p), coupling.middleRows<8>(8 * q));
      place(lambda * product + mu * product.transpose() - condensed, p, q, stiffness);
    }
  }
  for (int p = 0; p < 3; ++p) {
    const Square8 condensed = outer_sum(scaled.middleRows<8>(8 * p), coupling.middleRows<8>(8 * p));
    place((lambda + mu) * diagonal[p] + shear - condensed, p, p, stiffness);
  }
  return stiffness;
}

CornerStress<8> Hex8::stress(const Nodes<8>& x, const ElasticTensor& tensor, const Nodes<8>& displacement) {
  const Geometry cell = geometry_of(x);

  // Recover the modes.
  Eigen::Matrix<double, n_hex8_modes, 1> modes;
  if (tensor.is_isotropic()) {
    Eigen::Matrix<double, 24, 1> by_axis;
    for (int p = 0; p < 3; ++p) by_axis.segment<8>(8 * p) = displacement.row(p);
    const double mu = tensor.mu(), lambda = tensor.lambda();
    modes = -mode_stiffness(cell, lambda, mu).ldlt().solve(couple(cell, lambda, mu).transpose() * by_axis);
  } else {
    const GeneralModes general(cell, tensor.stiffness());
    modes = -general.own.llt().solve(general.coupling * displacement.reshaped());
  }

  // Stress at the points, then its trilinear interpolation at the nodes.
  const Mat3 incompatible = Eigen::Map<const Mat3>(modes.data());  // column j: a_j
  CornerStress<8> at_points;
  for (int i = 0; i < 8; ++i) {
    Mat3 gradient;
    for (int q = 0; q < 3; ++q) gradient.col(q) = displacement * cell.gradient[q].col(i);
    const auto functions = mode_functions().row(i);
    const double scale = cell.j_centre / cell.volume[i];
    gradient += scale * incompatible * functions.head<3>().asDiagonal() * cell.centre.transpose();
    gradient.diagonal().array() += scale * functions.tail<3>().dot(modes.tail<3>());
    at_points.col(i) = tensor.stress(gradient);
  }
  return at_points * to_nodes();
}

// Integrals of rho N_a N_b by two points a direction, at +-s: s = 1 is lumped, s^2 = 1/3 consistent.
MassMatrix<8> Hex8::tuned_mass(const Nodes<8>& x, double density, const WaveTuning& tuning) {
  const auto& table = shapes();
  Mat3 jacobian = Mat3::Zero();
  for (int i = 0; i < 8; ++i) jacobian += jacobian_at(table, x, i) / 8.0;  // at the centre
  Vec3 s;
  for (int d = 0; d < 3; ++d) s[d] = std::sqrt(1.0 - 2.0 / 3.0 * tuning.share(2.0 * jacobian.col(d).norm()));
  MassMatrix<8> mass = MassMatrix<8>::Zero();
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = table.points.col(i).cwiseSign();
    Eigen::Matrix<double, 8, 1> values;
    for (int a = 0; a < 8; ++a)
      values[a] = (Vec3::Ones() + table.points.col(a).cwiseSign().cwiseProduct(corner).cwiseProduct(s)).prod() / 8.0;
    const double volume = jacobian_at(table, x, i).determinant() * table.weights[i];
    mass += density * volume * values * values.transpose();
  }
  return mass;
}

}  // namespace dygita

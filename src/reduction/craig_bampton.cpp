#include "reduction/craig_bampton.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/log.hpp"
#include "numerics/dense.hpp"
#include "numerics/factor.hpp"
#include "numerics/lowest_modes.hpp"

namespace dygita {

namespace {

// Added to the diagonal of the faces while the assembly is factorised, and taken off its Schur complement: nothing else
// may hold it.
constexpr double reference_share = 0.1;

// The assembly with W u = q: interior by the factor, the faces' unknowns by dense matrices (eq. D3).
class HeldInterface {
 public:
  HeldInterface(const LinearAssembly& assembly, const InterfaceCoordinates& coordinates, const Problem& problem,
                const SuperelementRequest& request)
      : assembly_(assembly) {
    const int n = assembly.n();
    std::vector<char> is_interface(n, 0);
    for (const int node : coordinates.nodes)
      for (int d = 0; d < 3; ++d)
        for (SparseMatrix::InnerIterator e(assembly.map, 3 * node + d); e; ++e) is_interface[e.col()] = 1;
    // All unknowns of a place, tied copies that are not on the face included.
    const int n_b = static_cast<int>(std::count(is_interface.begin(), is_interface.end(), 1));
    if (n_b > most_face_unknowns)
      throw InputError(request.origin, fmt::format("output.superelement '{}': the faces of 'on' have {} unknowns, at "
                                                   "most {} are allowed: use smaller faces or larger cells there",
                                                   request.name, n_b, most_face_unknowns));
    if (const std::string motion = free_motion(assembly, problem, coordinates.nodes); !motion.empty())
      throw InputError(request.origin,
                       fmt::format("output.superelement '{}': {} is unconstrained ({})\n    hold it by a "
                                   "support, put a face of it into 'on', or give its contact friction",
                                   request.name, motion,
                                   assembly.n_damped() == 0 ? "open joints, or contact that slides"
                                                            : "open joints, contact that slides, or dampers alone"));
    SparseMatrix a = assembly.stiffness;
    Vec reference = Vec::Zero(n);
    for (int i = 0; i < n; ++i)
      if (is_interface[i]) {
        reference[i] = reference_share * a.coeff(i, i);
        a.coeffRef(i, i) += reference[i];
      }
    const std::string what = "output.superelement '" + request.name + "'";
    factor_ = std::make_unique<Factor>(a, assembly.place_of_unknown, is_interface, what);
    position_.resize(n);
    for (int i = 0; i < n; ++i) position_[factor_->order()[i]] = i;
    const int n_i = factor_->n_interior();
    Mat schur = factor_->take_schur();
    for (int i = 0; i < n_b; ++i) schur(i, i) -= reference[factor_->order()[n_i + i]];
    hold(coordinates, schur, what);
  }

  int n_held() const { return static_cast<int>(of_held_.cols()); }

  // Unknowns of the assembly in static equilibrium for a unit of each held coordinate: n x n_held.
  Mat static_modes() const {
    Mat x = Mat::Zero(assembly_.n(), n_held());
    x.bottomRows(of_held_.rows()) = of_held_;
    factor_->backward(x);
    return from_factor_order(x);
  }

  // x <- response to the forces x with the interface held.
  void solve(Eigen::Ref<Mat> x) const {
    Mat y(x.rows(), x.cols());
    for (int i = 0; i < x.rows(); ++i) y.row(position_[i]) = x.row(i);
    factor_->forward(y);
    const int n_b = factor_->n_interface();
    y.bottomRows(n_b) = compliance_.size() ? Mat(compliance_ * y.bottomRows(n_b)) : Mat(Mat::Zero(n_b, x.cols()));
    factor_->backward(y);
    x = from_factor_order(y);
  }

 private:
  // Z spans what W leaves free: compliance Z (Z^T S Z)^-1 Z^T, and the equilibrium for W x = 1.
  void hold(const InterfaceCoordinates& coordinates, const Mat& schur, const std::string& what) {
    const int n_b = static_cast<int>(schur.rows()), n_i = factor_->n_interior(),
              n_w = static_cast<int>(coordinates.w.rows());
    Mat transposed = Mat::Zero(n_b, n_w);
    for (int row = 0; row < n_w; ++row) {
      for (SparseMatrix::InnerIterator e(coordinates.w, row); e; ++e)
        transposed(position_[e.col()] - n_i, row) = e.value();
    }
    const Vec scale = transposed.colwise().norm();
    const Mat scaled = transposed * scale.cwiseInverse().asDiagonal();
    const auto [q, r] = full_qr(scaled);
    // W+ = Q1 R^-T, of the scaled rows.
    Mat right = r.transpose().triangularView<Eigen::Lower>().solve(Mat(scale.cwiseInverse().asDiagonal()));
    of_held_ = q.leftCols(n_w) * right;
    if (n_w == n_b) return;
    const Mat z = q.rightCols(n_b - n_w);
    const Mat s_z = schur * z;
    const Eigen::LLT<Mat> llt(z.transpose() * s_z);
    if (llt.info() != Eigen::Success)
      throw NumericalError(what + ": the faces' own stiffness is not positive definite");
    compliance_ = z * llt.solve(z.transpose());
    of_held_ -= z * llt.solve(s_z.transpose() * of_held_);
  }

  Mat from_factor_order(const Mat& x) const {
    Mat y(x.rows(), x.cols());
    for (int i = 0; i < x.rows(); ++i) y.row(i) = x.row(position_[i]);
    return y;
  }

  const LinearAssembly& assembly_;
  std::unique_ptr<Factor> factor_;
  std::vector<int> position_;
  Mat of_held_, compliance_;
};

double hertz(double lambda) { return std::sqrt(std::max(0.0, lambda)) / (2 * std::numbers::pi); }

Modes fixed_modes(const HeldInterface& held, const LinearAssembly& assembly, const SuperelementRequest& request) {
  // All of the assembly is on its faces.
  if (held.n_held() == assembly.n()) return {Vec(0), Mat(assembly.n(), 0), false};
  ModeRequest wanted;
  wanted.n = request.modes;
  wanted.up_to = std::pow(2 * 2 * std::numbers::pi * request.up_to, 2);
  return lowest_modes(
      assembly.n(), [&](Eigen::Ref<Mat> x) { held.solve(x); }, assembly.mass, 0.0, wanted,
      "output.superelement '" + request.name + "'");
}

Mat symmetric(const Mat& m) { return 0.5 * (m + m.transpose()); }

// What the modes left out would follow the faces with at first order, as modes of their own (eq. D7): orthogonal to
// those kept, in M and K. motions: of the assembly, static, that they are driven by.
Modes residual_modes(const HeldInterface& held, const LinearAssembly& assembly, const Mat& motions, const Modes& kept) {
  constexpr double nothing_left = 1e-9;
  Mat r = assembly.mass * motions;
  held.solve(r);
  const Vec whole = r.colwise().norm();
  for (int pass = 0; pass < 2; ++pass) r -= kept.vectors * (kept.vectors.transpose() * (assembly.mass * r));
  // Nothing is left where the modes kept are all there are.
  Vec scale = r.colwise().norm();
  for (Eigen::Index i = 0; i < scale.size(); ++i) scale[i] = scale[i] > nothing_left * whole[i] ? 1.0 / scale[i] : 0.0;
  if (scale.size() == 0 || scale.isZero(0.0)) return {Vec(0), Mat(assembly.n(), 0), false};
  r = r * scale.asDiagonal();
  const EigenPairs gram = symmetric_eigen(symmetric(r.transpose() * (assembly.mass * r)));
  const double largest = gram.values.size() > 0 ? gram.values.tail(1)[0] : 0.0;
  const int rank = static_cast<int>((gram.values.array() > 1e-8 * largest).count());
  const Mat basis = r * (gram.vectors.rightCols(rank) * gram.values.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal());
  const EigenPairs eigen = symmetric_eigen(symmetric(assembly.energies(basis)));
  return {eigen.values, basis * eigen.vectors, false};
}

// rad/s, up to which modes are kept.
double cut_off(const SuperelementRequest& request, const Modes& kept) {
  if (request.up_to > 0.0) return 2 * 2 * std::numbers::pi * request.up_to;
  return kept.values.size() > 0 ? std::sqrt(std::max(0.0, kept.values.tail(1)[0])) : 0.0;
}

// Interface rows (columns) of the eigenmodes that static and kept modes alone have up to an angular frequency, the
// lowest hundred at most.
Mat slow_motions(const LinearAssembly& assembly, const Mat& psi, const Modes& kept, double omega) {
  const int n_q = static_cast<int>(psi.cols()), n_m = static_cast<int>(kept.values.size());
  Mat k = Mat::Zero(n_q + n_m, n_q + n_m), m = Mat::Identity(n_q + n_m, n_q + n_m);
  const Mat m_psi = assembly.mass * psi;
  k.topLeftCorner(n_q, n_q) = symmetric(assembly.energies(psi));
  k.diagonal().tail(n_m) = kept.values;
  m.topLeftCorner(n_q, n_q) = symmetric(psi.transpose() * m_psi);
  m.bottomLeftCorner(n_m, n_q) = kept.vectors.transpose() * m_psi;
  m.topRightCorner(n_q, n_m) = m.bottomLeftCorner(n_m, n_q).transpose();
  const EigenPairs eigen = generalized_symmetric_eigen(k, m);
  const int n = std::min<int>(100, static_cast<int>((eigen.values.array() <= omega * omega).count()));
  return eigen.vectors.topLeftCorner(n_q, n);
}

}  // namespace

Superelement condense(const LinearAssembly& assembly, const Problem& problem, const SuperelementRequest& request) {
  const InterfaceCoordinates coordinates = interface_coordinates(assembly, problem, request);
  const HeldInterface held(assembly, coordinates, problem, request);
  Modes modes = fixed_modes(held, assembly, request);
  const int n_kept = static_cast<int>(modes.values.size());
  const Mat psi = held.static_modes() * coordinates.of_rows;
  if (!modes.is_all) {
    // Of the many rows of nodes those combinations that move up to twice the frequency of the modes kept.
    const Mat motions = request.motion == FaceMotion::nodes
                            ? Mat(psi * slow_motions(assembly, psi, modes, 2 * cut_off(request, modes)))
                            : psi;
    const Modes rest = residual_modes(held, assembly, motions, modes);
    const int n = static_cast<int>(rest.values.size());
    Vec values(n_kept + n);
    values << modes.values, rest.values;
    Mat vectors(assembly.n(), n_kept + n);
    vectors << modes.vectors, rest.vectors;
    modes = {values, vectors, false};
  }
  const int n_q = static_cast<int>(psi.cols()), n_m = static_cast<int>(modes.values.size());

  Superelement element;
  element.rows = coordinates.rows;
  element.dependent = coordinates.dependent;
  element.on = request.on;
  for (int i = 0; i < n_m; ++i) element.rows.push_back({-1, -1, i, Vec3::Zero()});
  // Static and fixed-interface modes are orthogonal in K.
  element.stiffness = Mat::Zero(n_q + n_m, n_q + n_m);
  element.stiffness.topLeftCorner(n_q, n_q) = symmetric(assembly.energies(psi));
  element.stiffness.diagonal().tail(n_m) = modes.values;
  element.mass = Mat::Identity(n_q + n_m, n_q + n_m);
  const Mat m_psi = assembly.mass * psi;
  element.mass.topLeftCorner(n_q, n_q) = symmetric(psi.transpose() * m_psi);
  element.mass.bottomLeftCorner(n_m, n_q) = modes.vectors.transpose() * m_psi;
  element.mass.topRightCorner(n_q, n_m) = element.mass.bottomLeftCorner(n_m, n_q).transpose();
  if (assembly.damping.rows() > 0) {
    Mat basis(assembly.n(), n_q + n_m);
    basis << psi, modes.vectors;
    element.damping = symmetric(basis.transpose() * (assembly.damping * basis));
  }

  const EigenPairs eigen = generalized_symmetric_eigen(element.stiffness, element.mass);
  // Motions as a whole store nothing but rounding.
  const double nothing = eigen.values.size() > 0 ? 1e-13 * eigen.values.cwiseAbs().maxCoeff() : 0.0;
  element.frequencies = eigen.values.unaryExpr([&](double lambda) { return lambda <= nothing ? 0.0 : hertz(lambda); });
  element.fixed_frequencies = modes.values.unaryExpr([](double lambda) { return hertz(lambda); });
  element.n_residual = n_m - n_kept;
  element.valid_to = request.up_to > 0.0 ? request.up_to
                     : n_kept > 0        ? 0.5 * element.fixed_frequencies[n_kept - 1]
                                         : 0.0;
  element.damping_ratios = Vec::Zero(element.frequencies.size());
  for (int i = 0; i < element.frequencies.size() && element.damping.rows() > 0; ++i) {
    const Vec phi = eigen.vectors.col(i);
    const double omega = 2 * std::numbers::pi * element.frequencies[i];
    if (omega > 0.0) element.damping_ratios[i] = phi.dot(element.damping * phi) / (2 * omega);
  }
  element.mass_of_parts = assembly.mass_of_parts;
  element.n_unknowns = assembly.n();
  element.n_tied = assembly.n_tied;
  element.n_normal = assembly.n_normal;
  element.n_open = assembly.n_open;
  element.n_damped = assembly.n_damped();
  return element;
}

}  // namespace dygita

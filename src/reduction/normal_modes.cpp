#include "reduction/normal_modes.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/factor.hpp"
#include "numerics/lowest_modes.hpp"
#include "reduction/free_motions.hpp"

namespace dygita {

namespace {

// Rows, one for each column of x, that hold its combinations best: of the rest each time the largest row.
std::vector<int> holding_rows(Mat x) {
  std::vector<int> rows;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    Eigen::Index row = 0;
    x.rowwise().squaredNorm().maxCoeff(&row);
    rows.push_back(static_cast<int>(row));
    const Vec along = x.row(row).transpose().normalized();
    x -= (x * along) * along.transpose();
  }
  return rows;
}

// Motions that the stiffness resists by its rounding alone leave the iteration no digits for the others, which it then
// takes for none.
void check_all_are_found(const LinearAssembly& assembly, const Modes& elastic, int n_free,
                         const ModesRequest& request) {
  const auto n_found = static_cast<int>(elastic.values.size());
  const bool is_short = request.n == 0 ? elastic.is_all : n_free + n_found < request.n;
  if (!is_short || n_free + n_found >= assembly.n() - assembly.springs.rows()) return;
  const double last =
      n_found > 0 ? std::sqrt(std::max(0.0, elastic.values[n_found - 1])) / (2 * std::numbers::pi) : 0.0;
  throw NumericalError(fmt::format(
      "output.modes '{}': {} modes were found, the last at {:.3g} Hz, and the others are lost in rounding: "
      "something is held by next to nothing, as rigid motions are by matrices with few digits\n    hold it, "
      "or give its matrices with all their digits",
      request.name, n_free + n_found, last));
}

// x <- K^-1 x for forces that leave the free motions N alone, displacements orthogonal to N in the mass (eq. D14). One
// factor: springs at as many unknowns as there are free motions hold the assembly and carry nothing.
class FreeAssembly {
 public:
  FreeAssembly(const LinearAssembly& assembly, const Mat& motions, const std::string& what)
      : assembly_(assembly), motions_(motions), momenta_(assembly.mass * motions) {
    SparseMatrix held = assembly.stiffness;
    elastic_ = assembly.springs.rows() > 0 ? assembly.cells : SparseMatrix();
    const Vec own = (elastic_.rows() > 0 ? elastic_ : held).diagonal();
    for (const int i : holding_rows(motions)) {
      const double pin = own[i] > 1e-6 * own.mean() ? own[i] : own.mean();  // a rigid body has no stiffness of its own
      held.coeffRef(i, i) += pin;
      if (elastic_.rows() > 0) elastic_.coeffRef(i, i) += pin;
    }
    factor_ = std::make_unique<Factor>(held, assembly.place_of_unknown, std::vector<char>(assembly.n(), 0), what);
    if (elastic_.rows() > 0) across_ = assembly.springs.transpose();
  }

  void solve(Eigen::Ref<Mat> x) const {
    x -= momenta_ * (motions_.transpose() * x);
    Mat answer = elastic_.rows() > 0 ? within_sums(x) : factored(x);
    answer -= motions_ * (momenta_.transpose() * answer);
    x = answer;
  }

 private:
  Mat factored(const Mat& x) const {
    const std::vector<int>& order = factor_->order();
    Mat y(x.rows(), x.cols());
    for (Eigen::Index i = 0; i < x.rows(); ++i) y.row(i) = x.row(order[static_cast<size_t>(i)]);
    factor_->solve(y);
    Mat answer(x.rows(), x.cols());
    for (Eigen::Index i = 0; i < x.rows(); ++i) answer.row(order[static_cast<size_t>(i)]) = y.row(i);
    return answer;
  }

  // With the sums between faces that do not match held exactly: what the springs stretch is taken off by forces (an
  // augmented Lagrangian), which mends their rounding too.
  Mat within_sums(const Mat& x) const {
    constexpr int most_sweeps = 8;
    constexpr double enough = 1e-13;
    Mat answer = factored(x);
    Mat forces = assembly_.springs * answer;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_sweeps; ++i) {
      const Mat change = factored(x - elastic_ * answer - across_ * (forces + assembly_.springs * answer));
      answer += change;
      forces += assembly_.springs * answer;
      const double moved = change.norm() / answer.norm();
      if (!(moved > enough) || moved > 0.5 * before) break;
      before = moved;
    }
    return answer;
  }

  const LinearAssembly& assembly_;
  const Mat& motions_;
  const Mat momenta_;
  SparseMatrix elastic_, across_;  // empty: no sums
  std::unique_ptr<Factor> factor_;
};

struct Eigenmodes {
  Vec omegas;   // rad/s
  Mat vectors;  // n x modes, orthonormal in the mass
};

Eigenmodes eigenmodes(const LinearAssembly& assembly, const Mat& motions, const ModesRequest& request) {
  const std::string what = "output.modes '" + request.name + "'";
  const int n_free = static_cast<int>(motions.cols());
  Modes elastic{Vec(0), Mat(assembly.n(), 0), false};
  if ((request.n == 0 || request.n > n_free) && n_free < assembly.n()) {
    const FreeAssembly held(assembly, motions, what);
    ModeRequest wanted;
    wanted.n = request.n == 0 ? 0 : request.n - n_free;
    wanted.up_to = std::pow(2 * std::numbers::pi * request.up_to, 2);
    elastic = lowest_modes(
        assembly.n(), [&](Eigen::Ref<Mat> x) { held.solve(x); }, assembly.mass, 0.0, wanted, what);
    check_all_are_found(assembly, elastic, n_free, request);
  }
  const auto n_first = request.n == 0 ? n_free : std::min(request.n, n_free);
  Eigenmodes modes{Vec::Zero(n_first + elastic.values.size()), Mat(assembly.n(), n_first + elastic.values.size())};
  modes.omegas.tail(elastic.values.size()) = elastic.values.cwiseMax(0.0).cwiseSqrt();
  modes.vectors << motions.leftCols(n_first), elastic.vectors;
  return modes;
}

// Modes of one frequency are any basis of theirs: they are told along x, y, z as far as they go (eq. D15).
void sort_equal_modes(const WholeInertia& whole, Eigenmodes& modes) {
  constexpr double equal = 1e-8;
  const Eigen::Index n = modes.omegas.size();
  for (Eigen::Index first = 0, end = 0; first < n; first = end) {
    for (end = first + 1; end < n && modes.omegas[end] <= (1.0 + equal) * modes.omegas[first];) ++end;
    if (end == first + 1 || modes.omegas[first] == 0.0) continue;
    const Mat own = modes.vectors.middleCols(first, end - first);
    modes.vectors.middleCols(first, end - first) = own * whole.sorted(own.transpose() * whole.momenta);
  }
}

// Of each substructure's nodes: does it stand for a place, as amplitudes of a superelement do not?
std::vector<char> places_of(const Problem& problem) {
  std::vector<char> is_place;
  for (const SubstructurePtr& part : problem.substructures)
    for (int i = 0; i < part->mesh->n_nodes(); ++i) is_place.push_back(part->mesh->inside->is_place(i));
  return is_place;
}

// u = T z, scaled so that the largest displacement is one and its largest component positive; the factors (eq. D15).
Vec scale_shapes(const Problem& problem, Mat& shapes) {
  const std::vector<char> is_place = places_of(problem);
  Vec scales(shapes.cols());
  for (Eigen::Index m = 0; m < shapes.cols(); ++m) {
    auto u = shapes.col(m).reshaped(3, shapes.rows() / 3);
    for (Eigen::Index i = 0; i < u.cols(); ++i)
      if (!is_place[static_cast<size_t>(i)]) u.col(i).setZero();
    Eigen::Index at = 0, axis = 0;
    const double largest = std::sqrt(u.colwise().squaredNorm().maxCoeff(&at));
    u.col(at).cwiseAbs().maxCoeff(&axis);
    scales[m] = std::copysign(largest > 0.0 ? 1.0 / largest : 1.0, u(axis, at));
    shapes.col(m) *= scales[m];
  }
  return scales;
}

// Of critical damping (eq. D16). A motion at 0 Hz has none: 0 where it is free of damping too, else nan.
Vec damping_ratios(const LinearAssembly& assembly, const Eigenmodes& modes) {
  constexpr double rounding = 1e-12;
  Vec ratios = Vec::Zero(modes.omegas.size());
  for (const auto& [damping, stiffness] : assembly.relaxing)  // by their share of the strain energy
    for (Eigen::Index m = 0; m < ratios.size(); ++m) {
      const double omega = modes.omegas[m];
      if (omega <= 0.0) continue;
      const Vec phi = modes.vectors.col(m);
      ratios[m] +=
          damping.ratio_of_branches(omega / (2 * std::numbers::pi)) * phi.dot(stiffness * phi) / (omega * omega);
    }
  if (assembly.damping.rows() == 0) return ratios;
  const double fastest = assembly.damping.diagonal().cwiseQuotient(assembly.mass.diagonal()).maxCoeff();
  for (Eigen::Index m = 0; m < ratios.size(); ++m) {
    const Vec phi = modes.vectors.col(m);
    const double damping = phi.dot(assembly.damping * phi);
    if (modes.omegas[m] > 0.0)
      ratios[m] += damping / (2 * modes.omegas[m]);
    else if (damping > rounding * fastest)
      ratios[m] = std::numeric_limits<double>::quiet_NaN();
  }
  return ratios;
}

}  // namespace

NormalModes normal_modes(const LinearAssembly& assembly, const Problem& problem, const ModesRequest& request) {
  if (request.n > assembly.n())
    throw InputError(request.origin,
                     fmt::format("output.modes '{}': {} modes are asked for, and the assembly has {} unknowns, less "
                                 "what supports hold and ties join",
                                 request.name, request.n, assembly.n()));
  const WholeInertia whole = whole_inertia(assembly, problem);
  const Mat motions = free_motions(assembly, problem, whole, "output.modes '" + request.name + "'");
  Eigenmodes eigen = eigenmodes(assembly, motions, request);
  sort_equal_modes(whole, eigen);
  NormalModes modes;
  modes.n_free = static_cast<int>(motions.cols());
  modes.frequencies = eigen.omegas / (2 * std::numbers::pi);
  modes.shapes = assembly.map * eigen.vectors;
  modes.shapes += assembly.followers * eigen.vectors;
  const Vec scales = scale_shapes(problem, modes.shapes);
  modes.generalised_masses = scales.cwiseAbs2();
  const Mat momenta = eigen.vectors.transpose() * whole.momenta;
  modes.participation = scales.cwiseInverse().asDiagonal() * momenta;
  modes.effective_masses = momenta.cwiseAbs2();
  modes.damping_ratios = damping_ratios(assembly, eigen);
  modes.first_node = assembly.first_node;
  modes.mass = whole.mass;
  modes.centre = whole.centre;
  modes.moments = whole.moments;
  modes.n_tied = assembly.n_tied;
  modes.n_normal = assembly.n_normal;
  modes.n_open = assembly.n_open;
  return modes;
}

}  // namespace dygita

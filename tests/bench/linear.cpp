#include "bench/linear.hpp"

#include <cblas.h>
#include <cholmod.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <tuple>

#include "fem/assembly.hpp"
#include "interfaces/loads.hpp"
#include "interfaces/surfaces.hpp"
#include "numerics/factor.hpp"
#include "step/step_model.hpp"

namespace dygita::bench {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

[[noreturn]] void refuse(const Named& object, const std::string& what) {
  throw InputError(object.origin, "the linear comparison does not do " + what + " ('" + object.name + "')");
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

cholmod_sparse view_of(const SparseMatrix& matrix) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<size_t>(matrix.rows());
  view.nzmax = static_cast<size_t>(matrix.nonZeros());
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;  // symmetric: rows are columns, the upper triangle is left unread
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

}  // namespace

struct LinearAnalysis::Cholmod {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  cholmod_dense *right = nullptr, *solution = nullptr, *y = nullptr, *e = nullptr;  // kept from step to step

  Cholmod() {
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
  }
  ~Cholmod() {
    for (cholmod_dense** dense : {&right, &solution, &y, &e}) cholmod_free_dense(dense, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
};

struct LinearAnalysis::Forces {
  State start;
  std::vector<Vec> masses;  // of each substructure, for gravity
  std::unique_ptr<Loads> loads;
};

LinearAnalysis::LinearAnalysis(const Problem& problem)
    : problem_(problem), forces_(std::make_unique<Forces>()), cholmod_(std::make_unique<Cholmod>()) {
  for (const StepPtr& step : problem.steps)
    if (!step->is_static) step_ = step.get();
  if (!step_) refuse(problem, "a problem without a dynamic step");
  if (problem.mass().is_tuned || problem.mass().is_moved_from_contact || problem.numerical_damping() != 0.0)
    refuse(problem, "tuned or massless nodes and numerical damping");
  for (const SubstructurePtr& part : problem.substructures)
    if (part->material.damping.mass != 0.0 || part->material.damping.stiffness != 0.0) refuse(*part, "damping");
  const auto begin = Clock::now();
  merge_nodes();
  number_unknowns();
  assemble_free();
  assembly_seconds_ = seconds_since(begin);
}

LinearAnalysis::~LinearAnalysis() = default;

// Facing nodes of every interface are one node, whatever the interface's law.
void LinearAnalysis::merge_nodes() {
  const std::vector<Surface> surfaces = make_surfaces(problem_);
  forces_->start = initial_state(problem_, surfaces);
  std::vector<int> first{0};
  for (const SubstructurePtr& part : problem_.substructures) first.push_back(first.back() + part->mesh->n_nodes());
  std::vector<int> parent(first.back());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Surface& surface : surfaces) {
    if (surface.wall) refuse(*surface.wall, "walls");
    for (int i = 0; i < surface.n_points(); ++i)
      parent[root_of(parent, first[surface.part_1] + surface.facing.side_1.main_node(i))] =
          root_of(parent, first[surface.part_2] + surface.facing.side_2.main_node(i));
  }
  std::vector<int> number(first.back(), -1);
  for (size_t part = 0; part + 1 < first.size(); ++part)
    for (int i = first[part]; i < first[part + 1]; ++i) {
      if (i == first[part]) node_of_.emplace_back();
      int& n = number[root_of(parent, i)];
      if (n < 0) n = n_nodes_++;
      node_of_[part].push_back(n);
    }
}

void LinearAnalysis::number_unknowns() {
  const Conditions conditions = make_conditions(problem_, *step_, forces_->start);
  for (const SupportPtr& support : supports_of(problem_, *step_))
    if (support->kind->absorbs()) refuse(*support, "absorbing supports");
  if (!conditions.motions.empty()) refuse(*step_, "moving supports");
  std::vector<char> is_held(3 * static_cast<size_t>(n_nodes_), 0);
  for (size_t part = 0; part < node_of_.size(); ++part)
    for (const auto& [node, held] : conditions.held[part])
      for (int axis = 0; axis < 3; ++axis) {
        const double length = held.directions.leftCols(held.n).row(axis).norm();  // of the axis, in what is held
        if (length > 1e-9 && length < 1 - 1e-9) refuse(*step_, "oblique supports");
        if (length > 0.5) is_held[3 * static_cast<size_t>(node_of_[part][node]) + axis] = 1;
      }
  int n = 0;
  for (const char held : is_held) unknown_of_.push_back(held ? -1 : n++);
}

// One mesh for each material, all on the nodes of the uncut body; then K and M of the unknowns.
void LinearAnalysis::assemble_free() {
  std::map<MaterialKey, std::pair<Mesh, Elastic>> bodies;
  for (size_t part = 0; part < node_of_.size(); ++part) {
    const Substructure& body = *problem_.substructures[part];
    const Elastic& m = body.material;
    auto& [mesh, material] = bodies[m.key()];
    if (mesh.nodes.cols() == 0) {
      mesh.nodes = Points::Zero(3, n_nodes_);
      mesh.source = "uncut";
      material = m;
    }
    for (size_t i = 0; i < node_of_[part].size(); ++i)
      mesh.nodes.col(node_of_[part][i]) = body.mesh->nodes.col(static_cast<Eigen::Index>(i)) + body.place;
    for (const CellBlock& block : body.mesh->blocks) {
      auto known = std::find_if(mesh.blocks.begin(), mesh.blocks.end(),
                                [&](const CellBlock& b) { return b.type == block.type; });
      if (known == mesh.blocks.end()) known = mesh.blocks.insert(known, {block.type, {}});
      for (const int node : block.nodes) known->nodes.push_back(node_of_[part][node]);
    }
  }
  SparseMatrix all(3 * n_nodes_, 3 * n_nodes_);
  Vec node_mass = Vec::Zero(n_nodes_);
  for (auto& [key, body] : bodies) {
    BodyMatrices matrices = assemble(body.first, body.second);
    node_mass += matrices.mass;
    if (bodies.size() == 1)
      all = std::move(matrices.stiffness);
    else
      all += matrices.stiffness;
  }

  const int n = static_cast<int>(unknown_of_.size() - std::count(unknown_of_.begin(), unknown_of_.end(), -1));
  mass_.resize(n);
  velocity_start_.resize(n);
  stiffness_.resize(n, n);
  stiffness_.reserve(all.nonZeros());
  for (int i = 0; i < all.rows(); ++i) {
    if (unknown_of_[i] < 0) continue;
    mass_[unknown_of_[i]] = node_mass[i / 3];
    stiffness_.startVec(unknown_of_[i]);
    for (SparseMatrix::InnerIterator entry(all, i); entry; ++entry)
      if (const int column = unknown_of_[entry.col()]; column >= 0)
        stiffness_.insertBack(unknown_of_[i], column) = entry.value();
  }
  stiffness_.finalize();
  matrix_ = step_->dt / 4 * stiffness_;
  for (int i = 0; i < n; ++i) matrix_.coeffRef(i, i) += mass_[i] / step_->dt;

  for (size_t part = 0; part < node_of_.size(); ++part) {
    const Substructure& body = *problem_.substructures[part];
    for (const int node : node_of_[part])
      for (int axis = 0; axis < 3; ++axis)
        if (const int u = unknown_of_[3 * node + axis]; u >= 0) velocity_start_[u] = body.velocity[axis];
    forces_->masses.push_back(body.material.density * nodal_volumes(*body.mesh));
  }
  forces_->loads = std::make_unique<Loads>(problem_, *step_, forces_->start, [&](int part, const Points& acceleration) {
    return Points(acceleration * forces_->masses[static_cast<size_t>(part)].asDiagonal());
  });
}

Vec LinearAnalysis::force(int increment) {
  forces_->loads->evaluate(increment);
  Vec sum = Vec::Zero(n_dofs());
  const std::vector<double>& values = forces_->loads->values();
  for (size_t i = 0; i < values.size(); ++i) {
    const LoadPattern& pattern = forces_->loads->patterns()[i];
    for (const auto& [node, unit] : pattern.nodes)
      for (int axis = 0; axis < 3; ++axis)
        if (const int u = unknown_of_[3 * node_of_[pattern.part][node] + axis]; u >= 0)
          sum[u] += values[i] * unit[axis];
  }
  return sum;
}

void LinearAnalysis::factorise(int blas_threads) {
  prepare_thread();
  openblas_set_num_threads(blas_threads);
  cholmod_sparse a = view_of(matrix_);
  Cholmod& c = *cholmod_;
  if (!c.factor) {
    const auto begin = Clock::now();
    c.factor = cholmod_analyze(&a, &c.common);
    analysis_seconds_ = seconds_since(begin);
  }
  const auto begin = Clock::now();
  if (!c.factor || !cholmod_factorize(&a, c.factor, &c.common) || c.common.status != CHOLMOD_OK || !c.factor->is_super)
    refuse(problem_, "a matrix that CHOLMOD does not factorise by supernodes");
  factor_seconds_ = seconds_since(begin);
}

double LinearAnalysis::factor_entries() const { return static_cast<double>(cholmod_->factor->xsize); }
double LinearAnalysis::factor_bytes() const {
  return 8.0 * factor_entries() + 4.0 * static_cast<double>(cholmod_->factor->ssize);
}

Vec LinearAnalysis::stiffness_times(const Vec& x, int threads) const {
  Vec y(x.size());
  const int* rows = stiffness_.outerIndexPtr();
  const int* columns = stiffness_.innerIndexPtr();
  const double* values = stiffness_.valuePtr();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int i = 0; i < static_cast<int>(x.size()); ++i) {
    double sum = 0.0;
    for (int e = rows[i]; e < rows[i + 1]; ++e) sum += values[e] * x[columns[e]];
    y[i] = sum;
  }
  return y;
}

LinearSeconds LinearAnalysis::run(const LinearOptions& options) {
  prepare_thread();
  openblas_set_num_threads(options.blas_threads);
  Cholmod& c = *cholmod_;
  const int n = n_dofs();
  const double dt = step_->dt;
  const Vec mass = mass_ / dt;
  if (!c.right) c.right = cholmod_allocate_dense(n, 1, n, CHOLMOD_REAL, &c.common);
  Eigen::Map<Vec> right(static_cast<double*>(c.right->x), n);

  displacement_ = Vec::Zero(n);
  velocity_ = velocity_start_;
  const bool recurs = options.right_hand_side == RightHandSide::recurrence;
  Vec w, p;  // of the recurrence: W = dt/4 K V, P = K (U + dt/4 V)
  if (recurs) p = w = dt / 4 * stiffness_times(velocity_, options.threads);
  LinearSeconds seconds;
  seconds.n_steps = options.n_steps > 0 ? std::min(options.n_steps, step_->n_increments()) : step_->n_increments();
  std::vector<double> solves;
  for (int i = 0; i < seconds.n_steps; ++i) {
    const Vec f = force(i);
    const auto begin = Clock::now();
    if (recurs)
      right = mass.cwiseProduct(velocity_) - p + f;
    else
      right = mass.cwiseProduct(velocity_) - stiffness_times(displacement_ + dt / 4 * velocity_, options.threads) + f;
    seconds.right_hand_side += seconds_since(begin);

    const auto solve_begin = Clock::now();
    if (!cholmod_solve2(CHOLMOD_A, c.factor, c.right, nullptr, &c.solution, nullptr, &c.y, &c.e, &c.common))
      refuse(problem_, "a solve that CHOLMOD refuses");
    solves.push_back(seconds_since(solve_begin));

    const auto update_begin = Clock::now();
    const Eigen::Map<const Vec> velocity(static_cast<const double*>(c.solution->x), n);
    if (recurs) {
      p += w;
      w = right - mass.cwiseProduct(velocity);
      p += 3 * w;
    }
    displacement_ += dt / 2 * (velocity_ + velocity);
    velocity_ = velocity;
    seconds.update += seconds_since(update_begin);
    seconds.all += seconds_since(begin);
  }
  seconds.solve = std::accumulate(solves.begin(), solves.end(), 0.0);
  std::nth_element(solves.begin(), solves.begin() + static_cast<std::ptrdiff_t>(solves.size() / 2), solves.end());
  seconds.median_solve = solves[solves.size() / 2];
  openblas_set_num_threads(1);
  return seconds;
}

Points LinearAnalysis::displacement(int part) const {
  Points nodal = Points::Zero(3, static_cast<Eigen::Index>(node_of_[part].size()));
  for (size_t i = 0; i < node_of_[part].size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (const int u = unknown_of_[3 * node_of_[part][i] + axis]; u >= 0)
        nodal(axis, static_cast<Eigen::Index>(i)) = displacement_[u];
  return nodal;
}

}  // namespace dygita::bench

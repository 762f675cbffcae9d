#include "pieces/piece_case.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "fem/mass.hpp"
#include "numerics/dense.hpp"

namespace dygita {

void PieceCase::make() {
  part = std::make_shared<Substructure>();
  part->name = "block";
  part->mesh = box_mesh(Vec3::Zero(), {0.01, 0.01, 0.02}, {2, 2, 2});
  part->material = steel();
  part->material.damping = damping;
  body.part = part.get();
  body.matrices = std::make_shared<const StoredMatrices>(part->mesh, part->material, true);
  make_mass();
  setup = {};
  setup.body = &body;
  setup.what = "substructure 'block' in step 'test'";
  if (dt > 0.0) setup.scheme = TimeScheme::weighted(dt, g);
  hold();
  make_rows();
}

void PieceCase::turn(const Mat3& by) {
  auto mesh = std::make_shared<Mesh>(*part->mesh);
  mesh->nodes = by * mesh->nodes;
  mesh->shape = mesh->shape_digest();
  mesh->turn = by * mesh->turn;
  part->mesh = mesh;
  body.matrices = std::make_shared<const StoredMatrices>(mesh, part->material, true);
  for (auto& [node, held] : setup.held) held.directions = by * held.directions;
  for (auto& [node, impedance] : setup.absorbing) impedance = by * impedance * by.transpose();
  for (InterfaceRow& row : setup.rows)
    for (NodeAlong& on : row.nodes) on.along = by * on.along;
}

Vec PieceCase::directions() const {
  const double scale = setup.scheme.is_static ? 1e9 : 200e9 * 0.01 * dt + 7800.0 * 1e-7 / dt;
  return scale * (2.0 + random_vector(n_rows(), 3).array()).matrix();
}

std::unique_ptr<ImplicitPiece> PieceCase::piece(bool is_plain) const {
  std::unique_ptr<ImplicitPiece> made = make_piece(setup, is_plain, {});
  made->set_search_directions(directions());
  return made;
}

void PieceCase::make_mass() {
  Mass mass{body.matrices->mass(), {}, {}};
  if (has_massless) mass.is_massless.assign(n_nodes(), 0);
  if (has_massless)
    for (const int node : nodes("zmax")) mass.is_massless[node] = 1;
  if (has_matrix)
    mass.matrix = tuned_mass(*part->mesh, part->material, {part->material.p_wave_speed(), dt}, mass.is_massless);
  for (int node = 0; has_massless && node < n_nodes(); ++node)
    if (mass.is_massless[node]) {
      mass.lumped[node] = 0.0;
      if (has_matrix) mass.matrix.coeffRef(node, node) = 0.0;
    }
  body.mass = std::make_shared<const Mass>(std::move(mass));
}

void PieceCase::hold() {
  setup.n_motions = is_moved ? 2 : 0;
  for (const int node : nodes("zmin")) {
    if (is_absorbing) {
      const Vec3 n = Vec3(0.6, 0.0, 0.8);
      setup.absorbing[node] = 40.0 * n * n.transpose() + 25.0 * Mat3::Identity();
      continue;
    }
    if (!is_held) continue;
    Held held;
    held.n = holds_normal_alone ? 1 : 3;
    held.directions.col(0) = Vec3::UnitZ();
    held.directions.col(1) = Vec3::UnitX();
    held.directions.col(2) = Vec3::UnitY();
    if (is_moved) {
      held.motion[0] = {{0, 1.0}};
      held.motion[1] = {{1, 0.5}, {0, -0.25}};
    }
    setup.held[node] = held;
  }
}

void PieceCase::make_rows() {
  const Mat3 frame = Eigen::AngleAxisd(0.4, Vec3(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
  for (const int node : nodes("zmax"))
    for (int d = 0; d < 3; ++d)
      setup.rows.push_back({{{node, frame.col(d)}}, setup.scheme.is_static && !is_held ? 1e9 : 0.0, 2e9, 1.0});
  if (has_spread_rows) spread_rows();
}

// Rows over a few nodes, one of them held where any is (nodes with and without mass do not mix); some of one node.
void PieceCase::spread_rows() {
  const std::vector<int> top = nodes("zmax"), bottom = nodes("zmin");
  for (size_t i = 0; i < setup.rows.size(); ++i) {
    InterfaceRow& row = setup.rows[i];
    row.side = 0;
    if (i % 6 == 0) continue;
    const Vec3 along = row.nodes[0].along;
    const auto own = static_cast<size_t>(std::find(top.begin(), top.end(), row.nodes[0].node) - top.begin());
    row.nodes = {{top[own], 0.8 * along + 0.02 * Vec3(random_vector(3, static_cast<int>(i)))},
                 {top[(own + 1) % top.size()], 0.3 * along},
                 {top[(own + 4) % top.size()], -0.1 * along}};
    if (is_held && !has_massless) row.nodes.push_back({bottom[i % bottom.size()], 0.2 * along});
  }
}

DensePiece::DensePiece(const PieceCase& of)
    : scheme(of.setup.scheme),
      g(of.dt > 0.0 ? of.g : 0.0),
      damping(of.damping),
      n(3 * of.n_nodes()),
      rows(Mat::Zero(n, of.n_rows())) {
  k = Mat(*of.body.matrices->stiffness());
  mass = z = Mat::Zero(n, n);
  for (int i = 0; i < of.n_nodes() && !scheme.is_static; ++i)
    for (int j = 0; j < of.n_nodes(); ++j)
      mass.block<3, 3>(3 * i, 3 * j) = (of.body.mass->matrix.size() > 0 ? of.body.mass->matrix.coeff(i, j)
                                        : i == j                        ? of.body.mass->lumped[i]
                                                                        : 0.0) *
                                       Mat3::Identity();
  for (const auto& [node, impedance] : of.setup.absorbing) z.block<3, 3>(3 * node, 3 * node) = impedance;
  for (int i = 0; i < of.n_rows(); ++i)
    for (const NodeAlong& on : of.setup.rows[i].nodes) rows.block<3, 1>(3 * on.node, i) += on.along;
  end = Vec::Constant(n, 1.0 - g);
  start = Vec::Constant(n, g);
  for (int i = 0; i < of.n_nodes(); ++i)
    if (!of.body.mass->is_massless.empty() && of.body.mass->is_massless[i] && !scheme.is_static) {
      end.segment<3>(3 * i).setOnes();
      start.segment<3>(3 * i).setZero();
    }
  std::vector<Vec> columns;
  Vec is_free = Vec::Ones(n);
  for (const auto& [node, conditions] : of.setup.held)
    for (int j = 0; j < conditions.n; ++j) {
      Vec column = Vec::Zero(n);
      column.segment<3>(3 * node) = conditions.directions.col(j);
      is_free -= column.cwiseAbs();  // held directions are axes here
      columns.push_back(column);
      motions.push_back(conditions.motion[j]);
    }
  held.resize(n, static_cast<Eigen::Index>(columns.size()));
  for (size_t i = 0; i < columns.size(); ++i) held.col(static_cast<Eigen::Index>(i)) = columns[i];
  free = Mat::Zero(n, static_cast<Eigen::Index>(is_free.sum() + 0.5));
  for (int i = 0, c = 0; i < n; ++i)
    if (is_free[i] > 0.5) free(i, c++) = 1.0;
}

Mat DensePiece::matrix() const {
  const double beta = scheme.beta(damping), alpha = scheme.alpha(damping);
  return (scheme.inverse_dt() + (1 - g) * alpha) * mass + (1 - g) * z +
         scheme.dt * Mat(end.asDiagonal() * k * end.asDiagonal()) + (1 - g) * beta * k;
}

Mat DensePiece::compliance(const Vec& directions) const {
  const Mat a = free.transpose() * (matrix() + rows * directions.asDiagonal() * rows.transpose()) * free;
  const Mat b = free.transpose() * rows;
  return b.transpose() * solve_dense(a, b);
}

Vec DensePiece::held_velocity(const std::vector<double>& motion_velocity) const {
  Vec velocity = Vec::Zero(n);
  for (Eigen::Index i = 0; i < held.cols(); ++i)
    for (const auto& [motion, factor] : motions[i]) velocity += factor * motion_velocity[motion] * held.col(i);
  return velocity;
}

Vec DensePiece::solve(const Vec& u0, const Vec& v0, const Vec& force, const Vec& q, const Vec& directions,
                      const std::vector<double>& motion_velocity) const {
  const Vec rhs = rest(u0, v0) + force + rows * q;
  const Mat a = matrix() + rows * directions.asDiagonal() * rows.transpose();
  const Vec known = held_velocity(motion_velocity);
  return known + free * solve_dense(free.transpose() * a * free, free.transpose() * (rhs - a * known));
}

Vec DensePiece::rest(const Vec& u0, const Vec& v0) const {
  const double beta = scheme.beta(damping), alpha = scheme.alpha(damping);
  return (scheme.inverse_dt() - g * alpha) * (mass * v0) - g * (z * v0) - k * (u0 + g * beta * v0) -
         scheme.dt * end.cwiseProduct(k * start.cwiseProduct(v0));
}

Vec DensePiece::next_displacement(const Vec& u0, const Vec& v0, const Vec& v1) const {
  return u0 + scheme.dt * mean_velocity(v0, v1);
}

Elastic steel() { return {"steel", 200e9, 0.3, 7800.0}; }

double pseudo_random(int i) { return std::fmod(std::abs(std::sin(12.9898 * i + 78.233)) * 43758.5453, 2.0) - 1.0; }

Points random_points(int n, int seed) {
  Points points(3, n);
  for (int i = 0; i < 3 * n; ++i) points(i % 3, i / 3) = pseudo_random(5000 * seed + i);
  return points;
}

Vec random_vector(int n, int seed) {
  Vec v(n);
  for (int i = 0; i < n; ++i) v[i] = pseudo_random(5000 * seed + i);
  return v;
}

Vec flat(const Points& points) { return Eigen::Map<const Vec>(points.data(), points.size()); }

Points nodal(const Vec& values) { return Eigen::Map<const Points>(values.data(), 3, values.size() / 3); }

IncrementEnergy advance(Piece& piece, const Points& force, const Vec& q, const std::vector<double>& motions,
                        Vec* velocity) {
  Piece* const self = &piece;
  piece.begin(force, motions, 0.0);
  piece.forward({&self, 1});
  Vec answer(q.size());
  piece.interface_velocity(q, answer);
  piece.backward({&self, 1});
  if (velocity) *velocity = answer;
  Points on_nodes = Points::Zero(3, force.cols());
  for (int i = 0; i < piece.n_rows(); ++i)
    for (const NodeAlong& on : piece.rows()[i].nodes)
      on_nodes.col(on.node) += (q[i] - piece.k()[i] * answer[i]) * on.along;
  return piece.finish(q, piece.has_motions() ? &on_nodes : nullptr);
}

}  // namespace dygita

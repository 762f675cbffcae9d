#include "intake/condensed_builder.hpp"

#include <spdlog/fmt/fmt.h>

#include <set>

#include "base/error.hpp"
#include "mesh/turned_facet.hpp"

namespace dygita {

int CondensedBuilder::add(NodeKind kind, const Vec3& place, const std::array<int, 3>& rows) {
  const int node = static_cast<int>(places_.size());
  places_.push_back(place);
  rows_.push_back(rows);
  body_->kinds.push_back(kind);
  for (int d = 0; d < 3; ++d)
    if (rows[static_cast<size_t>(d)] == no_row && kind != NodeKind::follower)
      (kind == NodeKind::point ? body_->held : body_->absent).emplace_back(node, Vec3::Unit(d));
  return node;
}

void CondensedBuilder::add_follower(const Vec3& place, int point, int turn, double size) {
  const int node = add(NodeKind::follower, place, {no_row, no_row, no_row});
  body_->followers.push_back({node, point, turn, place - places_[static_cast<size_t>(point)], size});
}

MeshPtr CondensedBuilder::finish(const Mat& stiffness, const Mat& mass, const Mat& damping,
                                 std::shared_ptr<Mesh> mesh) {
  check_rows_once(mesh->source);
  add_amplitudes(stiffness.rows());
  mesh->nodes.resize(3, n_nodes());
  for (int node = 0; node < n_nodes(); ++node) mesh->nodes.col(node) = places_[static_cast<size_t>(node)];
  const SparseMatrix pattern = dense_pattern();
  body_->stiffness = on_nodes(stiffness, pattern);
  body_->mass_matrix = on_nodes(mass, pattern);
  if (damping.size() > 0) body_->damping = on_nodes(damping, pattern);
  body_->find_carried(mesh->nodes);
  if (body_->mass_of_parts <= 0.0) body_->mass_of_parts = mass_of_translation(mesh->nodes);
  mesh->inside = body_;
  mesh->digest = mesh_digest(*mesh);
  return mesh;
}

void CondensedBuilder::add_amplitudes(Eigen::Index n_rows) {
  std::vector<char> is_taken(static_cast<size_t>(n_rows), 0);
  for (const auto& rows : rows_)
    for (const int row : rows)
      if (row != no_row) is_taken[static_cast<size_t>(row)] = 1;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& place : places_) middle += place / static_cast<double>(places_.size());
  std::array<int, 3> rows{no_row, no_row, no_row};
  int n = 0;
  for (int row = 0; row < static_cast<int>(n_rows); ++row) {
    if (is_taken[static_cast<size_t>(row)]) continue;
    rows[static_cast<size_t>(n++)] = row;
    if (n < 3) continue;
    add(NodeKind::amplitude, middle, rows);
    rows = {no_row, no_row, no_row};
    n = 0;
  }
  if (n > 0) add(NodeKind::amplitude, middle, rows);
}

// All pairs of nodes that have unknowns.
SparseMatrix CondensedBuilder::dense_pattern() const {
  std::vector<int> own;
  for (int node = 0; node < n_nodes(); ++node)
    if (body_->kinds[static_cast<size_t>(node)] != NodeKind::follower) own.push_back(node);
  SparseMatrix pattern(3 * n_nodes(), 3 * n_nodes());
  Eigen::VectorXi count = Eigen::VectorXi::Zero(3 * n_nodes());
  for (const int node : own) count.segment<3>(3 * node).setConstant(3 * static_cast<int>(own.size()));
  pattern.reserve(count);
  for (const int node : own)
    for (int r = 0; r < 3; ++r)
      for (const int other : own)
        for (int c = 0; c < 3; ++c) pattern.insert(3 * node + r, 3 * other + c) = 0.0;
  pattern.makeCompressed();
  return pattern;
}

SparseMatrix CondensedBuilder::on_nodes(const Mat& matrix, const SparseMatrix& pattern) const {
  SparseMatrix entries = pattern;
  const auto row_of = [&](Eigen::Index at) { return rows_[static_cast<size_t>(at / 3)][static_cast<size_t>(at % 3)]; };
  for (int i = 0; i < entries.outerSize(); ++i)
    for (SparseMatrix::InnerIterator e(entries, i); e; ++e)
      if (const int row = row_of(e.row()), column = row_of(e.col()); row != no_row && column != no_row)
        e.valueRef() = matrix(row, column);
  return entries;
}

void CondensedBuilder::check_rows_once(const std::string& source) const {
  std::set<int> taken;
  for (const auto& rows : rows_)
    for (const int row : rows)
      if (row != no_row && !taken.insert(row).second)
        throw InputError(fmt::format("'{}' has row {} twice", source, row + 1));
}

double CondensedBuilder::mass_of_translation(const Points& x) const {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec moved = body_->rigid_motion(x, Vec3::Unit(axis), Vec3::Zero()).reshaped();
    sum += moved.dot(body_->mass_matrix * moved) / 3.0;
  }
  return sum;
}

MeshPtr rigid_body(const RigidBody& given) {
  double size = 0.0;
  for (const RigidBody::Side& side : given.sides)
    size = std::max(size, (side.places.colwise() - given.at).colwise().norm().maxCoeff());
  if (!(size > 0)) throw InputError("its faces have no extent about its centre");
  CondensedBuilder builder;
  auto mesh = std::make_shared<Mesh>();
  mesh->source = "rigid";
  const int point = builder.add(NodeKind::point, given.at, {0, 1, 2});
  const int turn = builder.add(NodeKind::turn, given.at, {3, 4, 5});
  for (const RigidBody::Side& side : given.sides) {
    const int first = builder.n_nodes();
    for (const auto& place : side.places.colwise()) builder.add_follower(place, point, turn, size);
    for (Facet facet : side.facets) {
      for (int& node : facet.nodes()) node += first;
      mesh->faces[side.name].push_back(turned_facet(facet));
    }
  }
  Mat mass = Mat::Zero(6, 6);
  mass.topLeftCorner<3, 3>() = given.mass * Mat3::Identity();
  mass.bottomRightCorner<3, 3>() = given.inertia / (size * size);
  builder.body().mass_of_parts = given.mass;
  return builder.finish(Mat::Zero(6, 6), mass, Mat(), std::move(mesh));
}

}  // namespace dygita

// Condensed bodies as other programs write them: matrices, and a table of points.
#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/log.hpp"
#include "intake/condensed_builder.hpp"
#include "intake/labelled_matrix.hpp"
#include "intake/matrix_market.hpp"
#include "intake/point_table.hpp"
#include "intake/superelement_file.hpp"

namespace dygita {

namespace {

void check_sizes(const Mat& stiffness, const std::string& of, const Mat& other, const std::string& of_other) {
  if (stiffness.rows() != other.rows())
    throw InputError(fmt::format("'{}' has {} rows and '{}' {}: they do not belong to one body", of, stiffness.rows(),
                                 of_other, other.rows()));
}

// Positive semidefinite but for rounding, by the Cholesky factors of the matrix scaled to a diagonal of ones.
void check_definite(const Mat& matrix, const std::string& file, const char* what) {
  constexpr double of_rounding = 1e-9;
  Vec scale = matrix.diagonal();
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    if (scale[i] < 0.0 || (scale[i] == 0.0 && !matrix.row(i).isZero(0.0)))
      throw InputError(
          fmt::format("'{}' is no {} matrix: its diagonal entry in row {} is {:.6g}", file, what, i + 1, scale[i]));
    scale[i] = scale[i] > 0.0 ? 1.0 / std::sqrt(scale[i]) : 1.0;
  }
  Mat scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  scaled.diagonal().array() += of_rounding * static_cast<double>(matrix.rows());
  const Eigen::LLT<Eigen::Ref<Mat>> factor(scaled);
  if (factor.info() != Eigen::Success)
    throw InputError(fmt::format(
        "'{}' is no {} matrix: it is not positive semidefinite: some motion would have negative energy", file, what));
}

void check_rows(const std::vector<PointLine>& points, Eigen::Index n_rows, const MatrixFiles& files) {
  std::set<int> taken;
  for (const PointLine& point : points)
    for (const int row : point.rows) {
      if (row == no_row) continue;
      if (row >= n_rows)
        throw InputError(
            fmt::format("'{}' has row {}, and '{}' {} rows", files.points, row + 1, files.stiffness, n_rows));
      if (!taken.insert(row).second) throw InputError(fmt::format("'{}' has row {} twice", files.points, row + 1));
    }
}

// A body that moves freely weighs the same along all axes.
void doubt_masses(const Mesh& mesh, const std::string& file) {
  constexpr double unlike = 0.01;
  const CondensedBody& body = *mesh.inside->matrices();
  Vec3 masses;
  for (int axis = 0; axis < 3; ++axis) {
    if (body.resists(mesh.nodes, Vec3::Unit(axis))) return;
    const Vec moved = body.rigid_motion(mesh.nodes, Vec3::Unit(axis), Vec3::Zero()).reshaped();
    masses[axis] = moved.dot(body.mass_matrix * moved);
  }
  if (masses.maxCoeff() - masses.minCoeff() > unlike * masses.maxCoeff())
    warn(fmt::format(
        "'{}': the body weighs {:.4g} kg along x, {:.4g} along y and {:.4g} along z: are rows and points in "
        "the same order?",
        file, masses[0], masses[1], masses[2]));
}

void check_mass(const Mesh& mesh, const MatrixFiles& files) {
  constexpr double close = 0.01;
  if (!files.total_mass) return;
  for (int axis = 0; axis < 3; ++axis)
    if (mesh.inside->resists(mesh.nodes, Vec3::Unit(axis)))
      throw InputError(fmt::format(
          "'{}' resists motions as a whole, because a support was condensed with the body: its mass cannot be "
          "compared with 'total_mass'\n    leave that out, or condense the body free",
          files.stiffness));
  const double mass = mesh.inside->mass(0.0);
  if (std::abs(mass - *files.total_mass) > close * *files.total_mass)
    throw InputError(
        fmt::format("'{}': the body weighs {:.6g} kg, but 'total_mass' is {:.6g} kg\n    do 'units' fit the matrices?",
                    files.mass, mass, *files.total_mass));
}

// Stiffness, mass, damping with the same rows.
struct BodyOfFiles {
  LabelledMatrix stiffness, mass, damping;

  std::array<LabelledMatrix*, 3> all() { return {&stiffness, &mass, &damping}; }
};

// Rows that one of them has and another has not are of zeros there.
void join_rows(BodyOfFiles& body, const MatrixFiles& files) {
  const bool has_names = !body.stiffness.rows.empty();
  std::set<MatrixRow> joined;
  for (const LabelledMatrix* one : body.all()) {
    if (one->matrix.size() > 0 && one->rows.empty() == has_names)
      throw InputError(
          fmt::format("'{}' and the other matrices do not go together: those of one format name their rows "
                      "by node, those of another only number them",
                      files.stiffness));
    joined.insert(one->rows.begin(), one->rows.end());
  }
  if (!has_names) return;
  const std::vector<MatrixRow> rows(joined.begin(), joined.end());
  refuse_large_matrix(static_cast<long>(rows.size()), files.stiffness);
  for (LabelledMatrix* one : body.all()) {
    if (one->matrix.size() == 0 || one->rows == rows) continue;
    std::vector<Eigen::Index> place;
    for (const MatrixRow& row : one->rows)
      place.push_back(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
    Mat larger = Mat::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.size()));
    larger(place, place) = one->matrix;
    *one = {std::move(larger), rows};
  }
}

BodyOfFiles read_body(const MatrixFiles& files) {
  BodyOfFiles body{read_matrix(files.stiffness, MatrixRole::stiffness, files.stiffness_name),
                   read_matrix(files.mass, MatrixRole::mass, files.mass_name),
                   {}};
  if (files.damping) body.damping = read_matrix(*files.damping, MatrixRole::damping, files.damping_name);
  for (const LabelledMatrix* one : body.all())
    if (!files.units && one->matrix.size() > 0 && !one->is_matrix_market)
      throw InputError(
          fmt::format("'units' is missing: only matrices in Matrix Market format are in SI unless told, and "
                      "those of '{}' and '{}' are not all in that",
                      files.stiffness, files.mass));
  join_rows(body, files);
  const MatrixUnits units = files.units.value_or(MatrixUnits());
  body.stiffness.matrix *= units.mass / (units.time * units.time);
  body.mass.matrix *= units.mass;
  body.damping.matrix *= units.mass / units.time;
  return body;
}

// By the names of the matrices' rows, where they have some.
void find_rows(std::vector<PointLine>& points, const std::vector<MatrixRow>& rows, const MatrixFiles& files) {
  const bool has_numbers = points.front().node == 0;
  if (rows.empty() && !has_numbers)
    throw InputError(
        fmt::format("'{}' has a column 'node', but the matrices only number their rows\n    give row_x, "
                    "row_y and row_z, or rows in the order of the table",
                    files.points));
  if (!rows.empty() && has_numbers)
    throw InputError(fmt::format("'{}' has no column 'node': '{}' names its rows by node, and the table must do so too",
                                 files.points, files.stiffness));
  if (rows.empty()) return;
  for (PointLine& point : points)
    for (int d = 0; d < 3; ++d) {
      const MatrixRow wanted{point.node, d + 1};
      const auto at = std::lower_bound(rows.begin(), rows.end(), wanted);
      if (at == rows.end() || *at != wanted)
        throw InputError(
            fmt::format("{}:{}: the matrices have no row of node {} along {}\n    keep all three "
                        "displacements of the points in what the body is reduced to",
                        files.points, point.line, point.node, "xyz"[d]));
      point.rows[static_cast<size_t>(d)] = static_cast<int>(at - rows.begin());
    }
}

}  // namespace

MeshPtr read_matrices(const MatrixFiles& files) {
  std::vector<PointLine> points = read_points(files.points);
  const BodyOfFiles body = read_body(files);
  const Mat &stiffness = body.stiffness.matrix, &mass = body.mass.matrix, &damping = body.damping.matrix;
  check_sizes(stiffness, files.stiffness, mass, files.mass);
  if (files.damping) check_sizes(stiffness, files.stiffness, damping, *files.damping);
  find_rows(points, body.stiffness.rows, files);
  check_rows(points, stiffness.rows(), files);
  check_definite(stiffness, files.stiffness, "stiffness");
  check_definite(mass, files.mass, "mass");
  if (files.damping) check_definite(damping, *files.damping, "damping");
  CondensedBuilder builder;
  auto mesh = std::make_shared<Mesh>();
  mesh->source = files.stiffness;
  const double metres = files.units.value_or(MatrixUnits()).length;
  for (const PointLine& point : points) {
    const int node = builder.add(NodeKind::point, metres * point.place, point.rows);
    mesh->point_groups[point.face].push_back(node);
  }
  const MeshPtr made = builder.finish(stiffness, mass, damping, std::move(mesh));
  doubt_masses(*made, files.mass);
  check_mass(*made, files);
  return made;
}

}  // namespace dygita

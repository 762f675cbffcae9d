// Condensed bodies as other programs write them: matrices, and a table of points.
#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "intake/condensed_builder.hpp"
#include "intake/matrix_market.hpp"
#include "intake/superelement_file.hpp"

namespace dygita {

namespace {

void check_sizes(const Mat& stiffness, const std::string& of, const Mat& other, const std::string& of_other) {
  if (stiffness.rows() != other.rows())
    throw InputError(fmt::format("'{}' has {} rows and '{}' {}: they do not belong to one body", of, stiffness.rows(),
                                 of_other, other.rows()));
}

struct PointLine {
  std::string face;
  Vec3 place;
  std::array<int, 3> rows;
};

std::vector<std::string> fields_of_line(std::string_view line) {
  std::vector<std::string> fields;
  const char separator = line.find(';') != std::string_view::npos   ? ';'
                         : line.find(',') != std::string_view::npos ? ','
                                                                    : '\t';
  std::istringstream stream{std::string(line)};
  for (std::string field; std::getline(stream, field, separator);) {
    const size_t first = field.find_first_not_of(" \t\""), last = field.find_last_not_of(" \t\"");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

class PointTable {
 public:
  explicit PointTable(const std::string& file) : file_(file), text_(text_of_file(file)) {
    std::istringstream stream(text_);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
      if (line.find_first_not_of(" \t") == std::string::npos || line.front() == '#') continue;
      if (columns_.empty())
        read_titles(fields_of_line(line), number);
      else
        read_line(fields_of_line(line), number);
    }
    if (points_.empty()) throw InputError(fmt::format("'{}' has no point", file_));
  }

  const std::vector<PointLine>& points() const { return points_; }

 private:
  void read_titles(const std::vector<std::string>& titles, int number) {
    const std::vector<std::string> needed{"face", "x", "y", "z"}, rows{"row_x", "row_y", "row_z"};
    std::vector<std::string> known = needed;
    known.insert(known.end(), rows.begin(), rows.end());
    for (size_t i = 0; i < titles.size(); ++i) {
      const std::string title = in_lower_case(titles[i]);
      if (std::find(known.begin(), known.end(), title) == known.end())
        throw InputError(fmt::format("{}:{}: the first line must have titles, but '{}' is not one of them\n    {}",
                                     file_, number, printable(titles[i]), did_you_mean(title, known)));
      if (!columns_.emplace(title, i).second)
        throw InputError(fmt::format("{}:{}: title '{}' comes twice", file_, number, title));
    }
    for (const std::string& title : needed)
      if (!columns_.contains(title))
        throw InputError(
            fmt::format("{}:{}: column '{}' is missing: face, x, y, z are required, row_x, row_y, row_z optional",
                        file_, number, title));
    const auto n = std::count_if(rows.begin(), rows.end(), [&](const auto& title) { return columns_.contains(title); });
    if (n != 0 && n != 3)
      throw InputError(fmt::format("{}:{}: give all of row_x, row_y and row_z, or none", file_, number));
  }

  double number_at(const std::vector<std::string>& fields, const char* title, int line) const {
    const std::string& field = fields[columns_.at(title)];
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
      throw InputError(
          fmt::format("{}:{}: '{}' of column '{}' is not a finite number", file_, line, printable(field), title));
    return value;
  }

  void read_line(const std::vector<std::string>& fields, int line) {
    if (fields.size() != columns_.size())
      throw InputError(
          fmt::format("{}:{}: {} columns, but the line of titles has {}", file_, line, fields.size(), columns_.size()));
    PointLine point{fields[columns_.at("face")],
                    {number_at(fields, "x", line), number_at(fields, "y", line), number_at(fields, "z", line)},
                    {}};
    const int own = 3 * static_cast<int>(points_.size());
    for (int d = 0; d < 3; ++d) {
      const std::string title = std::string("row_") + "xyz"[d];
      if (!columns_.contains(title)) {
        point.rows[static_cast<size_t>(d)] = own + d;
        continue;
      }
      const double row = number_at(fields, title.c_str(), line);
      if (row < 0.0 || row != std::floor(row) || row > 1e9)
        throw InputError(
            fmt::format("{}:{}: '{}' must be the number of a row, from 1, or 0 for none", file_, line, title));
      point.rows[static_cast<size_t>(d)] = static_cast<int>(row) - 1;
    }
    if (point.face.empty()) throw InputError(fmt::format("{}:{}: the face has no name", file_, line));
    points_.push_back(std::move(point));
  }

  std::string file_, text_;
  std::map<std::string, size_t> columns_;
  std::vector<PointLine> points_;
};

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

}  // namespace

MeshPtr read_matrices(const MatrixFiles& files) {
  const PointTable table(files.points);
  const MatrixFile stiffness = read_matrix_market(files.stiffness), mass = read_matrix_market(files.mass);
  MatrixFile damping;
  check_sizes(stiffness.matrix, files.stiffness, mass.matrix, files.mass);
  if (files.damping) {
    damping = read_matrix_market(*files.damping);
    check_sizes(stiffness.matrix, files.stiffness, damping.matrix, *files.damping);
  }
  check_rows(table.points(), stiffness.matrix.rows(), files);
  check_definite(stiffness.matrix, files.stiffness, "stiffness");
  check_definite(mass.matrix, files.mass, "mass");
  if (files.damping) check_definite(damping.matrix, *files.damping, "damping");
  CondensedBuilder builder;
  auto mesh = std::make_shared<Mesh>();
  mesh->source = files.stiffness;
  for (const PointLine& point : table.points()) {
    const int node = builder.add(NodeKind::point, point.place, point.rows);
    mesh->point_groups[point.face].push_back(node);
  }
  const MeshPtr made = builder.finish(stiffness.matrix, mass.matrix, damping.matrix, std::move(mesh));
  doubt_masses(*made, files.mass);
  return made;
}

}  // namespace dygita

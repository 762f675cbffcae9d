#include "mesh/superelement_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

constexpr Eigen::Index most_rows = 8000;         // dense: some gigabytes
constexpr std::uintmax_t most_bytes = 2u << 30;  // of a file

std::string text_of(const std::string& file) {
  require_file(file);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) throw InputError(fmt::format("cannot read the file '{}'", file));
  if (size > most_bytes) throw InputError(fmt::format("the file '{}' is larger than 2 GB", file));
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream) throw InputError(fmt::format("cannot read the file '{}'", file));
  return text;
}

// Lines and numbers of a text, one after the other.
class Scanner {
 public:
  Scanner(const std::string& text, const std::string& file) : rest_(text), file_(file) {}

  std::string_view line() {
    const size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!found.empty() && found.back() == '\r') found.remove_suffix(1);
    ++line_;
    return found;
  }
  bool is_at_comment() {
    skip_blanks();
    return !rest_.empty() && rest_.front() == '%';
  }
  bool is_at_end() {
    skip_blanks();
    return rest_.empty();
  }
  template <class Number>
  Number next(const char* what) {
    skip_blanks();
    Number value{};
    if (!rest_.empty() && rest_.front() == '+') rest_.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    const auto length = static_cast<size_t>(end - rest_.data());
    if (error != std::errc() || (length < rest_.size() && !is_blank(rest_[length]))) fail(what);
    rest_.remove_prefix(length);
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    const std::string_view word = rest_.substr(0, std::min<size_t>(rest_.find_first_of(" \t\r\n"), 30));
    throw InputError(fmt::format("{}:{}: {} is expected, not {}", file_, line_, what,
                                 word.empty() ? "the end of the file" : "'" + printable(std::string(word)) + "'"));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_.front())) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
  }

  std::string_view rest_;
  const std::string& file_;
  int line_ = 1;
};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

struct MatrixHeader {
  bool is_array = false, is_symmetric = false;
};

MatrixHeader header_of(std::string_view line, const std::string& file) {
  std::istringstream words(lower_case(line));
  std::string banner, object, format, field, symmetry;
  words >> banner >> object >> format >> field >> symmetry;
  if (banner != "%%matrixmarket" || object != "matrix")
    throw InputError(
        fmt::format("'{}' is no matrix in Matrix Market format: its first line does not begin with "
                    "'%%MatrixMarket matrix'",
                    file));
  if ((format != "array" && format != "coordinate") || (field != "real" && field != "integer" && field != "double") ||
      (symmetry != "symmetric" && symmetry != "general"))
    throw InputError(
        fmt::format("'{}': a matrix 'array' or 'coordinate', 'real' or 'integer', 'symmetric' or "
                    "'general' is expected, got '{} {} {}'",
                    file, printable(format), printable(field), printable(symmetry)));
  return {format == "array", symmetry == "symmetric"};
}

void check_matrix(const Mat& matrix, const std::string& file) {
  constexpr double unlike = 1e-6;  // of the largest entry of the two rows
  if (!matrix.allFinite()) throw InputError(fmt::format("'{}' has an entry that is not finite", file));
  const Vec largest = matrix.cwiseAbs().rowwise().maxCoeff();
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = j + 1; i < matrix.rows(); ++i)
      if (std::abs(matrix(i, j) - matrix(j, i)) > unlike * std::max(largest[i], largest[j]))
        throw InputError(fmt::format("'{}' is not symmetric: {:.9g} in row {}, column {}, and {:.9g} the other way",
                                     file, matrix(i, j), i + 1, j + 1, matrix(j, i)));
}

}  // namespace

MatrixFile read_matrix_market(const std::string& file) {
  const std::string text = text_of(file);
  Fnv1a digest;
  digest.add(text);
  Scanner scanner(text, file);
  const MatrixHeader header = header_of(scanner.line(), file);
  while (scanner.is_at_comment()) scanner.line();
  const auto rows = scanner.next<long>("the number of rows"), columns = scanner.next<long>("the number of columns");
  if (rows != columns || rows < 1)
    throw InputError(fmt::format("'{}' is {} x {}: a square matrix is expected", file, rows, columns));
  if (rows > most_rows)
    throw InputError(
        fmt::format("'{}' has {} rows: at most {} are allowed, since a condensed body is kept as a dense "
                    "matrix\n    condense it to fewer points or modes",
                    file, rows, most_rows));
  Mat matrix = Mat::Zero(rows, rows);
  if (header.is_array) {
    for (long j = 0; j < rows; ++j)
      for (long i = header.is_symmetric ? j : 0; i < rows; ++i) {
        matrix(i, j) = scanner.next<double>("an entry");
        if (header.is_symmetric) matrix(j, i) = matrix(i, j);
      }
  } else {
    const auto n = scanner.next<long>("the number of entries");
    for (long k = 0; k < n; ++k) {
      const auto i = scanner.next<long>("a row"), j = scanner.next<long>("a column");
      if (i < 1 || j < 1 || i > rows || j > rows)
        throw InputError(fmt::format("'{}' has an entry in row {}, column {} of {} x {}", file, i, j, rows, rows));
      const auto value = scanner.next<double>("an entry");
      matrix(i - 1, j - 1) += value;
      if (header.is_symmetric && i != j) matrix(j - 1, i - 1) += value;
    }
  }
  if (!scanner.is_at_end()) scanner.fail("the end of the matrix");
  check_matrix(matrix, file);
  matrix = 0.5 * (matrix + matrix.transpose()).eval();
  return {std::move(matrix), digest.hexadecimal()};
}

namespace {

constexpr int no_row = -1;  // something inside holds it, or there is none

// A body that grows node by node, and then takes its matrices.
class CondensedBuilder {
 public:
  // Rows (from 0, or no_row) of three unknowns.
  int add(NodeKind kind, const Vec3& place, const std::array<int, 3>& rows) {
    const int node = static_cast<int>(places_.size());
    places_.push_back(place);
    rows_.push_back(rows);
    body_->kinds.push_back(kind);
    for (int d = 0; d < 3; ++d)
      if (rows[static_cast<size_t>(d)] == no_row && kind != NodeKind::follower)
        (kind == NodeKind::point ? body_->held : body_->absent).emplace_back(node, Vec3::Unit(d));
    return node;
  }
  void add_follower(const Vec3& place, int point, int turn, double size) {
    const int node = add(NodeKind::follower, place, {no_row, no_row, no_row});
    body_->followers.push_back({node, point, turn, place - places_[static_cast<size_t>(point)], size});
  }
  int n_nodes() const { return static_cast<int>(places_.size()); }

  // Amplitudes for the rows that no node has yet, and all entries. what: of the files, for messages.
  MeshPtr finish(const Mat& stiffness, const Mat& mass, const Mat& damping, std::shared_ptr<Mesh> mesh) {
    check_rows_once(mesh->source);
    add_amplitudes(stiffness.rows());
    mesh->nodes.resize(3, n_nodes());
    for (int node = 0; node < n_nodes(); ++node) mesh->nodes.col(node) = places_[static_cast<size_t>(node)];
    const SparseMatrix pattern = dense_pattern();
    body_->stiffness = on_nodes(stiffness, pattern);
    body_->mass = on_nodes(mass, pattern);
    if (damping.size() > 0) body_->damping = on_nodes(damping, pattern);
    body_->find_carried(mesh->nodes);
    if (body_->mass_of_parts <= 0.0) body_->mass_of_parts = mass_of_translation(mesh->nodes);
    mesh->condensed = body_;
    mesh->digest = mesh_digest(*mesh);
    return mesh;
  }
  CondensedBody& body() { return *body_; }

 private:
  void add_amplitudes(Eigen::Index n_rows) {
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
  SparseMatrix dense_pattern() const {
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

  SparseMatrix on_nodes(const Mat& matrix, const SparseMatrix& pattern) const {
    SparseMatrix entries = pattern;
    const auto row_of = [&](Eigen::Index at) {
      return rows_[static_cast<size_t>(at / 3)][static_cast<size_t>(at % 3)];
    };
    for (int i = 0; i < entries.outerSize(); ++i)
      for (SparseMatrix::InnerIterator e(entries, i); e; ++e)
        if (const int row = row_of(e.row()), column = row_of(e.col()); row != no_row && column != no_row)
          e.valueRef() = matrix(row, column);
    return entries;
  }

  void check_rows_once(const std::string& source) const {
    std::set<int> taken;
    for (const auto& rows : rows_)
      for (const int row : rows)
        if (row != no_row && !taken.insert(row).second)
          throw InputError(fmt::format("'{}' has row {} twice", source, row + 1));
  }

  double mass_of_translation(const Points& x) const {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec moved = body_->rigid_motion(x, Vec3::Unit(axis), Vec3::Zero()).reshaped();
      sum += moved.dot(body_->mass * moved) / 3.0;
    }
    return sum;
  }

  std::shared_ptr<CondensedBody> body_ = std::make_shared<CondensedBody>();
  std::vector<Vec3> places_;
  std::vector<std::array<int, 3>> rows_;
};

void check_sizes(const Mat& stiffness, const std::string& of, const Mat& other, const std::string& of_other) {
  if (stiffness.rows() != other.rows())
    throw InputError(fmt::format("'{}' has {} rows and '{}' {}: they are not of one body", of, stiffness.rows(),
                                 of_other, other.rows()));
}

// --- as output.superelement writes them

class Description {
 public:
  explicit Description(const std::string& file) : file_(file), text_(text_of(file)) {
    try {
      json_ = Json::parse(text_);
    } catch (const Json::exception&) {
      refuse("it is no JSON");
    }
    const Json what = json_.is_object() ? json_.value("what", Json()) : Json();
    if (what != "dygita superelement") refuse("its 'what' is not \"dygita superelement\"");
    if (json_.value("version", Json()) != 1)
      refuse("it is of a later version of the program: condense the body again with this one, or take the later one");
  }

  MeshPtr read() const {
    try {
      return read_body();
    } catch (const Json::exception& error) {
      refuse(fmt::format("something is missing in it or of another kind ({})", error.what()));
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(
        fmt::format("'{}' does not describe a superelement: {}\n    output.superelement writes "
                    "<name>.json; matrices of other programs are given by 'stiffness', 'mass' and "
                    "'points'",
                    file_, why));
  }

  Mat matrix(const char* what) const {
    const Json& entry = json_.at(what);
    const std::string name = entry.at("file");
    if (fs::path(name).filename() != name) refuse(fmt::format("'{}' is in another folder", printable(name)));
    const std::string path = (fs::path(file_).parent_path() / name).string();
    MatrixFile read = read_matrix_market(path);
    if (read.digest != entry.at("digest"))
      throw InputError(fmt::format("'{}' is not the {} that '{}' describes: it has been changed, or is of another run",
                                   path, what, file_));
    if (read.matrix.rows() != json_.at("n_rows").get<long>())
      throw InputError(fmt::format("'{}' has {} rows, '{}' says {}", path, read.matrix.rows(), file_,
                                   json_.at("n_rows").get<long>()));
    return std::move(read.matrix);
  }

  static Vec3 vector(const Json& json) {
    return Vec3(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
  }

  int row_of(const Json& json) const {
    const long row = json.get<long>();
    if (row == -1)
      throw InputError(
          fmt::format("'{}': a motion of one of its faces is that of another face, since they are tied to "
                      "each other or share nodes along a support that is oblique: it has no row of its "
                      "own\n    condense the assembly with one of the two in 'on'",
                      file_));
    if (row < 0 || row > json_.at("n_rows").get<long>()) refuse(fmt::format("there is no row {}", row));
    return row == 0 ? no_row : static_cast<int>(row) - 1;
  }
  std::array<int, 3> rows(const Json& json, size_t first = 0) const {
    return {row_of(json.at(first)), row_of(json.at(first + 1)), row_of(json.at(first + 2))};
  }

  // Nodes of the face's facets, as the mesh has them.
  std::vector<Facet> facets(const Json& json, const std::vector<int>& node_of) const {
    std::vector<Facet> all;
    for (const Json& entry : json) {
      const std::vector<int> nodes = numbered(entry.at("nodes"), node_of);
      const int type = entry.at("type");
      const auto shape = std::find_if(std::begin(facet_shapes), std::end(facet_shapes),
                                      [&](const FacetShape& one) { return one.vtk_type == type; });
      if (shape == std::end(facet_shapes) || static_cast<int>(nodes.size()) != nodes_per_facet(shape->type))
        refuse(fmt::format("a facet of type {} with {} nodes", type, nodes.size()));
      all.emplace_back(shape->type, nodes);
    }
    return all;
  }

  std::vector<int> numbered(const Json& numbers, const std::vector<int>& node_of) const {
    std::vector<int> nodes;
    for (const Json& json : numbers) {
      const long number = json.get<long>();
      if (number < 1 || number > static_cast<long>(node_of.size())) refuse(fmt::format("there is no node {}", number));
      nodes.push_back(node_of[static_cast<size_t>(number) - 1]);
    }
    return nodes;
  }

  // Of each node of the description its node in the mesh.
  std::vector<int> add_points(CondensedBuilder& builder) const {
    std::vector<int> node_of;
    for (const Json& node : json_.at("nodes"))
      node_of.push_back(builder.add(NodeKind::point, vector(node.at("place")), rows(node.at("rows"))));
    return node_of;
  }

  // A face that moves as a whole, and its nodes.
  std::vector<int> add_rigid(const Json& face, CondensedBuilder& builder) const {
    const Json &own = face.at("rows"), &nodes = face.at("nodes");
    const Vec3 centre = vector(face.at("centre"));
    double size = 0.0;
    for (const Json& place : nodes) size = std::max(size, (vector(place) - centre).norm());
    const int point = builder.add(NodeKind::point, centre, rows(own));
    const bool turns = own.size() == 6 && size > 0.0;
    int turn = -1;
    if (turns) {
      turn = builder.add(NodeKind::turn, centre, rows(own, 3));
      sizes_.emplace_back(rows(own, 3), size);
    }
    std::vector<int> node_of;
    for (const Json& place : nodes) {
      node_of.push_back(builder.n_nodes());
      builder.add_follower(vector(place), point, turn, std::max(size, 1e-12));
    }
    return node_of;
  }

  MeshPtr read_body() const {
    CondensedBuilder builder;
    auto mesh = std::make_shared<Mesh>();
    mesh->source = file_;
    const bool has_points = json_.at("motion") == "nodes";
    const std::vector<int> points = has_points ? add_points(builder) : std::vector<int>();
    for (const Json& face : json_.at("faces")) {
      const std::string name = face.at("name");
      if (mesh->faces.contains(name) || mesh->point_groups.contains(name))
        refuse(fmt::format("face '{}' comes twice", printable(name)));
      const std::vector<int> node_of = has_points ? points : add_rigid(face, builder);
      std::vector<Facet> all = facets(face.at("facets"), node_of);
      if (!all.empty())
        mesh->faces[name] = std::move(all);
      else
        mesh->point_groups[name] = has_points ? numbered(face.at("points"), node_of) : node_of;
    }
    if (builder.n_nodes() == 0) refuse("it has no node");
    Mat stiffness = matrix("stiffness"), mass = matrix("mass");
    Mat damping = json_.contains("damping") ? matrix("damping") : Mat();
    for (Mat* one : {&stiffness, &mass, &damping})
      if (one->size() > 0) scale_turns(*one);
    if (const int missed = json_.at("increments_not_converged"); missed > 0)
      warn(fmt::format("superelement '{}' was made after {} increment{} that had not converged", file_, missed,
                       missed == 1 ? "" : "s"));
    builder.body().mass_of_parts = json_.at("mass_of_parts");
    builder.body().valid_to = json_.at("valid_to");
    return builder.finish(stiffness, mass, damping, std::move(mesh));
  }

  // Rows of rotations (rad) become those of rotations times the face's size (m).
  void scale_turns(Mat& matrix) const {
    for (const auto& [turn_rows, size] : sizes_)
      for (const int row : turn_rows) {
        if (row == no_row) continue;
        matrix.row(row) /= size;
        matrix.col(row) /= size;
      }
  }

  std::string file_, text_;
  Json json_;
  mutable std::vector<std::pair<std::array<int, 3>, double>> sizes_;
};

// --- as other programs write them

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
  explicit PointTable(const std::string& file) : file_(file), text_(text_of(file)) {
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
      const std::string title = lower_case(titles[i]);
      if (std::find(known.begin(), known.end(), title) == known.end())
        throw InputError(fmt::format("{}:{}: a line of titles comes first, and '{}' is none of them\n    {}", file_,
                                     number, printable(titles[i]), did_you_mean(title, known)));
      if (!columns_.emplace(title, i).second)
        throw InputError(fmt::format("{}:{}: title '{}' comes twice", file_, number, title));
    }
    for (const std::string& title : needed)
      if (!columns_.contains(title))
        throw InputError(
            fmt::format("{}:{}: column '{}' is missing: face, x, y, z are needed, row_x, row_y, row_z may "
                        "follow",
                        file_, number, title));
    const auto n = std::count_if(rows.begin(), rows.end(), [&](const auto& title) { return columns_.contains(title); });
    if (n != 0 && n != 3)
      throw InputError(fmt::format("{}:{}: row_x, row_y and row_z come together or not at all", file_, number));
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
      throw InputError(fmt::format("{}:{}: {} columns where the line of titles has {}", file_, line, fields.size(),
                                   columns_.size()));
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
            fmt::format("{}:{}: '{}' is the number of a row from 1 on, or 0 where there is none", file_, line, title));
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
  constexpr double rounding = 1e-9;
  Vec scale = matrix.diagonal();
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    if (scale[i] < 0.0 || (scale[i] == 0.0 && !matrix.row(i).isZero(0.0)))
      throw InputError(
          fmt::format("'{}' is no {} matrix: its diagonal entry in row {} is {:.6g}", file, what, i + 1, scale[i]));
    scale[i] = scale[i] > 0.0 ? 1.0 / std::sqrt(scale[i]) : 1.0;
  }
  Mat scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  scaled.diagonal().array() += rounding * static_cast<double>(matrix.rows());
  const Eigen::LLT<Eigen::Ref<Mat>> factor(scaled);
  if (factor.info() != Eigen::Success)
    throw InputError(
        fmt::format("'{}' is no {} matrix: it is not positive semidefinite, some motion would have a "
                    "negative energy",
                    file, what));
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

}  // namespace

MeshPtr read_superelement(const std::string& file) { return Description(file).read(); }

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
  return builder.finish(stiffness.matrix, mass.matrix, damping.matrix, std::move(mesh));
}

}  // namespace dygita

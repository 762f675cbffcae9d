// Matrices of Abaqus and CalculiX: entries by node and degree of freedom or by row and column, and the triangle of a
// user element. Sources: Abaqus Keywords Guide, *MATRIX INPUT, *USER ELEMENT, *MATRIX; CalculiX User's Manual,
// SOLVER=MATRIXSTORAGE, *SUBSTRUCTURE MATRIX OUTPUT.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/names.hpp"
#include "intake/labelled_matrix.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace {

MatrixRow degree_of_freedom(const TextLines& lines, std::string_view node, std::string_view component) {
  constexpr long most = 2000000000;
  const MatrixRow row{lines.integer(node, "a node"), static_cast<int>(lines.integer(component, "a degree of freedom"))};
  if (row.node < 1 || row.node > most || row.component < 1 || row.component > 6)
    lines.fail(fmt::format("there is no degree of freedom {}.{}: nodes count from 1, degrees of freedom are 1 to 6",
                           row.node, row.component));
  return row;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields = split_at(line, line.find(',') != std::string_view::npos ? ',' : ' ');
  if (!fields.empty() && fields.back().empty()) fields.pop_back();  // after the last comma
  return fields;
}

// *USER ELEMENT, LINEAR: nodes in comments, degrees of freedom by position, then triangles row after row.
class UserElement {
 public:
  UserElement(const std::string& text, const std::string& file, MatrixRole role)
      : lines_(text, file), file_(file), role_(role) {}

  LabelledMatrix read() {
    for (std::string_view line; lines_.next(line);) {
      if (trimmed(line).empty()) continue;
      if (line.starts_with("**"))
        read_comment(line.substr(2));
      else if (line.starts_with('*'))
        read_keyword(in_lower_case(std::string(line)));
      else if (part_ == Part::freedoms)
        read_freedoms(line);
      else if (part_ == Part::matrix)
        read_entries(line);
    }
    if (entries_.empty())
      throw InputError(fmt::format("'{}' has no {} matrix (*MATRIX, TYPE={})", file_, text_of(role_), type()));
    return assemble();
  }

 private:
  enum class Part { other, nodes, freedoms, matrix };

  const char* type() const { return role_ == MatrixRole::stiffness ? "STIFFNESS" : "MASS"; }

  void read_comment(std::string_view line) {
    if (part_ != Part::freedoms || has_freedoms_) return;
    if (in_lower_case(std::string(trimmed(line))) == "element nodes") return;
    for (const std::string_view field : fields_of(line)) nodes_.push_back(lines_.integer(field, "a node"));
  }

  void read_keyword(std::string line) {
    line.erase(std::remove(line.begin(), line.end(), ' '), line.end());
    part_ = Part::other;
    if (line.starts_with("*userelement")) {
      if (!nodes_.empty()) lines_.fail("a second *USER ELEMENT: one substructure is expected");
      part_ = Part::freedoms;
    } else if (line.starts_with("*matrix")) {
      const bool is_stiffness = line.find("type=stiffness") != std::string::npos,
                 is_mass = line.find("type=mass") != std::string::npos;
      if (is_stiffness == is_mass) lines_.fail("*MATRIX requires TYPE=STIFFNESS or TYPE=MASS");
      if ((is_stiffness && role_ == MatrixRole::stiffness) || (is_mass && role_ == MatrixRole::mass)) {
        if (!entries_.empty()) lines_.fail(fmt::format("a second {} matrix", text_of(role_)));
        part_ = Part::matrix;
      }
    }
  }

  // "k, 1, 2, 3": from position k on nodes have these; the first line has no position.
  void read_freedoms(std::string_view line) {
    std::vector<std::string_view> fields = fields_of(line);
    const long position = has_freedoms_ ? lines_.integer(fields.front(), "the position of a node") : 1;
    if (has_freedoms_) fields.erase(fields.begin());
    if (position < 1 || position > static_cast<long>(nodes_.size()) ||
        (has_freedoms_ && position <= freedoms_.back().first))
      lines_.fail(fmt::format("there is no position {} after the one before, of {} nodes", position, nodes_.size()));
    freedoms_.emplace_back(position, std::vector<long>());
    for (const std::string_view field : fields)
      freedoms_.back().second.push_back(lines_.integer(field, "a degree of freedom"));
    has_freedoms_ = true;
  }

  void read_entries(std::string_view line) {
    constexpr size_t most = static_cast<size_t>(most_matrix_rows) * (most_matrix_rows + 1) / 2;
    for (const std::string_view field : fields_of(line)) entries_.push_back(lines_.real(field, "an entry"));
    if (entries_.size() > most) refuse_large_matrix(most_matrix_rows + 1, file_);
  }

  LabelledMatrix assemble() {
    std::vector<MatrixRow> rows;
    size_t now = 0;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      while (now + 1 < freedoms_.size() && freedoms_[now + 1].first <= static_cast<long>(i) + 1) ++now;
      if (freedoms_.empty()) break;
      for (const long component : freedoms_[now].second) {
        if (nodes_[i] < 1 || component < 1 || component > 6)
          throw InputError(
              fmt::format("'{}' has degree of freedom {}.{}: nodes count from 1, degrees of freedom are "
                          "1 to 6",
                          file_, nodes_[i], component));
        rows.push_back({nodes_[i], static_cast<int>(component)});
      }
      refuse_large_matrix(static_cast<long>(rows.size()), file_);
    }
    if (entries_.size() != rows.size() * (rows.size() + 1) / 2)
      throw InputError(
          fmt::format("'{}' has {} degrees of freedom, whose triangle has {} entries, but {} in its {} "
                      "matrix",
                      file_, rows.size(), rows.size() * (rows.size() + 1) / 2, entries_.size(), text_of(role_)));
    MatrixEntries all;
    size_t at = 0;
    for (size_t i = 0; i < rows.size(); ++i)
      for (size_t j = 0; j <= i; ++j) all.add(rows[i], rows[j], entries_[at++], lines_);
    return all.finish(MatrixEntries::Given::one_triangle, file_);
  }

  TextLines lines_;
  const std::string& file_;
  MatrixRole role_;
  Part part_ = Part::other;
  bool has_freedoms_ = false;
  std::vector<long> nodes_;
  std::vector<std::pair<long, std::vector<long>>> freedoms_;
  std::vector<double> entries_;
};

// Lines of row and column, or of two nodes with their degrees of freedom, and an entry. dofs: of each row; empty: none.
LabelledMatrix read_lines(TextLines lines, const std::string& file, const std::vector<MatrixRow>& dofs) {
  MatrixEntries entries;
  bool has_nodes = false;
  for (const MatrixRow& row : dofs) entries.name(row, lines);
  const auto by_number = [&](std::string_view field) -> MatrixRow {
    const long number = lines.integer(field, "a row or a column");
    if (number < 1 || (!dofs.empty() && number > static_cast<long>(dofs.size())))
      lines.fail(dofs.empty() ? fmt::format("there is no row {}", number)
                              : fmt::format("there is no row {} of {}", number, dofs.size()));
    refuse_large_matrix(number, file);
    return dofs.empty() ? MatrixRow{number, 0} : dofs[static_cast<size_t>(number) - 1];
  };
  long largest = 0;
  for (std::string_view line; lines.next(line);) {
    if (trimmed(line).empty() || line.starts_with("**")) continue;
    const std::vector<std::string_view> fields = fields_of(line);
    const bool is_first = entries.empty();
    if (fields.size() == 5 && dofs.empty() && (has_nodes || is_first)) {
      has_nodes = true;
      entries.add(degree_of_freedom(lines, fields[0], fields[1]), degree_of_freedom(lines, fields[2], fields[3]),
                  lines.real(fields[4], "an entry"), lines);
    } else if (fields.size() == 3 && !has_nodes) {
      const MatrixRow row = by_number(fields[0]), column = by_number(fields[1]);
      largest = std::max({largest, row.node, column.node});
      entries.add(row, column, lines.real(fields[2], "an entry"), lines);
    } else {
      lines.fail(fmt::format("{} fields: a row, a column and an entry are expected{}", fields.size(),
                             dofs.empty() ? ", or two nodes with their degrees of freedom and an entry" : ""));
    }
  }
  if (entries.empty()) throw InputError(fmt::format("'{}' has no entry", file));
  const bool has_numbers = dofs.empty() && !has_nodes;
  for (long row = 1; row <= largest && has_numbers; ++row) entries.name({row, 0}, lines);
  LabelledMatrix made = entries.finish(MatrixEntries::Given::either, file);
  if (has_numbers) made.rows.clear();
  return made;
}

}  // namespace

LabelledMatrix read_abaqus_matrix(const std::string& text, const std::string& file, MatrixRole role) {
  if (in_lower_case(text.substr(0, 4096)).find("*user element") == std::string::npos)
    return read_lines(TextLines(text, file), file, {});
  if (role == MatrixRole::damping)
    throw InputError(fmt::format("'{}' is a user element, which has no damping matrix", file));
  return UserElement(text, file, role).read();
}

LabelledMatrix read_coordinates(const std::string& text, const std::string& file, const std::string& dofs,
                                const std::string& dof_file) {
  std::vector<MatrixRow> rows;
  TextLines lines(dofs, dof_file);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty()) continue;
    const size_t dot = line.find('.');
    if (dot == std::string_view::npos) lines.fail("a node and its degree of freedom are expected, as 12.3");
    rows.push_back(degree_of_freedom(lines, line.substr(0, dot), line.substr(dot + 1)));
    refuse_large_matrix(static_cast<long>(rows.size()), dof_file);
  }
  std::vector<MatrixRow> sorted = rows;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    throw InputError(fmt::format("'{}' has {}.{} twice", dof_file, twice->node, twice->component));
  if (rows.empty()) throw InputError(fmt::format("'{}' has no degree of freedom", dof_file));
  return read_lines(TextLines(text, file), file, rows);
}

}  // namespace dygita

#include "intake/labelled_matrix.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace fs = std::filesystem;

const char* text_of(MatrixRole role) {
  return role == MatrixRole::stiffness ? "stiffness" : role == MatrixRole::mass ? "mass" : "damping";
}

bool TextLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const size_t end = std::min(rest_.find('\n'), rest_.size());
  line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++number_;
  return true;
}

void TextLines::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", *file_, number_, what));
}

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

std::vector<std::string_view> split_at(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  if (separator != ' ') {
    for (;;) {
      const size_t end = std::min(line.find(separator), line.size());
      fields.push_back(trimmed(line.substr(0, end)));
      if (end == line.size()) return fields;
      line.remove_prefix(end + 1);
    }
  }
  for (size_t first = line.find_first_not_of(" \t"); first != std::string_view::npos;
       first = line.find_first_not_of(" \t", first)) {
    const size_t end = std::min(line.find_first_of(" \t", first), line.size());
    fields.push_back(line.substr(first, end - first));
    first = end;
  }
  return fields;
}

namespace {

std::string shown(std::string_view field) {
  return field.empty() ? "nothing" : "'" + printable(std::string(field.substr(0, 30))) + "'";
}

}  // namespace

long TextLines::integer(std::string_view field, const char* what) const {
  field = trimmed(field);
  if (field.starts_with('+')) field.remove_prefix(1);
  long value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (field.empty() || error != std::errc() || end != field.data() + field.size())
    fail(fmt::format("{} is expected, not {}", what, shown(field)));
  return value;
}

double TextLines::real(std::string_view field, const char* what) const {
  field = trimmed(field);
  std::string text;
  for (const char c : field) {
    const bool has_mantissa = !text.empty() && text.back() != 'e';
    if (c == 'D' || c == 'd' || c == 'E')
      text += 'e';
    else if ((c == '+' || c == '-') && has_mantissa && text.find('e') == std::string::npos)
      text += std::string("e") + (c == '-' ? "-" : "");
    else if (c != '+')
      text += c;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail(fmt::format("{} is expected, not {}", what, shown(field)));
  return value;
}

std::string chosen_matrix(const std::vector<std::string>& names, MatrixRole role, const std::string& name,
                          const std::string& file) {
  std::string known;
  for (const std::string& one : names) known += (known.empty() ? "" : ", ") + printable(one);
  if (names.empty()) throw InputError(fmt::format("'{}' has no matrix", file));
  if (!name.empty()) {
    const std::string wanted = in_lower_case(name);
    for (const std::string& one : names)
      if (in_lower_case(one) == wanted) return one;
    throw InputError(fmt::format("'{}' has no matrix '{}'\n    it has {}", file, name, known));
  }
  const std::string_view initials = role == MatrixRole::stiffness ? "Kk" : role == MatrixRole::mass ? "Mm" : "BbCcDd";
  std::vector<std::string> found;
  for (const std::string& one : names)
    if (initials.find(one.front()) != std::string_view::npos) found.push_back(one);
  if (found.size() == 1) return found.front();
  throw InputError(
      fmt::format("'{}' has {} matrix whose name begins as that of a {} does\n    name it, as {}_name = "
                  "\"...\": the file has {}",
                  file, found.empty() ? "no" : "more than one", text_of(role), text_of(role), known));
}

int MatrixEntries::index_of(const MatrixRow& row, const TextLines& at) {
  const auto [it, is_new] = rows_.try_emplace(row, static_cast<int>(rows_.size()));
  if (is_new && static_cast<Eigen::Index>(rows_.size()) > most_matrix_rows)
    at.fail(
        fmt::format("more than {} rows: a condensed body is stored as a dense matrix\n    condense it to fewer "
                    "points or modes",
                    most_matrix_rows));
  return it->second;
}

void MatrixEntries::add(const MatrixRow& row, const MatrixRow& column, double value, const TextLines& at) {
  const int i = index_of(row, at), j = index_of(column, at);
  entries_.push_back({i, j, at.number(), value});
}

LabelledMatrix MatrixEntries::finish(Given given, const std::string& file) const {
  LabelledMatrix made;
  const auto n = static_cast<Eigen::Index>(rows_.size());
  std::vector<Eigen::Index> place(rows_.size());  // of each index, in the order of the labels
  for (const auto& [row, index] : rows_) {
    place[static_cast<size_t>(index)] = static_cast<Eigen::Index>(made.rows.size());
    made.rows.push_back(row);
  }
  made.matrix = Mat::Zero(n, n);
  Eigen::Matrix<char, Eigen::Dynamic, Eigen::Dynamic> is_given(n, n);
  is_given.setZero();
  bool has_lower = false, has_upper = false;
  for (const Entry& entry : entries_) {
    const Eigen::Index i = place[static_cast<size_t>(entry.row)], j = place[static_cast<size_t>(entry.column)];
    has_lower |= i > j;
    has_upper |= i < j;
    const bool is_mirrored = given == Given::one_triangle && is_given(j, i);
    if (is_given(i, j) || is_mirrored)
      throw InputError(
          fmt::format("{}:{}: the entry of {}.{} and {}.{} is given {}", file, entry.line,
                      made.rows[static_cast<size_t>(i)].node, made.rows[static_cast<size_t>(i)].component,
                      made.rows[static_cast<size_t>(j)].node, made.rows[static_cast<size_t>(j)].component,
                      is_mirrored && !is_given(i, j) ? "twice in a matrix that is said to be symmetric" : "twice"));
    is_given(i, j) = 1;
    made.matrix(i, j) = entry.value;
  }
  if (given == Given::one_triangle || (given == Given::either && has_lower != has_upper)) {
    const Vec diagonal = made.matrix.diagonal();
    made.matrix = (made.matrix + made.matrix.transpose()).eval();
    made.matrix.diagonal() = diagonal;
  }
  make_symmetric(made.matrix, file);
  return made;
}

namespace {

// By its first line: a keyword or a comment of Abaqus, or numbers with commas.
bool is_abaqus_matrix(const std::string& text) {
  const std::string_view line = trimmed(std::string_view(text).substr(0, text.find_first_of("\r\n")));
  return line.starts_with('*') || (line.find(',') != std::string_view::npos && !line.starts_with('%'));
}

}  // namespace

LabelledMatrix read_matrix(const std::string& file, MatrixRole role, const std::string& name) {
  const std::string extension = in_lower_case(fs::path(file).extension().string());
  const auto is_one_of = [&](std::initializer_list<const char*> known) {
    return std::find(known.begin(), known.end(), extension) != known.end();
  };
  if (is_one_of({".pch", ".bdf", ".dat", ".nas", ".dmig"})) return read_dmig(text_of_file(file), file, role, name);
  if (is_one_of({".op4"})) return read_op4(text_of_file(file), file, role, name);
  if (!name.empty())
    throw InputError(fmt::format("{}_name = \"{}\" is for files of several matrices, .pch and .op4: '{}' has one",
                                 text_of(role), name, file));
  if (is_one_of({".sti", ".mas", ".dam"})) {
    const std::string dofs = fs::path(file).replace_extension(".dof").string();
    return read_coordinates(text_of_file(file), file, text_of_file(dofs), dofs);
  }
  if (is_one_of({".mtx"}))
    if (const std::string text = text_of_file(file); is_abaqus_matrix(text))
      return read_abaqus_matrix(text, file, role);
  return {read_matrix_market(file).matrix, {}, true};
}

}  // namespace dygita

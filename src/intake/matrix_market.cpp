#include "intake/matrix_market.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"

namespace dygita {

namespace {

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

struct MatrixHeader {
  bool is_array = false, is_symmetric = false;
};

MatrixHeader header_of(std::string_view line, const std::string& file) {
  std::istringstream words(in_lower_case(std::string(line)));
  std::string banner, object, format, field, symmetry;
  words >> banner >> object >> format >> field >> symmetry;
  if (banner != "%%matrixmarket" || object != "matrix")
    throw InputError(
        fmt::format("'{}' is not in Matrix Market format: its first line does not begin with "
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

}  // namespace

void refuse_large_matrix(long rows, const std::string& file) {
  if (rows > most_matrix_rows)
    throw InputError(
        fmt::format("'{}' has {} rows: at most {} are allowed, since a condensed body is stored as a dense matrix\n    "
                    "condense it to fewer points or modes",
                    file, rows, most_matrix_rows));
}

void make_symmetric(Mat& matrix, const std::string& file) {
  constexpr double unlike = 1e-6;  // of the largest entry of the two rows
  if (!matrix.allFinite()) throw InputError(fmt::format("'{}' has an entry that is not finite", file));
  const Vec largest = matrix.cwiseAbs().rowwise().maxCoeff();
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = j + 1; i < matrix.rows(); ++i)
      if (std::abs(matrix(i, j) - matrix(j, i)) > unlike * std::max(largest[i], largest[j]))
        throw InputError(fmt::format("'{}' is not symmetric: {:.9g} in row {}, column {}, but {:.9g} transposed", file,
                                     matrix(i, j), i + 1, j + 1, matrix(j, i)));
  matrix = 0.5 * (matrix + matrix.transpose()).eval();
}

MatrixFile read_matrix_market(const std::string& file) {
  const std::string text = text_of_file(file);
  Fnv1a digest;
  digest.add(text);
  Scanner scanner(text, file);
  const MatrixHeader header = header_of(scanner.line(), file);
  while (scanner.is_at_comment()) scanner.line();
  const auto rows = scanner.next<long>("the number of rows"), columns = scanner.next<long>("the number of columns");
  if (rows != columns || rows < 1)
    throw InputError(fmt::format("'{}' is {} x {}: a square matrix is expected", file, rows, columns));
  refuse_large_matrix(rows, file);
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
  make_symmetric(matrix, file);
  return {std::move(matrix), digest.hexadecimal()};
}

}  // namespace dygita

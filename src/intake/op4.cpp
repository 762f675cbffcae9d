// Nastran's OUTPUT4 files as text: full columns, and strings of entries with small and large row numbers. Source: MSC
// Nastran DMAP Programmer's Guide, OUTPUT4.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.hpp"
#include "base/names.hpp"
#include "intake/labelled_matrix.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace {

struct Op4Header {
  long columns = 0, rows = 0;  // rows negative: large row numbers
  long type = 0;
  std::string name;
  size_t a_line = 5, width = 16;  // of numbers

  long words() const { return type == 2 || type == 4 ? 2 : 1; }  // of a number, as strings count them
};

class Op4Reader {
 public:
  Op4Reader(const std::string& text, const std::string& file) : lines_(text, file), file_(file) {}

  // The next matrix's header; false: there is none.
  bool next(Op4Header& header) {
    std::string_view line;
    do {
      if (!lines_.next(line)) return false;
    } while (trimmed(line).empty());
    if (line.size() < 33)
      lines_.fail("this is no OUTPUT4 text: a line with columns, rows, form, type and name of a matrix is expected");
    const auto field = [&](size_t i) { return lines_.integer(line.substr(8 * i, 8), "a number of a matrix's header"); };
    header = {field(0), field(1), field(3), std::string(trimmed(line.substr(32, 8)))};
    if (header.name.empty()) lines_.fail("the matrix has no name");
    if (header.columns < 1 || header.rows == 0 || header.type < 1 || header.type > 4)
      lines_.fail(fmt::format("matrix '{}' has {} rows, {} columns and type {}", printable(header.name), header.rows,
                              header.columns, header.type));
    if (line.size() > 40) read_format(trimmed(line.substr(40)), header);
    return true;
  }

  // The columns; into `matrix` unless it is null.
  void read(const Op4Header& header, Mat* matrix) {
    for (;;) {
      const std::vector<long> head = integers(3, "a column, its first row and the number of its words");
      if (head[0] < 1 || head[2] < 0) lines_.fail(fmt::format("column {} with {} words", head[0], head[2]));
      if (head[0] > header.columns) {
        values(header, head[2], head[0], 1, nullptr);
        return;
      }
      if (head[1] > 0)
        values(header, head[2], head[0], head[1], matrix);
      else
        read_strings(header, head[0], head[2], matrix);
    }
  }

 private:
  // "1P,3E23.16".
  void read_format(std::string_view format, Op4Header& header) {
    std::string text = in_lower_case(std::string(format));
    if (const size_t comma = text.find(','); comma != std::string::npos) text.erase(0, comma + 1);
    std::replace(text.begin(), text.end(), 'd', 'e');
    const size_t letter = text.find('e');
    if (letter == std::string::npos) lines_.fail(fmt::format("'{}' is no format of numbers", printable(text)));
    const long a_line = lines_.integer(std::string_view(text).substr(0, letter), "how many numbers a line has");
    const long width =
        lines_.integer(std::string_view(text).substr(letter + 1, text.find('.') - letter - 1), "the width of a number");
    if (a_line < 1 || a_line > 100 || width < 5 || width > 100)
      lines_.fail(fmt::format("'{}' is no format of numbers", printable(text)));
    header.a_line = static_cast<size_t>(a_line);
    header.width = static_cast<size_t>(width);
  }

  std::vector<long> integers(size_t n, const char* what) {
    std::string_view line;
    if (!lines_.next(line)) lines_.fail(fmt::format("{} is expected, not the end of the file", what));
    std::vector<long> found;
    for (const std::string_view field : split_at(line, ' ')) found.push_back(lines_.integer(field, what));
    if (found.size() != n) lines_.fail(fmt::format("{} is expected, but the line has {} numbers", what, found.size()));
    return found;
  }

  void read_strings(const Op4Header& header, long column, long words, Mat* matrix) {
    const bool is_large = header.rows < 0;
    while (words > 0) {
      long length = 0, row = 0;  // of numbers in words
      if (is_large) {
        const std::vector<long> head = integers(2, "the length of a string and its row");
        if (head[0] < 2 || head[0] >= words) lines_.fail("a string of another length than its column has left");
        length = head[0] - 1;
        row = head[1];
        words -= head[0] + 1;
      } else {
        const long packed = integers(1, "the length and the row of a string")[0];
        length = packed / 65536 - 1;
        row = packed % 65536;
        words -= length + 1;
      }
      if (length < 1) lines_.fail("a string of no entry");
      values(header, length / header.words(), column, row, matrix);
    }
  }

  void values(const Op4Header& header, long n, long column, long row, Mat* matrix) {
    const long rows = std::abs(header.rows);
    if (matrix && (row < 1 || row > rows || n > rows || row + n - 1 > rows))
      lines_.fail(fmt::format("{} entries from row {} on, of {} rows", n, row, rows));
    std::string_view line;
    for (long i = 0; i < n; ++i) {
      const size_t at = static_cast<size_t>(i) % header.a_line * header.width;
      if (at == 0 && !lines_.next(line)) lines_.fail("an entry is expected, not the end of the file");
      if (at >= line.size()) lines_.fail("an entry is expected, not the end of the line");
      const double value = lines_.real(line.substr(at, header.width), "an entry");
      if (matrix) (*matrix)(row - 1 + i, column - 1) = value;
    }
  }

  TextLines lines_;
  const std::string& file_;
};

}  // namespace

LabelledMatrix read_op4(const std::string& text, const std::string& file, MatrixRole role, const std::string& name) {
  std::vector<std::string> names;
  Op4Header header;
  for (Op4Reader reader(text, file); reader.next(header);) {
    names.push_back(header.name);
    reader.read(header, nullptr);
  }
  const std::string chosen = chosen_matrix(names, role, name, file);
  Op4Reader reader(text, file);
  while (reader.next(header) && header.name != chosen) reader.read(header, nullptr);
  const long rows = std::abs(header.rows);
  if (header.type > 2) throw InputError(fmt::format("'{}': matrix '{}' is complex", file, printable(chosen)));
  if (rows != header.columns)
    throw InputError(fmt::format("'{}': matrix '{}' is {} x {}: a square matrix is expected", file, printable(chosen),
                                 rows, header.columns));
  refuse_large_matrix(rows, file);
  LabelledMatrix made{Mat::Zero(rows, rows), {}};
  reader.read(header, &made.matrix);
  make_symmetric(made.matrix, file);
  return made;
}

}  // namespace dygita

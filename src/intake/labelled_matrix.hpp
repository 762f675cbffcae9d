// Matrices as other programs write them, with the names of their rows where the format has them.
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// A node or grid point and its component: 1 to 3 translations, 4 to 6 rotations, 0 of a scalar point.
struct MatrixRow {
  long node = 0;
  int component = 0;
  friend auto operator<=>(const MatrixRow&, const MatrixRow&) = default;
};

struct LabelledMatrix {
  Mat matrix;                   // symmetric
  std::vector<MatrixRow> rows;  // increasing; empty: rows are known by their order alone
  bool is_matrix_market = false;
};

enum class MatrixRole { stiffness, mass, damping };
const char* text_of(MatrixRole role);

// The matrix of a file: Nastran's DMIG (.pch, .bdf, .dat, .nas, .dmig) and ASCII OUTPUT4 (.op4), Abaqus' and CalculiX's
// .mtx, CalculiX's .sti, .mas, .dam with the .dof beside it, else Matrix Market. name: of the matrix, where the file
// has several; empty: the only one that begins as those of its role do (K; M; B, C, D). Throws InputError with file and
// line: what is no such file, complex, not symmetric, not finite, given twice, too large.
LabelledMatrix read_matrix(const std::string& file, MatrixRole role, const std::string& name);

// The readers, of a text; file: for messages.
LabelledMatrix read_dmig(const std::string& text, const std::string& file, MatrixRole role, const std::string& name);
LabelledMatrix read_op4(const std::string& text, const std::string& file, MatrixRole role, const std::string& name);
LabelledMatrix read_abaqus_matrix(const std::string& text, const std::string& file, MatrixRole role);
LabelledMatrix read_coordinates(const std::string& text, const std::string& file, const std::string& dofs,
                                const std::string& dof_file);

// For the readers: lines of a text, without what ends them.
class TextLines {
 public:
  TextLines(const std::string& text, const std::string& file) : rest_(text), file_(&file) {}
  bool next(std::string_view& line);
  int number() const { return number_; }
  [[noreturn]] void fail(const std::string& what) const;
  // Whole and real numbers of a field, blanks around it apart; Fortran's exponents D and without a letter.
  long integer(std::string_view field, const char* what) const;
  double real(std::string_view field, const char* what) const;

 private:
  std::string_view rest_;
  const std::string* file_;
  int number_ = 0;
};
std::string_view trimmed(std::string_view text);
std::vector<std::string_view> split_at(std::string_view line, char separator);  // ' ': at any blanks

// For the readers: which of a file's matrices is meant.
std::string chosen_matrix(const std::vector<std::string>& names, MatrixRole role, const std::string& name,
                          const std::string& file);

// For the readers: entries one by one.
class MatrixEntries {
 public:
  enum class Given { one_triangle, both, either };
  void add(const MatrixRow& row, const MatrixRow& column, double value, const TextLines& at);
  void name(const MatrixRow& row, const TextLines& at) { index_of(row, at); }  // it may have no entry
  bool empty() const { return rows_.empty(); }
  LabelledMatrix finish(Given given, const std::string& file) const;

 private:
  int index_of(const MatrixRow& row, const TextLines& at);
  struct Entry {
    int row, column, line;
    double value;
  };
  std::map<MatrixRow, int> rows_;
  std::vector<Entry> entries_;
};

}  // namespace dygita

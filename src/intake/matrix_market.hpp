// Matrices of files.
#pragma once

#include <string>

#include "numerics/types.hpp"

namespace dygita {

// A symmetric matrix of a Matrix Market file, real or integer, an array or by coordinates, one triangle or both;
// digest: of the file's text, in hexadecimal. Throws InputError: a file that is missing or of something else, too many
// rows, a matrix that is not square, symmetric and finite. Source: Boisvert, Pozo, Remington, NISTIR 5935 (1996).
struct MatrixFile {
  Mat matrix;
  std::string digest;
};
MatrixFile read_matrix_market(const std::string& file);

// Of a matrix that is kept dense: some gigabytes. Throws InputError beyond.
inline constexpr long most_matrix_rows = 8000;
void refuse_large_matrix(long rows, const std::string& file);
// Makes it exactly symmetric. Throws InputError where it is not finite, or not symmetric but for rounding.
void make_symmetric(Mat& matrix, const std::string& file);

}  // namespace dygita

// The largest eigenvalue of a symmetric tridiagonal matrix that grows row by row, as Lanczos' iteration makes it: by
// hand, since a library would solve the whole matrix anew for each row.
#pragma once

#include <vector>

namespace dygita {

class TopOfTridiagonal {
 public:
  // A row with its diagonal entry and the one beside it, which the first has no use for.
  void add(double diagonal, double beside);

  // Of the rows so far, to rounding; size of the last entry of its eigenvector of length one, to 1e-6: smaller ones may
  // be shown as zero.
  double value() const { return value_; }
  double last_entry() const { return last_entry_; }

 private:
  std::vector<double> diagonal_, squares_;
  double value_ = 0.0, last_entry_ = 1.0;
};

}  // namespace dygita

// Fields that several ranks have left, each its share in a file of its own, read where they lie.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// Which of the unknowns of an assembled q a rank keeps, in their order.
struct AssembledRuns {
  struct Run {
    long first, n;
    bool operator==(const Run&) const = default;
  };
  long n_all = -1;  // unknowns of the assembled q; -1: it is kept whole
  std::vector<Run> runs{};

  bool is_whole() const { return n_all < 0; }
  bool operator==(const AssembledRuns&) const = default;
  Eigen::Index n_kept() const {
    Eigen::Index n = 0;
    for (const Run& run : runs) n += run.n;
    return n;
  }
  // Are they in their order and within the assembled q?
  bool are_sound() const {
    long end = 0;
    for (const Run& run : runs) {
      if (run.first < end || run.n < 1 || run.n > n_all || run.first > n_all - run.n) return false;
      end = run.first + run.n;
    }
    return true;
  }
  // And so many unknowns in all?
  bool fit(Eigen::Index n) const { return are_sound() && n_kept() == n; }
  // Puts what is kept in its places among all.
  void place(const Vec& kept, Vec& assembled) const {
    long at = 0;
    for (const Run& run : runs) {
      assembled.segment(run.first, run.n) = kept.segment(at, run.n);
      at += run.n;
    }
  }
};

// Where a rank's share lies: q of each increment of each step, one after the other, from `begin` on (bytes).
struct FieldPart {
  std::filesystem::path file;
  std::int64_t begin = 0;
  std::vector<AssembledRuns> runs;  // of each step
};

class FieldParts {
 public:
  // n_increments: of each step. No file is opened before something of it is asked for.
  FieldParts(std::vector<FieldPart> parts, std::vector<size_t> n_increments);
  ~FieldParts();
  FieldParts(const FieldParts&) = delete;
  FieldParts& operator=(const FieldParts&) = delete;

  // The unknowns that are asked for of an increment, in their order, into q; false: a file cannot be read.
  bool read(size_t i_step, size_t increment, const AssembledRuns& asked, Vec& q);

 private:
  struct Place {
    std::int64_t at;
    long n;
    double* to;
  };
  bool get(size_t part, const Place& place);
  void close_all();

  std::vector<FieldPart> parts_;
  std::vector<std::vector<std::int64_t>> start_;  // of each part and step, bytes
  std::vector<int> descriptors_;                  // -1: not open
  int n_open_ = 0;
};

}  // namespace dygita

// The solution of a run is its interface fields: given q = F_hat + k W_hat, every interior is one linear sweep.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
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
  // Are they runs of so many unknowns in all, in their order, within the assembled q?
  bool fit(Eigen::Index n_kept) const {
    long n = 0, end = 0;
    for (const Run& run : runs) {
      if (run.first < end || run.n < 1 || run.n > n_all || run.first > n_all - run.n) return false;
      end = run.first + run.n;
      n += run.n;
    }
    return n_kept == n;
  }
  // Puts what is kept in its places among all.
  void place(const Vec& kept, Vec& assembled) const {
    long at = 0;
    for (const Run& run : runs) {
      assembled.segment(run.first, run.n) = kept.segment(at, run.n);
      at += run.n;
    }
  }
};

// q of every increment of every step (assembled order of the step's exchange; N), for another case to start from. Up to
// a budget they stay in memory, what comes after goes to a file that has no name and vanishes with this object.
class InterfaceFields {
 public:
  // Where the q of an increment lies in a file, bytes, and its unknowns.
  struct Place {
    std::int64_t at = 0;
    Eigen::Index size = 0;
  };

  explicit InterfaceFields(double memory_bytes) : budget_(memory_bytes) {}
  // Fields that an earlier run left in a file: they stay there. `file` is open for reading; one list of places per
  // step.
  InterfaceFields(std::FILE* file, const std::vector<std::vector<Place>>& steps);
  InterfaceFields(const InterfaceFields&) = delete;
  InterfaceFields& operator=(const InterfaceFields&) = delete;

  // Of several ranks each keeps some of the unknowns.
  void begin_step(AssembledRuns runs = {}) {
    steps_.emplace_back();
    runs_.push_back(std::move(runs));
  }
  // The next increment of the step begun last. A file that cannot be written ends the keeping, with a warning.
  void append(const Vec& q);

  // The kept q of an increment if it has `size` unknowns, into q: another case may have other contacts. False: none.
  bool read(size_t i_step, size_t increment, Eigen::Index size, Vec& q) const;

  size_t n_steps() const { return steps_.size(); }
  const AssembledRuns& runs(size_t i_step) const { return runs_.at(i_step); }
  size_t n_increments(size_t i_step) const { return i_step < steps_.size() ? steps_[i_step].size() : 0; }
  // Unknowns of a kept increment.
  Eigen::Index size(size_t i_step, size_t increment) const { return steps_.at(i_step).at(increment).size; }

  double memory_bytes() const { return in_memory_; }
  double file_bytes() const { return static_cast<double>(file_end_); }

 private:
  struct Kept {
    Vec q;                 // empty: in the file
    std::int64_t at = -1;  // where in the file, bytes; -1: in memory
    Eigen::Index size = 0;
  };
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool write(const Vec& q);

  double budget_, in_memory_ = 0.0;
  std::vector<std::vector<Kept>> steps_;
  std::vector<AssembledRuns> runs_;  // of each step
  std::unique_ptr<std::FILE, Close> file_;
  std::int64_t file_end_ = 0;
  bool has_failed_ = false;
};

// Collective. On the first rank the fields of which each has some, as whole ones; on the others none (null).
std::shared_ptr<const InterfaceFields> whole_on_first(const std::shared_ptr<const InterfaceFields>& kept,
                                                      double memory_bytes);

}  // namespace dygita

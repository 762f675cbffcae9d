// The solution of a run is its interface fields: given q = F_hat + k W_hat, every interior is one linear sweep.
#pragma once

#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

#include "interfaces/field_parts.hpp"

namespace dygita {

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
  // Fields that several ranks left, of which each step's increments have so many unknowns each.
  InterfaceFields(std::vector<FieldPart> parts, const std::vector<std::vector<Eigen::Index>>& sizes);
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
  // Of fields that are kept whole: the unknowns that are asked for alone, if there are as many in all.
  bool read_some(size_t i_step, size_t increment, const AssembledRuns& asked, Vec& q) const;

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
  std::unique_ptr<FieldParts> parts_;  // then nothing else is kept
  bool has_failed_ = false;
};

// Fields of another case or run that the iteration of the first `n_steps` steps starts from; null: none.
struct StartFields {
  StartFields(const InterfaceFields* of = nullptr, size_t n = std::numeric_limits<size_t>::max())
      : fields(of), n_steps(n) {}
  const InterfaceFields* of_step(size_t i_step) const { return i_step < n_steps ? fields : nullptr; }

  const InterfaceFields* fields;
  size_t n_steps;
};

}  // namespace dygita

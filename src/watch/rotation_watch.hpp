// Watches a run for parts that turn or stretch by more than a theory of small displacements knows: each rank its own
// pieces.
#pragma once

#include "result/result.hpp"
#include "step/observer.hpp"

namespace dygita {

class RotationWatch {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // Collective. Puts together what all ranks have seen.
  void settle();
  // Warnings with figures, place and time, and the largest angle. On rank 0, once it has settled.
  void finish(const Problem& problem, RunResult& result) const;

 private:
  // Times are indices in moments_.
  struct Finding {
    double value = 0.0;         // rad, or a strain
    Vec3 place = Vec3::Zero();  // m
    int at = -1, first = -1;    // when it was largest, and when it first was too much
  };
  // Of a piece or a part.
  struct Findings {
    Finding turned, strained;
  };
  static constexpr int n_numbers = 6;  // of a finding
  static void write(const Finding& finding, double* to);
  static void take(const double* from, Finding& finding);
  std::string told(const Substructure& part, const Finding& finding, const std::string& what) const;

  CutPtr cut_;
  std::vector<double> smallest_cell_;  // m, of each piece here
  std::vector<Findings> pieces_;       // of all pieces; those here are filled in
  std::vector<Findings> parts_;
  std::vector<std::string> moments_;  // looked at so far, the same on all ranks
};

}  // namespace dygita

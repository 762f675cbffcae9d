// Sums over the interface unknowns: each piece's share is added up by itself, and the shares piece by piece, so that
// one process and any number of ranks have the same bits.
#pragma once

#include <functional>
#include <vector>

#include "step/step_model.hpp"

namespace dygita {

class InterfaceSums {
 public:
  // Of a field that belongs to one piece.
  explicit InterfaceSums(Eigen::Index length);
  // Of the near unknowns of a step; or of the own ones of n_fields fields, one after the other (a window).
  explicit InterfaceSums(const StepModel& model, int n_fields = 1);

  // Adds what a run of unknowns [first, first + n) has to the sums of its piece.
  using Share = std::function<void(Eigen::Index first, Eigen::Index n, double* sums)>;
  // Collective. share: called for the unknowns of every piece that is here, of several pieces at once. Returns n_sums
  // sums over all pieces, which are valid until the next call.
  const std::vector<double>& add(int n_sums, const Share& share);

  // Sums that somebody needs at a time when others are taken.
  struct ToCome {
    int n = 0;
    Share share;
  };

 private:
  void find_starts();
  struct Run {
    int piece;
    Eigen::Index first, n;
  };
  std::vector<Run> runs_;
  std::vector<size_t> starts_;  // in runs_, of each piece that has any, and the end
  Eigen::Index n_unknowns_ = 0;
  int n_pieces_ = 1;
  bool is_shared_out_ = false;
  ranks::Segments of_pieces_;
  std::vector<double> shares_, sums_;
};

}  // namespace dygita

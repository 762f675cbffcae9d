// The axis of histories: time, with the static steps, in which time does not advance, set apart as shaded ranges.
#pragma once

#include <vector>

#include "drawing/svg_plot.hpp"
#include "files/run_folder.hpp"
#include "signal/frequency_range.hpp"

namespace dygita {

class TimeAxis {
 public:
  // The steps of a record that were begun.
  explicit TimeAxis(const Json& steps);

  // Place of each row of a table that has time and step.
  std::vector<double> places(const Table& table) const;
  // The same axis for charts of one value per increment: increments of all steps one after the other.
  PlotAxis axis() const;
  // The increments of convergence.csv that have not converged: shaded by what follows.
  void note_missed(const Table& convergence);
  // Static steps and what has not converged.
  void shade(Plot& plot) const;
  double record() const { return dynamic_; }  // s, of the dynamic steps
  // Frequencies that a spectrum of the run can be judged at.
  FrequencyRange judged() const { return reliable_range(dynamic_, dt_); }

  static PlotAxis increments();

 private:
  struct Range {
    bool is_static;
    int increments;
    double start, width;  // place
    double time;          // s, at the start, of the run
  };
  std::vector<Range> ranges_;
  std::vector<PlotSpan> spans_, missed_;
  double dynamic_ = 0.0, dt_ = 0.0;  // s; the smallest dt
};

// Shaded ranges of the static steps among increments 1, 2, ... of all steps; none if all steps are dynamic.
std::vector<PlotSpan> static_increments(const Json& steps);

}  // namespace dygita

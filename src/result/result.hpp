// What was asked for, as tables; what a run was, as figures. Every reader (deck, CSV, run record) takes these.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "solution/interface_fields.hpp"

namespace dygita {

// Rows follow the steps in order. Column 0 is `time [s]` (`frequency [Hz]` for spectra).
struct Table {
  std::vector<std::string> names;              // "time", "normal", ... without unit
  std::vector<std::string> units;              // "s", "N", "" where none
  std::vector<std::vector<double>> columns;    // one vector a name, equal lengths
  std::vector<int> step;                       // problem's step index of each row; empty for spectra

  int n_rows() const { return columns.empty() ? 0 : static_cast<int>(columns.front().size()); }
  const std::vector<double>& column(const std::string& name) const;  // CHECKs that it exists
};

struct StepSummary {
  std::string name;
  bool is_static = false;
  int increments = 0;
  int increments_not_converged = 0;
  long iterations = 0;
  double worst_indicator = 0.0;   // largest accepted
  double seconds = 0.0;
};

// What became of a bolt: an interface that a step shortens or preloads. Forces through the modelled interface, N, tension positive.
struct BoltSummary {
  std::string name;                       // of the interface
  double area = 0.0;                      // m^2, of the modelled interface
  std::vector<double> after_static;       // N, at the end of each static step, in the problem's order of static steps
  std::optional<double> target;           // N, load.preload's last one
  std::optional<double> hand;             // N, by the hand formula at the shortening found
  double shortening = 0.0;                // m, at the end
  double lowest = 0.0, highest = 0.0;     // N, during the dynamic steps; the force before them where there are none
  double last = 0.0;                      // N, at the end of the run
  double plastic_opening = 0.0;           // m, largest at the end
};

struct RunResult {
  std::vector<BoltSummary> bolts;
  std::map<const Output*, Table> tables;       // history, resultant, srs, joint, energy
  std::map<const Output*, Table> bands;        // of each srs, dB: frequency, iteration, time_step, mesh, all
  Table convergence;                           // time, step, iterations, indicator, converged (1 or 0)
  std::vector<StepSummary> steps;
  std::shared_ptr<const InterfaceFields> interface_fields;  // what start_from takes; null: the solver keeps none
  bool converged = true;
  bool interrupted = false;
  long iterations = 0;                         // all increments of all steps
  double mean_iterations = 0.0;
  long n_dofs = 0, n_interface_unknowns = 0;
  std::vector<int> pieces;                     // into which each substructure was cut; empty: the solver cuts none
  std::map<std::string, double> seconds;       // "assemble", "factor", "forward", "iterate", "backward", "output", ...
  std::map<std::string, double> figures;       // "largest energy imbalance [%]", "largest penetration [m]", ...
};

}  // namespace dygita

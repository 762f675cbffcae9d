// What was asked for, as tables; what a run was, as figures. Every reader (deck, CSV, run record) takes these.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/bolt_formula.hpp"
#include "model/model.hpp"
#include "result/figures.hpp"
#include "result/frame.hpp"

namespace dygita {

// Rows follow the steps in order. Column 0 is `time [s]` (`frequency [Hz]` for spectra).
struct Table {
  std::vector<std::string> names;            // "time", "normal", ... without unit
  std::vector<std::string> units;            // "s", "N", "" where none
  std::vector<std::vector<double>> columns;  // one vector a name, equal lengths
  std::vector<int> step;                     // problem's step index of each row; empty for spectra

  int n_rows() const { return columns.empty() ? 0 : static_cast<int>(columns.front().size()); }
  const std::vector<double>& column(const std::string& name) const;  // CHECKs that it exists
};

struct StepSummary {
  std::string name;
  bool is_static = false;
  int increments = 0;
  int increments_not_converged = 0;
  long iterations = 0;
  double worst_indicator = 0.0;  // largest accepted
  double seconds = 0.0;
};

// What VDI 2230's hand formula says of a bolt (manual, eq. B3-B6).
struct BoltByHand {
  BoltResilience resilience;  // of the whole bolt
  double share = 1.0;         // of it that the model has
  double shortening = 0.0;    // m, for the force asked for, or that its tightening gave
};

// What became of a bolt: an interface that a step shortens or preloads. Forces through the modelled interface, N,
// tension positive.
struct BoltSummary {
  std::string name;                    // of the interface
  double area = 0.0;                   // m^2, of the modelled interface
  std::vector<double> after_static;    // N, at the end of each static step, in the problem's order of static steps
  std::optional<double> target;        // N, load.preload's last one
  std::optional<double> hand;          // N, by the hand formula at the shortening that its last tightening made
  double shortening = 0.0;             // m, at the end
  double lowest = 0.0, highest = 0.0;  // N, during the dynamic steps; the force before them where there are none
  double last = 0.0;                   // N, at the end of the run
  double plastic_opening = 0.0;        // m, largest at the end
  double tightened = 0.0;              // N, at the end of the last step that shortened or preloaded it
  std::optional<BoltByHand> formula;   // where the deck gives the bolt's dimensions

  // Of what the bolt's own tightening gave, what is gone at the end; zero where that is nothing.
  double loss() const { return tightened != 0.0 ? 1.0 - last / tightened : 0.0; }
};

struct Scenes;

// A joint as a system model takes it: what output.loop makes of force against displacement (manual, eq. C1-C7).
struct LoopSummary {
  Table cycles;    // one row a closed cycle
  Table backbone;  // force against displacement of first loading, and the sliders that have it
  double exponent =
      0.0;  // of loss against force amplitude, least squares; nan where two cycles with a loss are not there
  double displacement_exponent = 0.0;        // the same against displacement amplitude
  double stiffness = 0.0;                    // N/m, of the first rows of the backbone; nan where there is none
  double secant = 0.0, largest_force = 0.0;  // N/m and N, at its end
};

// Mass and stiffness of an assembly on its interface coordinates and modes (manual, eq. D1-D6). Rows: those of the
// faces in the order of the output's `on`, then the modes.
struct Superelement {
  struct Row {
    int on = -1;        // index in the output's `on`; -1: a mode
    int node = -1;      // of that part's mesh; -1: a motion of the whole face
    int direction = 0;  // 0 1 2: translation along x y z, 3 4 5: rotation about them; of a mode its number from 0
    Vec3 place = Vec3::Zero();  // m, of the node, or the point about which the face turns
  };
  std::vector<Row> rows;
  Mat mass, stiffness, damping;  // n_rows x n_rows; damping empty where no material has any
  Vec fixed_frequencies;         // Hz, of the modes: with the interface coordinates held
  int n_residual = 0;            // how many of them, the last ones, stand for those that were left out
  Vec frequencies;               // Hz, of the superelement itself, increasing
  Vec damping_ratios;            // of each, of critical damping
  double valid_to = 0.0;         // Hz
  double mass_of_parts = 0.0;    // kg
  int n_unknowns = 0;            // of the assembly
  std::string step;
  bool is_converged = true;                  // the step's last increment
  int n_tied = 0, n_normal = 0, n_open = 0;  // contact points: tied, tied along their normal, open
  int n_damped = 0;                          // points of interfaces that are in the damping matrix
};

struct RunResult {
  std::vector<BoltSummary> bolts;
  std::map<const Output*, LoopSummary> loops;
  std::map<const Output*, Superelement> superelements;
  std::map<const Output*, Table> tables;               // of all outputs but vtk
  std::map<const Output*, std::vector<Frame>> fields;  // srs_field: a frame a frequency
  std::map<const Output*, Table> bands;                // of each srs, dB: frequency, iteration, time_step, mesh, all
  Table convergence;                                   // time, step, iterations, indicator, converged (1 or 0)
  std::vector<StepSummary> steps;
  std::shared_ptr<const InterfaceFields> interface_fields;  // what start_from takes; null: the solver keeps none
  bool converged = true;
  bool interrupted = false;
  long iterations = 0;  // all increments of all steps
  double mean_iterations = 0.0;
  long n_dofs = 0, n_interface_unknowns = 0;
  std::vector<int> pieces;                // into which each substructure was cut; empty: the solver cuts none
  std::map<std::string, double> seconds;  // "assemble", "factor", "forward", "iterate", "backward", "output", ...
  Figures figures;
  std::shared_ptr<const Scenes> scenes;  // what the report draws; null: nobody recorded it
};

}  // namespace dygita

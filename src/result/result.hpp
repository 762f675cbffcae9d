// What was asked for, as tables; what a run was, as figures. Every reader (deck, CSV, run record) takes these.
#pragma once

#include <algorithm>
#include <any>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/bolt_formula.hpp"
#include "model/output.hpp"
#include "result/contact_summary.hpp"
#include "result/figures.hpp"
#include "result/frame.hpp"

namespace dygita {

// Rows follow the steps in order. Column 0 is `time [s]` (`frequency [Hz]` for spectra).
struct Table {
  std::vector<std::string> names;            // "time", "normal", ... without unit
  std::vector<std::string> units;            // "s", "N", "" where none
  std::vector<std::vector<double>> columns;  // one vector a name, equal lengths
  std::vector<int> step;                     // problem's step index of each row; empty for spectra
  // 1 or 0, of each row: have all increments that it is made of converged? Empty: nobody tells.
  std::vector<double> converged = {};

  int n_rows() const { return columns.empty() ? 0 : static_cast<int>(columns.front().size()); }
  bool has_column(const std::string& name) const;                    // `converged` too
  const std::vector<double>& column(const std::string& name) const;  // CHECKs that it exists
  void mark(bool has_converged);                                     // all rows, where they do not tell themselves

  // add() appends a row; where memory ends within it the table is what it was, and that is thrown on.
  template <class Add>
  void whole_or_none(Add&& add) {
    const auto n = static_cast<size_t>(n_rows());
    try {
      add();
    } catch (...) {
      cut_to(n);
      throw;
    }
  }

 private:
  void cut_to(size_t n_rows);
};

// With these columns, and no row.
Table empty_table(const Columns& columns);

struct StepSummary {
  std::string name;
  bool is_static = false;
  int increments = 0;
  int increments_not_converged = 0;
  long iterations = 0;
  double worst_indicator = 0.0;  // largest accepted
  double seconds = 0.0;
  std::vector<Missed> missed;               // increments that did not converge, where the solver reports them
  std::vector<std::string> explicit_parts;  // substructures integrated explicitly
  int substeps = 1;                         // increments in each time step of the deck
  double stable_step = 0.0;                 // s, longest increment that they are stable with; 0: there are none
  std::vector<std::string> diagonal_parts;  // of those, with cells of order two, whose mass is a diagonal there
  std::vector<std::string> tuned_parts;     // of those, whose mass is tuned
  std::vector<std::pair<std::string, double>> phases;  // of those, rad, by which lumped or tuned mass was chosen
};

// What VDI 2230's hand formula says of a bolt (manual, eq. B3-B6).
struct BoltByHand {
  BoltResilience resilience;  // of the whole bolt
  double share = 1.0;         // of it that the model has
  double shortening = 0.0;    // m, for the force asked for, or that its tightening gave
};

// A bolt against what it may carry, and the contacts that it clamps (manual, eq. B8-B10); N, of the modelled share.
struct BoltMargins {
  double proof_load = 0.0, safety = 1.0;
  double largest = 0.0;               // force, at any time
  std::optional<double> slip;         // the least margin in time, where it clamps contacts that carry shear
  std::optional<double> clamp;        // on that of its contacts which lost the most, when all bolts were tight
  std::optional<double> least_clamp;  // the least on it since then

  double against_proof(double tightened) const;  // tightened: by its own tightening
  // None: there are no contacts, or they lose nothing.
  std::optional<double> against_separation() const;
};

// What became of a bolt: an interface that a step shortens or preloads. Forces through the modelled interface, N,
// tension positive.
struct BoltSummary {
  std::string name;                     // of the interface
  double area = 0.0;                    // m^2, of the modelled interface
  std::vector<double> after_static;     // N, at the end of each static step, in the problem's order of static steps
  std::optional<double> target;         // N, load.preload's last one
  std::optional<double> hand;           // N, by the hand formula at the shortening that its last tightening made
  double shortening = 0.0;              // m, at the end
  double lowest = 0.0, highest = 0.0;   // N, during the dynamic steps; the force before them where there are none
  double last = 0.0;                    // N, at the end of the run
  double plastic_opening = 0.0;         // m, largest at the end
  double tightened = 0.0;               // N, at the end of the last step that shortened or preloaded it
  double yielded = 0.0;                 // m, mean plastic opening since then
  double swing = 0.0;                   // N, half of what the force moves by in the last tenth of the motion
  std::optional<double> stiffness;      // N/m, force gained per shortening in the last increment of its tightening
  std::optional<double> before_motion;  // N, where the first dynamic step began, if it was tightened by then
  double yielded_before = 0.0;          // m, `yielded` there
  std::optional<BoltByHand> formula;    // where the deck gives the bolt's dimensions
  std::optional<BoltMargins> margins;   // where it gives what the bolt may carry

  // Of what the bolt's own tightening gave, the share that is gone at the end; none where the bolt was hardly
  // tightened: a tenth of the largest force through it, which then is the load's and not the bolt's.
  std::optional<double> loss() const;
  double largest() const;  // N, modulus: at the end of static steps, in the dynamic ones, at the end
  // Of it, what yielding of the bolt itself took: the plastic opening released as much as loosening the nut by it
  // (manual, eq. B7). The rest is the joint's.
  std::optional<double> loss_by_yield() const {
    if (!stiffness || !loss()) return std::nullopt;
    return std::min(1.0, *stiffness * yielded / tightened);
  }
  // Of the rest, what was gone when the motion began: other bolts' tightening, static loads, slip under them.
  std::optional<double> loss_before_motion() const {
    if (!stiffness || !before_motion || !loss()) return std::nullopt;
    return 1.0 - *before_motion / tightened - std::min(1.0, *stiffness * yielded_before / tightened);
  }
};

// The largest von Mises stress that a watched substructure has met, or failure index where its material has directions
// (stress_recorder.hpp).
struct PartStress {
  int part = -1;              // index in problem.substructures
  bool is_index = false;      // a failure index, else a von Mises stress
  double largest = 0.0;       // Pa or 1, at a node
  double allowed = 0.0;       // the yield of its material, or 1
  double time = 0.0;          // s, of the run
  int step = -1;              // index in problem.steps
  Vec3 place = Vec3::Zero();  // m, of the node, undeformed
  double above = 0.0;         // share of the volume beyond that at once, at most
  int ply = -1;               // where the index was met, from 0; -1: no layup
  std::string mode;           // of failure, where the criterion tells; empty: none
  double margin() const { return allowed / largest - 1.0; }
};

struct Scenes;

// What an output reports beside its table.
struct Findings {
  std::vector<std::pair<std::string, Table>> parts;  // further tables: <name>_<part>.csv, and result[output].<part>
  std::map<std::string, double> values;              // result[output].<value>
  Table band;                 // dB, what iteration, time step and mesh leave on a spectrum (manual, eq. Q7-Q8)
  std::vector<Frame> frames;  // over frequencies: <name>.pvd
  // Further files, made when they are written: what follows on the output's name, and the text.
  std::function<std::vector<std::pair<std::string, std::string>>()> files;
  std::map<std::string, double> figures;     // of the run record, by label with unit
  std::vector<std::string> lines, warnings;  // for the screen
  std::any model;                            // for who knows its type: a SuperelementPtr
};

struct RunResult {
  std::vector<BoltSummary> bolts;
  std::vector<ContactSummary> contacts;
  std::map<const Output*, Table> tables;  // of all outputs but vtk
  std::map<const Output*, Findings> findings;
  Table convergence;  // time, step, iterations, indicator, converged (1 or 0)
  std::vector<StepSummary> steps;
  std::shared_ptr<const InterfaceFields> interface_fields;  // what start_from takes; null: the solver keeps none
  std::vector<std::string> warnings;                        // of who watched the run
  std::vector<int> overloaded_steps;                        // static steps in which something slides or comes off
  bool converged = true;
  bool interrupted = false;       // by the user, or by
  std::exception_ptr stopped_by;  // an error; null: none
  long iterations = 0;            // all increments of all steps
  double mean_iterations = 0.0;
  long n_dofs = 0, n_interface_unknowns = 0;
  std::vector<int> pieces;                // into which each substructure was cut; empty: the solver cuts none
  Sharing sharing;                        // among ranks
  std::map<std::string, double> seconds;  // "assemble", "factor", "forward", "iterate", "backward", "output", ...
  Figures figures;
  std::shared_ptr<const Scenes> scenes;  // what the report draws; null: nobody recorded it
  std::vector<PartStress> stresses;      // of the substructures whose material has a yield or strengths, in their order
  std::vector<FreeStep> free;            // of the steps

  const Findings& findings_of(const Output& output) const;  // empty where it told nothing
};

}  // namespace dygita

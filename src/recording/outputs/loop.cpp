// output.loop: force against displacement of a joint, and what a system model takes of it (manual, eq. C1-C7).
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/loop_recorder.hpp"
#include "recording/output_table.hpp"
#include "reduction/loop_cycles.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

// "steps 'load' to 'back'".
std::string steps_text(const Problem& problem, const std::pair<int, int>& range) {
  const std::vector<StepPtr>& steps = problem.steps;
  if (range.second - range.first == 1) return "step '" + steps[range.first]->name + "'";
  return "steps '" + steps[range.first]->name + "' to '" + steps[range.second - 1]->name + "'";
}

std::string line_of(const std::string& name, const LoopSummary& loop, double resolution, const std::string& where) {
  std::string line = fmt::format("loop '{}': ", name);
  if (loop.range <= resolution)
    return line +
           fmt::format("nothing moves in {}: the displacement stays within {:.2g} m, below the tolerance of {:.2g} m",
                       where, loop.range, resolution);
  const int n = loop.cycles.n_rows();
  if (n == 0) {
    line += "no closed cycle in " + where;
  } else {
    const std::vector<double>& force = loop.cycles.column("force_amplitude");
    const auto [low, high] = std::minmax_element(force.begin(), force.end());
    line += fmt::format("{} cycle{} of {:.4g}{} N", n, n > 1 ? "s" : "", *low,
                        n > 1 ? fmt::format(" to {:.4g}", *high) : "");
    if (std::isfinite(loop.exponent) && loop.n_gaining == 0)
      line += fmt::format(", loss grows with the force to the power {:.2f}, with the displacement to the power {:.2f}",
                          loop.exponent, loop.displacement_exponent);
  }
  if (std::isfinite(loop.stiffness) && std::isfinite(loop.secant))
    line += fmt::format("; stiffness {:.4g} N/m at first, {:.4g} N/m at {:.4g} N", loop.stiffness, loop.secant,
                        loop.largest_force);
  return line;
}

// What makes a loop doubtful.
std::vector<std::string> doubts_of(const std::string& name, const LoopSummary& loop) {
  std::vector<std::string> doubts;
  if (loop.n_gaining > 0)
    doubts.push_back(
        fmt::format("loop '{}': {} of its {} cycles gain{} energy, which a joint cannot: inertia of the parts (a "
                    "dynamic step), or a load between the two places; ignore their loss factors",
                    name, loop.n_gaining, loop.cycles.n_rows(), loop.n_gaining == 1 ? "s" : ""));
  if (loop.energy_error > limit::loop_energy_error)
    doubts.push_back(
        fmt::format("loop '{}': the tolerance leaves up to {:.2g} % error in the loss of a cycle: use a tighter "
                    "tolerance (static_tolerance of solver.latin)",
                    name, 100.0 * loop.energy_error));
  return doubts;
}

// What a deck reads.
void give(const LoopSummary& loop, Findings& findings) {
  findings.parts = {{"cycles", loop.cycles}, {"backbone", loop.backbone}};
  findings.values = {{"exponent", loop.exponent},
                     {"displacement_exponent", loop.displacement_exponent},
                     {"stiffness", loop.stiffness},
                     {"secant", loop.secant},
                     {"not_converged", loop.not_converged}};
}

class LoopOutput final : public Output {
 public:
  explicit LoopOutput(const ModelArguments& a)
      : Output(a),
        request_{a.targets("on"), a.unit_vector("direction"), a.places("between"), a.step("after"), a.steps("steps")} {}

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, request_.on, [](const Target& target) {
      return place_of(target) ? "output.loop takes interfaces or supports; faces go to 'between'" : "";
    });
    has_two_sides(problem);
    if (request_.between.size() == 2) sides_are_in_order(problem);
    check::names_are_free(problem, *this, {"_cycles", "_backbone"});
  }

  Columns columns() const override { return {{"time", "s"}, {"displacement", "m"}, {"force", "N"}}; }

  Notes record(const Table&, const Findings& findings) const override {
    Notes notes;
    note_targets(request_.on, notes);
    note_direction(request_.direction, notes);
    if (const auto missed = findings.values.find("not_converged"); missed != findings.values.end())
      notes.push_back({"increments_not_converged", static_cast<int>(missed->second)});
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"displacement", StudyFigure::Of::largest}, {"force", StudyFigure::Of::largest}};
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<LoopRecorder>(columns(), problem, request_);
  }

  void conclude(const RunEnd& end, Table& table, Findings& findings) const override {
    const auto* trace = std::any_cast<LoopTrace>(&findings.model);
    if (table.n_rows() == 0 || !trace) return;
    const auto [begin, last] = request_.range(end.problem);
    int first = 0, n = 0, missed = 0;
    for (int i = 0; i < table.n_rows(); ++i) {
      if (table.step[i] < begin) first = i;
      if (table.step[i] < last) n = i + 1;
      missed += table.step[i] >= begin && table.step[i] < last && !trace->converged[i];
    }
    cut(table, n);
    const bool is_static = begin < static_cast<int>(end.problem.steps.size()) && end.problem.steps[begin]->is_static;
    LoopRows rows{{trace->converged.begin(), trace->converged.begin() + n},
                  {trace->balance.begin(), trace->balance.begin() + n},
                  std::max(1e-5, is_static ? end.static_errors.iteration : end.errors.iteration),
                  10.0 * tolerance_of(end.problem, is_static) * trace->moved};
    LoopSummary loop = summarise_loop(table, first, rows);
    loop.not_converged = missed;
    give(loop, findings);
    const auto note = [&](const char* what, double value) {
      if (std::isfinite(value) && missed == 0) findings.figures["loop '" + name + "', " + what] = value;
    };
    note("exponent of the loss over the force", loop.exponent);
    note("exponent of the loss over the displacement", loop.displacement_exponent);
    note("first stiffness [N/m]", loop.stiffness);
    const std::string where = steps_text(end.problem, {begin, last});
    findings.lines = {line_of(name, loop, rows.resolution, where)};
    if (missed > 0)
      findings.lines[0] +=
          fmt::format("; NOT TO BE USED: {} of {} increments have not converged", missed, n - 1 - first);
    findings.warnings = doubts_of(name, loop);
  }

  void hollow(const Table& table, Findings& findings) const override {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    LoopSummary loop = summarise_loop(table, 0);
    for (Table* part : {&loop.cycles, &loop.backbone}) {
      for (std::vector<double>& column : part->columns) column.assign(1, not_known);
      part->step.assign(1, 0);
    }
    loop.exponent = loop.displacement_exponent = loop.stiffness = loop.secant = loop.not_converged = not_known;
    give(loop, findings);
  }

 private:
  // The force is that on side 1, or on the ground, and its displacement must be of the same two.
  void has_two_sides(const Problem& problem) const {
    const std::string who = known_as();
    size_t n_supports = 0;
    bool needs_between = false;
    for (const Target& target : request_.on) {
      n_supports += std::holds_alternative<SupportPtr>(target);
      needs_between = needs_between || (std::holds_alternative<SupportPtr>(target) && !is_wall(target));
    }
    if (n_supports > 0 && n_supports < request_.on.size())
      check::fail(problem, origin, who + " is on interfaces and supports",
                  "the force is either that of interfaces or that on supports: use two loops");
    if (needs_between && request_.between.empty())
      check::fail(problem, origin, who + " is on a support that does not slide, and has no 'between'",
                  "as in between = block:face \"xmax\"");
    if (request_.between.size() > 2)
      check::fail(problem, origin,
                  fmt::format("{}: 'between' takes one or two places, got {}", who, request_.between.size()));
    for (const FaceOrRegion& place : request_.between) check::place_exists(problem, origin, who + " is between", place);
    steps_follow(problem);
  }

  // Of the displacements in steps of a kind.
  static double tolerance_of(const Problem& problem, bool is_static) {
    if (problem.monolithic) return problem.monolithic->tolerance;
    if (problem.explicit_dynamics && !is_static) return 0.0;
    return is_static ? problem.solver.static_tolerance : problem.solver.tolerance;
  }

  static void cut(Table& table, int n) {
    for (std::vector<double>& column : table.columns) column.resize(n);
    table.step.resize(n);
    table.converged.resize(n);
  }

  void steps_follow(const Problem& problem) const {
    const std::string who = known_as();
    if (request_.after) {
      check::listed(problem, who + " begins after step", *request_.after, problem.steps, "steps");
      if (request_.after == problem.steps.back())
        check::fail(problem, origin, who + " begins after '" + request_.after->name + "', the last step");
    }
    for (size_t i = 0; i < request_.steps.size(); ++i) {
      const Step& step = *request_.steps[i];
      check::listed(problem, who + " is closed in step", step, problem.steps, "steps");
      const int at = index_of(problem.steps, &step);
      if (i > 0 && at != index_of(problem.steps, request_.steps[i - 1].get()) + 1)
        check::fail(problem, origin,
                    fmt::format("{}: step '{}' does not follow on '{}'", who, step.name, request_.steps[i - 1]->name),
                    "'steps' must be consecutive steps of the problem");
      if (request_.after && at <= index_of(problem.steps, request_.after.get()))
        check::fail(problem, origin,
                    fmt::format("{}: step '{}' is not after '{}'", who, step.name, request_.after->name));
    }
  }

  void sides_are_in_order(const Problem& problem) const {
    const auto& [first, second] = std::tie(request_.between[0], request_.between[1]);
    for (const Target& target : request_.on) {
      const auto* interface = std::get_if<InterfacePtr>(&target);
      if (!interface || (*interface)->side_1.part == (*interface)->side_2.part) continue;
      if (&part_of(first) == (*interface)->side_2.part.get() && &part_of(second) == (*interface)->side_1.part.get())
        check::fail(problem, origin,
                    fmt::format("{}: 'between' is the other way round than that of {}: write {} first", known_as(),
                                describe(**interface), label_of(second)),
                    "the displacement is of the second place against the first, the force acts on side 1");
    }
  }

  LoopRequest request_;
};

}  // namespace

namespace outputs {
OutputEntry loop() { return {"loop", new_output<LoopOutput>, {Display::As::loop, "", 0}}; }
}  // namespace outputs

}  // namespace dygita

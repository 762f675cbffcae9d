// output.loop: force against displacement of a joint, and what a system model takes of it (manual, eq. C1-C7).
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "model/check.hpp"
#include "result/loop_cycles.hpp"
#include "result/output_table.hpp"
#include "result/recorder.hpp"
#include "result/surface_sums.hpp"
#include "result/weighted_nodes.hpp"

namespace dygita {

namespace {

struct LoopRequest {
  std::vector<Target> on;             // interfaces, or supports
  Vec3 direction;                     // unit
  std::vector<FaceOrRegion> between;  // one (against the ground) or two; empty: both sides of what it is on
  StepPtr after;                      // none: from the start

  bool is_of_supports() const { return std::holds_alternative<SupportPtr>(on.front()); }
};

class LoopRecorder : public TableRecorder {
 public:
  LoopRecorder(const Columns& columns, const Problem& problem, const LoopRequest& request)
      : TableRecorder(columns), problem_(problem), request_(request) {
    for (const FaceOrRegion& place : request.between) between_.push_back(weighted_nodes(problem, place));
  }

  void begin_step(const Instant& instant) override {
    before_ = displacement(instant);
    if (instant.i_step == 0) add_row(instant, instant.time(), {before_, 0.0});
  }

  // The force is a mean over a time step; so is the displacement then.
  void accept(const Instant& instant) override {
    const double now = displacement(instant),
                 force = resultant(instant, problem_, request_.on).force.dot(request_.direction);
    add_row(instant, mean_time(instant),
            {instant.is_static() ? now : 0.5 * (before_ + now), request_.is_of_supports() ? -force : force});
    before_ = now;
  }

 private:
  // Of side 2 against side 1; the ground is side 1 of a support.
  double displacement(const Instant& instant) const {
    if (!between_.empty()) {
      Vec3 moved = mean_over(between_.back(), instant.displacement(between_.back().part));
      if (between_.size() > 1) moved -= mean_over(between_.front(), instant.displacement(between_.front().part));
      return moved.dot(request_.direction);
    }
    double sum = 0.0, area = 0.0;
    for (const int s : surfaces_of(instant, request_.on)) {
      const Surface& surface = (*instant.model.surfaces)[s];
      const Points u_1 = instant.displacement(surface.part_1);
      const Points u_2 = surface.part_2 >= 0 ? instant.displacement(surface.part_2) : Points();
      for (int i = 0; i < surface.n_points(); ++i) {
        Vec3 jump = -u_1.col(surface.facing.nodes_1[i]);
        if (surface.part_2 >= 0) jump += u_2.col(surface.facing.nodes_2[i]);
        sum += surface.facing.areas[i] * jump.dot(request_.direction);
        area += surface.facing.areas[i];
      }
    }
    // A wall is side 2 of its surface, and side 1 here.
    return (request_.is_of_supports() ? -sum : sum) / area;
  }

  const Problem& problem_;
  const LoopRequest& request_;
  std::vector<WeightedNodes> between_;
  double before_ = 0.0;
};

std::string line_of(const std::string& name, const LoopSummary& loop) {
  std::string line = fmt::format("loop '{}': ", name);
  const int n = loop.cycles.n_rows();
  if (n == 0) {
    line += "no closed cycle";
  } else {
    const std::vector<double>& force = loop.cycles.column("force_amplitude");
    const auto [low, high] = std::minmax_element(force.begin(), force.end());
    line += fmt::format("{} cycle{} of {:.4g}{} N", n, n > 1 ? "s" : "", *low,
                        n > 1 ? fmt::format(" to {:.4g}", *high) : "");
    if (std::isfinite(loop.exponent))
      line += fmt::format(", loss grows with the force to the power {:.2f}, with the displacement to the power {:.2f}",
                          loop.exponent, loop.displacement_exponent);
  }
  if (std::isfinite(loop.stiffness))
    line += fmt::format("; stiffness {:.4g} N/m at first, {:.4g} N/m at {:.4g} N", loop.stiffness, loop.secant,
                        loop.largest_force);
  return line;
}

// What a deck reads.
void give(const LoopSummary& loop, Findings& findings) {
  findings.parts = {{"cycles", loop.cycles}, {"backbone", loop.backbone}};
  findings.values = {{"exponent", loop.exponent},
                     {"displacement_exponent", loop.displacement_exponent},
                     {"stiffness", loop.stiffness},
                     {"secant", loop.secant}};
}

class LoopOutput final : public Output {
 public:
  explicit LoopOutput(const ModelArguments& a)
      : Output(a), request_{a.targets("on"), a.unit_vector("direction"), a.places("between"), a.step("after")} {}

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, request_.on, [](const Target& target) {
      return check::place_of(target) ? "output.loop takes interfaces or supports; faces go to 'between'" : "";
    });
    has_two_sides(problem);
    if (request_.between.size() == 2) sides_are_in_order(problem);
    check::names_are_free(problem, *this, {"_cycles", "_backbone"});
  }

  Columns columns() const override { return {{"time", "s"}, {"displacement", "m"}, {"force", "N"}}; }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(request_.on, notes);
    note_direction(request_.direction, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"displacement", StudyFigure::Of::largest}, {"force", StudyFigure::Of::largest}};
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<LoopRecorder>(columns(), problem, request_);
  }

  void conclude(const RunEnd& end, Table& table, Findings& findings) const override {
    if (table.n_rows() == 0) return;
    int first = 0;
    const int i_after = request_.after ? index_of(end.problem.steps, request_.after.get()) : -1;
    for (int i = 0; i < table.n_rows(); ++i)
      if (table.step[i] <= i_after) first = i;
    const LoopSummary loop = summarise_loop(table, first);
    give(loop, findings);
    const auto note = [&](const char* what, double value) {
      if (std::isfinite(value)) findings.figures["loop '" + name + "', " + what] = value;
    };
    note("exponent of the loss over the force", loop.exponent);
    note("exponent of the loss over the displacement", loop.displacement_exponent);
    note("first stiffness [N/m]", loop.stiffness);
    findings.lines = {line_of(name, loop) +
                      (end.result.converged ? "" : "; NOT TO BE USED: increments have not converged")};
  }

  void hollow(const Table& table, Findings& findings) const override {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
    LoopSummary loop = summarise_loop(table, 0);
    for (Table* part : {&loop.cycles, &loop.backbone}) {
      for (std::vector<double>& column : part->columns) column.assign(1, not_known);
      part->step.assign(1, 0);
    }
    loop.exponent = loop.displacement_exponent = loop.stiffness = loop.secant = not_known;
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
      needs_between = needs_between || (std::holds_alternative<SupportPtr>(target) && !check::is_wall(target));
    }
    if (n_supports > 0 && n_supports < request_.on.size())
      check::fail(problem, origin, who + " is on interfaces and supports",
                  "the force is that of interfaces or that on supports: take two loops");
    if (needs_between && request_.between.empty())
      check::fail(problem, origin, who + " is on a support that does not slide, and has no 'between'",
                  "as in between = block:face \"xmax\"");
    if (request_.between.size() > 2)
      check::fail(problem, origin,
                  fmt::format("{}: 'between' takes one or two places, got {}", who, request_.between.size()));
    for (const FaceOrRegion& place : request_.between) check::place_exists(problem, origin, who + " is between", place);
    if (request_.after) check::listed(problem, who + " begins after step", *request_.after, problem.steps, "steps");
  }

  void sides_are_in_order(const Problem& problem) const {
    const auto& [first, second] = std::tie(request_.between[0], request_.between[1]);
    for (const Target& target : request_.on) {
      const auto* interface = std::get_if<InterfacePtr>(&target);
      if (!interface || (*interface)->side_1.part == (*interface)->side_2.part) continue;
      if (&check::part_of(first) == (*interface)->side_2.part.get() &&
          &check::part_of(second) == (*interface)->side_1.part.get())
        check::fail(problem, origin,
                    fmt::format("{}: 'between' is the other way round than that of {}: write {} first", known_as(),
                                check::describe(**interface), check::label_of(second)),
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

// output.backbone: frequency and damping of a mode against its amplitude, from static steps that push the assembly in
// its shape (quasi-static modal analysis; manual, eq. D17-D19).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/log.hpp"
#include "model/mode_forces.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"

namespace dygita {

namespace {

constexpr double pi = std::numbers::pi;

// Modal acceleration (m/s^2) and displacement (m) after each increment, from nothing on.
struct Path {
  std::vector<double> a = {0.0}, q = {0.0};

  size_t n() const { return a.size(); }
  // The first loading ends where it turns round.
  size_t end_of_loading() const {
    size_t i = 1;
    while (i + 1 < n() && std::abs(a[i + 1]) > std::abs(a[i]) && a[i + 1] * a[1] > 0.0) ++i;
    return i;
  }
  // d a / d q at a point of the stretch [first, last], by the parabola through it and its neighbours.
  double slope(size_t i, size_t first, size_t last) const {
    if (last - first < 2) return (a[last] - a[first]) / (q[last] - q[first]);
    const size_t m = std::clamp(i, first + 1, last - 1);
    const double h0 = q[m] - q[m - 1], h1 = q[m + 1] - q[m];
    const double s0 = (a[m] - a[m - 1]) / h0, s1 = (a[m + 1] - a[m]) / h1, bend = (s1 - s0) / (h0 + h1);
    if (i < m) return s0 - bend * h0;
    return i > m ? s1 + bend * h1 : (s0 * h1 + s1 * h0) / (h0 + h1);
  }
  // The area (m^2/s^2) under a stretch that goes one way, by cubics with those slopes.
  double area(size_t first, size_t last) const {
    double sum = 0.0;
    for (size_t i = first; i < last; ++i) {
      const double h = q[i + 1] - q[i];
      sum += 0.5 * h * (a[i] + a[i + 1]) + h * h / 12.0 * (slope(i, first, last) - slope(i + 1, first, last));
    }
    return sum;
  }
};

// Hz, of the secant over both ends, and damping ratio, what it loses over what its strain energy is.
struct Cycle {
  double frequency = std::numeric_limits<double>::quiet_NaN(), damping = frequency;
};

// The whole one after the first loading; nan without one.
Cycle cycle_of(const Path& path) {
  constexpr double same = 1e-6;
  const size_t first = path.end_of_loading();
  size_t back = first;
  while (back + 1 < path.n() && std::abs(path.a[back + 1] + path.a[first]) < std::abs(path.a[back] + path.a[first]))
    ++back;
  size_t last = back;
  while (last + 1 < path.n() && std::abs(path.a[last + 1] - path.a[first]) < std::abs(path.a[last] - path.a[first]))
    ++last;
  const double size = std::abs(path.a[first]);
  if (last == back || std::abs(path.a[back] + path.a[first]) > same * size ||
      std::abs(path.a[last] - path.a[first]) > same * size)
    return {};
  const double lost = path.area(first, back) + path.area(back, last);
  const double q = 0.25 * (path.q[first] + path.q[last] - 2.0 * path.q[back]);
  return {std::sqrt(size / std::abs(q)) / (2.0 * pi), std::abs(lost) / (2.0 * pi * size * std::abs(q))};
}

class BackboneRecorder : public TableRecorder {
 public:
  BackboneRecorder(const Columns& columns, const Problem& problem, const std::string& name, const ModeShapes& shapes,
                   int number, std::vector<int> steps)
      : TableRecorder(columns),
        problem_(problem),
        name_(name),
        shapes_(shapes),
        number_(number),
        steps_(std::move(steps)) {}

  void begin_step(const Instant& start) override {
    if (start.i_step == steps_.front()) before_ = displacement(start);
  }

  void accept(const Instant& instant) override {
    if (std::find(steps_.begin(), steps_.end(), instant.i_step) == steps_.end()) return;
    double force = 0.0;
    for (size_t p = 0; p < problem_.substructures.size(); ++p)
      force += instant.model.external_force(static_cast<int>(p), instant.state)
                   .cwiseProduct(shapes_.shape(*problem_.substructures[p], number_))
                   .sum();
    path_.a.push_back(force / shapes_.generalised_mass(number_));
    path_.q.push_back(displacement(instant) - before_);
    missed_ += !instant.converged;
  }

  void finish(Table& table, Findings& findings) override {
    if (path_.n() < 2 || path_.a[1] == 0.0) {
      findings.lines = {fmt::format("backbone '{}': NOT MADE: nothing pushes the mode in its steps", name_)};
      findings.values = {
          {"cycle_damping", Cycle().damping}, {"cycle_frequency", Cycle().frequency}, {"frequency_of_mode", 0.0}};
    } else {
      tell(findings);
    }
    TableRecorder::finish(table, findings);
    table.mark(missed_ == 0);
  }

 private:
  // Of the mode, m.
  double displacement(const Instant& instant) const {
    double sum = 0.0;
    for (size_t p = 0; p < problem_.substructures.size(); ++p)
      sum += instant.displacement(static_cast<int>(p))
                 .cwiseProduct(shapes_.mass_times_shape(*problem_.substructures[p], number_))
                 .sum();
    return sum / shapes_.generalised_mass(number_);
  }

  void tell(Findings& findings) {
    const size_t last = path_.end_of_loading();
    const double small = shapes_.frequency(number_), viscous = shapes_.damping_ratio(number_) * small;
    double frequency = 0.0, damping = 0.0, of_materials = 0.0;
    for (size_t i = 1; i <= last; ++i) {
      const double a = path_.a[i], q = path_.q[i];
      frequency = std::sqrt(a / q) / (2.0 * pi);
      // Masing: both branches of the cycle are the first loading, twice as large.
      const double lost = 8.0 * path_.area(0, i) - 4.0 * a * q;
      of_materials = viscous / frequency;
      damping = lost / (2.0 * pi * a * q) + of_materials;
      add_values({std::abs(a), std::abs(q), frequency, damping, of_materials});
    }
    Cycle cycle = cycle_of(path_);
    cycle.damping += viscous / cycle.frequency;
    findings.values = {
        {"cycle_damping", cycle.damping}, {"cycle_frequency", cycle.frequency}, {"frequency_of_mode", small}};
    std::string line = fmt::format(
        "backbone '{}': mode {} of {:.5g} Hz has {:.5g} Hz and {:.3g} % of critical damping at {:.4g} m/s^2", name_,
        number_, small, frequency, 100.0 * damping, std::abs(path_.a[last]));
    if (std::isfinite(cycle.damping))
      line += fmt::format(", {:.5g} Hz and {:.3g} % by a whole cycle", cycle.frequency, 100.0 * cycle.damping);
    findings.lines = {line + (missed_ > 0 ? fmt::format("; NOT CONVERGED: {} increments", missed_) : "")};
  }

  const Problem& problem_;
  const std::string& name_;
  const ModeShapes& shapes_;
  const int number_;
  const std::vector<int> steps_;
  Path path_;
  double before_ = 0.0;
  int missed_ = 0;
};

class BackboneOutput final : public Output {
 public:
  explicit BackboneOutput(const ModelArguments& a)
      : Output(a),
        modes_(a.output("mode")),
        shapes_(dynamic_cast<const ModeShapes*>(modes_.get())),
        number_(a.integer("number")),
        steps_(a.steps("steps")) {
    CHECK(shapes_, "'mode' of output.backbone is no output of modes");
  }

  void check(const Problem& problem) const override {
    check::listed(problem, known_as() + " is of", *modes_, problem.outputs, "outputs");
    for (const StepPtr& step : steps_) {
      check::listed(problem, known_as() + " is made of step", *step, problem.steps, "steps");
      if (!step->is_static)
        check::fail(problem, origin, known_as() + ": step '" + step->name + "' is dynamic",
                    "a backbone is made of static steps; a ring-down shows the same in time");
    }
  }

  Columns columns() const override {
    return {{"acceleration", "m/s^2"},
            {"displacement", "m"},
            {"frequency", "Hz"},
            {"damping", ""},
            {"material_damping", ""}};
  }
  Notes record(const Table&, const Findings& findings) const override {
    Notes notes = {{"mode", number_}};
    for (const auto& [of, value] : findings.values) notes.push_back({of, value});
    return notes;
  }
  std::vector<StudyFigure> study_figures() const override {
    return {{"frequency", StudyFigure::Of::last}, {"damping", StudyFigure::Of::last}};
  }
  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    std::vector<int> steps;
    for (const StepPtr& step : steps_) steps.push_back(index_of(problem.steps, step.get()));
    return std::make_unique<BackboneRecorder>(columns(), problem, name, *shapes_, number_, std::move(steps));
  }

 private:
  OutputPtr modes_;  // has the shapes
  const ModeShapes* shapes_;
  int number_;
  std::vector<StepPtr> steps_;
};

}  // namespace

namespace outputs {
OutputEntry backbone() { return {"backbone", new_output<BackboneOutput>, {Display::As::amplitude, "", 0}}; }
}  // namespace outputs

}  // namespace dygita

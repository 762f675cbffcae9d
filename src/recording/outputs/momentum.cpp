// output.momentum: linear momentum of parts (manual, instants and means).
#include <algorithm>
#include <array>

#include "fem/assembly.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"

namespace dygita {

namespace {

struct WeighedPart {
  int index;   // in problem.substructures
  Vec masses;  // kg, the integral of density times each node's shape function: exact for the sum, whatever the mass
               // matrix
  Vec lumped;  // kg, what explicit increments have instead: the same but in cells of order two
  std::array<Points, 3> of_matrix = {};  // kg, of a body without cells, instead: its mass times each translation
};

class MomentumRecorder : public TableRecorder {
 public:
  MomentumRecorder(const Columns& columns, std::vector<WeighedPart> parts)
      : TableRecorder(columns), parts_(std::move(parts)) {}

  void begin_step(const Instant& instant) override {
    if (!instant.is_static() || instant.i_step == 0) accept(instant);
  }
  void accept(const Instant& instant) override {
    Vec3 momentum = Vec3::Zero();
    const std::vector<Integration::Part>& how = instant.model.integration.parts;
    for (const WeighedPart& part : parts_) {
      if (part.of_matrix[0].size() > 0) {
        const Points velocity = instant.velocity(part.index);
        for (int d = 0; d < 3; ++d) momentum[d] += part.of_matrix[static_cast<size_t>(d)].cwiseProduct(velocity).sum();
        continue;
      }
      const bool is_explicit = !how.empty() && how[static_cast<size_t>(part.index)].is_explicit;
      momentum += instant.velocity(part.index) * (is_explicit ? part.lumped : part.masses);
    }
    add_row(instant, instant.time(), {momentum[0], momentum[1], momentum[2]});
  }

 private:
  std::vector<WeighedPart> parts_;
};

class MomentumOutput final : public Output {
 public:
  explicit MomentumOutput(const ModelArguments& a) : Output(a), of_(a.substructures("of")) {}

  void check(const Problem& problem) const override {
    for (size_t i = 0; i < of_.size(); ++i) {
      check::listed(problem, known_as() + " is of substructure", *of_[i], problem.substructures, "substructures");
      for (size_t j = 0; j < i; ++j)
        if (of_[i] == of_[j])
          check::fail(problem, origin, known_as() + ": substructure '" + of_[i]->name + "' occurs twice in 'of'");
    }
    for (const SubstructurePtr& part : problem.substructures) {
      const bool is_asked = of_.empty() || std::find(of_.begin(), of_.end(), part) != of_.end();
      if (!is_asked) continue;
      for (int axis = 0; axis < 3; ++axis)
        if (part->mesh->inside->resists(part->mesh->nodes, Vec3::Unit(axis)))
          check::fail(problem, origin,
                      known_as() + ": superelement '" + part->name +
                          "' contains a condensed support: its internal motion is unknown",
                      "list the other parts in 'of', or condense it without the support and hold it in the deck");
    }
  }

  void doubt(const Problem& problem) const override {
    if (!has_dynamic_step(problem))
      check::doubt(problem, origin, known_as() + " is zero throughout: there is no dynamic step");
  }

  Columns columns() const override { return {{"time", "s"}, {"x", "N s"}, {"y", "N s"}, {"z", "N s"}}; }

  Notes record(const Table&, const Findings&) const override {
    std::vector<std::string> names;
    for (const SubstructurePtr& part : of_) names.push_back(part->name);
    if (names.empty()) return {};
    return {{"of", names}};
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"x", StudyFigure::Of::last}, {"y", StudyFigure::Of::last}, {"z", StudyFigure::Of::last}};
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    std::vector<WeighedPart> parts;
    for (size_t i = 0; i < problem.substructures.size(); ++i) {
      const SubstructurePtr& part = problem.substructures[i];
      const bool is_asked = of_.empty() || std::find(of_.begin(), of_.end(), part) != of_.end();
      const double density = part->material.density;
      const CondensedBody* matrices = part->mesh->inside->matrices();
      if (is_asked && matrices) {
        WeighedPart& own = parts.emplace_back(WeighedPart{static_cast<int>(i), {}, {}});
        for (int d = 0; d < 3; ++d) {
          const Points moved = matrices->rigid_motion(part->mesh->nodes, Vec3::Unit(d), Vec3::Zero());
          own.of_matrix[static_cast<size_t>(d)].resize(3, moved.cols());
          own.of_matrix[static_cast<size_t>(d)].reshaped() = matrices->mass_matrix * moved.reshaped();
        }
      } else if (is_asked)
        parts.push_back(
            {static_cast<int>(i), density * nodal_integrals(*part->mesh), density * nodal_volumes(*part->mesh)});
    }
    return std::make_unique<MomentumRecorder>(columns(), std::move(parts));
  }

 private:
  std::vector<SubstructurePtr> of_;  // empty: all
};

}  // namespace

namespace outputs {
OutputEntry momentum() { return {"momentum", new_output<MomentumOutput>, {Display::As::curves, "momentum", 0}}; }
}  // namespace outputs

}  // namespace dygita

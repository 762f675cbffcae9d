// output.joint: forces, largest opening and slip, areas by state, works of an interface or a wall.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "law/law.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "watch/followed_motion.hpp"
#include "watch/surface_sums.hpp"

namespace dygita {

namespace {

// What a joint is at one instant; a row is the mean of both ends of an increment, forces are means already.
struct JointState {
  double opening = 0.0, slip = 0.0, plastic_opening = 0.0;
  Work work;
};

class JointRecorder : public TableRecorder {
 public:
  JointRecorder(const Columns& columns, const Problem& problem, const std::vector<Target>& on)
      : TableRecorder(columns), problem_(problem), on_(on) {}

  void begin_step(const Instant& instant) override {
    motion_.begin_step(instant);
    before_ = state_of(instant);
  }

  void accept(const Instant& instant) override {
    motion_.accept(instant);
    const JointState now = state_of(instant);
    const JointState& a = instant.is_static() ? now : before_;
    const auto mean = [](double x, double y) { return 0.5 * (x + y); };
    const Resultant r = resultant(instant, problem_, on_);
    double area[3] = {0.0, 0.0, 0.0};
    for (const int s : surfaces_of(instant, on_)) {
      const Surface& surface = (*instant.model.surfaces)[s];
      if (!surface.declared_law().shown().states) continue;
      for (int i = 0; i < surface.n_points(); ++i)
        area[static_cast<int>(instant.surface(s).points[i].status)] += surface.facing.areas[i];
    }
    add_row(instant, mean_time(instant),
            {r.normal, r.shear, mean(a.opening, now.opening), mean(a.slip, now.slip),
             mean(a.plastic_opening, now.plastic_opening), area[0], area[1], area[2],
             mean(a.work.friction, now.work.friction), mean(a.work.plastic, now.work.plastic),
             mean(a.work.damping, now.work.damping), mean(a.work.stored, now.work.stored)});
    before_ = now;
  }

 private:
  JointState state_of(const Instant& instant) {
    JointState joint;
    for (const int s : surfaces_of(instant, on_)) {
      const SurfaceState& surface = instant.surface(s);
      for (size_t i = 0; i < surface.points.size(); ++i) {
        const LawState& p = surface.points[i];
        const double opening = motion_.opening(instant, s, static_cast<int>(i));
        if (std::abs(opening) > std::abs(joint.opening)) joint.opening = opening;
        if (std::abs(p.plastic_opening) > std::abs(joint.plastic_opening)) joint.plastic_opening = p.plastic_opening;
        joint.slip = std::max(joint.slip, slip_at_touch(instant, s, i));
      }
      joint.work.add(surface.work());
    }
    return joint;
  }

  // m, as it was when the sides of a contact touched last.
  double slip_at_touch(const Instant& instant, int s, size_t i) {
    std::vector<double>& kept = slips_[s];
    kept.resize(instant.surface(s).points.size());
    const bool is_apart = (*instant.model.surfaces)[s].declared_law().shown().gap &&
                          instant.surface(s).points[i].status == PointState::open;
    if (!is_apart) kept[i] = motion_.slip(instant, s, static_cast<int>(i)).norm();
    return kept[i];
  }

  const Problem& problem_;
  const std::vector<Target>& on_;
  std::map<int, std::vector<double>> slips_;  // m, of each point of the surfaces
  FollowedMotion motion_;
  JointState before_;
};

class JointOutput final : public Output {
 public:
  explicit JointOutput(const ModelArguments& a) : Output(a), on_(a.targets("on")) {}

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, on_, [](const Target& target) {
      const bool fits = std::holds_alternative<InterfacePtr>(target) || is_wall(target);
      return fits ? "" : "output.joint takes an interface or a support.wall";
    });
  }

  Columns columns() const override {
    return {{"time", "s"},         {"normal", "N"},          {"shear", "N"},        {"opening", "m"},
            {"slip", "m"},         {"plastic_opening", "m"}, {"open_area", "m^2"},  {"stick_area", "m^2"},
            {"slip_area", "m^2"},  {"friction_work", "J"},   {"plastic_work", "J"}, {"damping_work", "J"},
            {"stored_energy", "J"}};
  }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(on_, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"normal", StudyFigure::Of::last},        {"opening", StudyFigure::Of::largest},
            {"slip", StudyFigure::Of::largest},       {"plastic_opening", StudyFigure::Of::largest},
            {"friction_work", StudyFigure::Of::last}, {"plastic_work", StudyFigure::Of::last}};
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<JointRecorder>(columns(), problem, on_);
  }

  std::vector<Target> mapped() const override { return on_; }

 private:
  std::vector<Target> on_;
};

}  // namespace

namespace outputs {
OutputEntry joint() { return {"joint", new_output<JointOutput>, {Display::As::joint, "", 0}}; }
}  // namespace outputs

}  // namespace dygita

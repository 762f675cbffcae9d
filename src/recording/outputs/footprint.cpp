// output.footprint: where a joint presses and how far from there (manual, instants and means).
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "watch/surface_sums.hpp"

namespace dygita {

namespace {

struct FootprintRequest {
  std::vector<Target> on;
  std::optional<Vec3> about;      // m; none: the centre of pressure
  std::optional<Vec3> direction;  // unit, of the shear; none: its modulus
};

// Forces of points at their places: their sum and its first and second moments along the axes.
struct Moments {
  double sum = 0.0;
  Vec3 first = Vec3::Zero(), second = Vec3::Zero();

  void add(double force, const Vec3& place) {
    sum += force;
    first += force * place;
    second += force * place.cwiseProduct(place);
  }
  Vec3 centre() const { return first / sum; }
  // Root mean square distance along each axis from a place; nan where nothing acts.
  Vec3 spread(const Vec3& from) const {
    if (sum == 0.0) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    const Vec3 square =
        second / sum - 2.0 * from.cwiseProduct(centre()) + from.cwiseProduct(from);  // round-off about the centre
    return square.cwiseMax(0.0).cwiseSqrt();
  }
};

class FootprintRecorder : public TableRecorder {
 public:
  FootprintRecorder(const Columns& columns, const FootprintRequest& request)
      : TableRecorder(columns), request_(request) {}

  void accept(const Instant& instant) override {
    Moments pressing, shearing;
    double largest = 0.0, area = 0.0;
    for (const int s : surfaces_of(instant, request_.on)) {
      const Facing& facing = (*instant.model.surfaces)[s].facing;
      for (int i = 0; i < facing.n_points(); ++i) {
        const Vec3 force = instant.surface(s).points[i].force, normal = facing.normals.col(i);
        const double push = std::max(0.0, -force.dot(normal));
        const Vec3 shear = force - force.dot(normal) * normal;
        pressing.add(push, facing.places.col(i));
        shearing.add(request_.direction ? shear.dot(*request_.direction) : shear.norm(), facing.places.col(i));
        largest = std::max(largest, push / facing.areas[i]);
        if (push > 0.0) area += facing.areas[i];
      }
    }
    const Vec3 centre = pressing.sum > 0.0 ? pressing.centre() : pressing.spread(Vec3::Zero());
    const Vec3 from = request_.about.value_or(centre);
    const Vec3 r = pressing.spread(from), q = shearing.spread(from);
    add_row(instant, mean_time(instant),
            {largest, area, centre[0], centre[1], centre[2], r[0], r[1], r[2], q[0], q[1], q[2]});
  }

 private:
  const FootprintRequest& request_;
};

class FootprintOutput final : public Output {
 public:
  explicit FootprintOutput(const ModelArguments& a) : Output(a), request_{a.targets("on"), {}, {}} {
    if (a.has("about")) request_.about = a.vector("about");
    if (a.has("direction")) request_.direction = a.unit_vector("direction");
  }

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, request_.on, [](const Target& target) {
      const bool fits = std::holds_alternative<InterfacePtr>(target) || is_wall(target);
      return fits ? "" : "output.footprint takes an interface or a support.wall";
    });
  }

  Columns columns() const override {
    return {{"time", "s"},     {"pressure", "Pa"}, {"area", "m^2"},   {"x", "m"},
            {"y", "m"},        {"z", "m"},         {"spread_x", "m"}, {"spread_y", "m"},
            {"spread_z", "m"}, {"shear_x", "m"},   {"shear_y", "m"},  {"shear_z", "m"}};
  }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(request_.on, notes);
    note_direction(request_.direction, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"pressure", StudyFigure::Of::largest}, {"area", StudyFigure::Of::last}};
  }

  std::unique_ptr<Recorder> recorder(const Problem&, const FrameSink&) const override {
    return std::make_unique<FootprintRecorder>(columns(), request_);
  }

  std::vector<Target> mapped() const override { return request_.on; }

 private:
  FootprintRequest request_;
};

}  // namespace

namespace outputs {
// Of the columns the largest pressure is drawn.
OutputEntry footprint() { return {"footprint", new_output<FootprintOutput>, {Display::As::curves, "pressure", 1}}; }
}  // namespace outputs

}  // namespace dygita

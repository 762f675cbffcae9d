// output.history: a quantity against time, as the mean over a face or a region (manual, instants and means).
#include <algorithm>

#include "fem/own_stress.hpp"
#include "model/load.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/placed.hpp"
#include "recording/recorder.hpp"
#include "recording/spectra.hpp"
#include "watch/growth.hpp"
#include "watch/surface_sums.hpp"
#include "watch/weighted_nodes.hpp"

namespace dygita {

namespace {

enum class Quantity {
  displacement,
  velocity,
  acceleration,
  stress,
  von_mises,
  material_stress,
  failure_index,
  pressure
};

struct QuantityEntry {
  Quantity quantity;
  const char *name, *unit;
};
constexpr QuantityEntry quantities[] = {
    {Quantity::displacement, "displacement", "m"},     {Quantity::velocity, "velocity", "m/s"},
    {Quantity::acceleration, "acceleration", "m/s^2"}, {Quantity::stress, "stress", "Pa"},
    {Quantity::von_mises, "von_mises", "Pa"},          {Quantity::material_stress, "material_stress", "Pa"},
    {Quantity::failure_index, "failure_index", ""},    {Quantity::pressure, "pressure", "Pa"}};

const QuantityEntry& quantity_named(const std::string& name) {
  for (const QuantityEntry& entry : quantities)
    if (entry.name == name) return entry;
  CHECK(false, "unknown quantity '" + name + "'");
  return quantities[0];
}

struct HistoryRequest {
  std::vector<Target> on;
  QuantityEntry what;
  std::optional<Vec3> direction;  // unit; none: x y z
  std::optional<int> ply;         // from 0; none: no layup, or of the failure index all

  bool is_of_surfaces() const { return what.quantity == Quantity::pressure; }
  bool is_of_axes() const {
    return what.quantity == Quantity::material_stress || what.quantity == Quantity::failure_index;
  }
  bool is_of_stress() const {
    return what.quantity == Quantity::stress || what.quantity == Quantity::von_mises || is_of_axes();
  }
  bool has_direction() const { return !is_of_surfaces() && !is_of_axes() && what.quantity != Quantity::von_mises; }
  bool is_scalar() const {
    return direction || what.quantity == Quantity::von_mises || what.quantity == Quantity::failure_index ||
           is_of_surfaces();
  }
  bool is_mean() const { return what.quantity == Quantity::acceleration || is_of_surfaces(); }
};

// Nodes of the faces and regions it is on; weights of all groups sum to one.
std::vector<WeightedNodes> weigh(const Problem& problem, const std::vector<Target>& on) {
  std::vector<WeightedNodes> groups;
  double total = 0.0;
  for (const Target& target : on) {
    const std::optional<FaceOrRegion> place = place_of(target);
    if (!place) continue;
    groups.push_back(weighted_nodes(problem, *place));
    for (const double w : groups.back().weights) total += w;
  }
  for (WeightedNodes& group : groups)
    for (double& w : group.weights) w /= total;
  return groups;
}

class HistoryRecorder : public TableRecorder {
 public:
  HistoryRecorder(const Columns& columns, const Problem& problem, const HistoryRequest& request)
      : TableRecorder(columns), problem_(problem), request_(request), groups_(weigh(problem, request.on)) {}

  void begin_step(const Instant& instant) override {
    if (!request_.is_mean() && (!instant.is_static() || instant.i_step == 0))
      add_row(instant, instant.time(), values(instant));
  }
  void accept(const Instant& instant) override {
    add_row(instant, request_.is_mean() ? mean_time(instant) : instant.time(), values(instant));
  }
  void finish(Table& table, Findings& findings) override {
    TableRecorder::finish(table, findings);
    SeenParts seen;
    for (const WeightedNodes& group : groups_) seen.parts.push_back(group.part);
    findings.model = std::move(seen);
  }

 private:
  std::vector<double> values(const Instant& instant) const {
    const Quantity quantity = request_.what.quantity;
    if (quantity == Quantity::pressure) return {mean_pressure(instant, request_.on)};
    if (request_.is_of_axes()) return own_stresses(instant);
    if (request_.is_of_stress()) return stresses(instant);
    Vec3 mean = Vec3::Zero();
    for (const WeightedNodes& group : groups_) {
      const Points field = quantity == Quantity::displacement ? instant.displacement(group.part, group.nodes)
                           : quantity == Quantity::velocity   ? instant.velocity(group.part, group.nodes)
                                                              : instant.acceleration(group.part, group.nodes);
      mean += field * Eigen::Map<const Vec>(group.weights.data(), field.cols());
    }
    if (request_.direction) return {mean.dot(*request_.direction)};
    return {mean[0], mean[1], mean[2]};
  }

  // Along the axes of the material.
  std::vector<double> own_stresses(const Instant& instant) const {
    const bool is_index = request_.what.quantity == Quantity::failure_index;
    Eigen::Matrix<double, 6, 1> mean = Eigen::Matrix<double, 6, 1>::Zero();
    double index = 0.0;
    for (const WeightedNodes& group : groups_) {
      const Substructure& part = *problem_.substructures[group.part];
      const Points moved = instant.displacement(group.part);
      const NodalFailure failure =
          is_index ? nodal_failure(*part.mesh, part.material, moved, request_.ply.value_or(of_all_plies))
                   : NodalFailure();
      const Tensors stress =
          is_index ? Tensors() : own_stress(*part.mesh, part.material, moved, request_.ply.value_or(at_its_place));
      for (size_t i = 0; i < group.nodes.size(); ++i) {
        if (is_index) index += group.weights[i] * failure.index[group.nodes[i]];
        if (!is_index) mean += group.weights[i] * stress.col(group.nodes[i]);
      }
    }
    if (is_index) return {index};
    return {mean.data(), mean.data() + 6};
  }

  std::vector<double> stresses(const Instant& instant) const {
    const bool is_von_mises = request_.what.quantity == Quantity::von_mises;
    Eigen::Matrix<double, 6, 1> mean = Eigen::Matrix<double, 6, 1>::Zero();
    double mises = 0.0;
    for (const WeightedNodes& group : groups_) {
      const Substructure& part = *problem_.substructures[group.part];
      const Points strained =
          without_growth(instant.displacement(group.part), growth_at(instant, group.part), part.mesh->nodes);
      const Tensors stress = nodal_stress(*part.mesh, part.material, strained);
      const Vec equivalent = is_von_mises ? von_mises(stress) : Vec();
      for (size_t i = 0; i < group.nodes.size(); ++i) {
        mean += group.weights[i] * stress.col(group.nodes[i]);
        if (equivalent.size() > 0) mises += group.weights[i] * equivalent[group.nodes[i]];
      }
    }
    if (is_von_mises) return {mises};
    if (!request_.direction) return {mean.data(), mean.data() + 6};
    const Vec3& d = *request_.direction;
    return {d[0] * d[0] * mean[0] + d[1] * d[1] * mean[1] + d[2] * d[2] * mean[2] +
            2.0 * (d[0] * d[1] * mean[3] + d[1] * d[2] * mean[4] + d[2] * d[0] * mean[5])};
  }

  const Problem& problem_;
  const HistoryRequest& request_;
  std::vector<WeightedNodes> groups_;
};

class HistoryOutput final : public Output, public Placed {
 public:
  explicit HistoryOutput(const ModelArguments& a)
      : Output(a), request_{a.targets("on"), quantity_named(a.text("quantity")), {}, {}} {
    if (a.has("direction")) request_.direction = a.unit_vector("direction");
    if (a.has("ply")) request_.ply = a.integer("ply") - 1;
  }

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, request_.on, [this](const Target& target) { return refused(target); });
    const auto n_faces = std::count_if(request_.on.begin(), request_.on.end(), is_face);
    const auto n_regions = std::count_if(request_.on.begin(), request_.on.end(),
                                         [](const Target& target) { return std::holds_alternative<Region>(target); });
    if (n_faces > 0 && n_regions > 0)
      check::fail(problem, origin,
                  known_as() + " is a mean over the area of faces or over the volume of regions, not over both",
                  "an output of its own for each kind");
    for (size_t i = 0; i < request_.on.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (const auto one = place_of(request_.on[j]), other = place_of(request_.on[i]);
            one && other && overlap(*one, *other))
          check::fail(problem, origin,
                      known_as() + " is on " + describe(request_.on[j]) + " and on " + describe(request_.on[i]) +
                          ", which share facets or nodes: these would count twice in the mean");
    for (const Target& target : request_.on)
      if (const auto place = place_of(target); place && request_.is_of_stress() && !part_of(*place).mesh->has_cells())
        check::fail(problem, origin,
                    known_as() + ": superelement '" + part_of(*place).name + "' has no stress, since it has no cells",
                    "take its displacement, velocity or acceleration, or the pressure of an interface");
    for (const Target& target : request_.on)
      if (const auto place = place_of(target)) check_axes(problem, part_of(*place));
    if (request_.ply && !request_.is_of_axes())
      check::fail(problem, origin, known_as() + ": quantity '" + request_.what.name + "' has no 'ply'",
                  "material_stress and failure_index have");
    if (request_.direction && !request_.has_direction())
      check::fail(problem, origin, known_as() + ": quantity '" + request_.what.name + "' has no direction");
  }

  void doubt(const Problem& problem) const override {
    for (const Target& target : request_.on)
      if (const auto* region = std::get_if<Region>(&target);
          region && !region->part->mesh->has_cells() && !region->part->mesh->faces.empty())
        check::doubt(problem, origin,
                     known_as() + " is a mean over nodes of superelement '" + region->part->name +
                         "', which weights each equally; in a mesh it weights them by volume");
    const Quantity quantity = request_.what.quantity;
    const bool is_rate = quantity == Quantity::velocity || quantity == Quantity::acceleration;
    if (is_rate && !has_dynamic_step(problem))
      check::doubt(problem, origin, known_as() + " is zero throughout: there is no dynamic step");
  }

  Columns columns() const override {
    Columns columns = {{"time", "s"}};
    const auto add = [&](const std::vector<std::string>& names) {
      for (const std::string& column : names) columns.push_back({column, request_.what.unit});
    };
    if (request_.is_scalar())
      add({request_.what.name});
    else if (request_.what.quantity == Quantity::stress)
      add({"xx", "yy", "zz", "xy", "yz", "zx"});
    else if (request_.what.quantity == Quantity::material_stress)
      add({"s11", "s22", "s33", "s12", "s23", "s13"});
    else
      add({"x", "y", "z"});
    return columns;
  }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(request_.on, notes);
    notes.push_back({"quantity", request_.what.name});
    note_direction(request_.direction, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    std::vector<StudyFigure> figures;
    for (const Column& column : columns())
      if (column.name != "time") figures.push_back({column.name, StudyFigure::Of::largest});
    return figures;
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<HistoryRecorder>(columns(), problem, request_);
  }

  bool is_prescribed(const Problem& problem) const override {
    const auto is_held_in = [&](const StepPtr& step) {
      return std::all_of(request_.on.begin(), request_.on.end(), [&](const Target& target) {
        const std::optional<FaceOrRegion> place = place_of(target);
        return place && is_held(problem, *step, *place);
      });
    };
    return has_dynamic_step(problem) && !request_.on.empty() &&
           std::all_of(problem.steps.begin(), problem.steps.end(),
                       [&](const StepPtr& step) { return step->is_static || is_held_in(step); });
  }

  std::optional<HistoryKind> history() const override {
    return HistoryKind{request_.what.name, request_.direction.has_value()};
  }
  const std::vector<Target>& places() const override { return request_.on; }

 private:
  void check_axes(const Problem& problem, const Substructure& part) const {
    if (!request_.is_of_axes()) return;
    const std::string its = known_as() + ": material '" + part.material.name + "' of '" + part.name + "'";
    if (part.material.is_isotropic())
      check::fail(problem, origin, its + " is the same in all directions",
                  "take its stress or von_mises; material.orthotropic and material.laminate have axes");
    if (request_.what.quantity == Quantity::failure_index && !part.material.has_strength())
      check::fail(problem, origin, its + " has no 'strength'",
                  "strength = { xt = ..., xc = ..., ... } gives the stresses that it bears");
    const Layup* layup = part.material.layup.get();
    if (request_.ply && !layup) check::fail(problem, origin, its + " has no plies", "leave 'ply' out");
    if (layup && request_.ply && *request_.ply >= layup->n_plies())
      check::fail(problem, origin,
                  known_as() + ": 'ply' = " + std::to_string(*request_.ply + 1) + ", and '" + part.material.name +
                      "' has " + std::to_string(layup->n_plies()));
    if (layup && !request_.ply && request_.what.quantity == Quantity::material_stress)
      check::fail(problem, origin, its + " is a laminate: 'ply' is missing",
                  "1 is the lowest along axis 3, " + std::to_string(layup->n_plies()) + " the highest");
  }

  // Are all its nodes on one support that holds them, shaken or at rest, or under one load that moves them along its
  // direction?
  bool is_held(const Problem& problem, const Step& step, const FaceOrRegion& place) const {
    const std::vector<int> nodes = nodes_at(place);
    const auto lies_in = [&](const FaceOrRegion& other) {
      if (&part_of(other) != &part_of(place)) return false;
      const std::vector<int> all = nodes_at(other);
      return std::includes(all.begin(), all.end(), nodes.begin(), nodes.end());
    };
    for (const SupportPtr& support : supports_of(problem, step))
      if (support->kind->holds(false) == Directions::all &&
          std::any_of(support->on.begin(), support->on.end(), lies_in))
        return true;
    for (const LoadPtr& load : step.loads)
      for (const Effect& effect : load->effects())
        if (const auto* motion = std::get_if<PrescribedMotion>(&effect);
            motion && moves_along(*motion) && lies_in(motion->on))
          return true;
    return false;
  }

  bool moves_along(const PrescribedMotion& motion) const {
    for (int d = 0; d < 3; ++d)
      if (!motion.along[d] && (!request_.direction || std::abs((*request_.direction)[d]) > 1e-9)) return false;
    return true;
  }

  // Why it cannot be on a target; empty: it can.
  std::string refused(const Target& target) const {
    const bool is_interface = std::holds_alternative<InterfacePtr>(target);
    if (request_.is_of_surfaces())
      return is_interface || is_wall(target) ? "" : "quantity 'pressure' takes an interface or a support.wall";
    return is_interface || std::holds_alternative<SupportPtr>(target)
               ? "quantity '" + std::string(request_.what.name) + "' takes a face or a region"
               : "";
  }

  HistoryRequest request_;
};

}  // namespace

namespace outputs {
OutputEntry history() { return {"history", new_output<HistoryOutput>, {Display::As::curves, "", 0}}; }
}  // namespace outputs

}  // namespace dygita

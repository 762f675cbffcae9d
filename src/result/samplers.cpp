// Histories, resultants and energies (manual, instants and means).
#include "fem/assembly.hpp"
#include "result/collector.hpp"
#include "result/surface_sums.hpp"
#include "result/weighted_nodes.hpp"

namespace dygita {

void Sampler::add_row(const Instant& instant, double time, const std::vector<double>& values) {
  CHECK(values.size() + 1 == table_.names.size(), "a row has one value a column");
  table_.columns[0].push_back(time);
  for (size_t i = 0; i < values.size(); ++i) table_.columns[i + 1].push_back(values[i]);
  table_.step.push_back(instant.i_step);
}

void Sampler::add_values(const std::vector<double>& values) {
  CHECK(values.size() == table_.names.size(), "a row has one value a column");
  for (size_t i = 0; i < values.size(); ++i) table_.columns[i].push_back(values[i]);
}

double Sampler::mean_time(const Instant& instant) {
  return instant.is_static() ? instant.time() : instant.time() - 0.5 * instant.model.scheme.dt;
}

namespace {

const char* unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::displacement:
      return "m";
    case Quantity::velocity:
      return "m/s";
    case Quantity::acceleration:
      return "m/s^2";
    default:
      return "Pa";
  }
}

// Nodes of the faces and regions an output is on; weights of all groups sum to one.
std::vector<WeightedNodes> weigh(const Problem& problem, const Output& output) {
  std::vector<WeightedNodes> groups;
  double total = 0.0;
  for (const Target& target : output.on) {
    if (const auto* face = std::get_if<Face>(&target))
      groups.push_back(weighted_nodes(problem, *face));
    else if (const auto* region = std::get_if<Region>(&target))
      groups.push_back(weighted_nodes(problem, *region));
    else
      continue;
    for (const double w : groups.back().weights) total += w;
  }
  for (WeightedNodes& group : groups)
    for (double& w : group.weights) w /= total;
  return groups;
}

class HistorySampler : public Sampler {
 public:
  HistorySampler(const Problem& problem, const Output& output)
      : Sampler(make_table(output)), problem_(problem), output_(output), groups_(weigh(problem, output)) {}

  void begin_step(const Instant& instant) override {
    if (!is_mean() && (!instant.is_static() || instant.i_step == 0)) add_row(instant, instant.time(), values(instant));
  }
  void accept(const Instant& instant) override {
    add_row(instant, is_mean() ? mean_time(instant) : instant.time(), values(instant));
  }

 private:
  static Table make_table(const Output& output) {
    Table table{{"time"}, {"s"}, {}, {}};
    const bool is_tensor = output.quantity == Quantity::stress;
    const bool is_scalar =
        output.direction || output.quantity == Quantity::von_mises || output.quantity == Quantity::pressure;
    if (is_scalar)
      table.names.push_back(quantity_name(output.quantity));
    else if (is_tensor)
      table.names.insert(table.names.end(), {"xx", "yy", "zz", "xy", "yz", "zx"});
    else
      table.names.insert(table.names.end(), {"x", "y", "z"});
    table.units.resize(table.names.size(), unit_of(output.quantity));
    return table;
  }

  bool is_mean() const { return output_.quantity == Quantity::acceleration || output_.quantity == Quantity::pressure; }

  std::vector<double> values(const Instant& instant) const {
    if (output_.quantity == Quantity::pressure) return {mean_pressure(instant, output_)};
    if (output_.quantity == Quantity::stress || output_.quantity == Quantity::von_mises) return stresses(instant);
    Vec3 mean = Vec3::Zero();
    for (const WeightedNodes& group : groups_) {
      const Points field = output_.quantity == Quantity::displacement ? instant.displacement(group.part)
                           : output_.quantity == Quantity::velocity   ? instant.velocity(group.part)
                                                                      : instant.acceleration(group.part);
      for (size_t i = 0; i < group.nodes.size(); ++i) mean += group.weights[i] * field.col(group.nodes[i]);
    }
    if (output_.direction) return {mean.dot(*output_.direction)};
    return {mean[0], mean[1], mean[2]};
  }

  std::vector<double> stresses(const Instant& instant) const {
    Eigen::Matrix<double, 6, 1> mean = Eigen::Matrix<double, 6, 1>::Zero();
    double mises = 0.0;
    for (const WeightedNodes& group : groups_) {
      const Substructure& part = *problem_.substructures[group.part];
      const Tensors stress = nodal_stress(*part.mesh, part.material, instant.displacement(group.part));
      const Vec equivalent = output_.quantity == Quantity::von_mises ? von_mises(stress) : Vec();
      for (size_t i = 0; i < group.nodes.size(); ++i) {
        mean += group.weights[i] * stress.col(group.nodes[i]);
        if (equivalent.size() > 0) mises += group.weights[i] * equivalent[group.nodes[i]];
      }
    }
    if (output_.quantity == Quantity::von_mises) return {mises};
    if (!output_.direction) return {mean.data(), mean.data() + 6};
    const Vec3& d = *output_.direction;
    return {d[0] * d[0] * mean[0] + d[1] * d[1] * mean[1] + d[2] * d[2] * mean[2] +
            2.0 * (d[0] * d[1] * mean[3] + d[1] * d[2] * mean[4] + d[2] * d[0] * mean[5])};
  }

  const Problem& problem_;
  const Output& output_;
  std::vector<WeightedNodes> groups_;
};

class ResultantSampler : public Sampler {
 public:
  ResultantSampler(const Problem& problem, const Output& output)
      : Sampler({{"time", "normal", "shear", "x", "y", "z"}, {"s", "N", "N", "N", "N", "N"}, {}, {}}),
        problem_(problem),
        output_(output) {}

  void accept(const Instant& instant) override {
    const Resultant r = resultant(instant, problem_, output_.on);
    add_row(instant, mean_time(instant), {r.normal, r.shear, r.force[0], r.force[1], r.force[2]});
  }

 private:
  const Problem& problem_;
  const Output& output_;
};

class EnergySampler : public Sampler {
 public:
  EnergySampler()
      : Sampler({{"time", "kinetic", "strain", "loads", "friction", "plastic", "damping", "scheme", "balance"},
                 {"s", "J", "J", "J", "J", "J", "J", "J", "J"},
                 {},
                 {}}) {}
  void begin_step(const Instant& instant) override {
    if (!instant.is_static() || instant.i_step == 0) accept(instant);
  }
  void accept(const Instant& instant) override {
    const Energies& e = instant.state.energies;
    add_row(instant, instant.time(),
            {e.kinetic, e.strain, e.loads, e.friction, e.plastic, e.damping, e.scheme, e.balance()});
  }
};

}  // namespace

std::unique_ptr<Sampler> make_history_sampler(const Problem& problem, const Output& output) {
  return std::make_unique<HistorySampler>(problem, output);
}
std::unique_ptr<Sampler> make_resultant_sampler(const Problem& problem, const Output& output) {
  return std::make_unique<ResultantSampler>(problem, output);
}
std::unique_ptr<Sampler> make_energy_sampler() { return std::make_unique<EnergySampler>(); }

}  // namespace dygita

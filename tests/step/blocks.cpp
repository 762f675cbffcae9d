#include "step/blocks.hpp"

#include "base/progress.hpp"
#include "law/law.hpp"

namespace dygita {

int Modelled::node_at(int part, const Vec3& place) const {
  const Points& nodes = problem.substructures[part]->mesh->nodes;
  for (int i = 0; i < nodes.cols(); ++i)
    if ((nodes.col(i) - place).norm() < 1e-9) return i;
  ADD_FAILURE() << "no node of substructure " << part << " at " << place.transpose();
  return 0;
}

void Watcher::accept(const Instant& instant) {
  Row row{instant.time(),   {}, {}, {}, instant.state.surfaces, instant.state.energies, instant.iterations,
          instant.converged};
  for (int part = 0; part < static_cast<int>(instant.model.problem->substructures.size()); ++part) {
    row.displacement.push_back(instant.displacement(part));
    row.velocity.push_back(instant.velocity(part));
    row.reactions.push_back(instant.reactions(part));
  }
  rows.push_back(std::move(row));
}

BlockPtr block(const std::string& name, const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells) {
  auto part = std::make_shared<Substructure>();
  part->name = name;
  part->mesh = box_mesh(origin, size, cells);
  part->material = steel();
  return part;
}

Face face(const BlockPtr& part, const char* group) { return {part, group}; }

BlockPtr cube(const std::string& name, int x, int y, int z, int n) {
  return block(name, 0.01 * Vec3(x, y, z), Vec3::Constant(0.01), {n, n, n});
}

InterfacePtr interface(const std::string& name, const Face& side_1, const Face& side_2, LawPtr law) {
  auto made = std::make_shared<Interface>();
  made->name = name;
  made->side_1 = side_1;
  made->side_2 = side_2;
  made->law = std::move(law);
  return made;
}

LawPtr bonded() { return make_law("bonded"); }

LawPtr contact(double friction, double gap) { return make_law("contact", {{"friction", friction}, {"gap", gap}}); }

LawPtr plastic(double yield, double hardening, bool compression) {
  return make_law("plastic", {{"yield", yield}, {"hardening", hardening}, {"compression", compression ? 1.0 : 0.0}});
}

std::shared_ptr<Support> support(const std::string& word, std::vector<FaceOrRegion> on, const LawArguments& arguments) {
  auto made = std::make_shared<Support>();
  made->name = "support." + word;
  made->kind = make_support(word, arguments);
  made->on = std::move(on);
  return made;
}

LoadPtr load(const std::string& word, std::vector<Target> on, const History& value, int component, bool is_number) {
  GivenArguments given("load." + word, Origin());
  given.on = std::move(on);
  static const std::map<std::string, std::string> keys = {
      {"pressure", "history"}, {"shortening", "by"}, {"preload", "force"}, {"release", "at"}};
  const auto key = keys.find(word);
  given.values_of_time[key == keys.end() ? std::string(1, "xyz"[component]) : key->second] = {value, is_number};
  return make_load(given);
}

LoadPtr number(const std::string& word, std::vector<Target> on, double value, int component) {
  return load(word, std::move(on), History::constant(value), component, true);
}

std::shared_ptr<Step> static_step(const std::string& name, int increments, std::vector<LoadPtr> loads, StepPtr after) {
  auto step = std::make_shared<Step>();
  step->name = name;
  step->is_static = true;
  step->increments = increments;
  step->loads = std::move(loads);
  step->after = std::move(after);
  return step;
}

std::shared_ptr<Step> dynamic_step(const std::string& name, int n, double dt, std::vector<LoadPtr> loads,
                                   StepPtr after) {
  auto step = std::make_shared<Step>();
  step->name = name;
  step->duration = n * dt;
  step->dt = dt;
  step->loads = std::move(loads);
  step->after = std::move(after);
  return step;
}

double displacement_difference(const Watcher& one, const Watcher& other) {
  return difference(
      one, other, [](const Watcher::Row& row) -> const auto& { return row.displacement; });
}

double velocity_difference(const Watcher& one, const Watcher& other) {
  return difference(
      one, other, [](const Watcher::Row& row) -> const auto& { return row.velocity; });
}

Problem two_cubes(LawPtr law, std::vector<StepPtr> steps, int n) {
  Problem problem;
  problem.name = "two_cubes";
  const BlockPtr lower = cube("lower", 0, 0, 0, n), upper = cube("upper", 0, 0, 1, n);
  problem.substructures = {lower, upper};
  problem.interfaces = {interface("between", face(lower, "zmax"), face(upper, "zmin"), std::move(law))};
  problem.supports = {support("fixed", {face(lower, "zmin")})};
  problem.steps = std::move(steps);
  problem.solver.tolerance = problem.solver.static_tolerance = 1e-11;
  problem.solver.max_iterations = 2000;
  problem.solver.integration = IntegrationChoice::implicitly;
  set_progress_enabled(false);
  return problem;
}

Face top_of(const Problem& problem) { return {problem.substructures[1], "zmax"}; }

}  // namespace dygita

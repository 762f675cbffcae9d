#include "model/load.hpp"

#include <algorithm>

#include "base/overloaded.hpp"
#include "model/places.hpp"

namespace dygita {

Load::Load(const ModelArguments& arguments, Values given)
    : path(arguments.path()), origin(arguments.origin()), on(arguments.targets("on")), values(std::move(given)) {}

std::string Load::name_of(size_t i) const { return has_axes() ? path + " " + "xyz"[i] : path; }

std::vector<Effect> Load::nodal_forces(const std::function<Points(const LoadedNodes&, size_t)>& unit) const {
  std::vector<Effect> all;
  for (size_t i = 0; i < values.size(); ++i)
    for (const Target& target : on)
      if (values[i])
        all.push_back(NodalForces{name_of(i), place(target), *values[i],
                                  [unit, i](const LoadedNodes& nodes) { return unit(nodes, i); }});
  return all;
}

Load::Values one_value(const ModelArguments& arguments, const char* key) {
  return {arguments.has(key) ? std::optional(arguments.value(key)) : std::nullopt};
}

Load::Values axis_values(const ModelArguments& arguments) {
  Load::Values values;
  for (const char* axis : {"x", "y", "z"}) values.push_back(one_value(arguments, axis).front());
  return values;
}

std::optional<Complaint> static_only(const Step& step, const std::string& hint) {
  if (step.is_static) return std::nullopt;
  return Complaint{" acts in static steps only, and this one is dynamic", hint};
}

std::optional<Complaint> dynamic_only(const Step& step, const std::string& hint) {
  if (!step.is_static) return std::nullopt;
  return Complaint{" acts in dynamic steps only, and this one is static", hint};
}

bool is_face(const Target& target) { return std::holds_alternative<Face>(target); }

bool is_place(const Target& target) { return is_face(target) || std::holds_alternative<Region>(target); }

FaceOrRegion place(const Target& target) {
  const std::optional<FaceOrRegion> place = place_of(target);
  CHECK(place, "a load that acts on places has another target");
  return *place;
}

const Tightening* tightening(const Effect& effect) {
  using Answer = const Tightening*;
  return std::visit(
      overloaded{[](const Tightening& t) -> Answer { return &t; }, [](const NodalForces&) -> Answer { return nullptr; },
                 [](const BodyForce&) -> Answer { return nullptr; },
                 [](const PrescribedMotion&) -> Answer { return nullptr; },
                 [](const BaseMotion&) -> Answer { return nullptr; }, [](const Release&) -> Answer { return nullptr; }},
      effect);
}

LoadPtr make_load(const ModelArguments& arguments) {
  const std::vector<LoadEntry>& table = load_table();
  const auto entry =
      std::find_if(table.begin(), table.end(), [&](const LoadEntry& e) { return e.word == arguments.word(); });
  CHECK(entry != table.end(), "no file of src/model/loads makes '" + arguments.path() + "'");
  return entry->make(arguments);
}

}  // namespace dygita

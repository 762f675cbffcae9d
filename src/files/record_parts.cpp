#include "files/record_parts.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/names.hpp"
#include "law/law.hpp"
#include "law/law_arguments.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Notes& notes) {
  Json json = Json::object();
  for (const Note& note : notes)
    json[note.name] = std::visit(
        [](const auto& value) {
          if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Notes>)
            return json_of(value);
          else
            return Json(value);
        },
        note.value);
  return json;
}

}  // namespace

namespace {

// Its parameters, and what the report says of it and of its joints.
void add_law(const Law& law, Json& json) {
  for (const LawParameter& parameter : law.parameters())
    std::visit([&](auto value) { json[parameter.name] = value; }, parameter.value);
  Json remarks = Json::array();
  for (const LawRemark& remark : law.remarks())
    remarks.push_back({{"text", remark.text}, {"value", remark.value}, {"unit", remark.unit}});
  const Shown shown = law.shown();
  Json memory = Json::array();
  for (const MemoryEntry& entry : law.memory())
    memory.push_back({{"name", entry.name},
                      {"unit", entry.unit},
                      {"kind", entry.kind == MemoryEntry::Kind::scalar ? "scalar" : "vector"},
                      {"count", entry.count}});
  json["law"] = {
      {"remarks", remarks}, {"yields", shown.plastic_opening}, {"has_states", shown.states}, {"memory", memory}};
}

// The law that a record of an earlier version tells by its kind and parameters alone; null: none is known by them.
LawPtr recorded_law(const std::string& word, const Json& object) {
  for (const LawEntry& entry : law_table()) {
    if (entry.word != word) continue;
    LawArguments arguments;
    for (const std::string& name : entry.arguments) {
      if (is_optional(name)) continue;
      const auto found = object.find(name);
      if (found == object.end() || (!found->is_number() && !found->is_boolean())) return nullptr;
      arguments[name] = found->is_boolean() ? (found->get<bool>() ? 1.0 : 0.0) : found->get<double>();
    }
    return entry.make(arguments);
  }
  return nullptr;
}

}  // namespace

void complete_laws(Json& record) {
  const auto text = [](const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (const auto interfaces = record.find("interfaces"); interfaces != record.end() && interfaces->is_array())
    for (Json& interface : *interfaces) {
      if (!interface.is_object() || interface.contains("law")) continue;
      const LawPtr law = recorded_law(text(interface, "kind"), interface);
      if (!law)
        throw InputError("run.json does not tell the law of interface '" + text(interface, "name") + "' (" +
                         text(interface, "kind") +
                         ")\n    another version of dygita has written it: run the deck again");
      add_law(*law, interface);
    }
  if (const auto supports = record.find("supports"); supports != record.end() && supports->is_array())
    for (Json& support : *supports)
      if (support.is_object() && !support.contains("law") && text(support, "kind") == "wall")
        if (const LawPtr law = recorded_law("contact", support)) add_law(*law, support);
}

Json interfaces_record(const Problem& problem) {
  Json list = Json::array();
  for (const InterfacePtr& interface : problem.interfaces) {
    Json json = {{"name", interface->name},
                 {"kind", interface->law->word()},
                 {"between", {interface->side_1.label(), interface->side_2.label()}}};
    add_law(*interface->law, json);
    if (interface->means) json["motion"] = "mean";
    if (interface->cyclic) json["cyclic"] = interface->cyclic->n;
    list.push_back(json);
  }
  return list;
}

namespace {

void add_sum(const Support& sum, Json& json) {
  json["factors"] = sum.factors;
  const auto numbers = [](const Vec3& v) { return std::vector<double>(v.begin(), v.end()); };
  if (!sum.axes.isIdentity(0.0))
    for (int d = 0; d < 3; ++d) json["axes"].push_back(numbers(sum.axes.col(d)));
  if (!sum.terms.empty()) {
    for (const Vec3& along : sum.terms) json["terms"].push_back(numbers(along));
    return;
  }
  Json along = Json::object(), about = Json::object();
  for (int axis = 0; axis < 6; ++axis) {
    const auto spring = sum.kind->spring(axis);
    if (spring ? spring->stiffness == 0.0 : axis > 2 || !sum.kind->sums().axes[static_cast<size_t>(axis)]) continue;
    (axis < 3 ? along : about)[std::string(1, "xyz"[axis % 3])] =
        spring ? Json({{"stiffness", spring->stiffness}, {"damping", spring->damping}}) : Json("held");
  }
  json["along"] = along;
  if (!about.empty()) json["about"] = about;
}

}  // namespace

Json supports_record(const Problem& problem) {
  Json list = Json::array();
  for (const SupportPtr& support : problem.supports) {
    Json on = Json::array();
    for (const FaceOrRegion& place : support->on)
      on.push_back(std::visit([](const auto& p) { return p.label(); }, place));
    Json json = {{"name", support->name}, {"kind", support->kind->word()}, {"on", on}};
    if (!support->factors.empty())
      add_sum(*support, json);
    else if (const LawPtr law = support->kind->law())
      add_law(*law, json);
    list.push_back(json);
  }
  return list;
}

Json outputs_record(const Problem& problem, const RunResult& result) {
  Json list = Json::array();
  for (const OutputPtr& output : problem.outputs) {
    const auto table = result.tables.find(output.get());
    if (table == result.tables.end()) continue;
    Json json = {{"name", output->name}, {"kind", output->word}, {"file", file_name_of(output->name) + ".csv"}};
    const std::vector<double>& converged = table->second.converged;
    json["converged"] = std::find(converged.begin(), converged.end(), 0.0) == converged.end();
    json.update(json_of(output->record(table->second, result.findings_of(*output))));
    list.push_back(json);
  }
  return list;
}

Json solver_record(const Problem& problem) {
  Json json = {{"name", problem.solver_name()}};
  if (problem.explicit_dynamics) return json;
  json["tolerance"] = problem.monolithic ? problem.monolithic->tolerance : problem.solver.tolerance;
  if (!problem.monolithic) json["static_tolerance"] = problem.solver.static_tolerance;
  const int most = problem.monolithic ? problem.monolithic->max_iterations : problem.solver.max_iterations;
  json["max_iterations"] = most > 0 ? Json(most) : Json();  // as many as help
  return json;
}

}  // namespace dygita

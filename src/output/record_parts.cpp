#include "output/record_parts.hpp"

#include "output/files.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

Json labels(const std::vector<Target>& targets) {
  Json list = Json::array();
  for (const Target& target : targets) list.push_back(label(target));
  return list;
}

Json specification(const Specification& specification, const Table& spectrum) {
  Json json = {
      {"source", specification.source}, {"frequency", specification.frequency}, {"level", specification.level}};
  if (spectrum.n_rows() == 0) return json;
  const Exceedance worst = largest_exceedance(specification, spectrum.columns.front(), spectrum.column("maximax"));
  if (worst.is_known) json["exceedance"] = {{"decibels", worst.decibels}, {"frequency", worst.frequency}};
  return json;
}

}  // namespace

std::string label(const Target& target) {
  if (const auto* face = std::get_if<Face>(&target)) return face->label();
  if (const auto* region = std::get_if<Region>(&target)) return region->label();
  if (const auto* interface = std::get_if<InterfacePtr>(&target)) return (*interface)->name;
  return std::get<SupportPtr>(target)->name;
}

namespace {

// Its parameters, and what the report says of it and of its joints.
void add_law(const Law& law, Json& json) {
  for (const LawParameter& parameter : law.parameters())
    std::visit([&](auto value) { json[parameter.name] = value; }, parameter.value);
  Json remarks = Json::array();
  for (const LawRemark& remark : law.remarks())
    remarks.push_back({{"text", remark.text}, {"value", remark.value}, {"unit", remark.unit}});
  const Shown shown = law.shown();
  json["law"] = {{"remarks", remarks}, {"yields", shown.plastic_opening}, {"has_states", shown.states}};
}

}  // namespace

Json interfaces_record(const Problem& problem) {
  Json list = Json::array();
  for (const InterfacePtr& interface : problem.interfaces) {
    Json json = {{"name", interface->name},
                 {"kind", interface->law->word()},
                 {"between", {interface->side_1.label(), interface->side_2.label()}}};
    add_law(*interface->law, json);
    list.push_back(json);
  }
  return list;
}

Json supports_record(const Problem& problem) {
  Json list = Json::array();
  for (const SupportPtr& support : problem.supports) {
    Json on = Json::array();
    for (const FaceOrRegion& place : support->on)
      on.push_back(std::visit([](const auto& p) { return p.label(); }, place));
    Json json = {{"name", support->name}, {"kind", support->kind->word()}, {"on", on}};
    if (const LawPtr law = support->kind->law()) add_law(*law, json);
    list.push_back(json);
  }
  return list;
}

namespace {

const char* spectrum_quantity(SrsQuantity quantity) {
  switch (quantity) {
    case SrsQuantity::relative_displacement:
      return "relative displacement";
    case SrsQuantity::pseudo_velocity:
      return "pseudo-velocity";
    case SrsQuantity::absolute_acceleration:
      break;
  }
  return "acceleration";
}

}  // namespace

Json outputs_record(const Problem& problem, const RunResult& result) {
  Json list = Json::array();
  for (const OutputPtr& output : problem.outputs) {
    const auto found = result.tables.find(output.get());
    if (found == result.tables.end()) continue;
    const bool is_energy = output->kind == OutputKind::energy;
    Json json = {{"name", output->name},
                 {"kind", output_kind_name(output->kind)},
                 {"file", (is_energy ? "energy" : file_name_of(output->name)) + ".csv"}};
    if (!output->on.empty()) json["on"] = labels(output->on);
    if (output->kind == OutputKind::history) json["quantity"] = quantity_name(output->quantity);
    if (output->direction)
      json["direction"] = {(*output->direction)[0], (*output->direction)[1], (*output->direction)[2]};
    if (output->kind == OutputKind::srs) {
      json.update({{"of", output->of->name},
                   {"quantity", spectrum_quantity(output->srs.quantity)},
                   {"q_factor", output->srs.q_factor}});
      if (result.bands.contains(output.get())) json["band"] = file_name_of(output->name) + "_band.csv";
      if (output->specification) json["specification"] = specification(*output->specification, found->second);
    }
    if (output->kind == OutputKind::attenuation)
      json.update({{"entering", output->of->name}, {"leaving", output->leaving->name}, {"joints", output->n_joints}});
    list.push_back(json);
  }
  return list;
}

Json solver_record(const Problem& problem) {
  Json json = {{"name", problem.solver_name()}};
  if (problem.explicit_dynamics) return json;
  json["tolerance"] = problem.monolithic ? problem.monolithic->tolerance : problem.solver.tolerance;
  if (!problem.monolithic) json["static_tolerance"] = problem.solver.static_tolerance;
  json["max_iterations"] = problem.monolithic ? problem.monolithic->max_iterations : problem.solver.max_iterations;
  return json;
}

}  // namespace dygita

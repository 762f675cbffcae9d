#include "files/run_record.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "files/record_parts.hpp"
#include "files/vtk_writer.hpp"
#include "model/load.hpp"
#include "numerics/factor.hpp"
#include "result/recorded_figures.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

template <class Pairs>
Json object(const Pairs& pairs) {
  Json json = Json::object();
  for (const auto& [name, value] : pairs) json[name] = value;
  return json;
}

Json libraries(const RunIdentity& identity) {
  Json json = {{"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
               {"CHOLMOD", cholmod_version()},
               {"BLAS", blas_description()},
               {"VTK", vtk_version()}};
  json.update(object(identity.libraries));
  return json;
}

Json strength(const Strength& own) {
  Json json = own.given();
  json["criterion"] = own.criterion() == Criterion::hashin ? "hashin" : "tsai_wu";
  return json;
}

// What a unit slip shows in: mass (kg), bounding box (m), material (SI).
Json body(const Substructure& part, double volume) {
  const Elastic& material = part.material;
  const Points& nodes = part.mesh->nodes;
  const Vec3 low = nodes.rowwise().minCoeff() + part.place, high = nodes.rowwise().maxCoeff() + part.place;
  if (const CondensedBody* own = part.mesh->inside->matrices())
    return {{"mass", mass_of(part, volume)},
            {"low", {low[0], low[1], low[2]}},
            {"high", {high[0], high[1], high[2]}},
            {"condensed", {{"rows", own->n_rows()}, {"valid_to", own->valid_to}}}};
  Json json = {{"mass", material.density * volume},
               {"low", {low[0], low[1], low[2]}},
               {"high", {high[0], high[1], high[2]}},
               {"density", material.density}};
  for (const MaterialConstant& constant : material.constants()) json[constant.name] = constant.value;
  if (part.yield) json["yield"] = *part.yield;
  if (material.strength) json["strength"] = strength(*material.strength);
  if (!material.layup) return json;
  for (int i = 0; i < material.layup->n_plies(); ++i) {
    const Ply& ply = material.layup->ply(i);
    Json own = {{"material", ply.material}, {"thickness", ply.thickness}, {"angle", ply.angle}};
    if (ply.strength) own["strength"] = strength(*ply.strength);
    json["plies"].push_back(own);
  }
  return json;
}

Json stress(const PartStress& peak, const Problem& problem) {
  Json json = {{peak.is_index ? "failure_index" : "von_mises", peak.largest},
               {"margin", peak.margin()},
               {peak.is_index ? "volume_above_failure" : "volume_above_yield", peak.above},
               {"step", peak.step >= 0 ? problem.steps[static_cast<size_t>(peak.step)]->name : ""},
               {"time", peak.time},
               {"place", {peak.place[0], peak.place[1], peak.place[2]}}};
  if (peak.ply >= 0) json["ply"] = peak.ply + 1;
  if (!peak.mode.empty()) json["mode"] = peak.mode;
  return json;
}

Json substructures(const Problem& problem, const RunResult& result, const RunIdentity& identity) {
  Json list = Json::array();
  const std::vector<double> volume = volumes(problem);
  for (size_t i = 0; i < problem.substructures.size(); ++i) {
    const SubstructurePtr& part = problem.substructures[i];
    Json json = {{"name", part->name},
                 {"mesh", part->mesh->source},
                 {"digest", part->mesh->digest},
                 {"nodes", part->mesh->n_nodes()},
                 {"cells", part->mesh->n_cells()},
                 {"material", part->material.name}};
    json.update(body(*part, volume[i]));
    for (const auto& [name, digest] : identity.mesh_digests) {
      if (name == part->name) json["digest"] = digest;
    }
    if (i < result.pieces.size() && result.pieces[i] > 1) json["pieces"] = result.pieces[i];
    for (const PartStress& peak : result.stresses)
      if (peak.part == static_cast<int>(i)) json["stress"] = stress(peak, problem);
    list.push_back(json);
  }
  return list;
}

Json solver(const Problem& problem, const RunIdentity& identity) {
  Json json = solver_record(problem);
  if (!identity.solver.empty()) json["command_line"] = identity.solver;
  return json;
}

Json loads(const Step& step) {
  Json list = Json::array();
  for (const LoadPtr& load : step.loads) {
    Json on = Json::array(), value = Json::array();
    for (const Target& target : load->on) on.push_back(label(target));
    for (const auto& given : load->values) value.push_back(given ? Json(given->history.description()) : Json());
    while (!value.empty() && value.back().is_null()) value.erase(value.size() - 1);
    Json json = {{"kind", load->word()}, {"on", on}, {"value", value}, {"unit", load->unit()}};
    if (load->has_axes()) json["axes"] = {"x", "y", "z"};
    for (const auto& [name, numbers] : load->settings()) json["settings"][name] = numbers;
    list.push_back(json);
  }
  return list;
}

// Who had what among several ranks, and who shares points with whom: what a model of larger machines replays.
Json sharing(const Sharing& shared) {
  Json of_each = Json::array(), pieces = Json::array();
  const auto kinds = [](const std::array<double, 3>& of) {
    return Json{{"neighbours", of[0]}, {"all", of[1]}, {"results", of[2]}};
  };
  for (const RankFigures& rank : shared.ranks)
    of_each.push_back(
        {{"pieces", rank.pieces},
         {"unknowns", rank.unknowns},
         {"messages", kinds(rank.messages)},
         {"bytes", kinds(rank.bytes)},
         {"seconds_waited", rank.seconds_waited},
         {"memory",
          {{"now", rank.memory}, {"peak", rank.peak_memory}, {"meshes_once_on_machine", rank.shared_meshes}}}});
  for (const SharedPiece& piece : shared.pieces)
    pieces.push_back({{"substructure", piece.part},
                      {"rank", piece.rank},
                      {"unknowns", piece.unknowns},
                      {"seconds", piece.seconds},
                      {"neighbours", piece.neighbours}});
  return {{"of_each", of_each}, {"pieces", pieces}};
}

Json inertia_relief(const RigidAcceleration& acceleration) {
  const auto vector = [](const Vec3& v) { return Json{v[0], v[1], v[2]}; };
  return {{"centre_of_mass", vector(acceleration.centre)},
          {"acceleration", vector(acceleration.linear)},
          {"angular_acceleration", vector(acceleration.angular)}};
}

Json steps(const Problem& problem, const RunResult& result) {
  Json list = Json::array();
  for (size_t i = 0; i < result.steps.size(); ++i) {
    const StepSummary& step = result.steps[i];
    Json json = {{"name", step.name},
                 {"kind", step.is_static ? "static" : "dynamic"},
                 {"increments", step.increments},
                 {"increments_not_converged", step.increments_not_converged},
                 {"iterations", step.iterations},
                 {"worst_indicator", step.worst_indicator},
                 {"seconds", step.seconds}};
    if (i < result.free.size() && result.free[i].is_whole) json["is_free"] = true;
    if (i < result.free.size() && result.free[i].relief)
      json["inertia_relief"] = inertia_relief(*result.free[i].relief);
    if (i < problem.steps.size()) {
      const bool has_length = problem.steps[i]->is_static || problem.steps[i]->dt > 0.0;
      if (has_length) json["asked_increments"] = problem.steps[i]->n_increments();
      if (!problem.steps[i]->is_static)
        json.update({{"dt", problem.steps[i]->dt}, {"duration", problem.steps[i]->duration}});
      if (!step.explicit_parts.empty()) {
        json["explicit"] = {{"substructures", step.explicit_parts},
                            {"substeps", step.substeps},
                            {"stable_step", step.stable_step},
                            {"mass", step.tuned_parts.empty()                                ? "lumped"
                                     : step.tuned_parts.size() == step.explicit_parts.size() ? "tuned"
                                                                                             : "tuned in some"}};
        if (!step.tuned_parts.empty()) json["explicit"]["tuned_mass"] = step.tuned_parts;
        for (const auto& [part, phase] : step.phases) json["explicit"]["phase_of_lumped_mass"][part] = phase;
        if (!step.diagonal_parts.empty()) json["explicit"]["diagonal_mass"] = step.diagonal_parts;
      }
      json["loads"] = loads(*problem.steps[i]);
    }
    list.push_back(json);
  }
  return list;
}

Json bolts(const RunResult& result) {
  Json list = Json::array();
  for (const BoltSummary& bolt : result.bolts) {
    Json json = {{"name", bolt.name},
                 {"area", bolt.area},
                 {"after_static", bolt.after_static},
                 {"tightened", bolt.tightened},
                 {"lowest", bolt.lowest},
                 {"highest", bolt.highest},
                 {"last", bolt.last},
                 {"loss", bolt.loss() ? Json(*bolt.loss()) : Json()},
                 {"shortening", bolt.shortening},
                 {"plastic_opening", bolt.plastic_opening}};
    json["swing"] = bolt.swing;
    if (const auto by_yield = bolt.loss_by_yield()) {
      json["stiffness"] = *bolt.stiffness;
      json["loss_by_yield"] = *by_yield;
      if (const auto before = bolt.loss_before_motion()) json["loss_before_motion"] = *before;
    }
    if (bolt.target) json["target"] = *bolt.target;
    if (const auto& margins = bolt.margins) {
      json["proof_load"] = margins->proof_load;
      json["largest"] = margins->largest;
      json["safety"] = margins->safety;
      json["margin_proof"] = margins->against_proof(bolt.tightened);
      if (margins->slip) json["margin_slip"] = *margins->slip;
      if (const auto separation = margins->against_separation()) json["margin_separation"] = *separation;
    }
    if (bolt.formula)
      json["hand"] = {{"force", bolt.hand.value_or(0.0)},
                      {"shortening", bolt.formula->shortening},
                      {"bolt_resilience", bolt.formula->resilience.bolt},
                      {"plate_resilience", bolt.formula->resilience.plates},
                      {"load_factor", bolt.formula->resilience.load_factor()},
                      {"share", bolt.formula->share}};
    list.push_back(json);
  }
  return list;
}

Json contacts(const Problem& problem, const RunResult& result) {
  const auto known = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json list = Json::array();
  for (const ContactSummary& contact : result.contacts) {
    Json steps = Json::array();
    for (const ContactStep& step : contact.steps)
      steps.push_back({{"step", problem.steps[static_cast<size_t>(step.step)]->name},
                       {"pressed_lowest", step.lowest},
                       {"pressed_highest", step.highest},
                       {"shear", step.shear},
                       {"closed", step.closed},
                       {"opening", step.opening},
                       {"opening_at", {step.opening_at[0], step.opening_at[1], step.opening_at[2]}},
                       {"sliding", known(step.sliding)},
                       {"slip", known(step.slip)},
                       {"slip_at", {step.slip_at[0], step.slip_at[1], step.slip_at[2]}},
                       {"friction_used", known(step.friction_used)}});
    list.push_back(
        {{"name", contact.name}, {"area", contact.area}, {"friction", contact.friction}, {"steps", std::move(steps)}});
  }
  return list;
}

}  // namespace

const char* program_version() { return DYGITA_VERSION; }

namespace {

std::string what(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return "not enough memory on this machine";
  } catch (const std::exception& known) {
    return known.what();
  }
}

}  // namespace

const char* verdict(const RunResult& result) {
  return result.interrupted ? "interrupted" : result.converged ? "converged" : "not converged";
}

std::optional<RecordedRun> read_run_record(const std::filesystem::path& directory) {
  require_readable(directory / "run.json");
  std::ifstream file(directory / "run.json");
  const Json json = Json::parse(file, nullptr, false);
  if (!file || json.is_discarded()) return std::nullopt;
  try {
    return RecordedRun{.problem = json.at("problem"),
                       .case_name = json.at("case"),
                       .version = json.at("program").at("version"),
                       .solver = json.at("solver").at("name"),
                       .converged = json.at("verdict") == "converged",
                       .interrupted = json.at("verdict") == "interrupted",
                       .iterations = json.at("iterations").at("all"),
                       .mean_iterations = json.at("iterations").at("mean"),
                       .seconds = json.at("seconds").at("all")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::vector<RecordedPiece> read_recorded_pieces(const std::filesystem::path& directory) {
  require_readable(directory / "run.json");
  std::ifstream file(directory / "run.json");
  const Json json = Json::parse(file, nullptr, false);
  std::vector<RecordedPiece> pieces;
  if (!file || json.is_discarded()) return pieces;
  try {
    for (const Json& piece : json.at("ranks").at("pieces"))
      pieces.push_back({piece.at("unknowns"), piece.at("seconds")});
  } catch (const Json::exception&) {
    pieces.clear();
  }
  return pieces;
}

Json options(const RunIdentity& identity) {
  Json json = {{"frames", identity.has_frames}, {"state", identity.has_state}};
  if (!identity.from.empty()) json["from"] = identity.from;
  return json;
}

std::string run_record(const Problem& problem, const RunResult& result, const RunIdentity& identity,
                       const std::vector<std::string>& warnings, const std::vector<std::string>& files) {
  Json json = {
      {"program", {{"name", "dygita"}, {"version", program_version()}}},
      {"problem", problem.name},
      {"case", identity.case_name},
      {"verdict", verdict(result)},
      {"warnings", warnings},
      {"deck", {{"path", identity.deck_path}, {"digest", identity.deck_digest}}},
      {"parameters", object(identity.parameters)},
      {"options", options(identity)},
      {"solver", solver(problem, identity)},
      {"substructures", substructures(problem, result, identity)},
      {"interfaces", interfaces_record(problem)},
      {"supports", supports_record(problem)},
      {"outputs", outputs_record(problem, result)},
      {"size", {{"dofs", result.n_dofs}, {"interface_unknowns", result.n_interface_unknowns}}},
      {"iterations", {{"all", result.iterations}, {"mean", result.mean_iterations}}},
      {"steps", steps(problem, result)},
      {"bolts", bolts(result)},
      {"contacts", contacts(problem, result)},
      {"figures", object(recorded_figures(result))},
      {"seconds", object(result.seconds)},
      {"threads", identity.threads},
      {"kernels", identity.kernels},
      {"libraries", libraries(identity)},
      {"files", files},
  };
  if (!result.sharing.ranks.empty()) json["ranks"] = sharing(result.sharing);
  if (result.stopped_by) json["stopped_by"] = what(result.stopped_by);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dygita

#include "report/ensemble_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/log.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "files/csv.hpp"
#include "files/files.hpp"
#include "files/manifest.hpp"
#include "model/output.hpp"
#include "report/ensemble_report.hpp"
#include "result/case_summary.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

std::string nine_digits_of(double value) { return fmt::format("{:.9g}", value); }

std::vector<std::string> names_of_steps(const Problem& problem) {
  std::vector<std::string> names;
  for (const StepPtr& step : problem.steps) names.push_back(step->name);
  return names;
}

// All columns of an output side by side: "maximax median".
Table side_by_side(const OutputScatter& scatter) {
  Table all;
  for (const auto& [column, table] : scatter.columns)
    for (size_t i = all.names.empty() ? 0 : 1; i < table.names.size(); ++i) {
      all.names.push_back(i == 0 ? table.names[0] : column + " " + table.names[i]);
      all.units.push_back(table.units[i]);
      all.columns.push_back(table.columns[i]);
      all.step = table.step;
    }
  return all;
}

std::string members_csv(const Ensemble& ensemble) {
  std::string text = "member";
  for (const std::string& parameter : ensemble.parameters) text += "," + quoted(parameter);
  bool is_headed = false;
  std::string rows;
  for (const EnsembleMember& member : ensemble.members) {
    const std::vector<CaseFigure> figures = case_summary(*member.problem, *member.result);
    for (const CaseFigure& figure : figures)
      if (!is_headed) text += "," + quoted(figure.unit.empty() ? figure.name : figure.name + " [" + figure.unit + "]");
    is_headed = true;
    rows += quoted(member.name);
    for (const double value : member.values) rows += "," + nine_digits_of(value);
    for (const CaseFigure& figure : figures) rows += "," + nine_digits_of(figure.value);
    const auto seconds = member.result->seconds.find("all");
    rows += fmt::format(",{},{},{:.3f}\n", member.result->iterations, member.result->converged ? 1 : 0,
                        seconds == member.result->seconds.end() ? 0.0 : seconds->second);
  }
  return text + ",iterations,converged,seconds [s]\n" + rows;
}

std::string drives_csv(const std::vector<OutputScatter>& scatter) {
  std::string text = "figure,parameter,rank_correlation,lowest,highest,share,clear\n";
  for (const OutputScatter& one : scatter)
    for (const Drive& drive : one.drives)
      text += fmt::format("{},{},{},{},{},{},{}\n", quoted(drive.figure), quoted(drive.parameter),
                          nine_digits_of(drive.correlation.value), nine_digits_of(drive.correlation.low),
                          nine_digits_of(drive.correlation.high), nine_digits_of(drive.share()),
                          drive.correlation.is_clear() ? 1 : 0);
  return text;
}

std::string ensemble_record(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter) {
  const auto known = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  const auto n = static_cast<int>(ensemble.counted().size());
  Json members = Json::array(), outputs = Json::array();
  for (const EnsembleMember& member : ensemble.members) {
    Json values = Json::object();
    for (size_t i = 0; i < ensemble.parameters.size(); ++i) values[ensemble.parameters[i]] = known(member.values[i]);
    members.push_back({{"name", member.name},
                       {"values", std::move(values)},
                       {"converged", member.result->converged},
                       {"iterations", member.result->iterations}});
  }
  for (const OutputScatter& one : scatter) {
    Json drives = Json::array();
    for (const Drive& drive : one.drives)
      drives.push_back({{"figure", drive.figure},
                        {"parameter", drive.parameter},
                        {"rank_correlation", known(drive.correlation.value)},
                        {"lowest", known(drive.correlation.low)},
                        {"highest", known(drive.correlation.high)},
                        {"clear", drive.correlation.is_clear()}});
    outputs.push_back({{"name", one.output->name},
                       {"kind", one.output->word},
                       {"file", one.columns.empty() ? Json() : Json(file_name_of(one.output->name) + ".csv")},
                       {"drives", std::move(drives)}});
  }
  const Json all = {
      {"problem", ensemble.members.front().problem->name},
      {"case", ensemble.name},
      {"method", name_of(ensemble.design)},
      {"seed", ensemble.seed},
      {"counted", n},
      {"tolerance_factor", ensemble.is_sample() && n > 1 ? Json(tolerance_factor(n)) : Json()},
      {"parameters", ensemble.parameters},
      {"members", std::move(members)},
      {"outputs", std::move(outputs)},
  };
  return all.dump(2) + "\n";
}

// Null: there is none, or none of ours.
Json record_before(const std::filesystem::path& folder) {
  try {
    require_file(folder / own_file::ensemble);
    return Json::parse(text_of_file((folder / own_file::ensemble).string()), nullptr, false);
  } catch (const InputError&) {
    return {};
  }
}

// "ensemble_07": no other case beside it is its own to remove, whatever the record says.
bool is_called_as_member(const Ensemble& ensemble, const std::string& name) {
  const std::string start = ensemble.name + "_";
  return name.size() > start.size() && name.starts_with(start) &&
         std::all_of(name.begin() + static_cast<long>(start.size()), name.end(),
                     [](unsigned char c) { return std::isdigit(c); });
}

}  // namespace

void check_ensemble_folder(const std::filesystem::path& out, const std::filesystem::path& folder) {
  refuse_links(out, folder);
}

void take_as_written(Ensemble& ensemble) {
  for (EnsembleMember& member : ensemble.members) {
    auto result = std::make_shared<RunResult>(*member.result);
    for (auto& [output, table] : result->tables) table = as_written(std::move(table));
    member.result = std::move(result);
  }
}

void write_ensemble(const std::filesystem::path& folder, const Ensemble& ensemble,
                    const std::vector<OutputScatter>& scatter) {
  make_directory(folder);
  Manifest written(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    written.add(name);
    write_text(folder / name, text);
  };
  for (const OutputScatter& one : scatter) {
    if (one.columns.empty()) continue;
    const std::string name = file_name_of(one.output->name);
    write(name + ".csv", csv_text(side_by_side(one), names_of_steps(*ensemble.members.front().problem)));
    if (!one.is_spectrum) continue;
    write(name + "_drives.csv", csv_text(one.drives_at, {}));
    write(name + ".svg", ensemble_chart(ensemble, one));
  }
  write(own_file::report, ensemble_page(ensemble, scatter));
  write(own_file::members, members_csv(ensemble));
  write(own_file::drives, drives_csv(scatter));
  write(own_file::ensemble, ensemble_record(ensemble, scatter));
}

void drop_members_before(const std::filesystem::path& folder, const Ensemble& ensemble, bool keeps_members) {
  const Json before = record_before(folder);
  if (!before.is_object() || !before.contains("members") || !before["members"].is_array()) return;
  for (const Json& member : before["members"]) {
    if (!member.is_object() || !member.contains("name") || !member["name"].is_string()) continue;
    const std::string name = member["name"];
    if (!is_called_as_member(ensemble, name)) continue;
    const bool is_own = std::any_of(ensemble.members.begin(), ensemble.members.end(),
                                    [&](const EnsembleMember& own) { return own.name == name; });
    if (!(is_own && keeps_members)) Manifest::clear(folder.parent_path() / file_name_of(name));
  }
}

}  // namespace dygita

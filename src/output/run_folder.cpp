#include "output/run_folder.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "output/scene_file.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

std::optional<std::string> text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(file), {}};
}

// The cells of a line of RFC 4180 without line breaks in them.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (line[i] != '\r') {
      cells.back() += line[i];
    }
  }
  return cells;
}

int index_of_step(const Json& record, const std::string& name) {
  const Json& steps = record.at("steps");
  for (size_t i = 0; i < steps.size(); ++i)
    if (text(steps[i], "name") == name) return static_cast<int>(i);
  throw InputError("no step '" + name + "' in run.json");
}

Table read_table(std::istream& file, const Json& record) {
  std::string line;
  if (!std::getline(file, line)) throw InputError("is empty");
  Table table;
  const std::vector<std::string> header = cells_of(line);
  const bool has_steps = header.size() > 1 && header[1] == "step";
  for (size_t i = 0; i < header.size(); ++i) {
    if (has_steps && i == 1) continue;
    const size_t open = header[i].rfind(" [");
    const bool has_unit = open != std::string::npos && header[i].back() == ']';
    table.names.push_back(has_unit ? header[i].substr(0, open) : header[i]);
    table.units.push_back(has_unit ? header[i].substr(open + 2, header[i].size() - open - 3) : "");
  }
  table.columns.resize(table.names.size());
  std::string last_step;
  int step = -1;
  for (int n = 2; std::getline(file, line); ++n) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != header.size())
      throw InputError(fmt::format("line {} has {} cells where the header has {}", n, cells.size(), header.size()));
    if (has_steps) {
      if (step < 0 || cells[1] != last_step) step = index_of_step(record, cells[1]);
      last_step = cells[1];
      table.step.push_back(step);
    }
    for (size_t i = 0, column = 0; i < cells.size(); ++i) {
      if (has_steps && i == 1) continue;
      char* end = nullptr;
      table.columns[column++].push_back(std::strtod(cells[i].c_str(), &end));
      if (cells[i].empty() || *end != '\0') throw InputError(fmt::format("line {}: '{}' is no number", n, cells[i]));
    }
  }
  return table;
}

}  // namespace

double number(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string text(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

RunFolder::RunFolder(fs::path folder, const std::string& record_text) : folder_(std::move(folder)) {
  std::error_code error;
  if (!fs::is_directory(folder_, error))
    throw InputError("no folder '" + folder_.string() + "'; a run's is out/<problem>/<case>");
  const std::optional<std::string> record = record_text.empty() ? text_of(folder_ / "run.json") : record_text;
  if (!record) {
    std::string hint;
    for (const auto& entry : fs::directory_iterator(folder_, error))
      if (hint.empty() && fs::exists(entry.path() / "run.json", error))
        hint = "\n    there is one in '" + entry.path().string() + "'";
    throw InputError("'" + folder_.string() + "' holds no run.json: no run came to its end there" + hint);
  }
  record_ = Json::parse(*record, nullptr, false);
  const char* damaged = "' is not the record of a run of dygita, or it is damaged";
  if (!record_.is_object() || !record_.contains("problem") || !record_.contains("verdict") ||
      !record_.contains("steps") || !record_["steps"].is_array())
    throw InputError("'" + (folder_ / "run.json").string() + damaged);
  if (const auto scenes = text_of(folder_ / scene_file)) {
    scenes_ = Json::parse(*scenes, nullptr, false);
    if (!scenes_.is_object()) {
      scenes_ = Json();
      faults_.push_back(std::string(scene_file) + " is damaged: pictures and maps are left out");
    }
  }
}

Table RunFolder::table(const std::string& file, const std::vector<std::string>& columns) const {
  std::ifstream stream(folder_ / file);
  try {
    if (!stream) throw InputError("is missing");
    Table table = read_table(stream, record_);
    for (const std::string& name : columns)
      if (std::find(table.names.begin(), table.names.end(), name) == table.names.end())
        throw InputError("has no column '" + name + "'");
    return table;
  } catch (const InputError& error) {
    faults_.push_back(file + " " + error.what() + ": it is left out");
    return {};
  }
}

std::vector<Json> RunFolder::outputs(const std::string& kind) const {
  std::vector<Json> found;
  const auto outputs = record_.find("outputs");
  if (outputs == record_.end()) return found;
  for (const Json& output : *outputs)
    if (text(output, "kind") == kind) found.push_back(output);
  return found;
}

double RunFolder::figure(const std::string& name) const {
  const auto figures = record_.find("figures");
  return figures == record_.end() ? std::numeric_limits<double>::quiet_NaN() : number(*figures, name.c_str());
}

}  // namespace dygita

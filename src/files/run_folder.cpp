#include "files/run_folder.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "files/csv.hpp"
#include "files/files.hpp"
#include "files/record_parts.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

std::optional<std::string> text_of(const fs::path& path) {
  require_file(path);
  if (!std::ifstream(path)) return std::nullopt;
  return text_of_file(path.string());
}

}  // namespace

int whole_number(const Json& value) {
  constexpr double most = 1e9;
  const double number = value.is_number() ? value.get<double>() : 2 * most;
  if (!(std::abs(number) <= most) || number != std::floor(number))
    throw InputError("a file of the run holds " + value.dump() + " where a whole number is expected: it is damaged");
  return static_cast<int>(number);
}

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
  try {
    complete_laws(record_);
  } catch (const InputError& unknown) {
    throw InputError("'" + folder_.string() + "': " + unknown.what());
  }
  if (const auto scenes = text_of(folder_ / scene_file)) {
    scenes_ = Json::parse(*scenes, nullptr, false);
    if (!scenes_.is_object()) {
      scenes_ = Json();
      faults_.push_back(std::string(scene_file) + " is damaged: pictures and maps are left out");
    }
  }
}

Table RunFolder::table(const std::string& file, const std::vector<std::string>& columns) const {
  try {
    if (read_.find(file) == read_.end()) {
      if (is_no_file(folder_ / file)) throw InputError("is no file");
      require_readable(folder_ / file);
      std::ifstream stream(folder_ / file);
      if (!stream) throw InputError("is missing");
      std::vector<std::string> steps;
      for (const Json& step : record_.at("steps")) steps.push_back(text(step, "name"));
      read_[file] = parse_csv(stream, steps);
    }
    const Table& table = read_.at(file);
    for (const std::string& name : columns)
      if (!table.has_column(name)) throw InputError("has no column '" + name + "'");
    return table;
  } catch (const InputError& error) {
    const std::string fault = file + " " + error.what() + ": it is left out";
    if (std::find(faults_.begin(), faults_.end(), fault) == faults_.end()) faults_.push_back(fault);
    return {};
  }
}

std::string RunFolder::file_text(const std::string& file) const { return text_of(folder_ / file).value_or(""); }

std::vector<Json> RunFolder::outputs(Display::As as) const {
  std::vector<Json> found;
  const auto outputs = record_.find("outputs");
  if (outputs == record_.end()) return found;
  for (const Json& output : *outputs)
    if (const OutputEntry* entry = output_entry(text(output, "kind")); entry && entry->display.as == as)
      found.push_back(output);
  return found;
}

double RunFolder::figure(Figure figure) const {
  const auto figures = record_.find("figures");
  return figures == record_.end() ? std::numeric_limits<double>::quiet_NaN() : number(*figures, label(figure));
}

bool RunFolder::has_figure(Figure figure) const {
  const auto figures = record_.find("figures");
  return figures != record_.end() && figures->contains(label(figure));
}

}  // namespace dygita

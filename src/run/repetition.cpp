#include "run/repetition.hpp"

#include <spdlog/fmt/fmt.h>

#include <fstream>

#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "files/run_folder.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

std::string digest_of_file(const fs::path& path) {
  require_readable(path);
  std::ifstream file(path, std::ios::binary);
  Fnv1a digest;
  std::string block(1 << 16, '\0');
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    digest.add(block.data(), static_cast<size_t>(file.gcount()));
  return digest.hexadecimal();
}

std::map<std::string, std::string> tables_in(const fs::path& folder) {
  std::map<std::string, std::string> tables;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".csv" && entry.is_regular_file(error))
      tables[entry.path().filename().string()] = digest_of_file(entry.path());
  return tables;
}

// A table that is not there cannot be compared: that is not the same as one that is equal.
void require_tables(const Json& record, const fs::path& folder) {
  if (!record.at("files").is_array())
    throw InputError(fmt::format("--repeat {}: the record does not list its files", folder.string()));
  for (const std::string name : record.at("files")) {
    const fs::path path = folder / name;
    std::error_code error;
    if (path.extension() == ".csv" && !fs::is_regular_file(path, error))
      throw InputError(fmt::format("--repeat {}: its table '{}' is {}: nothing to compare with", folder.string(), name,
                                   fs::exists(path, error) ? "not a file" : "not there"));
  }
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

Repetition::Repetition(const fs::path& record)
    : folder_(fs::is_directory(record)       ? record
              : record.parent_path().empty() ? "."
                                             : record.parent_path()) {
  if (!fs::is_directory(record) && fs::exists(record) && record.filename() != "run.json")
    throw InputError(fmt::format("--repeat {}: give a run's folder or its run.json", record.string()));
  if (!fs::is_directory(record) && !fs::exists(record))
    throw InputError(fmt::format("--repeat {}: no such record", record.string()));
  const RunFolder run(folder_, "");
  const Json& json = run.record();
  try {
    problem_ = json.at("problem");
    case_ = json.at("case");
    deck_ = fs::path(json.at("deck").at("path").get<std::string>());
    deck_digest_ = json.at("deck").at("digest");
    kernels_ = json.at("kernels");
    version_ = json.at("program").at("version");
    solver_ = text(json.at("solver"), "command_line");
    if (const auto options = json.find("options"); options != json.end()) {  // earlier versions have none
      has_frames_ = options->value("frames", true);
      has_state_ = options->value("state", true);
      from_ = options->value("from", std::string());
    }
    for (const auto& [name, value] : json.at("parameters").items())
      settings_.emplace_back(name, fmt::format("{}", value.get<double>()));
    for (const Json& part : json.at("substructures")) meshes_[part.at("name")] = part.at("digest");
    require_tables(json, folder_);
  } catch (const Json::exception&) {
    throw InputError(fmt::format("--repeat {}: the record lacks the settings of the run", record.string()));
  }
  tables_ = tables_in(folder_);
}

std::string Repetition::label() const { return fmt::format("problem '{}', case '{}'", problem_, case_); }

void Repetition::check_same(const RunRequest& request) const {
  if (request.identity.deck_digest != deck_digest_)
    throw InputError(fmt::format("deck '{}' has changed since the run of '{}': --repeat requires an unchanged deck",
                                 request.identity.deck_path, folder_.string()));
  for (const auto& [name, digest] : request.identity.mesh_digests)
    if (const auto known = meshes_.find(name); known == meshes_.end() || known->second != digest)
      throw InputError(
          fmt::format("the mesh of substructure '{}' has changed since the run of '{}'", name, folder_.string()));
  if (request.identity.kernels != kernels_ || program_version() != version_)
    warn(fmt::format("the run was made by version {} with kernels for {}: the last digits may differ", version_,
                     kernels_));
}

void Repetition::compare_tables(const fs::path& folder) {
  const std::map<std::string, std::string> now = tables_in(folder);
  std::vector<std::string> other;
  for (const auto& [name, digest] : tables_)
    if (const auto found = now.find(name); found == now.end() || found->second != digest) other.push_back(name);
  differing_ = list_of(other);
  if (other.empty())
    say(fmt::format("  repeated: deck, parameters, meshes and all {} tables are identical, bit for bit",
                    tables_.size()));
}

std::shared_ptr<const RunResult> Repetition::run(const Problem& problem, const RunRequest& request) {
  if (problem.name != problem_ || request.case_name != case_) return run_problem(problem, request);
  check_same(request);
  auto result = run_problem(problem, request);
  is_done_ = true;
  if (!result->interrupted) compare_tables(request.out / problem.name / request.case_name);
  return result;
}

}  // namespace dygita

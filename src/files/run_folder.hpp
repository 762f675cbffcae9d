// A run's output directory read back: its record, its tables, what was drawn of it.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "recording/output_table.hpp"
#include "result/result.hpp"

namespace dygita {

using Json = nlohmann::ordered_json;

class RunFolder {
 public:
  // Reads the record (or takes its text) and scenes.json. Throws InputError where there is no record or it is damaged.
  RunFolder(std::filesystem::path folder, const std::string& record_text);

  const Json& record() const { return record_; }
  const Json& scenes() const { return scenes_; }  // null where there are none

  // The table of a file in the folder, rows with the index of their step in the record's; empty where it is missing,
  // damaged or without one of the columns, which `faults` then tells.
  Table table(const std::string& file, const std::vector<std::string>& columns = {}) const;
  const std::vector<std::string>& faults() const { return faults_; }

  // A file of the folder as it is; empty where there is none.
  std::string file_text(const std::string& file) const;

  // Outputs of the record that are shown in one way.
  std::vector<Json> outputs(Display::As as) const;
  double figure(Figure figure) const;  // nan where the run has none, or it is not finite
  bool has_figure(Figure figure) const;

 private:
  std::filesystem::path folder_;
  Json record_, scenes_;
  mutable std::vector<std::string> faults_;
  mutable std::map<std::string, Table> read_;  // several sections ask for the same table
};

// Throws InputError where it is no whole number, or beyond a thousand million: no file of ours has such a one.
int whole_number(const Json& value);

// Of an object's member: nan where it is missing or null; "" likewise.
double number(const Json& object, const char* key);
std::string text(const Json& object, const char* key);

}  // namespace dygita

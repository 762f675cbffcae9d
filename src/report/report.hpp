// report.html: a run on one page that needs nothing beside itself.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "signal/specification.hpp"

namespace dygita {

struct ReportRequest {
  std::string record = {};  // text of run.json where it is not written yet; empty: the folder's
  // In place of the deck's, by the name of the spectrum; "": of those that have one in the deck, or of all where none
  // has.
  std::map<std::string, std::shared_ptr<const Specification>> specifications = {};
};

// The page of the run in this folder, out/<problem>/<case>, from run.json, its tables and scenes.json; depends on
// nothing else. Throws InputError where the folder holds no run, or one that cannot be read. A table or scenes.json
// that is missing leaves its section out and is told on the page.
std::string report_html(const std::filesystem::path& folder, const ReportRequest& request = {});

}  // namespace dygita

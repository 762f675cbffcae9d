// report.html: a run on one page that needs nothing beside itself.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "signal/specification.hpp"

namespace dygita {

struct ReportRequest {
  std::string record = {};  // text of run.json where it is not written yet; empty: the folder's
  std::shared_ptr<const Specification> specification = {};  // of all spectra, in place of the deck's
};

// The page of the run in this folder, out/<problem>/<case>, from run.json, its tables and scenes.json; depends on
// nothing else. Throws InputError where the folder holds no run, or one that cannot be read. A table or scenes.json
// that is missing leaves its section out and is told on the page.
std::string report_html(const std::filesystem::path& folder, const ReportRequest& request = {});

}  // namespace dygita

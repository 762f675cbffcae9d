#include "report/report.hpp"

#include "base/error.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

std::string page_of(const RunFolder& run, const ReportRequest& request) {
  const TimeAxis time(run.record().at("steps"));
  // Verdict first on the page, faults of the folder known only at the end.
  std::string body = verdict_section(run, spectra_findings(run, request)) + computed_section(run) +
                     picture_section(run) + motion_section(run);
  body += spectra_section(run, time, request) + attenuation_section(run) + histories_section(run, time) +
          bolts_section(run) + joints_section(run, time) + condensed_section(run);
  body += energy_section(run, time) + convergence_section(run) + cost_section(run);
  return html::page(text(run.record(), "problem") + ", " + text(run.record(), "case"),
                    title_section(run) + html::list(run.faults(), "warnings") + body);
}

}  // namespace

std::string report_html(const std::filesystem::path& folder, const ReportRequest& request) {
  const RunFolder run(folder, request.record);
  try {
    return page_of(run, request);
  } catch (const Json::exception& error) {
    throw InputError("'" + folder.string() + "' holds a run that cannot be read: " + error.what());
  }
}

}  // namespace dygita

#include "report/report.hpp"

#include "base/error.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

std::string page_of(const RunFolder& run, const ReportRequest& request) {
  const TimeAxis time(run.record().at("steps"));
  // What matters first; the folder's faults are known only at the end.
  std::string body = verdict_section(run, request) + masses_section(run) + picture_section(run) + motion_section(run) +
                     peaks_section(run, time, request) + margins_section(run) + bolts_section(run);
  body += spectra_section(run, time, request) + attenuation_section(run, time) + histories_section(run, time) +
          joints_section(run, time) + condensed_section(run) + energy_section(run, time);
  body += convergence_section(run) + cost_section(run) + computed_section(run);
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

#include "report/report.hpp"

#include "base/error.hpp"
#include "base/log.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

// "NOT CONVERGED: 3 of 60 increments"; empty: all have.
std::string unconverged_text(const Json& record) {
  double missed = 0.0, increments = 0.0;
  for (const Json& step : record.at("steps")) {
    if (const double n = number(step, "increments_not_converged"); n > 0.0) missed += n;
    if (const double n = number(step, "increments"); n > 0.0) increments += n;
  }
  return missed > 0.0 ? fmt::format("NOT CONVERGED: {:.0f} of {:.0f} increments", missed, increments) : "";
}

std::string page_of(const RunFolder& run, const ReportRequest& request) {
  TimeAxis time(run.record().at("steps"));
  time.note_missed(run.table("convergence.csv"));
  // What matters first; the folder's faults are known only at the end.
  std::string body = verdict_section(run, request) + spectra_section(run, time, request) + picture_section(run) +
                     limits_section(run) + motion_section(run) + margins_section(run) + bolts_section(run) +
                     joints_section(run, time) + peaks_section(run, time, request) + attenuation_section(run, time) +
                     histories_section(run, time) + modes_section(run) + condensed_section(run) + masses_section(run) +
                     energy_section(run, time) + convergence_section(run) + cost_section(run) + computed_section(run);
  return html::page(text(run.record(), "problem") + ", " + text(run.record(), "case"),
                    title_section(run) + html::list(run.faults(), "warnings") + body);
}

}  // namespace

std::string doubted_section(const RunFolder& run, const std::string& title, const std::string& body_html) {
  const std::string words = unconverged_text(run.record());
  return html::section(
      {title, words.empty() ? "" : words + " (red in charts). Later results depend on these increments.", body_html});
}

std::string doubted_figure(const RunFolder& run, const std::string& drawing, const std::string& caption) {
  return html::figure(drawing, caption, unconverged_text(run.record()).empty() ? "" : "NOT CONVERGED");
}

std::string report_html(const std::filesystem::path& folder, const ReportRequest& request) {
  const RunFolder run(folder, request.record);
  try {
    return page_of(run, request);
  } catch (const Json::exception& error) {
    throw InputError("'" + folder.string() + "' contains a run that cannot be read: " + error.what());
  }
}

}  // namespace dygita

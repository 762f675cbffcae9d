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

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

// Every section and every drawing says so: a figure is taken out of the page, a table is read without its top.
std::string marked(std::string sections, const std::string& words) {
  if (words.empty()) return sections;
  replace_all(
      sections, "</h2>\n",
      "</h2>\n<p class=\"missed\">" + words + " (red in charts). Later results depend on these increments.</p>\n");
  const std::string stamp =
      "<text x=\"99.5%\" y=\"98.5%\" text-anchor=\"end\" font-size=\"11\" font-weight=\"bold\" fill=\"#d55e00\" "
      "stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\">"
      "NOT CONVERGED</text>\n";
  for (const char* end : {"</svg>\n<figcaption", "</svg>\n</figure>"}) replace_all(sections, end, stamp + end);
  return sections;
}

std::string page_of(const RunFolder& run, const ReportRequest& request) {
  TimeAxis time(run.record().at("steps"));
  time.note_missed(run.table("convergence.csv"));
  // What matters first; the folder's faults are known only at the end.
  std::string body = verdict_section(run, request) + masses_section(run) + picture_section(run);
  body +=
      marked(motion_section(run) + peaks_section(run, time, request) + margins_section(run) + bolts_section(run) +
                 spectra_section(run, time, request) + attenuation_section(run, time) + histories_section(run, time) +
                 joints_section(run, time) + modes_section(run) + condensed_section(run) + energy_section(run, time),
             unconverged_text(run.record()));
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
    throw InputError("'" + folder.string() + "' contains a run that cannot be read: " + error.what());
  }
}

}  // namespace dygita

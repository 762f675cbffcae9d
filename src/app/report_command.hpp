// dygita report: the page of a run that is there.
#pragma once

#include <string>

namespace dygita {

struct ReportCommand {
  std::string run;            // folder
  std::string specification;  // CSV; empty: the deck's
  std::string out;            // empty: report.html in the folder
};

// Writes the page. Throws InputError.
void write_report(const ReportCommand& command);

}  // namespace dygita

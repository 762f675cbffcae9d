// dygita report: the page of a run that is there.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct ReportCommand {
  std::string run;                          // folder
  std::vector<std::string> specifications;  // CSV, or SPECTRUM=CSV; empty: the deck's
  std::string out;                          // empty: report.html in the folder
};

// Writes the page. Throws InputError.
void write_report(const ReportCommand& command);

}  // namespace dygita

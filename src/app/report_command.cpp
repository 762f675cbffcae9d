#include "app/report_command.hpp"

#include <filesystem>

#include "base/log.hpp"
#include "output/files.hpp"
#include "report/report.hpp"
#include "signal/specification.hpp"

namespace dygita {

void write_report(const ReportCommand& command) {
  ReportRequest request;
  if (!command.specification.empty())
    request.specification = std::make_shared<const Specification>(read_specification(command.specification));
  const std::filesystem::path folder = command.run;
  const std::filesystem::path page = command.out.empty() ? folder / "report.html" : std::filesystem::path(command.out);
  write_text(page, report_html(folder, request));
  say("written: " + page.string());
}

}  // namespace dygita

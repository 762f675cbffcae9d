#include "app/report_command.hpp"

#include <filesystem>

#include "base/error.hpp"
#include "base/log.hpp"
#include "files/files.hpp"
#include "report/report.hpp"
#include "signal/specification.hpp"

namespace dygita {

namespace {

// "board=unit.csv"; a file of such a name is a file.
std::pair<std::string, std::string> name_and_file(const std::string& given) {
  const size_t sign = given.find('=');
  if (sign == std::string::npos || std::filesystem::exists(given)) return {"", given};
  return {given.substr(0, sign), given.substr(sign + 1)};
}

}  // namespace

void write_report(const ReportCommand& command) {
  ReportRequest request;
  for (const std::string& given : command.specifications) {
    const auto [name, file] = name_and_file(given);
    if (!request.specifications.emplace(name, std::make_shared<const Specification>(read_specification(file))).second)
      throw InputError(
          "--specification " + given + ": " +
          (name.empty() ? "a second file without the name of a spectrum" : "'" + name + "' has one already"));
  }
  const std::filesystem::path folder = command.run;
  const std::filesystem::path page = command.out.empty() ? folder / "report.html" : std::filesystem::path(command.out);
  write_text(page, report_html(folder, request));
  say("written: " + page.string());
}

}  // namespace dygita

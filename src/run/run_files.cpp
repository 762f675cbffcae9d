#include "run/run_files.hpp"

#include "base/log.hpp"
#include "output/run_record.hpp"
#include "report/report.hpp"
#include "report/scene_file.hpp"

namespace dygita {

void write_run_files(RunWriter& writer, const Problem& problem, const RunResult& result, const RunIdentity& identity,
                     const std::vector<std::string>& warnings) {
  writer.write_tables(problem, result);
  if (result.scenes) writer.write(scene_file, scene_text(problem, *result.scenes));
  try {
    const std::string record = run_record(problem, result, identity, warnings, {});
    writer.write("report.html", report_html(writer.directory(), {.record = record}));
  } catch (const std::exception& error) {
    warn(std::string("no report.html: ") + error.what());
  }
  writer.write_record(problem, result, identity, warnings);
}

}  // namespace dygita

#include "run/run_files.hpp"

#include "base/log.hpp"
#include "drawing/scene_file.hpp"
#include "drawing/turning_file.hpp"
#include "files/run_record.hpp"
#include "report/report.hpp"
#include "report/view_script.hpp"

namespace dygita {

void write_run_files(RunWriter& writer, const Problem& problem, const RunResult& result, const RunIdentity& identity,
                     const std::vector<std::string>& warnings) {
  writer.write_tables(problem, result);
  if (result.scenes) writer.write(scene_file, scene_text(problem, *result.scenes));
  try {
    if (const std::string motion = result.scenes ? motion_text(problem, result.scenes->motion) : ""; !motion.empty())
      writer.write(motion_file, motion);
    const std::string record = run_record(problem, result, identity, warnings, {});
    writer.write(own_file::report, report_html(writer.directory(), {.record = record}));
  } catch (const std::exception& error) {
    warn(std::string("no report.html: ") + error.what());
  }
  writer.write_record(problem, result, identity, warnings);
}

void write_view(RunWriter& writer, const Problem& problem, const std::filesystem::path& folder) {
  if (const std::string script = view_script(problem, writer.frames(), folder); !script.empty())
    writer.write(view_file, script);
}

}  // namespace dygita

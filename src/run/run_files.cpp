#include "run/run_files.hpp"

#include "base/log.hpp"
#include "base/names.hpp"
#include "drawing/scene_file.hpp"
#include "drawing/turning_file.hpp"
#include "files/run_record.hpp"
#include "report/report.hpp"
#include "report/view_script.hpp"

namespace dygita {

namespace {

// What the report turns of natural modes.
void write_shapes(RunWriter& writer, const Problem& problem, const RunResult& result) {
  for (const OutputPtr& output : problem.outputs)
    if (const std::vector<Frame>& frames = result.findings_of(*output).frames;
        !frames.empty() && !frames.front().parts.empty())
      if (const std::string shapes = shapes_text(problem, frames); !shapes.empty())
        writer.write(shapes_file(file_name_of(output->name)), shapes);
}

}  // namespace

void write_run_files(RunWriter& writer, const Problem& problem, const RunResult& result, const RunIdentity& identity,
                     const std::vector<std::string>& warnings) {
  writer.write_tables(problem, result);
  if (result.scenes) writer.write(scene_file, scene_text(problem, result));
  try {
    if (const std::string motion = result.scenes ? motion_text(problem, result.scenes->motion) : ""; !motion.empty())
      writer.write(motion_file, motion);
    write_shapes(writer, problem, result);
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

// The picture that turns, from motion.json.
#include "drawing/turning_file.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

std::string motion_section(const RunFolder& run) {
  const std::string json = run.file_text(motion_file);
  if (json.empty()) return "";
  if (!Json::accept(json))
    return doubted_section(run, "The motion",
                           html::paragraph(std::string(motion_file) + " is damaged: no picture turns."));
  return doubted_section(
      run, "The motion",
      turning_figure(
          json, "The assembly in motion",
          "Drag to turn, with Shift to move, Ctrl and the wheel (or + and −) to zoom. Frames are evenly spaced in each "
          "step and "
          "include the instant of largest strain energy. A cut begins in the middle of the most stressed part. "
          "Values are on the report's own, coarser mesh: "
          "displacements "
          "rounded to 1/32767 and cube roots of stresses to 1/255 of a frame's largest; ParaView files have full "
          "precision."));
}

}  // namespace dygita

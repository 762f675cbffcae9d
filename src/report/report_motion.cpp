// The picture that turns, from motion.json.
#include "drawing/turning_file.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

std::string motion_section(const RunFolder& run) {
  const std::string json = run.file_text(motion_file);
  if (json.empty()) return "";
  if (!Json::accept(json))
    return html::section("The motion", html::paragraph(std::string(motion_file) + " is damaged: no picture turns."));
  return html::section(
      "The motion",
      turning_figure(
          json, "The assembly in motion",
          "Drag to turn, with Shift to move, Ctrl and the wheel (or + and −) to zoom. Frames are even over each step, "
          "the instant of largest strain energy with them. Values are those of the report's own, smaller mesh: "
          "displacements "
          "rounded to 1/32767 and stresses to 1/255 of a frame's largest; files for ParaView hold them in full."));
}

}  // namespace dygita

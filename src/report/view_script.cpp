#include "report/view_script.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "drawing/picture.hpp"
#include "drawing/units.hpp"
#include "report/embedded.hpp"

namespace dygita {

namespace {

bool is_motion(const Problem& problem, const FrameSummary& frame) {
  return std::any_of(problem.steps.begin(), problem.steps.end(),
                     [&](const StepPtr& step) { return step->name == frame.step && !step->is_static; });
}

// The frame to show first.
const FrameSummary& shown(const Problem& problem, const std::vector<FrameSummary>& frames) {
  const bool has_motion =
      std::any_of(frames.begin(), frames.end(), [&](const FrameSummary& f) { return is_motion(problem, f); });
  const bool has_stress = std::any_of(frames.begin(), frames.end(), [](const auto& f) { return f.von_mises > 0.0; });
  const FrameSummary* best = nullptr;
  for (const FrameSummary& frame : frames) {
    if (has_motion && !is_motion(problem, frame)) continue;
    const auto size = [&](const FrameSummary& f) { return has_stress ? f.von_mises : f.displacement; };
    if (!best || size(frame) > size(*best)) best = &frame;
  }
  return *best;
}

double largest(const std::vector<FrameSummary>& frames, double FrameSummary::*value) {
  double result = 0.0;
  for (const FrameSummary& frame : frames) result = std::max(result, frame.*value);
  return result;
}

double warp(const View& view, double displacement) {
  Points u = Points::Zero(3, 1);
  u(0, 0) = displacement;
  const double scale = picture_scale(view, {u});
  return scale > 0.0 ? scale : 1.0;
}

// Of the axes that look across the picture the one that looks most towards the reader.
Vec3 clip_normal(const View& view) {
  if (view.is_cut) return view.cut;
  int up = 0, axis = 0;
  view.axes.row(1).cwiseAbs().maxCoeff(&up);
  Vec3 towards = view.axes.row(2).transpose().cwiseAbs();
  towards[up] = 0.0;
  towards.maxCoeff(&axis);
  return Vec3::Unit(axis) * (view.axes(2, axis) > 0.0 ? 1.0 : -1.0);
}

std::string text(const std::string& value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

enum class Literal { text, file, file_or_none, number, vector, truth };

// What the script starts with.
constexpr std::pair<const char*, Literal> constants[] = {
    {"PROBLEM", Literal::text},       {"PROBLEM_FILE", Literal::file}, {"INTERFACES_FILE", Literal::file_or_none},
    {"WARP", Literal::number},        {"TITLE", Literal::text},        {"TIME", Literal::number},
    {"FIELD", Literal::text},         {"FIELD_TITLE", Literal::text},  {"TOP", Literal::number},
    {"PRESSURE", Literal::number},    {"CENTRE", Literal::vector},     {"SIZE", Literal::number},
    {"HALF_HEIGHT", Literal::number}, {"HALF_WIDTH", Literal::number}, {"EYE", Literal::vector},
    {"UP", Literal::vector},          {"NORMAL", Literal::vector},     {"IS_CUT", Literal::truth}};

bool is_number(const nlohmann::json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

// As Python has it; nothing where it is no such literal.
std::string python(const std::string& written, Literal literal) {
  if (literal == Literal::truth) return written == "True" || written == "False" ? written : "";
  if (literal == Literal::file_or_none && written == "None") return written;
  const nlohmann::json value = nlohmann::json::parse(written, nullptr, false);
  if (literal == Literal::number) return is_number(value) ? fmt::format("{}", value.get<double>()) : "";
  if (literal == Literal::vector) {
    if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), is_number)) return "";
    return fmt::format("[{}, {}, {}]", value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
  }
  if (!value.is_string()) return "";
  const std::string plain = value.get<std::string>();
  return literal == Literal::text || plain == file_name_of(plain) ? value.dump() : "";
}

std::string vector(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

}  // namespace

std::string view_script(const Problem& problem, const std::vector<FrameSummary>& frames,
                        const std::filesystem::path& folder) {
  if (frames.empty()) return "";
  const View view = view_of(problem.substructures);
  const double von_mises = largest(frames, &FrameSummary::von_mises),
               displacement = largest(frames, &FrameSummary::displacement), scale = warp(view, displacement);
  const bool has_interfaces =
      std::any_of(frames.begin(), frames.end(), [](const FrameSummary& f) { return f.has_interfaces; });
  std::string script =
      "# Sets ParaView up for this run: dygita view RUN, or paraview --script=view.py, or pvpython view.py "
      "picture.png\n";
  const auto put = [&script](const char* name, const std::string& value) {
    script += fmt::format("{} = {}\n", name, value);
  };
  put("PROBLEM", text(problem.name));
  put("PROBLEM_FILE", text(file_name_of(problem.name) + ".pvd"));
  put("INTERFACES_FILE", has_interfaces ? "\"interfaces.pvd\"" : "None");
  put("FOLDER", text(std::filesystem::absolute(folder).string()));
  put("WARP", fmt::format("{}", scale));
  const int missed = frames.back().missed;
  put("TITLE",
      text(problem.name + (scale == 1.0 ? "" : fmt::format(", displacements x {:g}", scale)) +
           (missed > 0 ? fmt::format("\nNOT CONVERGED: {} increment{}", missed, missed == 1 ? "" : "s") : "")));
  put("TIME", fmt::format("{}", shown(problem, frames).label_time));
  put("FIELD", von_mises > 0.0 ? "\"von_mises\"" : "\"displacement\"");
  put("FIELD_TITLE", von_mises > 0.0 ? "\"von Mises stress (Pa)\"" : "\"displacement (m)\"");
  put("TOP", fmt::format("{}", von_mises > 0.0 ? von_mises : displacement));
  put("PRESSURE", fmt::format("{}", largest(frames, &FrameSummary::pressure)));
  put("CENTRE", vector(view.centre));
  put("SIZE", fmt::format("{}", view.size));
  put("HALF_HEIGHT", fmt::format("{}", 0.58 * view.size * view.height / view.width));
  put("HALF_WIDTH", fmt::format("{}", 0.58 * view.size));
  put("EYE", vector(view.axes.row(2).transpose()));
  put("UP", vector(view.axes.row(1).transpose()));
  put("NORMAL", vector(clip_normal(view)));
  put("IS_CUT", view.is_cut ? "True" : "False");
  return script + "\n" + embedded_text("view.py");
}

std::string view_script_again(const std::string& kept, const std::filesystem::path& folder,
                              const std::filesystem::path& own) {
  std::map<std::string, std::string> written;
  std::istringstream lines(kept);
  for (std::string line; std::getline(lines, line);)
    if (const size_t at = line.find(" = "); at != std::string::npos)
      written.emplace(line.substr(0, at), line.substr(at + 3));
  std::string script = fmt::format("RUN = {}\n", text(folder.string()));
  for (const auto& [name, literal] : constants) {
    const std::string value = python(written[name], literal);
    if (value.empty())
      throw InputError(
          fmt::format("'{}' is not as a run of dygita writes it, or damaged: it gives no {}\n    run the "
                      "deck again",
                      (folder / view_file).string(), name));
    script += fmt::format("{} = {}\n", name, value);
  }
  return script + "\n" + embedded_text("view.py") +
         fmt::format("\nimport shutil\n\nshutil.rmtree({}, ignore_errors=True)\n", text(own.string()));
}

}  // namespace dygita

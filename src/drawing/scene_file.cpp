#include "drawing/scene_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/parallel.hpp"
#include "drawing/close_up.hpp"
#include "drawing/cut_plane.hpp"
#include "drawing/joint_map.hpp"
#include "drawing/picture.hpp"
#include "model/extent.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

// Three significant digits: short in the file.
Json rounded(double value) {
  if (!std::isfinite(value) || value == 0.0) return value == 0.0 ? Json(0) : Json();
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
  const double digits = std::round(value / unit);
  // Dividing by a power of ten gives the shortest text where multiplying by its inverse would not.
  return unit < 1.0 ? digits / std::round(1.0 / unit) : digits * unit;
}

constexpr double value_steps = 1e6;  // up to the largest: beside a peak the rest still tells

// Each facet: part, light (%), value, number of corners, then their places.
Json json_of(const Picture& picture) {
  Json facets = Json::array();
  const double unit = picture.value_high > 0.0 ? value_steps / picture.value_high : 0.0;
  for (const PictureFacet& facet : picture.facets) {
    facets.push_back(facet.part);
    facets.push_back(std::lround(100.0 * facet.light));
    facets.push_back(std::lround(unit * facet.value));
    facets.push_back(facet.corners.size());
    for (const std::array<int, 2>& corner : facet.corners) facets.insert(facets.end(), {corner[0], corner[1]});
  }
  return {{"width", picture.width},     {"height", picture.height},
          {"cut", picture.is_cut},      {"boundary_facets", picture.n_facets},
          {"axes", picture.axes},       {"largest", picture.value_high},
          {"value_steps", value_steps}, {"facets", std::move(facets)},
          {"edges", picture.edges},     {"outline", picture.outline}};
}

// m; what is not finite is told as it is.
double largest(const std::vector<Points>& displacement) {
  double largest = 0.0;
  for (const Points& u : displacement)
    for (Eigen::Index i = 0; i < u.cols(); ++i) {
      const double length = u.col(i).norm();
      if (!std::isfinite(length)) return length;
      largest = std::max(largest, length);
    }
  return largest;
}

// Where the pictures are seen from: the whole assembly and, where there is something to see inside, cut open.
struct Views {
  View whole;
  std::optional<View> cut;
  std::string cut_text;
};

// Through the bolts where there are any, else through the middle where a part is hidden.
Views views_of(const Problem& problem) {
  Views views{view_of(problem.substructures), {}, {}};
  if (const std::optional<CutPlane> plane = plane_through_bolts(problem, views.whole)) {
    views.cut = views.whole;
    views.cut->is_cut = true;
    views.cut->cut = plane->normal;
    views.cut->cut_at = plane->point;
    views.cut_text = plane->text;
  } else if (views.whole.is_cut) {
    views.cut = views.whole;
    views.cut_text = "through the middle, " + plane_text(views.whole.cut, views.whole.cut_at);
  }
  views.whole.is_cut = false;
  return views;
}

Json stress_picture(const Problem& problem, const View& view, const AssemblyScene& scene) {
  const double scale = picture_scale(view, scene.displacement);
  Json json = json_of(make_picture(problem.substructures, view, scene.displacement, scene.von_mises, scale));
  json["colour"] = "von_mises";
  json["step"] = scene.step;
  json["static"] = scene.is_static;
  json["time"] = scene.time;
  json["missed"] = scene.missed;
  json["scale"] = scale;
  const double moved = largest(scene.displacement);
  json["largest_displacement"] = std::isfinite(moved) ? Json(moved) : Json();
  return json;
}

Json shape_picture(const Problem& problem, const View& view) {
  Json json = json_of(make_picture(problem.substructures, view, {}, {}, 0.0));
  json["colour"] = "part";
  return json;
}

Json assembly(const Problem& problem, const Scenes& scenes) {
  const Views views = views_of(problem);
  std::vector<std::pair<const AssemblyScene*, bool>> wanted;  // none: the shape; is it cut?
  const auto want = [&](const AssemblyScene* scene) {
    wanted.emplace_back(scene, false);
    if (views.cut) wanted.emplace_back(scene, true);
  };
  want(nullptr);
  for (const AssemblyScene& scene : scenes.assembly) want(&scene);
  std::vector<Json> pictures(wanted.size());
  parallel_for(static_cast<int>(wanted.size()), [&](int i) {
    const auto& [scene, is_cut] = wanted[static_cast<size_t>(i)];
    const View& view = is_cut ? *views.cut : views.whole;
    Json picture = scene ? stress_picture(problem, view, *scene) : shape_picture(problem, view);
    if (is_cut) picture["cut_text"] = views.cut_text;
    pictures[static_cast<size_t>(i)] = std::move(picture);
  });
  return pictures;
}

// The first modes that are no motions at 0 Hz, of each output that has shapes of the parts.
Json shapes(const Problem& problem, const RunResult& result) {
  constexpr size_t most_modes = 6;
  constexpr double drawn_as = 0.08;  // of the view's width, the largest displacement
  View view = view_of(problem.substructures);
  view.is_cut = false;
  std::vector<std::tuple<const Output*, size_t, const Frame*>> wanted;
  for (const OutputPtr& output : problem.outputs) {
    const std::vector<Frame>& frames = result.findings_of(*output).frames;
    size_t n = 0;
    for (size_t i = 0; i < frames.size() && n < most_modes; ++i) {
      if (frames[i].parts.empty() || frames[i].time <= 0.0) continue;
      wanted.emplace_back(output.get(), i, &frames[i]);
      ++n;
    }
  }
  std::vector<Json> pictures(wanted.size());
  parallel_for(static_cast<int>(wanted.size()), [&](int k) {
    const auto& [output, i, frame] = wanted[static_cast<size_t>(k)];
    std::vector<Points> displacement;
    std::vector<Vec> moved;
    for (const PartFrame& part : frame->parts) {
      displacement.push_back(part.displacement);
      moved.push_back(part.displacement.colwise().norm().transpose());
    }
    Json picture = json_of(make_picture(problem.substructures, view, displacement, moved, drawn_as * view.size));
    picture["output"] = output->name;
    picture["mode"] = i + 1;
    picture["frequency"] = frame->time;
    picture["missed"] = frame->missed;
    pictures[static_cast<size_t>(k)] = std::move(picture);
  });
  return pictures;
}

// A place where the run came nearest to a limit.
struct Limit {
  std::string kind, name;  // "stress", "failure_index" of a part; "slip", "opening" of a contact
  double value = 0.0;      // Pa, 1, m
  Vec3 place = Vec3::Zero();
  int part = -1;  // drawn
};

double diagonal(const Problem& problem, int part) {
  const Box box = extent_of(*problem.substructures[static_cast<size_t>(part)]);
  return (box.high - box.low).norm();
}

// The smaller part of a contact, which its place is a larger share of.
int smaller_part(const Problem& problem, const std::vector<int>& parts) {
  return *std::min_element(parts.begin(), parts.end(),
                           [&](int a, int b) { return diagonal(problem, a) < diagonal(problem, b); });
}

// The largest slip and opening, of the motion where there is one, else of the end of the static steps.
std::vector<Limit> limits_of_contacts(const Problem& problem, const RunResult& result) {
  constexpr double least = 1e-9;  // m, that is worth a picture
  Limit slip{"slip", "", least, Vec3::Zero(), -1}, opening{"opening", "", least, Vec3::Zero(), -1};
  const auto raise = [&](Limit& limit, const ContactSummary& contact, double value, const Vec3& place) {
    if (value > limit.value) limit = {limit.kind, contact.name, value, place, smaller_part(problem, contact.parts)};
  };
  for (const ContactSummary& contact : result.contacts) {
    if (contact.steps.empty() || contact.parts.empty()) continue;
    const auto is_static = [&](const ContactStep& step) {
      return problem.steps[static_cast<size_t>(step.step)]->is_static;
    };
    const bool rests = std::all_of(contact.steps.begin(), contact.steps.end(), is_static);
    for (const ContactStep& step : contact.steps) {
      if (rests ? &step != &contact.steps.back() : is_static(step)) continue;
      raise(slip, contact, step.slip.value_or(0.0), step.slip_at);
      raise(opening, contact, step.opening, step.opening_at);
    }
  }
  std::vector<Limit> limits;
  for (const Limit& limit : {slip, opening})
    if (limit.part >= 0) limits.push_back(limit);
  return limits;
}

Json limits(const Problem& problem, const RunResult& result) {
  const StressedPart& stressed = result.scenes->stressed;
  std::vector<Limit> wanted = limits_of_contacts(problem, result);
  for (const PartStress& peak : result.stresses)
    if (peak.part == stressed.part)
      wanted.insert(wanted.begin(),
                    {stressed.is_index ? "failure_index" : "stress",
                     problem.substructures[static_cast<size_t>(peak.part)]->name, peak.largest, peak.place, peak.part});
  Json list = Json::array();
  for (const Limit& limit : wanted) {
    const bool is_stress = limit.kind == "stress" || limit.kind == "failure_index";
    const CloseUp close_up =
        make_close_up(problem.substructures, limit.part, limit.place, is_stress ? stressed.value : Vec());
    Json json = json_of(close_up.picture);
    json["around"] = close_up.around;
    json["mark"] = close_up.mark;
    json["kind"] = limit.kind;
    json["name"] = limit.name;
    json["part"] = limit.part;
    json["value"] = limit.value;
    json["place"] = {limit.place[0], limit.place[1], limit.place[2]};
    if (is_stress) {
      json["step"] = stressed.step;
      json["time"] = stressed.time;
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json values(const std::vector<float>& of_points, const JointMap& map) {
  Json list = Json::array();
  for (const std::vector<int>& points : map.points) list.push_back(rounded(mean_of_cell(of_points, points)));
  return list;
}

Json joint(const JointScenes& joint) {
  const JointMap map = make_joint_map(joint);
  Json json = {{"name", joint.name}, {"contact", joint.is_contact}, {"flat", map.is_flat}};
  if (!map.is_flat) return json;
  const double unit = std::max({map.width, map.height, 1e-12}) / 1000.0;
  json["unit"] = unit;  // m, of the corners' places
  json["size"] = {map.width, map.height};
  json["axes"] = {map.across, map.up};
  Json cells = Json::array(), instants = Json::array();
  for (const auto& cell : map.cells) {
    Json corners = Json::array();
    for (const std::array<double, 2>& corner : cell)
      corners.insert(corners.end(), {std::lround(corner[0] / unit), std::lround(corner[1] / unit)});
    cells.push_back(std::move(corners));
  }
  json["cells"] = std::move(cells);
  for (const JointScene& scene : joint.instants) {
    Json instant = {{"step", scene.step}, {"static", scene.is_static}, {"time", scene.time}, {"missed", scene.missed}};
    Json states = Json::array();
    for (const std::vector<int>& points : map.points) states.push_back(state_of_cell(scene.status, points));
    instant["state"] = std::move(states);
    instant["pressure"] = values(scene.pressure, map);
    if (!scene.slip.empty()) instant["slip"] = values(scene.slip, map);
    if (!scene.plastic_opening.empty()) instant["plastic_opening"] = values(scene.plastic_opening, map);
    instants.push_back(std::move(instant));
  }
  json["instants"] = std::move(instants);
  return json;
}

}  // namespace

std::string scene_text(const Problem& problem, const RunResult& result) {
  const Scenes& scenes = *result.scenes;
  Json joints = Json::array();
  for (const JointScenes& scene : scenes.joints) joints.push_back(joint(scene));
  Json json = {{"assembly", assembly(problem, scenes)}, {"joints", std::move(joints)}};
  if (Json nearest = limits(problem, result); !nearest.empty()) json["limits"] = std::move(nearest);
  if (Json of_modes = shapes(problem, result); !of_modes.empty()) json["shapes"] = std::move(of_modes);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dygita

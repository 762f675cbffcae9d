#include "deck/pick_places.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/log.hpp"
#include "deck/arguments.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/pick_facets.hpp"
#include "mesh/smooth_patches.hpp"

namespace dygita {

namespace {

// As a deck writes places and directions: in its axes, or in those of a frame.
struct View {
  Mat3 axes = Mat3::Identity();  // columns
  Vec3 origin = Vec3::Zero();    // m
  bool is_frame = false;

  Vec3 place(const Vec3& x) const { return axes.transpose() * (x - origin); }
  Vec3 direction(const Vec3& v) const { return axes.transpose() * v; }
  double height(double at, const Vec3& normal) const { return at - normal.dot(origin); }
  // What turning leaves of nothing is nothing.
  static double plain(double value, double size) { return std::abs(value) < 1e-12 * size ? 0.0 : value; }
  const char* called() const { return is_frame ? " of the frame" : ""; }
};

View view_of(const LuaArguments& a) {
  if (!a.has("seen_from")) return {};
  const std::vector<double> p = a.numbers("seen_from");  // of a placement, lua/placement.lua
  CHECK(p.size() == 12, "a frame is twelve numbers");
  View view;
  view.axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p.data());
  view.origin = Vec3(p[9], p[10], p[11]);
  view.is_frame = true;
  return view;
}

std::string extent(const Points& nodes, const Vec3& place, const View& view) {
  const Points seen = view.axes.transpose() * (nodes.colwise() + (place - view.origin));
  const double size = view.is_frame ? seen.cwiseAbs().maxCoeff() : 0.0;
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += fmt::format("{}{} [{:g}, {:g}]", i ? ", " : "", "xyz"[i], View::plain(seen.row(i).minCoeff(), size),
                        View::plain(seen.row(i).maxCoeff(), size));
  return text + " m" + view.called();
}

// Does the deck's function at stack index `function` answer true at x?
bool answers_true(lua_State* L, int function, const Vec3& x, const std::string& part, const Origin& origin) {
  lua_pushvalue(L, function);
  for (int d = 0; d < 3; ++d) lua_pushnumber(L, x[d]);
  lua_call(L, 3, 1);
  if (!lua_isboolean(L, -1))
    throw InputError(origin,
                     fmt::format("substructure '{}': the function of 'where' must return true or false, got {}\n"
                                 "    is its 'return' missing?",
                                 part, luaL_typename(L, -1)));
  const bool answer = lua_toboolean(L, -1);
  lua_pop(L, 1);
  return answer;
}

}  // namespace

Region region_of(const SubstructurePtr& part, lua_State* L, const Origin& origin) {
  Region region{part, {}};
  const Points& nodes = part->mesh->nodes;
  const bool is_in_frame = lua_istable(L, 3);
  const View view = is_in_frame ? view_of(LuaArguments(L, 3, "substructure:where", origin, "")) : View();
  if (is_in_frame) lua_getfield(L, 3, "where");
  const int function = is_in_frame ? lua_gettop(L) : 3;
  for (int i = 0; i < part->mesh->n_nodes(); ++i) {
    if (!part->mesh->inside->is_place(i)) continue;
    const Vec3 x = nodes.col(i) + part->place;
    if (answers_true(L, function, x, part->name, origin)) region.nodes.push_back(i);
  }
  if (region.nodes.empty()) {
    throw InputError(origin,
                     fmt::format("substructure '{}': 'where' selects none of its {} nodes\n    they span {}; compare "
                                 "coordinates with near(a, b)",
                                 part->name, part->mesh->n_nodes(), extent(nodes, part->place, view)));
  }
  return region;
}

namespace {

// Where along a normal there are facets of it: "; along that normal there are some at 0.06 m".
std::string places_along(const Substructure& part, FacetPick pick, const View& view) {
  if (!pick.at) return "";
  pick.at.reset();
  std::set<double> places;
  for (const Facet& facet : pick_facets(*part.mesh, part.place, pick)) {
    Vec3 middle = Vec3::Zero();
    for (const int node : facet.corners()) middle += part.mesh->nodes.col(node) + part.place;
    const double at = pick.normal->dot(middle) / static_cast<double>(facet.corners().size());
    places.insert(std::stod(fmt::format("{:.6g}", view.height(at, *pick.normal))));
  }
  constexpr size_t most = 5;
  if (places.empty() || places.size() > most) return places.empty() ? "; no facet matches at any 'at'" : "";
  std::string list;
  for (const double at : places) list += fmt::format("{}{:g}", list.empty() ? "" : ", ", at);
  return "; 'at' is measured along the normal: facets match at " + list + " m";
}

// Surfaces at one height along a normal.
struct Level {
  double at = 0.0, area = 0.0;  // m, m^2
  Vec3 moment = Vec3::Zero();
  int n_facets = 0;
};

// A normal by itself fits steps and recesses, too: "16 facets of 400 mm^2 around (5, 5, 10) mm ('at' = 0.01), ...",
// where it fits surfaces at several heights.
std::string several_levels(const Substructure& part, const Vec3& normal, const std::vector<Facet>& facets,
                           const View& view) {
  constexpr double alike = 1e-4;  // of the part's size
  constexpr size_t most_told = 5;
  std::vector<Vec3> areas, normals;
  for (const Facet& facet : facets) {
    areas.push_back(facet_area_vector(part.mesh->nodes, facet));
    normals.push_back(areas.back().normalized());
  }
  std::map<int, Level> surfaces;
  const std::vector<int> patch = smooth_patches(facets, normals);
  for (size_t f = 0; f < facets.size(); ++f) {
    Vec3 middle = part.place;
    for (const int node : facets[f].corners())
      middle += part.mesh->nodes.col(node) / static_cast<double>(facets[f].corners().size());
    Level& surface = surfaces[patch[f]];
    surface.area += areas[f].norm();
    surface.moment += areas[f].norm() * middle;
    ++surface.n_facets;
  }
  const Points& x = part.mesh->nodes;
  const double same = alike * (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  std::vector<Level> levels;
  for (auto& [number, surface] : surfaces) {
    surface.at = normal.dot(surface.moment) / surface.area;
    const auto known = std::find_if(levels.begin(), levels.end(), [at = surface.at, same](const Level& level) {
      return std::abs(level.at - at) <= same;
    });
    Level& level = known == levels.end() ? levels.emplace_back(Level{surface.at, 0.0, Vec3::Zero(), 0}) : *known;
    level.area += surface.area;
    level.moment += surface.moment;
    level.n_facets += surface.n_facets;
  }
  if (levels.size() < 2) return "";
  std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.area > b.area; });
  std::string text;
  for (size_t i = 0; i < std::min(levels.size(), most_told); ++i) {
    const Vec3 centre = 1e3 * view.place(levels[i].moment / levels[i].area);
    text += fmt::format("{}{} facets, {:.4g} mm^2 around ({:.4g}, {:.4g}, {:.4g}) mm (at = {:.6g})", i == 0 ? "" : "; ",
                        levels[i].n_facets, 1e6 * levels[i].area, centre[0], centre[1], centre[2],
                        view.height(levels[i].at, normal));
  }
  return fmt::format("surfaces at {} heights{}: {}{}", levels.size(), view.called(), text,
                     levels.size() > most_told ? "; ..." : "");
}

// What the deck asks of a face: "normal 0 0 1, at 0.01 m".
std::string told_as(const LuaArguments& a, const FacetPick& pick, const View& view) {
  std::string text;
  const auto note = [&](const std::string& one) { text += (text.empty() ? "" : ", ") + one; };
  const auto vector = [&](Vec3 v) {
    for (double& x : v) x = View::plain(x, view.is_frame ? v.norm() : 0.0);
    return fmt::format("{:.4g} {:.4g} {:.4g}", v[0], v[1], v[2]);
  };
  if (pick.normal) note("normal " + vector(view.direction(*pick.normal)));
  if (pick.at) note(fmt::format("at {:g} m", pick.normal ? view.height(*pick.at, *pick.normal) : *pick.at));
  if (pick.radius) note(fmt::format("radius {:g} m", *pick.radius));
  if (pick.axis) note("axis " + vector(view.direction(*pick.axis)));
  if (pick.is_cylinder) note("cylinder");
  if (pick.box) note("from " + vector(pick.box->first) + " to " + vector(pick.box->second) + " m");
  if (view.is_frame && a.has("box")) {
    const std::vector<double> box = a.numbers("box");
    note("from " + vector({box[0], box[1], box[2]}) + " to " + vector({box[3], box[4], box[5]}) + " m");
  } else if (pick.where) {
    note("where");
  }
  return text + (text.empty() ? "" : view.called());
}

}  // namespace

Face picked_face(const std::filesystem::path& folder, const SubstructurePtr& part, lua_State* L, const Origin& origin) {
  const LuaArguments a(L, 3, "substructure:face", origin, folder);
  FacetPick pick;
  if (a.has("normal")) pick.normal = a.unit_vector("normal");
  if (a.has("at")) pick.at = a.number("at");
  if (a.has("radius")) pick.radius = a.number("radius");
  if (a.has("axis")) pick.axis = a.unit_vector("axis");
  pick.is_cylinder = a.boolean("cylinder");
  if (a.has("low") != a.has("high")) throw InputError(origin, "'low' and 'high' are two corners of a box: give both");
  if (a.has("low")) pick.box = {a.vector("low"), a.vector("high")};
  if (pick.at && !pick.normal) throw InputError(origin, "'at' is a position along 'normal', which is missing");
  if ((pick.radius || pick.axis) && !pick.is_cylinder)
    throw InputError(origin, "'radius' and 'axis' require cylinder = true");
  if (a.is_function("where")) {
    lua_getfield(L, 3, "where");
    const int function = lua_gettop(L);
    pick.where = [&, function](const Vec3& x) { return answers_true(L, function, x, part->name, origin); };
  }
  const View view = view_of(a);
  const std::string by = told_as(a, pick, {}), told = told_as(a, pick, view);  // which it is called by, and in the deck
  if (by.empty()) throw InputError(origin, "part:face{} requires 'normal', 'cylinder', 'low' and 'high', or 'where'");
  const auto facets = std::make_shared<const std::vector<Facet>>(pick_facets(*part->mesh, part->place, pick));
  if (facets->empty())
    throw InputError(
        origin, fmt::format("substructure '{}' has no facet on its boundary of {}\n    it spans {}{}", part->name, told,
                            extent(part->mesh->nodes, part->place, view), places_along(*part, pick, view)));
  if (pick.normal && !pick.at && !pick.where && !pick.is_cylinder)
    if (const std::string levels = several_levels(*part, *pick.normal, *facets, view); !levels.empty())
      warn(fmt::format(
          "{}substructure '{}': face ({}) is {}; 'at' selects one of them, a 'where' that returns true confirms all",
          origin.prefix(), part->name, told, levels));
  return {part, "(" + by + ")", facets};
}

}  // namespace dygita

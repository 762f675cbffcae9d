#include "drawing/close_up.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/item_buffer.hpp"
#include "drawing/picture_mesh.hpp"

namespace dygita {

namespace {

constexpr double context = 1.6;       // of the part's own extent, what is seen around it
constexpr size_t most_around = 1500;  // lines of other parts, the longest
constexpr int most_facets = 2500;

// The part from one of its sides, with some room around it.
View seen_from(const SubstructurePtr& part, double turn, double elevation) {
  View view = view_of_side({part}, turn, elevation);
  view.size *= context;
  return view;
}

View view_that_shows(const SubstructurePtr& part, const Vec3& place) {
  const double tolerance = 0.01;  // of the view's width
  for (const double elevation : {35.264, -35.264})
    for (const double turn : {0.0, 90.0, 180.0, 270.0}) {
      const View view = seen_from(part, turn, elevation);
      if (is_seen({part}, view, place, tolerance)) return view;
    }
  return seen_from(part, 0.0, 35.264);
}

// Lines that reach into the picture, the longest first.
std::vector<std::array<int, 4>> lines_around(const std::vector<SubstructurePtr>& parts, int part, const View& view) {
  const Skin skin = make_skin(parts, view, {}, {}, 0.0);
  const Points p = projected(skin.position, view);
  const auto is_near = [&](int node) {
    return std::abs(p(0, node) - 0.5 * view.width) < view.width &&
           std::abs(p(1, node) - 0.5 * view.height) < view.width;
  };
  std::vector<std::array<int, 4>> lines;
  for (const SharpEdge& edge : sharp_edges(skin)) {
    if (skin.part[static_cast<size_t>(edge.facet)] == part || !is_near(edge.a) || !is_near(edge.b)) continue;
    const auto a = tenths(p, edge.a), b = tenths(p, edge.b);
    lines.push_back({a[0], a[1], b[0], b[1]});
  }
  const auto length = [](const std::array<int, 4>& l) { return std::hypot(l[2] - l[0], l[3] - l[1]); };
  std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) { return length(a) > length(b); });
  if (lines.size() > most_around) lines.resize(most_around);
  return lines;
}

}  // namespace

CloseUp make_close_up(const std::vector<SubstructurePtr>& parts, int part, const Vec3& place, const Vec& values) {
  const SubstructurePtr& subject = parts[static_cast<size_t>(part)];
  const View view = view_that_shows(subject, place);
  CloseUp close_up;
  close_up.picture = make_picture({subject}, view, {},
                                  values.size() > 0 ? std::vector<Vec>{values} : std::vector<Vec>(), 0.0, most_facets);
  for (PictureFacet& facet : close_up.picture.facets) facet.part = part;
  close_up.around = lines_around(parts, part, view);
  close_up.mark = tenths(projected(place, view), 0);
  return close_up;
}

}  // namespace dygita

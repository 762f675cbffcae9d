#include "drawing/picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "drawing/item_buffer.hpp"
#include "drawing/picture_mesh.hpp"
#include "model/extent.hpp"

namespace dygita {

namespace {

constexpr double picture_margin = 24.0;  // px
constexpr double isometric = 35.264;     // degrees

// Along which axis something is long and thin; -1: it is not.
int long_axis(const Box& box) {
  const Vec3 extent = box.high - box.low;
  int longest = 0;
  const double length = extent.maxCoeff(&longest);
  return length > 2.5 * std::max(extent[(longest + 1) % 3], extent[(longest + 2) % 3]) ? longest : -1;
}

// Rows: right, up, towards the reader; `right_hand`, `up` are axes of the assembly, angles in degrees.
Mat3 turned(int right_hand, int up, double azimuth, double elevation) {
  const double a = azimuth * M_PI / 180.0, e = elevation * M_PI / 180.0;
  const Vec3 x = Vec3::Unit(right_hand), z = Vec3::Unit(up), y = z.cross(x);
  Mat3 axes;
  axes.row(2) = (std::cos(e) * (std::sin(a) * x - std::cos(a) * y) + std::sin(e) * z).transpose();
  axes.row(0) = (std::cos(a) * x + std::sin(a) * y).transpose();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

void draw(ItemBuffer& buffer, const Skin& skin, const Points& p, int i_facet) {
  const SkinFacet& f = skin.facets[i_facet];
  for (int k = 2; k < f.n_corners; ++k) {
    const int n[3] = {f.corners[0], f.corners[k - 1], f.corners[k]};
    buffer.draw(i_facet, {p(0, n[0]), p(0, n[1]), p(0, n[2])}, {p(1, n[0]), p(1, n[1]), p(1, n[2])},
                {p(2, n[0]), p(2, n[1]), p(2, n[2])});
  }
}

bool faces_reader(const Skin& skin, const View& view, int i_facet) {
  return view.axes.row(2).dot(skin.normal(i_facet)) > 0.0;
}

ItemBuffer buffer_of(const Skin& skin, const View& view, const Points& p) {
  ItemBuffer buffer(view.width, view.height);
  for (int f = 0; f < static_cast<int>(skin.facets.size()); ++f)
    if (faces_reader(skin, view, f)) draw(buffer, skin, p, f);
  return buffer;
}

// Edges beside a facet that is seen, not hidden themselves where it matters: at their middle.
std::vector<std::array<int, 4>> seen_edges(const Skin& skin, const View& view, const Points& p,
                                           const ItemBuffer& buffer) {
  std::vector<std::array<int, 4>> lines;
  for (const SharpEdge& edge : sharp_edges(skin)) {
    const Vec3 middle = 0.5 * (p.col(edge.a) + p.col(edge.b));
    if (!buffer.is_in_front(middle[0], middle[1], middle[2], 0.006 * view.width)) continue;
    const auto a = tenths(p, edge.a), b = tenths(p, edge.b);
    lines.push_back({a[0], a[1], b[0], b[1]});
  }
  return lines;
}

// Of how many parts at least a twentieth is seen.
size_t n_parts_seen(const std::vector<SubstructurePtr>& parts, const View& view) {
  const Skin skin = make_skin(parts, view, {}, {}, 0.0);
  const std::vector<char> seen =
      buffer_of(skin, view, projected(skin.position, view)).seen(static_cast<int>(skin.facets.size()));
  std::vector<int> n_seen(parts.size(), 0), n_all(parts.size(), 0);
  for (size_t f = 0; f < seen.size(); ++f) {
    n_seen[skin.part[f]] += seen[f];
    ++n_all[skin.part[f]];
  }
  size_t n = 0;
  for (size_t p = 0; p < parts.size(); ++p) n += n_seen[p] >= 0.05 * n_all[p];
  return n;
}

int n_seen(const std::vector<char>& seen) { return static_cast<int>(std::count(seen.begin(), seen.end(), 1)); }

// Of the diagonals of the parts' boxes.
double largest_part(const std::vector<SubstructurePtr>& parts) {
  double largest = 0.0;
  for (const SubstructurePtr& part : parts) {
    const Box box = extent_of({part});
    largest = std::max(largest, (box.high - box.low).norm());
  }
  return largest;
}

// From the side that hides the fewest parts; all parts are seen?
std::pair<View, bool> clearest_view_of(const std::vector<SubstructurePtr>& parts) {
  const Box box = extent_of(parts);
  View best;
  size_t most = 0;
  for (const double turn : {0.0, 180.0, 90.0, 270.0}) {
    if (long_axis(box) >= 0 && turn != 0.0 && turn != 180.0) continue;  // not along it
    const View view = view_of_side(parts, turn, isometric);
    const size_t n = n_parts_seen(parts, view);
    if (turn == 0.0 || n > most) {
      most = n;
      best = view;
    }
    if (most == parts.size()) break;
  }
  return {best, most == parts.size()};
}

}  // namespace

View view_of_side(const std::vector<SubstructurePtr>& parts, double turn, double elevation) {
  View view;
  const int longest = long_axis(extent_of(parts));
  const double shallow = std::copysign(22.0, elevation);
  view.axes =
      longest >= 0 ? turned(longest, longest == 2 ? 1 : 2, 20.0 + turn, shallow) : turned(0, 2, 45.0 + turn, elevation);
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const SubstructurePtr& part : parts) {
    const Points p = view.axes * (part->mesh->nodes.colwise() + part->place);
    low = low.cwiseMin(p.rowwise().minCoeff());
    high = high.cwiseMax(p.rowwise().maxCoeff());
  }
  view.centre = view.axes.transpose() * (0.5 * (low + high));
  const double across = std::max(high[0] - low[0], 1e-9), up = std::max(high[1] - low[1], 1e-9);
  // Deformed shapes need some room.
  view.size = 1.08 * across;
  double height = up / view.size * (view.width - 2.0 * picture_margin) + 2.0 * picture_margin + 16.0;
  constexpr double highest = 560.0;
  if (height > highest) {
    view.size *= (height - 2.0 * picture_margin) / (highest - 2.0 * picture_margin);
    height = highest;
  }
  view.height = static_cast<int>(std::lround(height));
  return view;
}

Points projected(const Points& x, const View& view) {
  Points p = view.axes * (x.colwise() - view.centre);
  const double pixels = (view.width - 2.0 * picture_margin) / view.size;
  p.row(0) = (0.5 * view.width + pixels * p.row(0).array()).matrix();
  p.row(1) = (0.5 * view.height - pixels * p.row(1).array()).matrix();
  p.row(2) *= pixels;
  return p.cwiseMax(-1e6).cwiseMin(1e6);
}

std::array<int, 2> tenths(const Points& p, int node) {
  return {static_cast<int>(std::lround(10.0 * std::clamp(p(0, node), -1e4, 1e4))),
          static_cast<int>(std::lround(10.0 * std::clamp(p(1, node), -1e4, 1e4)))};
}

bool is_seen(const std::vector<SubstructurePtr>& parts, const View& view, const Vec3& place, double tolerance) {
  const Skin skin = make_skin(parts, view, {}, {}, 0.0);
  const Points p = projected(place, view);
  return buffer_of(skin, view, projected(skin.position, view))
      .is_in_front(p(0, 0), p(1, 0), p(2, 0), tolerance * view.width);
}

View whole_view_of(const std::vector<SubstructurePtr>& parts) { return view_of_side(parts, 0.0, isometric); }

View view_of(const std::vector<SubstructurePtr>& parts) {
  auto [view, shows_all] = clearest_view_of(parts);
  if (shows_all) return view;
  view.is_cut = true;
  // The horizontal axis that looks most towards the reader.
  const int along = long_axis(extent_of(parts));
  Vec3 towards = view.axes.row(2).transpose().cwiseAbs();
  towards[along == 2 ? 1 : 2] = 0.0;
  if (along >= 0) towards[along] = 0.0;
  int axis = 0;
  towards.maxCoeff(&axis);
  view.cut_at = view.centre;
  view.cut = Vec3::Unit(axis) * (view.axes(2, axis) > 0.0 ? 1.0 : -1.0);
  return view;
}

double picture_scale(const View& view, const std::vector<Points>& displacement) {
  double largest = 0.0;
  for (const Points& u : displacement)
    for (Eigen::Index i = 0; i < u.cols(); ++i)
      if (u.col(i).allFinite()) largest = std::max(largest, u.col(i).norm());
  if (!(largest > 0.0) || largest > view.size) return 0.0;
  const double wanted = 0.05 * view.size / largest;
  if (wanted < 1.0) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double m : {5.0, 2.0})
    if (m * power <= wanted) return m * power;
  return power;
}

Picture make_picture(const std::vector<SubstructurePtr>& parts, const View& view,
                     const std::vector<Points>& displacement, const std::vector<Vec>& values, double scale,
                     int most_facets) {
  Picture picture;
  picture.width = view.width;
  picture.height = view.height;
  picture.is_cut = view.is_cut;
  Skin skin = make_skin(parts, view, displacement, values, scale);
  picture.n_facets = static_cast<int>(skin.facets.size());
  for (const Vec& v : values)
    for (const double x : v)
      if (std::isfinite(x)) {
        picture.value_low = std::min(picture.value_low, x);
        picture.value_high = std::max(picture.value_high, x);
      }
  Points p = projected(skin.position, view);
  ItemBuffer buffer = buffer_of(skin, view, p);
  std::vector<char> seen = buffer.seen(picture.n_facets);
  const Skin fine = skin;
  // Each part keeps some facets: of thousands of parts more are drawn.
  const double largest_useful = 2.0 * largest_part(parts);
  for (double size = view.size / std::sqrt(4.0 * most_facets); n_seen(seen) > most_facets && size < largest_useful;
       size *= 1.25) {
    skin = merged(fine, size);
    p = projected(skin.position, view);
    buffer = buffer_of(skin, view, p);
    seen = buffer.seen(static_cast<int>(skin.facets.size()));
  }

  // Back to front by the facets' centres.
  std::vector<int> order;
  std::vector<double> depth(skin.facets.size());
  for (int f = 0; f < static_cast<int>(skin.facets.size()); ++f) {
    // A body is closed: what looks away is seen through a crack of the buffer only, and would be drawn whole.
    if (!seen[f] || view.axes.row(2).dot(skin.normal(f)) < 0.0) continue;
    order.push_back(f);
    const SkinFacet& facet = skin.facets[f];
    for (int k = 0; k < facet.n_corners; ++k) depth[f] += p(2, facet.corners[k]) / facet.n_corners;
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return depth[a] < depth[b]; });
  const Vec3 light = (view.axes.transpose() * Vec3(-0.35, 0.6, 0.72)).normalized();
  for (const int f : order) {
    const SkinFacet& facet = skin.facets[f];
    PictureFacet& flat = picture.facets.emplace_back();
    flat.part = skin.part[f];
    flat.light = std::clamp(light.dot(skin.normal(f).normalized()), 0.0, 1.0);
    for (int k = 0; k < facet.n_corners; ++k) {
      flat.corners.push_back(tenths(p, facet.corners[k]));
      flat.value += skin.value[facet.corners[k]] / facet.n_corners;
    }
  }
  picture.edges = seen_edges(skin, view, p, buffer);
  if (!displacement.empty()) {
    Skin still = skin;
    still.position = still.reference;
    const Points at_rest = projected(still.position, view);
    picture.outline = seen_edges(still, view, at_rest, buffer_of(still, view, at_rest));
  }
  for (int axis = 0; axis < 3; ++axis)
    picture.axes.push_back({static_cast<int>(std::lround(1000 * view.axes(0, axis))),
                            static_cast<int>(std::lround(-1000 * view.axes(1, axis)))});
  return picture;
}

}  // namespace dygita

// Pictures and maps: what is seen, in which order, and how small they stay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "drawing/close_up.hpp"
#include "drawing/item_buffer.hpp"
#include "drawing/joint_map.hpp"
#include "drawing/picture.hpp"
#include "drawing/picture_mesh.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {
namespace {

// A box of n^3 hexahedra.
SubstructurePtr box(int n, double size, const Vec3& place = Vec3::Zero(), double height = 1.0) {
  auto mesh = std::make_shared<Mesh>();
  const int m = n + 1;
  mesh->nodes.resize(3, m * m * m);
  const auto number = [m](int i, int j, int k) { return i + m * (j + m * k); };
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) mesh->nodes.col(number(i, j, k)) = Vec3(i, j, k * height) * (size / n);
  CellBlock block{CellType::hex8, {}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const int node :
             {number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k), number(i, j, k + 1),
              number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1)})
          block.nodes.push_back(node);
  mesh->blocks = {block};
  auto part = std::make_shared<Substructure>();
  part->name = "box";
  part->mesh = mesh;
  part->place = place;
  return part;
}

Picture picture_of(const std::vector<SubstructurePtr>& parts, int most = 2500) {
  return make_picture(parts, view_of(parts), {}, {}, 0.0, most);
}

int of_part(const Picture& picture, int part) {
  return static_cast<int>(std::count_if(picture.facets.begin(), picture.facets.end(),
                                        [part](const PictureFacet& f) { return f.part == part; }));
}

TEST(CloseUp, looks_from_a_side_that_shows_the_place) {
  const std::vector<SubstructurePtr> parts = {box(2, 4.0, Vec3(0, 0, -4)), box(2, 1.0)};  // the small one on the large
  for (const Vec3& place : {Vec3(0.5, 0.5, 0.0), Vec3(0.5, 0.5, 1.0), Vec3(0.0, 0.5, 0.5), Vec3(0.5, 1.0, 0.5)}) {
    const CloseUp close_up = make_close_up(parts, 1, place, {});
    const Picture& picture = close_up.picture;
    ASSERT_GT(picture.facets.size(), 0U);
    for (const PictureFacet& facet : picture.facets) EXPECT_EQ(facet.part, 1);
    EXPECT_GT(close_up.around.size(), 0U);
    // The place is inside some facet that is drawn, which looks the way the place's face does.
    const auto holds = [&](const PictureFacet& facet) {
      bool left = false, right = false;
      for (size_t k = 0; k < facet.corners.size(); ++k) {
        const auto& a = facet.corners[k];
        const auto& b = facet.corners[(k + 1) % facet.corners.size()];
        const long turn = static_cast<long>(b[0] - a[0]) * (close_up.mark[1] - a[1]) -
                          static_cast<long>(b[1] - a[1]) * (close_up.mark[0] - a[0]);
        left |= turn > 20;
        right |= turn < -20;
      }
      return !(left && right);
    };
    EXPECT_TRUE(std::any_of(picture.facets.begin(), picture.facets.end(), holds)) << place.transpose();
  }
  // From below for what is on the underside: the large box hides nothing, since it is drawn as lines.
  const CloseUp under = make_close_up(parts, 1, Vec3(0.5, 0.5, 0.0), {}),
                over = make_close_up(parts, 1, Vec3(0.5, 0.5, 1.0), {});
  EXPECT_NE(under.picture.axes, over.picture.axes);
}

TEST(View, fits_what_is_turned_as_tightly_as_what_lies_along_the_axes) {
  const SubstructurePtr straight = box(2, 1.0, Vec3::Zero(), 0.2);
  auto mesh = std::make_shared<Mesh>(*straight->mesh);
  const double c = std::cos(0.5), s = std::sin(0.5);
  mesh->nodes.topRows(2) = (Eigen::Matrix2d() << c, -s, s, c).finished() * straight->mesh->nodes.topRows(2).eval();
  auto turned = std::make_shared<Substructure>(*straight);
  turned->mesh = mesh;
  // The diagonal of the plate is the most that can be seen of it from any side; the box around the turned one has more.
  EXPECT_LE(whole_view_of({turned}).size, 1.08 * std::sqrt(2.04) + 1e-12);
  const Points p = projected(mesh->nodes, whole_view_of({turned}));
  EXPECT_NEAR(p.row(0).minCoeff() + p.row(0).maxCoeff(), whole_view_of({turned}).width, 1e-6);
  EXPECT_NEAR(p.row(1).minCoeff() + p.row(1).maxCoeff(), whole_view_of({turned}).height, 1.0);
}

TEST(ItemBuffer, keeps_the_nearest) {
  ItemBuffer buffer(10, 10);
  buffer.draw(0, {-5, 25, -5}, {-5, -5, 25}, {1, 1, 1});
  buffer.draw(1, {-5, 25, -5}, {-5, -5, 25}, {0, 0, 0});
  buffer.draw(2, {2, 6, 2}, {2, 2, 6}, {2, 2, 2});
  EXPECT_EQ(buffer.seen(3), (std::vector<char>{1, 0, 1}));
  EXPECT_TRUE(buffer.is_in_front(8.0, 8.0, 1.0, 0.1));
  EXPECT_FALSE(buffer.is_in_front(3.0, 3.0, 0.5, 0.1));
}

// Rows of pixels at once are what each pixel by itself would be, but for centres on a side to rounding; triangles that
// share a side leave no pixel between them.
TEST(ItemBuffer, has_each_pixel_whose_centre_lies_in_a_triangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-8.0, 38.0);
  constexpr int width = 30, height = 24;
  int n_on_side = 0;
  for (int k = 0; k < 400; ++k) {
    double x[4], y[4];
    for (int a = 0; a < 4; ++a) x[a] = k % 4 ? place(random) : std::round(2.0 * place(random)) / 2.0;
    for (int a = 0; a < 4; ++a) y[a] = k % 4 ? place(random) : std::round(2.0 * place(random)) / 2.0;
    ItemBuffer buffer(width, height);
    const double flat[3] = {1.0, 1.0, 1.0};
    buffer.draw(0, {x[0], x[1], x[2]}, {y[0], y[1], y[2]}, flat);
    buffer.draw(0, {x[0], x[2], x[3]}, {y[0], y[2], y[3]}, flat);
    const auto least_share = [&](double px, double py, int b, int c) {
      const auto cross = [&](double x1, double y1, double x2, double y2) {
        return (x1 - px) * (y2 - py) - (x2 - px) * (y1 - py);
      };
      const double area = cross(x[b], y[b], x[c], y[c]) + cross(x[c], y[c], x[0], y[0]) + cross(x[0], y[0], x[b], y[b]);
      return std::min({cross(x[b], y[b], x[c], y[c]) / area, cross(x[c], y[c], x[0], y[0]) / area,
                       cross(x[0], y[0], x[b], y[b]) / area});
    };
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) {
        const double least = std::max(least_share(i + 0.5, j + 0.5, 1, 2), least_share(i + 0.5, j + 0.5, 2, 3));
        n_on_side += std::abs(least) < 1e-8;
        if (std::abs(least) < 1e-8 || !std::isfinite(least)) continue;
        EXPECT_EQ(buffer.item(i, j), least > 0.0 ? 0 : -1) << k << ": " << i << ", " << j;
      }
  }
  EXPECT_GT(n_on_side, 10);
}

TEST(Picture, shows_the_three_sides_of_a_box_that_face_the_reader) {
  const Picture picture = picture_of({box(4, 0.01)});
  EXPECT_EQ(picture.n_facets, 6 * 16);
  EXPECT_EQ(picture.facets.size(), 3u * 16u);
  EXPECT_FALSE(picture.is_cut);
  for (const PictureFacet& facet : picture.facets)
    for (const auto& corner : facet.corners) {
      EXPECT_GE(corner[0], 0);
      EXPECT_LE(corner[0], 10 * picture.width);
      EXPECT_GE(corner[1], 0);
      EXPECT_LE(corner[1], 10 * picture.height);
    }
  EXPECT_EQ(picture.edges.size(), 9u * 4u);  // nine of its twelve edges
}

TEST(Picture, leaves_out_what_is_between_parts) {
  // The upper box hides the top of the lower one.
  const Picture picture = picture_of({box(4, 0.01), box(4, 0.01, {0, 0, 0.01})});
  EXPECT_EQ(of_part(picture, 0), 2 * 16);
  EXPECT_EQ(of_part(picture, 1), 3 * 16);
}

TEST(Picture, is_cut_where_a_part_cannot_be_seen_from_outside) {
  const SubstructurePtr inside = box(2, 0.002, {0.004, 0.004, 0.004});
  const SubstructurePtr outside = box(4, 0.01);
  const std::vector<SubstructurePtr> parts = {outside, inside};
  View view = view_of(parts);
  EXPECT_TRUE(view.is_cut);
  EXPECT_GT(of_part(make_picture(parts, view, {}, {}, 0.0), 0), 0);
  EXPECT_FALSE(view_of({outside}).is_cut);
}

// What a closed surface encloses, m^3; its area vectors must cancel.
double enclosed(const Skin& skin) {
  double volume = 0.0;
  Vec3 sum = Vec3::Zero();
  for (const SkinFacet& facet : skin.facets)
    for (int k = 2; k < facet.n_corners; ++k) {
      const Vec3 a = skin.position.col(facet.corners[0]), b = skin.position.col(facet.corners[k - 1]),
                 c = skin.position.col(facet.corners[k]);
      volume += a.dot(b.cross(c)) / 6.0;
      sum += (b - a).cross(c - a);
    }
  EXPECT_LT(sum.norm(), 1e-12);
  return volume;
}

View cut_at(double x, const Vec3& normal) {
  View view;
  view.size = 0.01;
  view.is_cut = true;
  view.cut = normal.normalized();
  view.cut_at = {x, 0.005, 0.005};
  return view;
}

TEST(Picture, is_cut_by_the_plane_and_not_by_whole_cells) {
  const SubstructurePtr cube = box(4, 0.01);
  // Through the middle of cells, through nodes, and askew: what is left has the volume behind the plane.
  for (const double x : {0.001, 0.0037, 0.005, 0.0075})
    EXPECT_NEAR(enclosed(make_skin({cube}, cut_at(x, Vec3::UnitX()), {}, {}, 0.0)), x * 1e-4, 2e-12) << x;
  EXPECT_NEAR(enclosed(make_skin({cube}, cut_at(0.005, {1, 2, 3}), {}, {}, 0.0)), 0.5e-6, 2e-12);
  EXPECT_NEAR(enclosed(make_skin({cube}, cut_at(0.02, Vec3::UnitX()), {}, {}, 0.0)), 1e-6, 1e-15);
  EXPECT_TRUE(make_skin({cube}, cut_at(-0.001, Vec3::UnitX()), {}, {}, 0.0).facets.empty());
}

// Every other type of cell: a unit brick of them.
TEST(Picture, cuts_prisms_and_tetrahedra_by_the_plane) {
  auto part = std::make_shared<Substructure>();
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes.resize(3, 8);
  mesh->nodes << 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1;
  mesh->nodes *= 0.01;
  part->mesh = mesh;
  for (const CellBlock& block :
       {CellBlock{CellType::prism6, {0, 2, 1, 4, 6, 5, 0, 3, 2, 4, 7, 6}},
        CellBlock{CellType::tet4, {0, 1, 3, 4, 1, 2, 3, 6, 1, 4, 5, 6, 3, 4, 6, 7, 1, 3, 4, 6}}}) {
    mesh->blocks = {block};
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0.3, 1, 0), Vec3(1, 1, 1)})
      EXPECT_NEAR(enclosed(make_skin({part}, cut_at(0.005, normal), {}, {}, 0.0)), 0.5e-6, 2e-12) << block.n_cells();
  }
}

TEST(Picture, carries_displacements_and_values_to_the_cut) {
  const SubstructurePtr cube = box(2, 0.01);
  Points u = Points::Zero(3, 27);
  u.row(2) = cube->mesh->nodes.row(0);
  const Skin skin = make_skin({cube}, cut_at(0.0031, Vec3::UnitX()), {u}, {cube->mesh->nodes.row(0).transpose()}, 0.5);
  for (Eigen::Index i = 0; i < skin.position.cols(); ++i) {
    EXPECT_NEAR(skin.value[i], skin.reference(0, i), 1e-12);
    EXPECT_NEAR(skin.position(2, i), skin.reference(2, i) + 0.5 * skin.reference(0, i), 1e-12);
  }
  EXPECT_NEAR(skin.reference.row(0).maxCoeff(), 0.0031, 1e-7);
}

TEST(Colours, do_not_repeat) {
  std::set<std::string> colors;
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(colors.insert(series_color(i)).second) << i;
  const auto channel = [](const std::string& color, size_t c) {
    return std::stoi(color.substr(1 + 2 * c, 2), nullptr, 16);
  };
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < i; ++j) {
      int apart = 0;
      for (size_t c = 0; c < 3; ++c)
        apart = std::max(apart, std::abs(channel(series_color(i), c) - channel(series_color(j), c)));
      EXPECT_GE(apart, 25) << i << " " << j;
    }
}

TEST(Picture, stays_small_on_a_fine_mesh) {
  const Picture picture = picture_of({box(40, 0.01)}, 900);
  EXPECT_LE(picture.facets.size(), 900u);
  EXPECT_GT(picture.facets.size(), 300u);
  EXPECT_EQ(picture.n_facets, 6 * 1600);
}

// A plate much thinner than what is merged: its sides stay apart, so that none shows through the other.
TEST(Picture, keeps_both_sides_of_a_thin_wall) {
  const std::vector<SubstructurePtr> plate = {box(40, 0.1, Vec3::Zero(), 0.02)};  // 100 x 100 x 2 mm
  const Skin fine = make_skin(plate, view_of(plate), {}, {}, 0.0), coarse = merged(fine, 0.01);
  EXPECT_LT(coarse.facets.size(), fine.facets.size() / 8);
  for (size_t f = 0; f < coarse.facets.size(); ++f) {
    const Vec3 normal = coarse.normal(static_cast<int>(f));
    if (std::abs(normal[2]) < 0.9 * normal.norm()) continue;
    for (int k = 0; k < coarse.facets[f].n_corners; ++k) {
      const Vec3 x = coarse.position.col(coarse.facets[f].corners[k]);
      if (x.head<2>().minCoeff() < 0.01 || x.head<2>().maxCoeff() > 0.09) continue;  // the rim looks to its own side
      EXPECT_NEAR(x[2], normal[2] > 0.0 ? 0.002 : 0.0, 1e-12);
    }
  }
}

TEST(Picture, draws_what_is_not_a_number_where_it_was) {
  const std::vector<SubstructurePtr> parts = {box(2, 0.01)};
  Points u = Points::Zero(3, 27);
  u.col(5).setConstant(std::numeric_limits<double>::quiet_NaN());
  Vec stress = Vec::Constant(27, 1e6);
  stress[3] = std::numeric_limits<double>::infinity();
  const View view = view_of(parts);
  const Picture picture = make_picture(parts, view, {u}, {stress}, 100.0);
  EXPECT_EQ(picture.facets.size(), 12u);
  EXPECT_EQ(picture.value_high, 1e6);
  for (const PictureFacet& facet : picture.facets) EXPECT_TRUE(std::isfinite(facet.value));
}

TEST(Picture, magnifies_by_a_round_factor) {
  const View view = view_of({box(2, 0.01)});
  Points u = Points::Zero(3, 27);
  u(0, 4) = 1e-6;
  const double scale = picture_scale(view, {u});
  const double mantissa = scale / std::pow(10.0, std::floor(std::log10(scale) + 1e-9));
  EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9) << scale;
  EXPECT_LE(scale * 1e-6, 0.05 * view.size);
  EXPECT_GE(scale * 1e-6, 0.02 * view.size);
  EXPECT_EQ(picture_scale(view, {Points::Zero(3, 27)}), 0.0);
  u(0, 4) = 10.0;
  EXPECT_EQ(picture_scale(view, {u}), 0.0);
}

TEST(Picture, lays_a_tower_on_its_side) {
  const View view = view_of({box(2, 0.01, Vec3::Zero(), 10.0)});
  EXPECT_LT(view.height, view.width);
  EXPECT_GT(std::abs(view.axes(0, 2)), 0.9);  // z goes across
}

// The unit square of n x n facets at height 0, normals up.
JointScenes square(int n) {
  JointScenes joint;
  joint.points.resize(3, (n + 1) * (n + 1));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) joint.points.col(i + (n + 1) * j) = Vec3(i, j, 0.0) / n;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j;
      joint.facets.push_back({FacetType::quad4, {a, a + 1, a + n + 2, a + n + 1}});
    }
  return joint;
}

double area(const JointMap& map) {
  double sum = 0.0;
  for (const auto& cell : map.cells)
    for (size_t k = 0; k < cell.size(); ++k) {
      const auto &a = cell[k], &b = cell[(k + 1) % cell.size()];
      sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
  return sum;
}

TEST(JointMap, gives_each_point_of_a_coarse_joint_its_own_cells) {
  const JointMap map = make_joint_map(square(3));
  ASSERT_TRUE(map.is_flat);
  EXPECT_EQ(map.cells.size(), 36u);
  for (const std::vector<int>& points : map.points) EXPECT_EQ(points.size(), 1u);
  EXPECT_NEAR(area(map), 1.0, 1e-12);
  EXPECT_EQ(map.across, "x");
  EXPECT_EQ(map.up, "y");
}

TEST(JointMap, merges_the_points_of_a_fine_joint_and_keeps_its_area) {
  const JointMap map = make_joint_map(square(50), 400);
  EXPECT_LE(map.cells.size(), 400u);
  EXPECT_GT(map.cells.size(), 100u);
  EXPECT_NEAR(area(map), 1.0, 0.1);
}

TEST(JointMap, does_not_lay_a_tube_flat) {
  JointScenes tube;
  const int n = 12;
  tube.points.resize(3, 2 * n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2; ++k)
      tube.points.col(2 * i + k) = Vec3(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), k);
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % n);
    tube.facets.push_back({FacetType::quad4, {a, b, b + 1, a + 1}});
  }
  EXPECT_FALSE(make_joint_map(tube).is_flat);
}

// Each cube keeps its facets however coarse the picture: it ends, with more than were asked for.
TEST(Picture, of_more_parts_than_facets_are_wanted_is_made_all_the_same) {
  std::vector<SubstructurePtr> parts;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) parts.push_back(box(2, 1.0, Vec3(1.5 * i, 1.5 * j, 0.0)));
  const Picture picture = picture_of(parts, 60);
  for (int part = 0; part < 49; ++part) EXPECT_GT(of_part(picture, part), 0) << part;
}

TEST(JointMap, tells_the_state_of_most_points_and_the_more_severe_of_equals) {
  EXPECT_EQ(state_of_cell({0, 1, 1, 2}, {0, 1, 2, 3}), 1);
  EXPECT_EQ(state_of_cell({0, 1, 2}, {1, 2}), 2);
  EXPECT_EQ(state_of_cell({0, 1, 2}, {0, 1}), 0);
  EXPECT_NEAR(mean_of_cell({1.0f, 2.0f, 6.0f}, {1, 2}), 4.0, 1e-6);
}

}  // namespace
}  // namespace dygita

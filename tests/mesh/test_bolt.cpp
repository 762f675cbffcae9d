// Meshes of hexagon bolts: volumes, areas of sections and faces, all facets named.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/bolt.hpp"
#include "mesh/cell_quality.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {
namespace {

double named_area(const Mesh& mesh, const std::string& face) {
  Vec3 area = Vec3::Zero();
  double sum = 0.0;
  for (const Facet& facet : mesh.faces.at(face)) {
    area += facet_area_vector(mesh.nodes, facet);
    sum += facet_area_vector(mesh.nodes, facet).norm();
  }
  return sum;
}

TEST(Bolt, sections_have_their_nominal_area_whatever_the_number_of_cells) {
  const double hexagon = std::sqrt(3.0) / 2.0 * 10.0 * 10.0;  // across flats 10
  for (const int around : {12, 24, 36})
    for (const int order : {1, 2})
      for (const bool is_above : {true, false}) {
        const MeshPtr mesh = bolt_end_mesh({5.0618, 10.0, 4.0, 7.6, 1.6, is_above, around, order});
        check_mesh(*mesh, "bolt");
        const double section = M_PI / 4.0 * 5.0618 * 5.0618, off = order == 1 ? 1e-12 : 2e-4;
        EXPECT_NEAR(named_area(*mesh, "cut"), section, off * section) << around;
        EXPECT_NEAR(named_area(*mesh, "end"), hexagon, 1e-12 * hexagon);
        EXPECT_NEAR(named_area(*mesh, "bearing"), hexagon - section, off * hexagon);
        EXPECT_NEAR(named_area(*mesh, "flats"), 6.0 * 10.0 / std::sqrt(3.0) * 4.0, 1e-9);
        EXPECT_NEAR(volume(*mesh), hexagon * 4.0 + section * 7.6, off * hexagon * 4.0 + 1e-9);
        EXPECT_NEAR(mesh->nodes.row(2).maxCoeff(), is_above ? 5.6 : 9.2, 1e-12);
        EXPECT_NEAR(mesh->nodes.row(2).minCoeff(), is_above ? -6.0 : -2.4, 1e-12);
        EXPECT_GT(worst_shape(*mesh), 0.3);
        size_t named = 0;
        for (const auto& [name, facets] : mesh->faces) named += facets.size();
        EXPECT_EQ(named, boundary_facets(mesh->blocks).size());
      }
}

TEST(Bolt, halves_meet_node_for_node) {
  const MeshPtr head = bolt_end_mesh({5.0, 10.0, 4.0, 7.0, 1.0, true, 24}),
                nut = bolt_end_mesh({5.0, 10.0, 5.0, 7.0, -13.0, false, 24});
  for (const int node : nodes_of(head->faces.at("cut"))) {
    double nearest = 1.0;
    for (const int other : nodes_of(nut->faces.at("cut")))
      nearest = std::min(nearest, (head->nodes.col(node) - nut->nodes.col(other)).norm());
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(Bolt, washers_have_the_area_of_the_ring) {
  for (const int around : {12, 24})
    for (const int order : {1, 2}) {
      const MeshPtr mesh = washer_mesh({6.4, 12.0, 0.0, 1.6, around, order});
      check_mesh(*mesh, "washer");
      const double ring = M_PI / 4.0 * (12.0 * 12.0 - 6.4 * 6.4), off = order == 1 ? 1e-12 : 2e-4;
      for (const char* face : {"lower", "upper"}) EXPECT_NEAR(named_area(*mesh, face), ring, off * ring);
      EXPECT_NEAR(volume(*mesh), 1.6 * ring, off * 1.6 * ring);
      EXPECT_EQ(mesh->faces.at("inside").size(), static_cast<size_t>(around));
      EXPECT_EQ(mesh->faces.at("outside").size(), static_cast<size_t>(around));
    }
}

}  // namespace
}  // namespace dygita

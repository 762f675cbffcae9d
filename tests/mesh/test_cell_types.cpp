// Every row of the tables of facets and cells: what its members claim of one another.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "intake/gmsh_reader.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/jacobian.hpp"
#include "mesh/reference_integrals.hpp"

namespace dygita::test {
namespace {

constexpr int n_axes_of(const CellShape&) { return 3; }
constexpr int n_axes_of(const FacetShape&) { return 2; }

std::string name_of(const CellShape& cell) { return cell.name; }
std::string name_of(const FacetShape& facet) { return "facet of " + std::to_string(nodes_per_facet(facet.type)); }

Domain domain_of(const CellShape& cell) { return test::domain_of(cell.n_corners, 3); }
Domain domain_of(const FacetShape& facet) { return test::domain_of(facet.n_corners, 2); }

Points nodes_of_reference(const ShapeSpace& shape) {
  Points x(3, shape.nodes.size());
  for (Eigen::Index a = 0; a < x.cols(); ++a) x.col(a) = vector_of(shape.nodes[static_cast<size_t>(a)]);
  return x;
}

// Ten places about the middle of the element.
std::vector<Vec3> places_in(const ShapeSpace& shape, int n_axes) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  std::vector<Vec3> places;
  for (int i = 0; i < 10; ++i) {
    Vec3 place = nodes_of_reference(shape).rowwise().mean();
    for (int d = 0; d < n_axes; ++d) place[d] += shift(generator);
    places.push_back(place);
  }
  return places;
}

template <typename Row>
void expect_shape_functions(const Row& row) {
  const ShapeFunctions& functions = shape_functions(row.type);
  const Points nodes = nodes_of_reference(row.shape);
  for (Eigen::Index a = 0; a < nodes.cols(); ++a)
    EXPECT_LT((functions.values(nodes.col(a)) - Vec::Unit(nodes.cols(), a)).norm(), 1e-14) << name_of(row);
  for (const Vec3& xi : places_in(row.shape, n_axes_of(row))) {
    const Vec values = functions.values(xi);
    const auto slopes = functions.slopes(xi);
    EXPECT_NEAR(values.sum(), 1.0, 1e-14) << name_of(row);
    EXPECT_LT((nodes * values - xi).norm(), 1e-14) << name_of(row);
    constexpr double h = 1e-5;
    for (int axis = 0; axis < 3; ++axis) {
      const bool has_axis = axis < n_axes_of(row);
      const Vec difference =
          has_axis ? Vec((functions.values(xi + h * Vec3::Unit(axis)) - functions.values(xi - h * Vec3::Unit(axis))) /
                         (2 * h))
                   : Vec::Zero(nodes.cols());
      EXPECT_LT((slopes.col(axis) - difference).norm(), 1e-9) << name_of(row) << ", axis " << axis;
    }
  }
}

TEST(CellTypes, have_shape_functions_that_are_one_at_their_node_and_sum_to_one) {
  for (const CellShape& cell : cell_shapes) expect_shape_functions(cell);
  for (const FacetShape& facet : facet_shapes) expect_shape_functions(facet);
}

double by_rule(const QuadratureRule& rule, const std::function<double(const Vec3&)>& f) {
  double sum = 0.0;
  for (const QuadraturePoint& point : rule.points) sum += point.weight * f(vector_of(point.at));
  return sum;
}

void expect_exact(const QuadratureRule& rule, Domain domain, int n_axes, const std::string& name) {
  for (int i = 0; i <= rule.degree; ++i)
    for (int j = 0; i + j <= rule.degree; ++j)
      for (int k = 0; i + j + k <= (n_axes == 3 ? rule.degree : i + j); ++k) {
        const auto monomial = [&](const Vec3& x) { return std::pow(x[0], i) * std::pow(x[1], j) * std::pow(x[2], k); };
        EXPECT_NEAR(by_rule(rule, monomial), integral(domain, n_axes, monomial), 1e-14)
            << name << ": " << i << ' ' << j << ' ' << k;
      }
}

TEST(CellTypes, have_quadrature_that_is_exact_to_its_degree) {
  for (const FacetShape& facet : facet_shapes) expect_exact(facet.rule, domain_of(facet), 2, name_of(facet));
  for (const CellShape& cell : cell_shapes)
    for (const QuadratureRule& rule : {cell.stiffness, cell.mass, cell.at_recovery})
      expect_exact(rule, domain_of(cell), 3, cell.name);
}

// On the reference element, where the map has a constant Jacobian.
TEST(CellTypes, integrate_shape_functions_and_their_products_exactly) {
  for (const FacetShape& facet : facet_shapes)
    for (Eigen::Index a = 0; a < nodes_per_facet(facet.type); ++a) {
      const auto value = [&](const Vec3& xi) { return shape_functions(facet.type).values(xi)[a]; };
      EXPECT_NEAR(by_rule(facet.rule, value), integral(domain_of(facet), 2, value), 1e-14) << name_of(facet);
    }
  for (const CellShape& cell : cell_shapes)
    for (Eigen::Index a = 0; a < nodes_per_cell(cell.type); ++a) {
      const auto value = [&](const Vec3& xi) { return shape_functions(cell.type).values(xi)[a]; };
      EXPECT_NEAR(by_rule(cell.stiffness, value), integral(domain_of(cell), 3, value), 1e-14) << cell.name;
      for (Eigen::Index b = 0; b <= a; ++b) {
        const auto product = [&](const Vec3& xi) { return value(xi) * shape_functions(cell.type).values(xi)[b]; };
        EXPECT_NEAR(by_rule(cell.mass, product), integral(domain_of(cell), 3, product), 1e-14) << cell.name;
      }
    }
}

Mesh reference_mesh(const CellShape& cell) {
  Mesh mesh;
  mesh.nodes = nodes_of_reference(cell.shape);
  mesh.blocks = {{cell.type, {}}};
  for (int a = 0; a < nodes_per_cell(cell.type); ++a) mesh.blocks[0].nodes.push_back(a);
  return mesh;
}

TEST(CellTypes, are_turned_inside_out_by_their_mirrored_numbering) {
  for (const CellShape& cell : cell_shapes) {
    const Points x = nodes_of_reference(cell.shape);
    Points mirrored = x;
    for (size_t a = 0; a < cell.mirrored.size(); ++a)
      mirrored.col(static_cast<Eigen::Index>(a)) = x.col(cell.mirrored[a]);
    EXPECT_NEAR(smallest_jacobian(cell.type, x), 1.0, 1e-14) << cell.name;
    EXPECT_GT(cell_volume(cell.type, x), 0.0) << cell.name;
    EXPECT_NEAR(cell_volume(cell.type, mirrored), -cell_volume(cell.type, x), 1e-14) << cell.name;
    EXPECT_LT(smallest_jacobian(cell.type, mirrored), 0.0) << cell.name;
  }
}

// Closed, with normals outward: the facets' area vectors cancel, and the divergence theorem gives the volume.
TEST(CellTypes, have_facets_that_close_them_with_normals_outward) {
  for (const CellShape& cell : cell_shapes) {
    const Mesh mesh = reference_mesh(cell);
    const Vec3 centre = mesh.nodes.leftCols(cell.n_corners).rowwise().mean();
    const std::vector<Facet> facets = boundary_facets(mesh.blocks);
    EXPECT_EQ(facets.size(), cell.facets.size()) << cell.name;
    Vec3 total = Vec3::Zero();
    double volume = 0.0;
    for (const Facet& facet : facets) {
      const Vec3 area = facet_area_vector(mesh.nodes, facet), corner = mesh.nodes.col(facet.corners()[0]);
      for (const int node : facet.nodes())
        EXPECT_NEAR(area.dot(Vec3(mesh.nodes.col(node)) - corner), 0.0, 1e-14) << cell.name;
      for (const int node : facet.corners()) EXPECT_LT(node, cell.n_corners) << cell.name;
      EXPECT_GT(area.dot(corner - centre), 0.0) << cell.name;
      total += area;
      volume += area.dot(corner) / 3.0;
    }
    EXPECT_LT(total.norm(), 1e-14) << cell.name;
    EXPECT_NEAR(volume, cell_volume(cell.type, mesh.nodes), 1e-14) << cell.name;
  }
}

// A facet's nodes lie on the cell where the facet's own reference has them: on the sides of its corners.
TEST(CellTypes, have_facets_with_the_nodes_of_the_facet_in_its_order) {
  for (const CellShape& cell : cell_shapes)
    for (const LocalFacet& local : cell.facets) {
      const FacetShape& facet = facet_shape(local.type);
      Points corners(3, facet.n_corners);
      for (int a = 0; a < facet.n_corners; ++a) corners.col(a) = vector_of(cell.shape.nodes[local.nodes[a]]);
      // The linear facet on the same corners, by the first row that has as many.
      const auto linear = std::find_if(std::begin(facet_shapes), std::end(facet_shapes), [&](const FacetShape& f) {
        return nodes_per_facet(f.type) == facet.n_corners && f.n_corners == facet.n_corners;
      });
      ASSERT_NE(linear, std::end(facet_shapes)) << cell.name;
      for (int a = 0; a < nodes_per_facet(facet.type); ++a) {
        const Vec3 place = corners * shape_functions(linear->type).values(vector_of(facet.shape.nodes[a]));
        EXPECT_LT((place - vector_of(cell.shape.nodes[local.nodes[a]])).norm(), 1e-14) << cell.name;
      }
    }
}

TEST(CellTypes, name_the_rim_of_a_facet_in_turn) {
  for (const FacetShape& facet : facet_shapes) {
    Points x = nodes_of_reference(facet.shape);
    const Vec3 centre = x.leftCols(facet.n_corners).rowwise().mean();
    double turn = 0.0;
    for (size_t a = 0; a < facet.rim.size(); ++a) {
      const Vec3 here = x.col(facet.rim[a]) - centre, next = x.col(facet.rim[(a + 1) % facet.rim.size()]) - centre;
      const double angle = std::atan2(here[0] * next[1] - here[1] * next[0], here.dot(next));
      EXPECT_GT(angle, 0.0) << name_of(facet);
      turn += angle;
    }
    EXPECT_NEAR(turn, 2 * M_PI, 1e-12) << name_of(facet);
  }
}

// Areas of the nodes of a flat facet, in parts of it.
TEST(CellTypes, share_a_facet_among_its_nodes_in_positive_parts) {
  struct Known {
    FacetType type;
    double corner, edge, middle;                       // areas
    double corner_weight, edge_weight, middle_weight;  // integrals of the shape functions
  };
  for (const Known& known :
       {Known{FacetType::tri3, 1.0 / 3, 0, 0, 1.0 / 3, 0, 0}, Known{FacetType::quad4, 0.25, 0, 0, 0.25, 0, 0},
        Known{FacetType::tri6, 1.0 / 12, 0.25, 0, 0, 1.0 / 3, 0},
        Known{FacetType::quad8, 1.0 / 24, 5.0 / 24, 0, -1.0 / 12, 1.0 / 3, 0},
        Known{FacetType::quad9, 1.0 / 36, 1.0 / 9, 4.0 / 9, 1.0 / 36, 1.0 / 9, 4.0 / 9}}) {
    const FacetShape& facet = facet_shape(known.type);
    Mesh mesh;
    mesh.nodes = nodes_of_reference(facet.shape);
    std::vector<int> numbers;
    for (int a = 0; a < nodes_per_facet(known.type); ++a) numbers.push_back(a);
    const FaceNodes nodes = face_nodes(mesh, {Facet(known.type, numbers)});
    const double area = facet.n_corners == 3 ? 0.5 : 4.0;
    for (int a = 0; a < nodes_per_facet(known.type); ++a) {
      const int kind = a < facet.n_corners ? 0 : a < 2 * facet.n_corners ? 1 : 2;
      EXPECT_NEAR(nodes.areas[a], area * (&known.corner)[kind], 1e-14) << name_of(facet) << ", node " << a;
      EXPECT_NEAR(nodes.weights[a], area * (&known.corner_weight)[kind], 1e-14) << name_of(facet) << ", node " << a;
      EXPECT_LT((nodes.normals.col(a) - Vec3::UnitZ()).norm(), 1e-14) << name_of(facet) << ", node " << a;
      EXPECT_LT((nodes.vectors.col(a) - nodes.weights[a] * Vec3::UnitZ()).norm(), 1e-14) << name_of(facet);
    }
  }
}

TEST(CellTypes, cut_a_facet_into_polygons_that_cover_it) {
  for (const FacetShape& facet : facet_shapes) {
    const Points x = nodes_of_reference(facet.shape);
    std::vector<int> used;
    double area = 0.0;
    for (const SubFacet& sub : facet.sub_facets) {
      used.insert(used.end(), sub.nodes.begin(), sub.nodes.begin() + sub.n);
      for (int k = 2; k < sub.n; ++k) {
        const Vec3 a = x.col(sub.nodes[0]), b = x.col(sub.nodes[k - 1]), c = x.col(sub.nodes[k]);
        const double part = 0.5 * ((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]);
        EXPECT_GT(part, 0.0) << name_of(facet);
        area += part;
      }
    }
    EXPECT_NEAR(area, facet.n_corners == 3 ? 0.5 : 4.0, 1e-14) << name_of(facet);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    EXPECT_EQ(static_cast<int>(used.size()), nodes_per_facet(facet.type)) << name_of(facet);
  }
}

TEST(CellTypes, fill_a_brick_by_as_many_as_they_say) {
  for (const CellShape& cell : cell_shapes) {
    const Points x = nodes_of_reference(cell.shape);
    const double brick = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).prod();
    EXPECT_NEAR(brick / cell_volume(cell.type, x), cell.cells_per_brick, 1e-12) << cell.name;
  }
}

// A file with one cell of gmsh's type, its nodes where gmsh has them, stretched.
std::string gmsh_file(const CellShape& cell) {
  std::string name;
  int dimension, order, n_nodes, n_primary;
  std::vector<double> x;
  gmsh::initialize(0, nullptr, false);
  gmsh::model::mesh::getElementProperties(cell.gmsh_type, name, dimension, order, n_nodes, x, n_primary);
  gmsh::finalize();
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"one\"\n$EndPhysicalNames\n$Nodes\n" +
      std::to_string(n_nodes) + "\n";
  std::string element = "$EndNodes\n$Elements\n1\n1 " + std::to_string(cell.gmsh_type) + " 2 1 1";
  for (int a = 0; a < n_nodes; ++a) {
    text += std::to_string(a + 1) + " " + std::to_string(2 * x[3 * a]) + " " + std::to_string(3 * x[3 * a + 1]) + " " +
            std::to_string(4 * x[3 * a + 2]) + "\n";
    element += " " + std::to_string(a + 1);
  }
  return text + element + "\n$EndElements\n";
}

TEST(CellTypes, are_read_from_gmsh_with_every_node_at_its_place) {
  for (const CellShape& cell : cell_shapes) {
    const auto path = std::filesystem::temp_directory_path() / (std::string("dygita_one_") + cell.name + ".msh");
    std::ofstream(path) << gmsh_file(cell);
    const MeshPtr mesh = GmshMeshes({path.string(), {}, std::nullopt, 1.0}).volume("one");
    std::filesystem::remove(path);
    ASSERT_EQ(mesh->blocks.size(), 1u) << cell.name;
    EXPECT_EQ(mesh->blocks[0].type, cell.type) << cell.name;
    const Points expected = Vec3(2, 3, 4).asDiagonal() * nodes_of_reference(cell.shape);
    EXPECT_LT((cell_nodes(mesh->nodes, mesh->blocks[0], 0) - expected).norm(), 1e-12) << cell.name;
  }
}

}  // namespace
}  // namespace dygita::test

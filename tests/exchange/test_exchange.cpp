// Where substructures meet: groups, frames, held directions, walls, several laws at a node.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "step/blocks.hpp"

namespace dygita::exchange_tests {
namespace {

constexpr double exchange_dt = 0.5e-6;

struct Sides {
  int n_1, n_2;
};
Sides sides_of(const Point& point) {
  return {point.first_port_2 - point.first_port, point.end_port - point.first_port_2};
}

void expect_sound(const Modelled& of) {
  const Exchange& exchange = of.model.exchange;
  std::vector<std::set<int>> taken(of.model.pieces.size());
  for (const Point& point : exchange.points) {
    EXPECT_LT((point.frame.transpose() * point.frame - Mat3::Identity()).norm(), 1e-12);
    EXPECT_GT(point.frame.determinant(), 0.0);
    for (int p = point.first_port; p < point.end_port; ++p)
      for (int d = 0; d < 3; ++d) {
        const Port& port = exchange.ports[p];
        if (port.unknown[d] < 0) continue;
        EXPECT_FALSE(port.is_held[d]);
        EXPECT_TRUE(point.is_active[d]);
        EXPECT_TRUE(taken[port.piece].insert(port.unknown[d]).second) << "an unknown of two ports";
      }
  }
  for (size_t piece = 0; piece < taken.size(); ++piece) {
    EXPECT_EQ(static_cast<int>(taken[piece].size()), exchange.n_unknowns[piece]);
    EXPECT_EQ(of.model.pieces[piece]->n_rows(), exchange.n_unknowns[piece]);
  }
}

TEST(Exchange, pairs_the_nodes_of_two_faces_along_their_normal) {
  const Modelled of(two_cubes(contact(0.3), {dynamic_step("test", 1, exchange_dt, {})}));
  expect_sound(of);
  ASSERT_EQ(of.model.exchange.points.size(), 9U);
  double area = 0.0;
  for (const Point& point : of.model.exchange.points) {
    EXPECT_LT((point.frame.col(0) - Vec3::UnitZ()).norm(), 1e-12);  // from lower to upper
    EXPECT_EQ(sides_of(point).n_1, 1);
    EXPECT_EQ(sides_of(point).n_2, 1);
    const Port &one = of.model.exchange.ports[point.first_port], &two = of.model.exchange.ports[point.first_port_2];
    EXPECT_EQ(one.part, 0);
    EXPECT_EQ(two.part, 1);
    EXPECT_LT((of.problem.substructures[0]->mesh->nodes.col(one.node) -
               of.problem.substructures[1]->mesh->nodes.col(two.node))
                  .norm(),
              1e-12);
    area += point.area;
  }
  EXPECT_NEAR(area, 1e-4, 1e-15);
}

TEST(Exchange, of_a_law_without_friction_has_normals_alone) {
  const Modelled of(two_cubes(contact(0.0), {dynamic_step("test", 1, exchange_dt, {})}));
  EXPECT_EQ(of.model.n_q(), 2 * 9);
  for (const Point& point : of.model.exchange.points) EXPECT_EQ(point.is_active, (std::array{true, false, false}));
}

// Three cubes that meet along an edge, each bonded to its neighbours: the nodes of the edge are one group of three.
TEST(Exchange, makes_one_group_of_three_pieces_on_an_edge) {
  Problem problem;
  const BlockPtr a = cube("a", 0, 0, 0), b = cube("b", 1, 0, 0), c = cube("c", 0, 0, 1);
  problem.substructures = {a, b, c};
  const BlockPtr d = cube("d", 1, 0, 1);
  problem.substructures.push_back(d);
  problem.interfaces = {interface("ab", face(a, "xmax"), face(b, "xmin"), bonded()),
                        interface("ac", face(a, "zmax"), face(c, "zmin"), bonded()),
                        interface("bd", face(b, "zmax"), face(d, "zmin"), bonded()),
                        interface("cd", face(c, "xmax"), face(d, "xmin"), bonded())};
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  const Modelled of(problem);
  expect_sound(of);
  int n_edge = 0, n_pairs = 0;
  for (const Point& point : of.model.exchange.points) {
    EXPECT_EQ(point.law, nullptr);
    EXPECT_EQ(sides_of(point).n_2, 0);
    n_edge += sides_of(point).n_1 == 4;
    n_pairs += sides_of(point).n_1 == 2;
  }
  EXPECT_EQ(n_edge, 3);
  EXPECT_EQ(n_pairs, 4 * 6);
  EXPECT_EQ(of.model.exchange.ties.size(), 4U * 9U);  // each interface at each of its nodes
  problem.substructures.pop_back();
  problem.interfaces.resize(2);
  const Modelled three(problem);
  expect_sound(three);
  int n_three = 0;
  for (const Point& point : three.model.exchange.points) n_three += sides_of(point).n_1 == 3;
  EXPECT_EQ(n_three, 3);
}

// A group under one law is that law's side; a node under two laws has a q for each.
TEST(Exchange, gives_a_node_under_two_laws_a_q_for_each) {
  Problem problem;
  const BlockPtr a = cube("a", 0, 0, 0), b = cube("b", 1, 0, 0), c = cube("c", 0, 0, 1);
  problem.substructures = {a, b, c};
  problem.interfaces = {interface("ab", face(a, "xmax"), face(b, "xmin"), contact(0.2)),
                        interface("ac", face(a, "zmax"), face(c, "zmin"), contact(0.2))};
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  problem.solver.integration = IntegrationChoice::implicitly;
  const Modelled of(problem);
  expect_sound(of);
  EXPECT_EQ(of.model.exchange.points.size(), 18U);
  EXPECT_EQ(of.model.exchange.n_unknowns[0], 3 * 18);
  const int corner = of.node_at(0, {0.01, 0.0, 0.01});
  std::vector<Vec3> normals;
  for (const Point& point : of.model.exchange.points)
    if (of.model.exchange.ports[point.first_port].node == corner) normals.push_back(point.frame.col(0));
  ASSERT_EQ(normals.size(), 2U);
  EXPECT_NEAR(normals[0].dot(normals[1]), 0.0, 1e-12);
  // The piece shares its Schur complement between them.
  const int inside = of.node_at(0, {0.005, 0.0, 0.01});
  for (const InterfaceRow& row : of.model.pieces[0]->rows()) {
    const int node = row.nodes[0].node;
    if (node != corner && node != inside) continue;
    EXPECT_NEAR(row.n_sharing, node == corner ? 2.0 : 1.0, 1e-12);
  }
}

TEST(Exchange, ties_a_group_on_one_side_of_a_law) {
  Problem problem;
  const BlockPtr a = cube("a", 0, 0, 0), b = cube("b", 1, 0, 0);
  const BlockPtr c = block("c", {0.0, 0.0, 0.01}, {0.02, 0.01, 0.01}, {4, 2, 2});
  problem.substructures = {a, b, c};
  const LawPtr law = contact(0.1);
  problem.interfaces = {interface("ab", face(a, "xmax"), face(b, "xmin"), bonded()),
                        interface("ac", face(a, "zmax"), face(c, "zmin"), law),
                        interface("bc", face(b, "zmax"), face(c, "zmin"), contact(0.1))};
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  const Modelled of(problem);
  expect_sound(of);
  const int corner = of.node_at(2, {0.01, 0.005, 0.01});
  int found = 0;
  for (const Point& point : of.model.exchange.points) {
    if (!point.law || of.model.exchange.ports[point.first_port_2].node != corner) continue;
    ++found;
    EXPECT_EQ(sides_of(point).n_1, 2);  // both halves of what is tied below
    EXPECT_EQ(sides_of(point).n_2, 1);
    EXPECT_EQ(point.members.size(), 2U);  // one contact, of two interfaces side by side
    EXPECT_NEAR(point.members[0].share + point.members[1].share, 1.0, 1e-12);
  }
  EXPECT_EQ(found, 1);
}

TEST(Exchange, leaves_held_directions_to_their_support) {
  Problem problem = two_cubes(bonded(), {dynamic_step("test", 1, exchange_dt, {})});
  const BlockPtr lower = std::const_pointer_cast<Substructure>(problem.substructures[0]);
  problem.supports.push_back(support("symmetry", {face(lower, "xmin")}));
  const Modelled of(problem);
  expect_sound(of);
  int n_held = 0;
  for (const Point& point : of.model.exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = of.model.exchange.ports[p];
      if (port.part != 0 || of.problem.substructures[0]->mesh->nodes(0, port.node) > 1e-9) continue;
      for (int d = 0; d < 3; ++d) {
        const bool is_along = std::abs(point.frame.col(d)[0]) > 0.999;
        EXPECT_EQ(port.is_held[d], is_along);
        n_held += port.is_held[d];
      }
    }
  EXPECT_EQ(n_held, 3);
}

TEST(Exchange, at_a_wall_has_one_side) {
  Problem problem;
  const BlockPtr alone = cube("alone", 0, 0, 0);
  problem.substructures = {alone};
  problem.supports = {support("wall", {face(alone, "zmin")}, {{"friction", 0.3}, {"gap", 0.0}})};
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  const Modelled of(problem);
  expect_sound(of);
  ASSERT_EQ(of.model.exchange.points.size(), 9U);
  for (const Point& point : of.model.exchange.points) {
    EXPECT_TRUE(point.is_wall);
    EXPECT_EQ(sides_of(point).n_2, 0);
    EXPECT_LT((point.frame.col(0) + Vec3::UnitZ()).norm(), 1e-12);  // out of the block
  }
}

TEST(Exchange, of_a_step_without_that_wall_has_none) {
  Problem problem;
  const BlockPtr alone = cube("alone", 0, 0, 0);
  problem.substructures = {alone};
  problem.supports = {support("wall", {face(alone, "zmin")}, {{"friction", 0.3}, {"gap", 0.0}})};
  auto away = dynamic_step("away", 1, exchange_dt, {});
  away->supports.emplace();
  problem.steps = {dynamic_step("test", 1, exchange_dt, {}), away};
  EXPECT_EQ(Modelled(problem, 0).model.exchange.points.size(), 9U);
  EXPECT_EQ(Modelled(problem, 1).model.exchange.points.size(), 0U);
}

TEST(Exchange, ties_what_a_cut_takes_apart) {
  Problem problem;
  const BlockPtr one = cube("one", 0, 0, 0, 4);
  problem.substructures = {one};
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  problem.solver.pieces = 2;
  const Modelled of(problem);
  expect_sound(of);
  ASSERT_EQ(of.model.pieces.size(), 2U);
  EXPECT_EQ(of.model.exchange.points.size(), 25U);
  EXPECT_TRUE(of.model.exchange.ties.empty());  // no interface of the deck
  for (const Point& point : of.model.exchange.points) {
    int n_owners = 0;
    for (int p = point.first_port; p < point.end_port; ++p) n_owners += of.model.exchange.ports[p].is_owner;
    EXPECT_EQ(n_owners, 1);
  }
}

std::string complaint(const Problem& problem) {
  try {
    const Modelled of(problem);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Two towers of cubes, side by side: bonded but for contact where the second cubes touch.
Problem towers(int height, int n_cells) {
  Problem problem;
  const auto join = [&](const Face& one, const Face& other, LawPtr law) {
    problem.interfaces.push_back(interface(one.part->name + other.part->name, one, other, std::move(law)));
  };
  BlockPtr below_left, below_right;
  for (int k = 0; k < height; ++k) {
    const BlockPtr left = cube("l" + std::to_string(k), 0, 0, k, n_cells);
    const BlockPtr right = cube("r" + std::to_string(k), 1, 0, k, n_cells);
    problem.substructures.insert(problem.substructures.end(), {left, right});
    join(face(left, "xmax"), face(right, "xmin"), k == 1 ? contact(0.1) : bonded());
    if (k > 0) join(face(below_left, "zmax"), face(left, "zmin"), bonded());
    if (k > 0) join(face(below_right, "zmax"), face(right, "zmin"), bonded());
    below_left = left;
    below_right = right;
  }
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  return problem;
}

TEST(Exchange, contact_leaves_a_line_of_ties_to_them) {
  const Modelled of(towers(2, 2));
  int n_of_contact = 0;
  for (const Point& point : of.model.exchange.points) n_of_contact += point.law != nullptr;
  EXPECT_EQ(n_of_contact, 6);
}

TEST(Exchange, refuses_a_law_between_sides_that_are_tied) {
  const std::string message = complaint(towers(3, 1));
  EXPECT_NE(message.find("interface 'l1r1': its two sides are tied to each other"), std::string::npos) << message;
}

// Pieces of one shape and material have one factor between them.
TEST(StepModel, shares_the_operators_of_equal_pieces) {
  Problem problem;
  problem.solver.integration = IntegrationChoice::implicitly;
  const MeshPtr mesh = cube("any", 0, 0, 0)->mesh;
  for (int i = 0; i < 4; ++i) {
    const BlockPtr part = cube("cube " + std::to_string(i), 0, 0, 0);
    part->mesh = mesh;
    part->place = Vec3(0.03 * i, 0.0, 0.0);
    problem.substructures.push_back(part);
  }
  const BlockPtr other = std::const_pointer_cast<Substructure>(problem.substructures[3]);
  other->material.density = 2700.0;
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  for (const auto& part : problem.substructures) problem.supports.push_back(support("fixed", {Face{part, "zmin"}}));
  const Modelled of(problem);
  const auto& pieces = of.model.pieces;
  EXPECT_FALSE(pieces[0]->shares_operator());
  for (const int i : {1, 2}) {
    EXPECT_TRUE(pieces[i]->shares_operator());
    EXPECT_EQ(pieces[i]->shared_key(), pieces[0]->shared_key());
  }
  EXPECT_FALSE(pieces[3]->shares_operator());
  EXPECT_NE(pieces[3]->shared_key(), pieces[0]->shared_key());
  EXPECT_EQ(of.model.equal, (std::vector<std::vector<int>>{{0, 1, 2}, {3}}));
}

// The error of one factorisation among many, on threads, reaches the caller with the name of its substructure.
TEST(StepModel, tells_which_substructure_cannot_be_factorised) {
  Problem problem;
  problem.solver.integration = IntegrationChoice::implicitly;
  for (int i = 0; i < 4; ++i) problem.substructures.push_back(cube("cube " + std::to_string(i), 3 * i, 0, 0));
  Elastic& own = const_cast<Substructure&>(*problem.substructures[2]).material;
  own = Elastic(own.name, 1e11, 0.3, own.density);  // matrices of its own
  problem.steps = {dynamic_step("test", 1, exchange_dt, {})};
  const std::vector<Surface> surfaces = make_surfaces(problem);
  std::vector<Body> bodies = make_bodies(problem, surfaces);
  BodyMatrices broken{-1e3 * *bodies[2].matrices->stiffness(), bodies[2].matrices->mass()};
  bodies[2].matrices = std::make_shared<const StoredMatrices>(std::move(broken));
  const State state = initial_state(problem, surfaces);
  const int before = thread_limit();
  set_thread_limit(2);
  try {
    make_step_model(problem, *problem.steps[0], surfaces, bodies, state, no_cut(problem));
    ADD_FAILURE() << "a negative definite matrix was factorised";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("substructure 'cube 2' in step 'test'"), std::string::npos)
        << error.what();
  }
  set_thread_limit(before);
}

}  // namespace
}  // namespace dygita::exchange_tests

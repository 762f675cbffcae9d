#include <gtest/gtest.h>

#include <numeric>

#include "mesh/box.hpp"
#include "partition/copies.hpp"
#include "partition/cut.hpp"
#include "partition/share_out.hpp"
#include "step/bodies.hpp"
#include "step/step_model.hpp"

namespace dygita::cut_tests {
namespace {

Problem blocks(int pieces) {
  auto one = std::make_shared<Substructure>(), other = std::make_shared<Substructure>();
  for (const auto& part : {one, other}) {
    part->name = part == one ? "one" : "other";
    part->material = Elastic("steel", 200e9, 0.3, 7800);
  }
  one->mesh = box_mesh(Vec3::Zero(), {6, 6, 9}, {6, 6, 9});
  other->mesh = box_mesh({0, 0, 9}, {6, 6, 1}, {2, 2, 1});
  Problem problem;
  problem.substructures = {one, other};
  problem.solver.pieces = pieces;
  auto step = std::make_shared<Step>();
  step->duration = 1e-3;
  step->dt = 2e-4;
  problem.steps = {step};
  return problem;
}

TEST(Cut, gives_every_node_one_owner_and_all_its_copies) {
  const Problem problem = blocks(5);
  const CutPtr cut = make_cut(problem, {});
  EXPECT_EQ(cut->n_pieces(0), 5);
  EXPECT_EQ(cut->n_pieces(1), 1);  // four cells make no two pieces of eight
  EXPECT_EQ(cut->piece(5).body, problem.substructures[1]);
  const Mesh& mesh = *problem.substructures[0]->mesh;
  std::vector<int> n_copies(mesh.n_nodes(), 0), n_owners(mesh.n_nodes(), 0);
  for (int p = 0; p < 5; ++p)
    for (int i = 0; i < cut->piece(p).body->mesh->n_nodes(); ++i) {
      ++n_copies[cut->piece(p).node(i)];
      n_owners[cut->piece(p).node(i)] += cut->piece(p).owns(i);
      EXPECT_EQ(Vec3(cut->piece(p).body->mesh->nodes.col(i)), Vec3(mesh.nodes.col(cut->piece(p).node(i))));
    }
  int n_cut = 0;
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    EXPECT_EQ(n_owners[node], 1);
    const std::vector<Copy> copies = cut->copies(0, node);
    EXPECT_EQ(static_cast<int>(copies.size()), n_copies[node]);
    EXPECT_TRUE(cut->piece(copies[0].piece).owns(copies[0].node));
    double share = 0.0;
    for (const Copy& copy : copies) {
      EXPECT_EQ(cut->piece(copy.piece).node(copy.node), node);
      share += copy.share;
    }
    EXPECT_NEAR(share, 1.0, 1e-14);
    n_cut += copies.size() > 1;
  }
  EXPECT_GT(n_cut, 50);
}

TEST(Cut, takes_fields_apart_and_puts_them_together) {
  const Problem problem = blocks(4);
  const CutPtr cut = make_cut(problem, {});
  const Points field = Points::Random(3, problem.substructures[0]->mesh->n_nodes());
  EXPECT_EQ(cut->from_owners(0, [&](int p) { return cut->on_piece(p, field); }), field);
  EXPECT_EQ(cut->summed(0, [&](int p) { return cut->on_owners(p, field); }), field);
}

TEST(Cut, the_pieces_stiffness_and_masses_add_up_to_those_of_the_whole) {
  for (const bool is_tuned : {false, true}) {
    Problem problem = blocks(6);
    problem.solver.mass.is_tuned = is_tuned;
    const CutPtr cut = make_cut(problem, {});
    const std::vector<Body> pieces = make_bodies(problem, {}, *cut), whole = make_bodies(problem, {});
    const Mesh& mesh = *problem.substructures[0]->mesh;
    const Points u = Points::Random(3, mesh.n_nodes());
    const auto times_stiffness = [](const Body& body, const Points& x) {
      Points f(3, x.cols());
      Eigen::Map<Vec>(f.data(), f.size()) = *body.matrices->stiffness() * Eigen::Map<const Vec>(x.data(), x.size());
      return f;
    };
    const auto times_mass = [](const Body& body, const Points& x) {
      return body.mass->matrix.size() > 0 ? Points((body.mass->matrix * x.transpose()).transpose())
                                          : Points(x * body.mass->lumped.asDiagonal());
    };
    EXPECT_EQ(whole[0].mass->matrix.size() > 0, is_tuned);
    for (const auto& product : {std::function<Points(const Body&, const Points&)>(times_stiffness), {times_mass}}) {
      const Points expected = product(whole[0], u),
                   sum = cut->summed(0, [&](int p) { return product(pieces[p], cut->on_piece(p, u)); });
      EXPECT_LT((sum - expected).norm(), 1e-13 * expected.norm());
    }
  }
}

TEST(Cut, small_bodies_and_massless_contact_are_left_whole) {
  Problem problem = blocks(0);
  EXPECT_EQ(make_cut(problem, {})->n_pieces(), 2);
  problem.solver.pieces = 4;
  EXPECT_EQ(make_cut(problem, {})->n_pieces(), 5);
  problem.solver.mass.is_moved_from_contact = true;
  EXPECT_EQ(make_cut(problem, {})->n_pieces(), 2);
}

TEST(Cut, a_large_body_is_cut_by_itself_whatever_the_number_of_threads) {
  Problem problem = blocks(0);
  auto large = std::make_shared<Substructure>(*problem.substructures[0]);
  large->mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {24, 24, 24});
  problem.substructures[0] = large;
  EXPECT_GT(make_cut(problem, {})->n_pieces(0), 1);
}

// Cubes of so many cells along an edge.
Problem cubes(const std::vector<int>& cells) {
  Problem problem = blocks(0);
  const SubstructurePtr first = problem.substructures[0];
  problem.substructures.clear();
  for (const int n : cells) {
    auto cube = std::make_shared<Substructure>(*first);
    cube->mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {n, n, n});
    problem.substructures.push_back(cube);
  }
  return problem;
}

using Pieces = std::vector<int>;

TEST(PiecesForRanks, are_the_usual_ones_where_these_share_out_evenly) {
  const Problem few = cubes({3, 3, 3, 3});
  EXPECT_EQ(pieces_for_ranks(few, 1), usual_pieces(few));
  EXPECT_EQ(pieces_for_ranks(few, 2), usual_pieces(few));
  EXPECT_EQ(pieces_for_ranks(few, 4), usual_pieces(few));
  const Problem small = cubes({8, 8, 8});  // too small to be cut for evenness alone
  EXPECT_EQ(pieces_for_ranks(small, 2), Pieces({1, 1, 1}));
}

TEST(PiecesForRanks, are_more_where_ranks_would_have_none) {
  EXPECT_EQ(pieces_for_ranks(cubes({8}), 4), Pieces({4}));
  const Pieces pieces = pieces_for_ranks(cubes({8, 8, 8}), 4);
  EXPECT_GE(std::accumulate(pieces.begin(), pieces.end(), 0), 4);
  EXPECT_EQ(pieces_for_ranks(cubes({2}), 4), Pieces({1}));  // eight cells are one piece
}

TEST(PiecesForRanks, are_more_of_what_the_heaviest_rank_would_have_too_much_of) {
  Problem problem = cubes({20, 20, 20});
  const Pieces usual = usual_pieces(problem), pieces = pieces_for_ranks(problem, 2);
  EXPECT_EQ(usual, Pieces({1, 1, 1}));
  std::vector<double> costs, as_usual(3, 1.0);
  for (const int n : pieces) costs.insert(costs.end(), n, 1.0 / n);
  EXPECT_LT(unevenness(costs, 2), 1.15);
  EXPECT_NEAR(unevenness(as_usual, 2), 4.0 / 3.0, 1e-12);
  problem.solver.integration = IntegrationChoice::implicitly;  // a third too much is not worth a cut that iterates
  EXPECT_EQ(pieces_for_ranks(problem, 2), usual);
  problem.solver.integration = IntegrationChoice::explicitly;
  EXPECT_EQ(pieces_for_ranks(problem, 2), pieces);
  problem.solver.mass.is_chosen = false;  // cells along a cut would be lumped: not for evenness alone
  problem.solver.mass.is_tuned = true;
  EXPECT_EQ(pieces_for_ranks(problem, 2), usual);
  EXPECT_NE(pieces_for_ranks(problem, 5), usual);
  problem.solver.pieces = 1;
  EXPECT_EQ(pieces_for_ranks(problem, 5), usual);
}

TEST(Copies, have_what_the_owner_has_and_are_summed_on_it) {
  const Problem problem = blocks(5);
  const CutPtr cut = make_cut(problem, {});
  std::vector<Points> fields;
  for (const CutPiece& piece : cut->pieces()) fields.push_back(Points::Random(3, piece.body->mesh->n_nodes()));
  std::vector<Points> given = fields, summed = fields;
  give_to_copies(*cut, false, given);
  sum_on_owners(*cut, true, summed);
  for (int part = 0; part < 2; ++part) {
    const Points owned = cut->from_owners(part, [&](int p) { return fields[p]; }),
                 sum = cut->summed(part, [&](int p) { return fields[p]; });
    for (int p = cut->first(part); p < cut->first(part) + cut->n_pieces(part); ++p) {
      EXPECT_EQ(given[p], cut->on_piece(p, owned));
      cut->keep_owned(p, summed[p]);
      EXPECT_EQ(summed[p], cut->on_owners(p, sum));
    }
  }
}

}  // namespace
}  // namespace dygita::cut_tests

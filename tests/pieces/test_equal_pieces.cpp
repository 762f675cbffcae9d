// Pieces that are one piece, moved and turned: when they are, and that one factor serves them all.
#include <Eigen/Geometry>

#include "pieces/equal_pieces.hpp"
#include "pieces/piece_case.hpp"

namespace dygita {
namespace {

constexpr double equal_dt = 2e-7;

Mat3 some_turn() { return Eigen::AngleAxisd(0.7, Vec3(0.3, -1.0, 0.5).normalized()).toRotationMatrix(); }

std::optional<Mat3> turn_of(const PieceSetup& first, const PieceSetup& second) {
  return turn_between(first, FreeUnknowns(first.n_nodes(), first.rows, first.held), second);
}

bool are_equal(const PieceSetup& first, const PieceSetup& second) {
  const auto turn = turn_of(first, second);
  return turn && turn->isIdentity(0.0);
}

TEST(PieceSetup, is_equal_to_another_only_where_the_matrices_are) {
  PieceCase c;
  c.dt = equal_dt;
  c.make();
  PieceSetup other = c.setup;
  EXPECT_TRUE(are_equal(c.setup, other));
  other.rows[3].nodes[0].along += Vec3::Constant(1e-15);  // frames of places that differ by a shift
  EXPECT_TRUE(are_equal(c.setup, other));
  other = c.setup;
  other.rows.pop_back();  // one unknown fewer on the interface
  EXPECT_FALSE(are_equal(c.setup, other));
  EXPECT_FALSE(are_equal(other, c.setup));
  other = c.setup;
  other.held.erase(other.held.begin());
  EXPECT_FALSE(are_equal(c.setup, other));
  EXPECT_FALSE(are_equal(other, c.setup));
  other = c.setup;
  other.held.begin()->second.motion[0] = {{0, 1.0}};  // what moves it is not in the matrix
  EXPECT_TRUE(are_equal(c.setup, other));
  other = c.setup;
  other.held.begin()->second.n = 2;
  EXPECT_FALSE(are_equal(c.setup, other));
  other = c.setup;
  other.absorbing[0] = Mat3::Identity();
  EXPECT_FALSE(are_equal(c.setup, other));
  EXPECT_FALSE(are_equal(other, c.setup));
  other = c.setup;
  other.precision = Precision::single_precision;
  EXPECT_FALSE(are_equal(c.setup, other));
}

// Equal meshes of one material share their matrices; damping comes in with the step.
TEST(PieceSetup, is_not_equal_to_one_that_is_damped_otherwise) {
  for (const Damping damping : {Damping{2e3, 0.0}, Damping{0.0, 3e-8}}) {
    PieceCase c;
    c.dt = equal_dt;
    c.make();
    Substructure damped = *c.part;
    damped.material.damping = damping;
    Body body = c.body;
    body.part = &damped;
    PieceSetup other = c.setup;
    other.body = &body;
    EXPECT_FALSE(are_equal(c.setup, other));
    other.scheme = {};  // a static step knows no damping
    PieceSetup still = c.setup;
    still.scheme = {};
    EXPECT_TRUE(are_equal(still, other));
  }
}

TEST(PieceSetup, knows_a_turned_copy_by_what_turns_with_it) {
  PieceCase c, turned;
  for (PieceCase* one : {&c, &turned}) {
    one->dt = equal_dt;
    one->is_absorbing = true;
    one->make();
  }
  turned.body.mass = c.body.mass;
  turned.turn(some_turn());
  const auto turn = turn_of(c.setup, turned.setup);
  ASSERT_TRUE(turn.has_value());
  EXPECT_LT((*turn - some_turn()).norm(), 1e-14);
  PieceSetup other = turned.setup;
  other.absorbing.begin()->second += 1e-3 * Mat3::Identity();
  EXPECT_FALSE(turn_of(c.setup, other).has_value());
  other.absorbing = c.setup.absorbing;  // not turned
  EXPECT_FALSE(turn_of(c.setup, other).has_value());
}

struct Variant {
  const char* name;
  bool is_static, holds_normal_alone, is_moved, is_absorbing, has_matrix, has_spread_rows;
};

// Against the same piece with a factor of its own, and an increment of it.
TEST(TurnedPiece, answers_by_the_factor_of_the_one_that_is_not) {
  for (const Variant& v : {Variant{"held", false, false, false, false, false, false},
                           Variant{"static", true, false, false, false, false, false},
                           Variant{"moved", false, false, true, false, false, false},
                           Variant{"absorbing", false, false, false, true, false, false},
                           Variant{"mass matrix", false, true, false, false, true, false},
                           Variant{"spread rows", false, false, false, false, false, true}})
    for (const bool is_plain : {false, true}) {
      SCOPED_TRACE(v.name);
      PieceCase c, turned;
      for (PieceCase* one : {&c, &turned}) {
        one->dt = v.is_static ? 0.0 : equal_dt;
        one->holds_normal_alone = v.holds_normal_alone;
        one->is_moved = v.is_moved;
        one->is_absorbing = v.is_absorbing;
        one->has_matrix = v.has_matrix;
        one->has_spread_rows = v.has_spread_rows;
        one->make();
      }
      turned.body.mass = c.body.mass;
      turned.turn(some_turn());
      const auto turn = turn_of(c.setup, turned.setup);
      ASSERT_TRUE(turn.has_value());
      const auto first = c.piece(is_plain), own = turned.piece(is_plain);
      const auto shared = make_piece(turned.setup, is_plain, {first.get(), *turn});
      shared->set_search_directions(turned.directions());
      EXPECT_TRUE(shared->shares_operator());
      EXPECT_EQ(first->condensation()->factor, shared->condensation()->factor);
      if (!is_plain) {
        EXPECT_LT(shared->figures().bytes, 0.5 * own->figures().bytes);
      }
      const Mat compliance = row_compliance(*own);
      EXPECT_LT((row_compliance(*shared) - compliance).norm(), 1e-8 * compliance.norm());
      EXPECT_LT((shared->schur_diagonal() - own->schur_diagonal()).norm(), 1e-9 * own->schur_diagonal().norm());

      const std::vector<double> motions(turned.setup.n_motions, 0.4);
      const Points start = 1e-6 * random_points(c.n_nodes(), 5), none = Points::Zero(3, c.n_nodes());
      const Points force = 1e3 * random_points(c.n_nodes(), 6);
      const Vec q = 1e3 * random_vector(c.n_rows(), 7);
      Vec velocity(c.n_rows()), velocity_own(c.n_rows());
      shared->set_state(start, none, force, none);
      own->set_state(start, none, force, none);
      const IncrementEnergy energy = advance(*shared, force, q, motions, &velocity);
      const IncrementEnergy energy_own = advance(*own, force, q, motions, &velocity_own);
      EXPECT_LT((velocity - velocity_own).norm(), 1e-9 * velocity_own.norm());
      EXPECT_LT((shared->velocity() - own->velocity()).norm(), 1e-9 * own->velocity().norm());
      EXPECT_LT((shared->displacement() - own->displacement()).norm(), 1e-9 * own->displacement().norm());
      EXPECT_LT((shared->reactions(none) - own->reactions(none)).norm(), 1e-8 * (1.0 + own->reactions(none).norm()));
      EXPECT_NEAR(energy.strain, energy_own.strain, 1e-9 * energy_own.strain);
      EXPECT_NEAR(energy.loads, energy_own.loads, 1e-8 * (std::abs(energy_own.loads) + energy_own.strain));
    }
}

// Tangents that do not turn with the piece: L and S0 are still the same, H is not.
TEST(TurnedPiece, whose_rows_have_directions_of_their_own_shares_the_factor_alone) {
  PieceCase c, turned;
  for (PieceCase* one : {&c, &turned}) {
    one->dt = equal_dt;
    one->make();
  }
  turned.body.mass = c.body.mass;
  turned.turn(some_turn());
  const Mat3 other = Eigen::AngleAxisd(-1.1, Vec3(0.2, 0.4, 1.0).normalized()).toRotationMatrix();
  for (InterfaceRow& row : turned.setup.rows) row.nodes[0].along = other * row.nodes[0].along;
  const auto turn = turn_of(c.setup, turned.setup);
  ASSERT_TRUE(turn.has_value());
  const auto first = make_piece(c.setup, false, {}), shared = make_piece(turned.setup, false, {first.get(), *turn});
  first->set_search_directions(c.directions());
  shared->set_search_directions(turned.directions());
  EXPECT_EQ(first->condensation()->factor, shared->condensation()->factor);
  EXPECT_FALSE(have_equal_springs(first->op(), c.directions(), shared->op(), turned.directions()));
  EXPECT_TRUE(have_equal_springs(first->op(), c.directions(), first->op(), c.directions()));
  EXPECT_FALSE(have_equal_springs(first->op(), c.directions(), first->op(), (1.0 + 1e-6) * c.directions()));
  const auto alone = turned.piece();
  const Mat compliance = row_compliance(*alone);
  EXPECT_LT((row_compliance(*shared) - compliance).norm(), 1e-8 * compliance.norm());
  const Vec own = alone->schur_diagonal();
  EXPECT_LT((shared->schur_diagonal() - own).norm(), 1e-9 * own.norm());
}

}  // namespace
}  // namespace dygita

// The state of a piece: copied, put back, taken from fields.
#include <gtest/gtest.h>

#include "pieces/piece_case.hpp"

namespace dygita::state_tests {
namespace {

constexpr double state_dt = 0.4e-6;

std::vector<PieceCase> cases() {
  std::vector<PieceCase> all(5);
  for (PieceCase& c : all) c.dt = state_dt;
  all[1].damping = {2e5, 1e-7};
  all[1].is_moved = true;
  all[2].has_massless = true;
  all[3].is_absorbing = all[3].has_matrix = true;
  all[4].dt = 0.0;
  for (PieceCase& c : all) c.make();
  return all;
}

std::vector<double> motions(const PieceCase& c, int i) {
  return c.is_moved ? std::vector<double>{0.1 * i, -0.2} : std::vector<double>{};
}

void expect_same_bits(const PieceState& a, const PieceState& b) {
  EXPECT_EQ(a.u, b.u);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.w, b.w);
  EXPECT_EQ(a.z, b.z);
  EXPECT_EQ(a.momentum, b.momentum);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.imbalance, b.imbalance);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.held_pull, b.held_pull);
  EXPECT_EQ(a.held_u, b.held_u);
  EXPECT_EQ(a.held_v, b.held_v);
  EXPECT_EQ(a.held_reaction, b.held_reaction);
  EXPECT_EQ(a.n_since_product, b.n_since_product);
}

TEST(PieceState, put_back_gives_the_same_bits_once_more) {
  for (const bool is_plain : {false, true})
    for (const PieceCase& c : cases()) {
      const auto piece = c.piece(is_plain);
      const auto step = [&](int i) {
        return advance(*piece, 1e3 * random_points(c.n_nodes(), i), 1e3 * random_vector(c.n_rows(), i), motions(c, i));
      };
      // Out of balance at the start: the first increment books that, each time it is run.
      piece->set_state(1e-6 * random_points(c.n_nodes(), 1), random_points(c.n_nodes(), 2),
                       1e3 * random_points(c.n_nodes(), 3), Points::Zero(3, c.n_nodes()));
      for (int from = 0; from < 2; ++from) {
        const PieceState start = piece->state();
        std::vector<IncrementEnergy> energies;
        for (int i = 0; i < 3; ++i) energies.push_back(step(i));
        const PieceState end = piece->state();
        EXPECT_NE(start.u, end.u);
        piece->restore(start);
        expect_same_bits(piece->state(), start);
        for (int i = 0; i < 3; ++i) {
          const IncrementEnergy again = step(i);
          EXPECT_EQ(again.kinetic, energies[i].kinetic);
          EXPECT_EQ(again.strain, energies[i].strain);
          EXPECT_EQ(again.loads, energies[i].loads);
          EXPECT_EQ(again.damping, energies[i].damping);
          EXPECT_EQ(again.scheme, energies[i].scheme);
        }
        expect_same_bits(piece->state(), end);
      }
    }
}

TEST(PieceState, gives_back_the_fields_it_was_taken_from) {
  for (const PieceCase& c : cases()) {
    const auto piece = c.piece();
    const Points u = 1e-6 * random_points(c.n_nodes(), 1), v = random_points(c.n_nodes(), 2);
    piece->set_state(u, v, random_points(c.n_nodes(), 3), random_points(c.n_nodes(), 4));
    EXPECT_LT((piece->displacement() - u).norm(), 1e-15 * u.norm());
    // A support that rests has no velocity, whatever the field says.
    Points allowed = v;
    for (const HeldDirection& held : piece->op().held())
      if (held.motion.empty()) allowed.col(held.node) -= held.direction.dot(allowed.col(held.node)) * held.direction;
    EXPECT_LT((piece->velocity() - allowed).norm(), 1e-14 * v.norm());
    EXPECT_TRUE(piece->acceleration().isZero(0.0));  // of no increment
    EXPECT_TRUE(piece->reactions(u).isZero(0.0));
    EXPECT_TRUE(piece->absorbing_force().isZero(0.0));
  }
}

TEST(PieceState, at_rest_stays_at_rest) {
  for (const PieceCase& c : cases()) {
    const auto piece = c.piece();
    const Points still = Points::Zero(3, c.n_nodes());
    piece->set_state(still, still, still, still);
    for (int i = 0; i < 3; ++i) {
      const IncrementEnergy energy =
          advance(*piece, still, Vec::Zero(c.n_rows()), c.is_moved ? std::vector<double>{0, 0} : std::vector<double>{});
      EXPECT_EQ(energy.kinetic + energy.strain + std::abs(energy.loads) + energy.damping + std::abs(energy.scheme),
                0.0);
    }
    EXPECT_TRUE(piece->displacement().isZero(0.0));
    EXPECT_TRUE(piece->velocity().isZero(0.0));
  }
}

// Prestressed, with the forces that hold it: a dynamic step begins without a jolt.
TEST(PieceState, in_balance_stays_where_it_is) {
  for (const PieceCase& c : cases()) {
    if (c.is_moved) continue;
    const auto piece = c.piece();
    const DensePiece dense(c);
    Vec u = 1e-6 * random_vector(dense.n, 1);
    u -= dense.held * (dense.held.transpose() * u);
    const Vec interface = 1e3 * random_vector(c.n_rows(), 2), on_nodes = dense.rows * interface;
    Vec force = dense.k * u - on_nodes;
    force -= dense.held * (dense.held.transpose() * force);
    piece->set_state(nodal(u), Points::Zero(3, c.n_nodes()), nodal(force), nodal(on_nodes));
    for (int i = 0; i < 3; ++i) advance(*piece, nodal(force), interface, {});  // V = 0: F = q
    EXPECT_LT((flat(piece->displacement()) - u).norm(), 1e-9 * u.norm());
    EXPECT_LT(dense.scheme.dt * piece->velocity().norm(), 1e-9 * u.norm());
  }
}

}  // namespace
}  // namespace dygita::state_tests

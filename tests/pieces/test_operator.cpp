// The operator of a piece against dense matrices.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "numerics/dense.hpp"
#include "pieces/piece_case.hpp"

namespace dygita::operator_tests {
namespace {

constexpr double operator_dt = 0.4e-6;

void expect_equal(const Mat& found, const Mat& expected, double tolerance) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LT((found - expected).norm(), tolerance * expected.norm());
}

std::vector<PieceCase> cases() {
  std::vector<PieceCase> all(12);
  for (PieceCase& c : all) c.dt = operator_dt;
  all[1].dt = 0.0;                   // static
  all[2].holds_normal_alone = true;  // nodes of whose directions one is held
  all[3].is_absorbing = true;        // and nothing held
  all[4].has_matrix = true;          // tuned mass
  all[5].has_massless = true;
  all[6].damping = {2e3, 3e-8};
  all[6].g = 0.45;
  all[7].dt = 0.0;  // static, unconstrained: only the rows hold it
  all[7].is_held = false;
  for (int i = 8; i < 12; ++i) all[i].has_spread_rows = true;
  all[9].holds_normal_alone = true;
  all[10].dt = all[11].dt = 0.0;
  all[11].is_held = false;
  for (PieceCase& c : all) c.make();
  return all;
}

TEST(PieceOperator, answers_with_the_inverse_of_the_whole_matrix_at_the_rows) {
  for (const PieceCase& c : cases())
    for (const bool is_plain : {false, true})
      expect_equal(row_compliance(*c.piece(is_plain)), DensePiece(c).compliance(c.directions()), 1e-8);
}

// A step that takes few products has no inverse: its answers are the same, of some rows and of all.
TEST(PieceOperator, answers_by_substitution_where_few_products_are_expected) {
  for (PieceCase& c : cases()) {
    c.setup.n_products = 0.0;
    const auto piece = c.piece();
    const Mat exact = DensePiece(c).compliance(c.directions());
    expect_equal(row_compliance(*piece), exact, 1e-8);
    const std::vector<int> some = {0, 3, c.n_rows() - 1};
    expect_equal(piece->row_compliance(some), exact(Eigen::all, some), 1e-8);
  }
}

TEST(PieceOperator, gives_the_diagonal_of_the_schur_complement_without_reference_stiffness) {
  for (const PieceCase& c : cases()) {
    if (c.has_spread_rows) continue;
    const DensePiece dense(c);
    // The rows span all directions of their nodes: S0 is the inverse of the compliance, where there is one.
    const Mat a = dense.free.transpose() * dense.matrix() * dense.free, b = dense.free.transpose() * dense.rows;
    const Mat inside = Mat::Identity(a.rows(), a.rows()) - b * b.transpose();
    const Mat interior = inside * a * inside + b * b.transpose();
    const Mat coupling = inside * a * b;
    const Mat schur = b.transpose() * a * b - coupling.transpose() * solve_dense(interior, coupling);
    expect_equal(c.piece()->schur_diagonal(), schur.diagonal(), 1e-8);
  }
}

// The compliance gets a millionth of its diagonal more. Held free of everything, that of the rows alone is infinite.
TEST(PieceOperator, gives_rows_over_several_nodes_the_stiffness_of_their_side) {
  for (const PieceCase& c : cases()) {
    if (!c.has_spread_rows || (c.setup.scheme.is_static && !c.is_held)) continue;
    const DensePiece dense(c);
    const Mat a = dense.free.transpose() * dense.matrix() * dense.free, b = dense.free.transpose() * dense.rows;
    Mat compliance = b.transpose() * solve_dense(a, b);
    compliance.diagonal() *= 1.1;  // manual, eq. K6
    const Mat stiffness = solve_dense(compliance, Mat::Identity(c.n_rows(), c.n_rows()));
    expect_equal(c.piece()->schur_diagonal(), stiffness.diagonal(), 1e-8);
  }
}

TEST(PieceOperator, gives_rows_over_several_nodes_of_an_unconstrained_piece_their_stiffness_without_reference) {
  const std::vector<PieceCase> all = cases();
  const PieceCase& c = all.back();
  const DensePiece dense(c);
  Vec reference(c.n_rows());
  for (int i = 0; i < c.n_rows(); ++i) reference[i] = c.setup.rows[i].reference_stiffness;
  ASSERT_GT(reference.minCoeff(), 0.0);
  Mat compliance = dense.compliance(reference);
  compliance.diagonal() *= 1.1;  // manual, eq. K6
  const Mat stiffness = solve_dense(compliance, Mat::Identity(c.n_rows(), c.n_rows()));
  expect_equal(c.piece()->schur_diagonal(), stiffness.diagonal() - reference, 1e-6);
}

TEST(PieceOperator, shares_the_schur_diagonal_among_laws_at_a_node) {
  PieceCase c;
  c.dt = operator_dt;
  c.make();
  const Vec alone = c.piece()->schur_diagonal();
  const size_t n = c.setup.rows.size();
  for (size_t i = 0; i < n; ++i) {
    c.setup.rows[i].n_sharing = 2.0;
    c.setup.rows.push_back(c.setup.rows[i]);
  }
  const Vec shared = c.piece()->schur_diagonal();
  expect_equal(shared.head(static_cast<Eigen::Index>(n)), 0.5 * alone, 1e-13);
  expect_equal(shared.tail(static_cast<Eigen::Index>(n)), 0.5 * alone, 1e-13);
}

TEST(PieceOperator, serves_an_equal_piece_too) {
  for (const bool is_plain : {false, true}) {
    PieceCase c;
    c.dt = operator_dt;
    c.make();
    const auto first = c.piece(is_plain);
    const auto second = make_piece(c.setup, is_plain, {first.get()});
    second->set_search_directions(c.directions());
    EXPECT_FALSE(first->shares_operator());
    EXPECT_TRUE(second->shares_operator());
    EXPECT_EQ(first->condensation()->factor, second->condensation()->factor);
    EXPECT_EQ(first->shared_key(), second->shared_key());
    EXPECT_EQ(first->shared_key() == nullptr, is_plain);
    EXPECT_EQ(row_compliance(*first), row_compliance(*second));
    if (is_plain) continue;
    EXPECT_LT(second->figures().bytes, 0.5 * first->figures().bytes);
  }
}

TEST(PieceOperator, of_other_search_directions_is_its_own_but_for_the_factor) {
  PieceCase c;
  c.dt = operator_dt;
  c.make();
  const auto first = make_piece(c.setup, false, {}), second = make_piece(c.setup, false, {first.get()});
  EXPECT_THROW(second->set_search_directions(Vec::Ones(1)), ContractError);
  first->set_search_directions(c.directions());
  second->set_search_directions(2.0 * c.directions());
  expect_equal(row_compliance(*first), DensePiece(c).compliance(c.directions()), 1e-8);
  expect_equal(row_compliance(*second), DensePiece(c).compliance(2.0 * c.directions()), 1e-8);
}

TEST(PieceOperator, predicts_the_bytes_of_its_factor) {
  PieceCase c;
  c.dt = operator_dt;
  c.make();
  const double held = c.piece()->figures().bytes;
  EXPECT_NEAR(predicted_bytes(c.setup, false), held, 0.2 * held);
  EXPECT_LT(predicted_bytes(c.setup, true), 0.5 * held);
}

TEST(PieceOperator, of_a_piece_that_is_held_everywhere_has_nothing_to_find) {
  PieceCase c;
  c.dt = operator_dt;
  c.make();
  c.setup.rows.clear();
  for (int node = 0; node < c.n_nodes(); ++node) c.setup.held[node] = Held{3, Mat3::Identity(), {}, {}};
  const auto piece = make_piece(c.setup, false, {});
  piece->set_search_directions(Vec());
  const Points still = Points::Zero(3, c.n_nodes());
  piece->set_state(still, still, still, still);
  advance(*piece, random_points(c.n_nodes(), 1), Vec(), {});
  EXPECT_EQ(piece->displacement(), still);
  EXPECT_LT((piece->reactions(still) + random_points(c.n_nodes(), 1)).norm(), 1e-15);
}

TEST(PieceOperator, that_cannot_be_factorised_is_named) {
  PieceCase c;
  c.make();
  BodyMatrices negative{-*c.body.matrices->stiffness(), c.body.matrices->mass()};
  c.body.matrices = std::make_shared<const StoredMatrices>(std::move(negative));
  try {
    make_piece(c.setup, false, {});
    FAIL() << "a negative definite matrix was factorised";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("substructure 'block' in step 'test'"), std::string::npos) << error.what();
  }
}

TEST(FreeUnknowns, take_fields_apart_and_put_them_together) {
  for (const PieceCase& c : cases()) {
    const auto piece = c.piece();
    const FreeUnknowns& unknowns = piece->op().unknowns();
    const Points field = random_points(c.n_nodes(), 9);
    std::vector<double> held;
    for (const HeldDirection& direction : unknowns.held())
      held.push_back(direction.direction.dot(field.col(direction.node)));
    EXPECT_LT((unknowns.expand(unknowns.restrict_nodal(field), held) - field).norm(), 1e-14 * field.norm());
    const Vec free = unknowns.restrict_nodal(field);
    const Vec at_rows = piece->op().at_rows(free) + piece->op().held_at_rows(held);
    for (int i = 0; i < c.n_rows(); ++i) {
      double expected = 0.0;
      for (const NodeAlong& on : c.setup.rows[i].nodes) expected += on.along.dot(field.col(on.node));
      EXPECT_NEAR(at_rows[i], expected, 1e-14);
    }
  }
}

}  // namespace
}  // namespace dygita::operator_tests

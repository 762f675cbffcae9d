// Increments of a piece by itself against the equations of the scheme, solved densely, and its energy.
#include <gtest/gtest.h>

#include <functional>

#include "pieces/piece_case.hpp"

namespace dygita::increment_tests {
namespace {

constexpr double increment_dt = 0.4e-6;

struct Variant {
  std::string name;
  std::function<void(PieceCase&)> set;
};

std::vector<Variant> of_single_nodes() {
  return {
      {"lumped", [](PieceCase&) {}},
      {"numerical dissipation", [](PieceCase& c) { c.g = 0.4; }},
      {"mass damping", [](PieceCase& c) { c.damping.mass = 2e5; }},
      {"stiffness damping", [](PieceCase& c) { c.damping.stiffness = 1e-7; }},
      {"both dampings and numerical dissipation",
       [](PieceCase& c) {
         c.damping = {2e5, 1e-7};
         c.g = 0.4;
       }},
      {"tuned mass", [](PieceCase& c) { c.has_matrix = true; }},
      {"non-reflecting support", [](PieceCase& c) { c.is_absorbing = true; }},
      {"non-reflecting support with numerical dissipation",
       [](PieceCase& c) {
         c.is_absorbing = true;
         c.g = 0.4;
       }},
      {"partly held", [](PieceCase& c) { c.holds_normal_alone = true; }},
      {"moving support", [](PieceCase& c) { c.is_moved = true; }},
      {"moving support, tuned mass and damping",
       [](PieceCase& c) {
         c.is_moved = c.has_matrix = true;
         c.damping = {2e5, 1e-7};
       }},
      {"moving support and numerical dissipation",
       [](PieceCase& c) {
         c.is_moved = true;
         c.g = 0.4;
       }},
      {"interface without mass", [](PieceCase& c) { c.has_massless = true; }},
      {"interface without mass, numerical dissipation and moving support",
       [](PieceCase& c) {
         c.has_massless = c.is_moved = true;
         c.g = 0.4;
       }},
      {"interface without mass, tuned mass elsewhere", [](PieceCase& c) { c.has_massless = c.has_matrix = true; }},
      {"static", [](PieceCase& c) { c.dt = 0.0; }},
      {"static, moving support",
       [](PieceCase& c) {
         c.dt = 0.0;
         c.is_moved = true;
       }},
      {"static, unconstrained",
       [](PieceCase& c) {
         c.dt = 0.0;
         c.is_held = false;
       }},
  };
}

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = [] {
    std::vector<Variant> list = of_single_nodes();
    for (const Variant& variant : of_single_nodes())
      list.push_back({variant.name + ", rows over several nodes", [variant](PieceCase& c) {
                        variant.set(c);
                        c.has_spread_rows = true;
                      }});
    return list;
  }();
  return all;
}

// A piece and its equal in dense matrices, from the same start: in balance with external and interface forces.
struct Pair {
  PieceCase of;
  std::unique_ptr<ImplicitPiece> piece;
  std::unique_ptr<DensePiece> dense;
  Vec u, v, force, interface;  // nodal
  Vec on_rows;                 // the interface's force
  Vec k;

  explicit Pair(const Variant& variant, bool is_plain = false) {
    of.dt = increment_dt;
    variant.set(of);
    of.make();
    piece = of.piece(is_plain);
    dense = std::make_unique<DensePiece>(of);
    k = of.directions();
    const bool is_static = of.setup.scheme.is_static;
    // Start from a displacement that the supports allow, at the speed of their motions.
    const Vec held_velocity = dense->held_velocity({0.3, -0.2});
    u = 1e-6 * random_vector(dense->n, 1);
    u -= dense->held * (dense->held.transpose() * u);
    v = is_static ? Vec::Zero(dense->n) : Vec(0.5 * random_vector(dense->n, 2));
    if (!is_static) v += held_velocity - dense->held * (dense->held.transpose() * v);
    on_rows = 2e3 * random_vector(of.n_rows(), 4);
    interface = dense->rows * on_rows;
    force = dense->k * u - interface;
    if (dense->held.cols() > 0) force -= dense->held * (dense->held.transpose() * force);
    piece->set_state(nodal(u), nodal(v), nodal(force), nodal(interface));
  }

  std::vector<double> motions(int i) const {
    if (!of.is_moved) return {};
    const double scale = of.setup.scheme.is_static ? 1e-6 : 1.0;
    return {scale * (0.3 + 0.1 * i), scale * (-0.2 + 0.07 * i)};
  }
  Vec data(int i) const { return 3e3 * random_vector(of.n_rows(), 20 + i); }
  Vec load(int i) const { return force + 4e3 * random_vector(dense->n, 40 + i); }
};

void expect_close(const Vec& found, const Vec& expected, double tolerance, const char* what) {
  EXPECT_LT((found - expected).norm(), tolerance * expected.norm()) << what;
}

void expect_scheme(const Variant& variant, bool is_plain) {
  SCOPED_TRACE(variant.name);
  Pair pair(variant, is_plain);
  const DensePiece& dense = *pair.dense;
  for (int i = 0; i < 5; ++i) {
    const Vec q = pair.data(i), load = pair.load(i);
    const Vec v1 = dense.solve(pair.u, pair.v, load, q, pair.k, pair.motions(i));
    const Vec u1 = dense.next_displacement(pair.u, pair.v, v1);
    Vec at_rows;
    advance(*pair.piece, nodal(load), q, pair.motions(i), &at_rows);
    expect_close(at_rows, dense.rows.transpose() * v1, 1e-8, "velocity at the rows");
    expect_close(flat(pair.piece->velocity()), v1, 1e-8, "velocity");
    expect_close(flat(pair.piece->displacement()), u1, 1e-8, "displacement");
    expect_close(pair.piece->row_displacements(), dense.rows.transpose() * u1, 1e-8, "displacement of the rows");
    if (!dense.scheme.is_static)
      expect_close(flat(pair.piece->acceleration()), (v1 - pair.v) / dense.scheme.dt, 1e-7, "acceleration");
    // What is left of the equation at the supports is their reaction.
    const Vec interface = dense.rows * (q - pair.k.cwiseProduct(dense.rows.transpose() * v1));
    const Vec left = dense.matrix() * v1 - dense.rest(pair.u, pair.v) - load - interface;
    const Vec drag = dense.z * (dense.g * pair.v + (1 - dense.g) * v1);
    if (dense.held.cols() > 0)
      expect_close(flat(pair.piece->reactions(nodal(interface))), dense.held * (dense.held.transpose() * left), 1e-7,
                   "reactions");
    if (pair.of.is_absorbing) expect_close(flat(pair.piece->absorbing_force()), -drag, 1e-8, "non-reflecting force");
    pair.u = u1;
    pair.v = v1;
  }
}

TEST(Increment, is_the_schemes_equation_solved) {
  for (const Variant& variant : variants()) expect_scheme(variant, false);
}

TEST(Increment, solved_in_full_is_the_same) {
  for (const Variant& variant : variants()) expect_scheme(variant, true);
}

// E2: what is stored changes by the works of loads and interfaces, less what damping and scheme take.
TEST(Increment, books_all_its_energy) {
  for (const Variant& variant : variants()) {
    SCOPED_TRACE(variant.name);
    Pair pair(variant);
    const DensePiece& dense = *pair.dense;
    const TimeScheme& scheme = dense.scheme;
    const auto stored = [&](const Vec& u, const Vec& v) {
      return 0.5 * u.dot(dense.k * u) + (scheme.is_static ? 0.0 : 0.5 * v.dot(dense.mass * v));
    };
    const IncrementEnergy start = pair.piece->stored_energy();
    EXPECT_NEAR(start.kinetic + start.strain, stored(pair.u, pair.v), 1e-9 * stored(pair.u, pair.v));
    Vec force_on_rows = pair.on_rows;
    for (int i = 0; i < 4; ++i) {
      const Vec q = pair.data(i);
      const double before = stored(pair.u, pair.v);
      const IncrementEnergy energy = advance(*pair.piece, nodal(pair.load(i)), q, pair.motions(i));
      const Vec u1 = flat(pair.piece->displacement()), v1 = flat(pair.piece->velocity());
      EXPECT_NEAR(energy.kinetic, scheme.is_static ? 0.0 : 0.5 * v1.dot(dense.mass * v1), 1e-9 * stored(u1, v1));
      EXPECT_NEAR(energy.strain, 0.5 * u1.dot(dense.k * u1), 1e-8 * stored(u1, v1));
      const Vec force = q - pair.k.cwiseProduct(dense.rows.transpose() * v1);
      const bool is_of_the_end = scheme.is_static || pair.of.has_massless;
      const Vec motion = scheme.dt * dense.mean_velocity(pair.v, v1);
      const double on_piece =
          (is_of_the_end ? Vec(0.5 * (force_on_rows + force)) : force).dot(dense.rows.transpose() * motion);
      EXPECT_NEAR(energy.kinetic + energy.strain - before, energy.loads + on_piece - energy.damping - energy.scheme,
                  1e-8 * (before + energy.kinetic + energy.strain));
      const bool has_damping = pair.of.is_absorbing || pair.of.damping.mass + pair.of.damping.stiffness > 0.0;
      EXPECT_EQ(energy.damping > 0.0, has_damping && !scheme.is_static);
      const bool gives_nothing_away = pair.of.g == 0.5 && !scheme.is_static && i > 0;
      EXPECT_TRUE(!gives_nothing_away || energy.scheme == 0.0);
      pair.u = u1;
      pair.v = v1;
      force_on_rows = force;
    }
  }
}

// The second term of E2, with numerical dissipation.
TEST(Increment, books_what_the_scheme_takes) {
  const Variant dissipation{"numerical dissipation", [](PieceCase& c) { c.g = 0.4; }};
  Pair pair(dissipation);
  const DensePiece& dense = *pair.dense;
  const IncrementEnergy energy = advance(*pair.piece, nodal(pair.load(0)), pair.data(0), {});
  const Vec du = flat(pair.piece->displacement()) - pair.u, dv = flat(pair.piece->velocity()) - pair.v;
  const double expected = 0.1 * (du.dot(dense.k * du) + dv.dot(dense.mass * dv));
  EXPECT_NEAR(energy.scheme, expected, 1e-8 * expected);
}

// Where neither loads nor interfaces have changed nothing is solved, and nothing moves otherwise than it did.
TEST(Increment, without_a_change_is_not_solved) {
  Pair pair(variants().front());
  const Points still = Points::Zero(3, pair.of.n_nodes());
  pair.piece->set_state(still, still, still, still);
  Piece* const self = pair.piece.get();
  Vec velocity(pair.of.n_rows());
  const Vec none = Vec::Zero(pair.of.n_rows());
  self->begin(still, {}, 1e-12);
  self->forward({&self, 1});
  self->interface_velocity(none, velocity);
  EXPECT_TRUE(velocity.isZero(0.0));
  self->backward({&self, 1});
  self->finish(none, nullptr);
  EXPECT_EQ(self->figures().n_solved, 0);
  EXPECT_EQ(self->figures().n_spared, 2);
  // The interfaces wake it.
  self->begin(still, {}, 1e-12);
  self->forward({&self, 1});
  self->interface_velocity(pair.data(0), velocity);
  EXPECT_GT(velocity.norm(), 0.0);
  self->backward({&self, 1});
  self->finish(pair.data(0), nullptr);
  EXPECT_EQ(self->figures().n_solved, 2);
}

// Sixteen columns of one factor's solve are sixteen pieces.
TEST(Increment, of_equal_pieces_together_is_that_of_each) {
  PieceCase c;
  c.dt = increment_dt;
  c.make();
  constexpr int n = 5;
  std::vector<std::unique_ptr<ImplicitPiece>> together;
  std::vector<Piece*> group;
  for (int i = 0; i < n; ++i) {
    together.push_back(make_piece(c.setup, false, {i > 0 ? together.front().get() : nullptr}));
    group.push_back(together.back().get());
  }
  for (const auto& piece : together) piece->set_search_directions(c.directions());
  const Points still = Points::Zero(3, c.n_nodes());
  Vec velocity(c.n_rows());
  const auto data = [&](int i) { return Vec(1e3 * random_vector(c.n_rows(), i)); };
  for (int i = 0; i < n; ++i) {
    group[i]->set_state(still, still, still, still);
    group[i]->begin(1e3 * random_points(c.n_nodes(), 60 + i), {}, 0.0);
  }
  group.front()->forward(group);
  for (int i = 0; i < n; ++i) group[i]->interface_velocity(data(i), velocity);
  group.front()->backward(group);
  for (int i = 0; i < n; ++i) group[i]->finish(data(i), nullptr);
  for (int i = 0; i < n; ++i) {
    const auto alone = c.piece();
    alone->set_state(still, still, still, still);
    advance(*alone, 1e3 * random_points(c.n_nodes(), 60 + i), data(i), {});
    EXPECT_LT((alone->velocity() - group[i]->velocity()).norm(), 1e-12 * alone->velocity().norm());
  }
}

// Single precision bounds what is stored; products by K every few increments keep the recurrence from drifting.
TEST(Increment, in_single_precision_stays_close) {
  PieceCase c;
  c.dt = increment_dt;
  c.make();
  const auto exact = c.piece();
  c.setup.precision = Precision::single_precision;
  const auto rough = c.piece();
  EXPECT_TRUE(rough->figures().is_in_single_precision);
  const Points still = Points::Zero(3, c.n_nodes());
  for (Piece* piece : {static_cast<Piece*>(exact.get()), static_cast<Piece*>(rough.get())}) {
    piece->set_state(still, still, still, still);
    for (int i = 0; i < 40; ++i)
      advance(*piece, 1e3 * random_points(c.n_nodes(), i), 1e3 * random_vector(c.n_rows(), i), {});
  }
  const double error = (exact->velocity() - rough->velocity()).norm() / exact->velocity().norm();
  EXPECT_LT(error, 1e-5);
  EXPECT_GT(error, 0.0);
}

// What has changed since the last whole product, to the error that its operator has; then whole again.
TEST(Increment, answers_changes_in_half_precision) {
  PieceCase c;
  c.dt = increment_dt;
  c.make();
  c.setup.precision = Precision::single_precision;
  const auto plain = c.piece();
  c.setup.half_error = 0x1p-16;
  const auto half = c.piece();
  EXPECT_FALSE(plain->has_operator_in_half());
  ASSERT_TRUE(half->has_operator_in_half());
  const Points still = Points::Zero(3, c.n_nodes());
  const Vec first = 1e3 * random_vector(c.n_rows(), 1), second = first + 1e3 * random_vector(c.n_rows(), 2);
  Vec exact(c.n_rows()), found(c.n_rows());
  for (Piece* piece : {static_cast<Piece*>(plain.get()), static_cast<Piece*>(half.get())}) {
    piece->set_state(still, still, still, still);
    piece->begin(1e3 * random_points(c.n_nodes(), 3), {}, 0.0);
    piece->forward({&piece, 1});
    piece->interface_velocity(first, piece == plain.get() ? exact : found);
  }
  EXPECT_EQ(found, exact);
  plain->interface_velocity_in_half(second, exact);  // has no such form
  half->interface_velocity_in_half(second, found);
  EXPECT_LT((found - exact).norm(), 1e-4 * exact.norm());
  EXPECT_GT((found - exact).norm(), 0.0);
  half->interface_velocity(second, found);
  EXPECT_EQ(found, exact);
}

// A node of a bent plate is all interface: solved in full because that costs less.
TEST(Increment, of_a_piece_that_is_almost_all_interface_is_solved_in_full) {
  PieceCase c;
  c.dt = increment_dt;
  c.make();
  c.part->mesh = box_mesh(Vec3::Zero(), {0.1, 0.1, 0.002}, {16, 16, 1});
  c.body.matrices = std::make_shared<const StoredMatrices>(c.part->mesh, c.part->material, true);
  c.body.mass = std::make_shared<const Mass>(Mass{c.body.matrices->mass(), {}, {}});
  c.setup.held.clear();
  c.setup.rows.clear();
  for (int node = 0; node < c.n_nodes(); ++node)
    for (int d = 0; d < 3; ++d) c.setup.rows.push_back({{{node, Vec3::Unit(d)}}, 0.0, 2e9, 1.0});
  const auto piece = c.piece();
  EXPECT_TRUE(piece->figures().is_mostly_interface);
  EXPECT_EQ(piece->schur_diagonal().size(), 0);
  const DensePiece dense(c);
  const Points still = Points::Zero(3, c.n_nodes());
  piece->set_state(still, still, still, still);
  const Vec q = 1e3 * random_vector(c.n_rows(), 5), load = 1e3 * random_vector(dense.n, 6);
  Vec found;
  advance(*piece, nodal(load), q, {}, &found);
  const Vec none = Vec::Zero(dense.n);
  const Vec expected = dense.solve(none, none, load, q, c.directions(), {});
  EXPECT_LT((found - dense.rows.transpose() * expected).norm(), 1e-8 * expected.norm());
}

}  // namespace
}  // namespace dygita::increment_tests

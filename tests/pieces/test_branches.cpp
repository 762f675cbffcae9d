// Branches of a material's damping in the increments of a piece: the equations of the scheme, energies, decay
// (manual, eq. D22-D25, S16).
#include <gtest/gtest.h>

#include <complex>
#include <functional>
#include <numbers>

#include "pieces/central_differences.hpp"
#include "pieces/longest_step.hpp"
#include "pieces/piece_case.hpp"

namespace dygita::branches_tests {
namespace {

constexpr double branches_dt = 0.4e-6;
const std::vector<Branch> some_branches{{0.3, 1e5}, {0.5, 2e6}, {-0.2, 0.0}};

struct Variant {
  std::string name;
  std::function<void(PieceCase&)> set;
};

std::vector<Variant> variants() {
  return {{"held", [](PieceCase&) {}},
          {"partly held", [](PieceCase& c) { c.holds_normal_alone = true; }},
          {"numerical dissipation", [](PieceCase& c) { c.g = 0.4; }},
          {"moving support", [](PieceCase& c) { c.is_moved = true; }},
          {"moving support and numerical dissipation",
           [](PieceCase& c) {
             c.is_moved = true;
             c.g = 0.4;
           }},
          {"beside Rayleigh's, with a mass matrix",
           [](PieceCase& c) {
             c.damping.mass = 2e5;
             c.damping.stiffness = 1e-7;
             c.has_matrix = true;
           }},
          {"non-reflecting support", [](PieceCase& c) { c.is_absorbing = true; }},
          {"spread rows", [](PieceCase& c) { c.has_spread_rows = true; }}};
}

// S1 with the branches at the mean of their ends, each by its own equation; its energies.
TEST(Branches, of_an_implicit_piece_are_those_of_the_scheme) {
  for (const Variant& variant : variants())
    for (const bool is_plain : {false, true}) {
      SCOPED_TRACE(variant.name);
      PieceCase c;
      c.dt = branches_dt;
      c.damping.branches = some_branches;
      variant.set(c);
      c.make();
      const auto piece = c.piece(is_plain);
      const DensePiece dense(c);
      const Vec k = c.directions();
      const TimeScheme& scheme = dense.scheme;
      const double dt = scheme.dt, g = dense.g;
      Vec u = 1e-6 * random_vector(dense.n, 1), v = 0.5 * random_vector(dense.n, 2);
      u -= dense.held * (dense.held.transpose() * u);
      v += dense.held_velocity(c.is_moved ? std::vector<double>{0.3, -0.2} : std::vector<double>()) -
           dense.held * (dense.held.transpose() * v);
      std::vector<Vec> e;
      std::vector<Points> given;
      for (int b = 0; b < 3; ++b) {
        e.push_back(1e-6 * random_vector(dense.n, 5 + b));
        given.push_back(nodal(e.back()));
      }
      given.push_back(Points::Zero(3, c.n_nodes()));  // of a material that has more
      const Vec force = dense.k * u;
      piece->set_state(nodal(u), nodal(v), nodal(force), Points::Zero(3, c.n_nodes()));
      piece->set_elongations(given);
      const auto strain = [&] {
        double sum = 0.5 * u.dot(dense.k * u);
        for (size_t b = 0; b < e.size(); ++b) sum += 0.5 * some_branches[b].strength * e[b].dot(dense.k * e[b]);
        return sum;
      };
      EXPECT_NEAR(piece->stored_energy().strain, strain(), 1e-9 * strain());
      for (int i = 0; i < 6; ++i) {
        const Vec q = 3e3 * random_vector(c.n_rows(), 20 + i), load = force + 4e3 * random_vector(dense.n, 40 + i);
        const std::vector<double> motions =
            c.is_moved ? std::vector<double>{0.3 + 0.1 * i, -0.2 + 0.07 * i} : std::vector<double>();
        const double before = strain() + 0.5 * v.dot(dense.mass * v);
        const IncrementEnergy energy = advance(*piece, nodal(load), q, motions);
        const Vec u1 = flat(piece->displacement()), v1 = flat(piece->velocity()), mean = g * v + (1 - g) * v1;
        EXPECT_LT((u1 - u - dt * mean).norm(), 1e-12 * u1.norm());
        const double alpha = c.damping.mass, beta = c.damping.stiffness;
        Vec strained = g * u + (1 - g) * u1 + beta * mean;
        double taken = dt * (alpha * mean.dot(dense.mass * mean) + beta * mean.dot(dense.k * mean) +
                             mean.dot(dense.z * mean)),
               scheme_s = (0.5 - g) * ((u1 - u).dot(dense.k * (u1 - u)) + (v1 - v).dot(dense.mass * (v1 - v)));
        for (size_t b = 0; b < e.size(); ++b) {
          const Branch& branch = some_branches[b];
          // (e1 - e0)/dt = V_g - r (g e0 + (1-g) e1)
          const double r = branch.rate;
          const Vec e1 = ((1.0 - g * dt * r) * e[b] + dt * mean) / (1.0 + (1 - g) * dt * r);
          const Vec middle = g * e[b] + (1 - g) * e1, change = e1 - e[b];
          strained += branch.strength * middle;
          taken += dt * branch.strength * r * middle.dot(dense.k * middle);
          scheme_s += (0.5 - g) * branch.strength * change.dot(dense.k * change);
          e[b] = e1;
          EXPECT_LT((flat(piece->elongations()[b]) - e1).norm(), 1e-9 * e1.norm()) << b;
        }
        const Vec on_rows = q - k.cwiseProduct(dense.rows.transpose() * v1), interface = dense.rows * on_rows;
        const Vec left =
            dense.mass * ((v1 - v) / dt + alpha * mean) + dense.z * mean + dense.k * strained - load - interface;
        const Vec held = dense.held * (dense.held.transpose() * left);
        EXPECT_LT((left - held).norm(), 1e-8 * (dense.k * strained).norm()) << i;
        if (dense.held.cols() > 0) {
          EXPECT_LT((flat(piece->reactions(nodal(interface))) - held).norm(), 1e-8 * held.norm()) << i;
        }
        u = u1;
        v = v1;
        const double all = before + energy.kinetic + energy.strain;
        EXPECT_NEAR(energy.strain, strain(), 1e-9 * all) << i;
        EXPECT_NEAR(energy.damping, taken, 1e-9 * all) << i;
        EXPECT_NEAR(energy.scheme, scheme_s, 1e-9 * all) << i;
        EXPECT_NEAR(energy.kinetic + energy.strain - before,
                    energy.loads + dt * on_rows.dot(dense.rows.transpose() * mean) - energy.damping - energy.scheme,
                    1e-8 * all)
            << i;
      }
      // Once more from where it was, to the same bits.
      const PieceState kept = piece->state();
      const Vec q = random_vector(c.n_rows(), 3);
      const std::vector<double> motions = c.is_moved ? std::vector<double>{0.1, 0.2} : std::vector<double>();
      advance(*piece, nodal(force), q, motions);
      const Points first = piece->velocity(), stretched = piece->elongations()[0];
      piece->restore(kept);
      advance(*piece, nodal(force), q, motions);
      EXPECT_EQ(piece->velocity(), first);
      EXPECT_EQ(piece->elongations()[0], stretched);
    }
}

TEST(Branches, do_nothing_in_a_static_step) {
  PieceCase with, without;
  with.damping.branches = some_branches;
  for (PieceCase* c : {&with, &without}) c->make();
  const auto one = with.piece(), other = without.piece();
  const Points still = Points::Zero(3, with.n_nodes()), load = 1e3 * random_points(with.n_nodes(), 1);
  for (const auto& piece : {one.get(), other.get()}) {
    piece->set_state(still, still, still, still);
    advance(*piece, load, Vec::Zero(with.n_rows()), {});
  }
  EXPECT_EQ(one->displacement(), other->displacement());
  EXPECT_TRUE(one->elongations().empty());
}

// A bar of 20 cells, held at one end, in its first mode, a quarter of a wave: the exact one of cells with lumped mass.
struct Bar {
  std::shared_ptr<Substructure> part = std::make_shared<Substructure>();
  Body body;
  PieceSetup setup;
  Points mode;
  double frequency;  // Hz, undamped, of the cells
  double longest = 0.0;

  Bar(double of_bar, const Damping& damping) {
    constexpr int n = 20;
    const double length = 5000.0 / (4.0 * of_bar), half = std::numbers::pi / (4 * n);
    part->name = "bar";
    part->mesh = box_mesh(Vec3::Zero(), {length / n, length / n, length}, {1, 1, n});
    part->material = Elastic("m", 200e9, 0.0, 8000.0, damping);
    body.part = part.get();
    body.matrices = std::make_shared<const StoredMatrices>(part->mesh, part->material, true);
    Mass mass{body.matrices->mass(), {}, {}};
    mass.all = mass.lumped.sum();
    mass.least = mass.lumped.minCoeff();
    body.mass = std::make_shared<const Mass>(std::move(mass));
    setup.body = &body;
    setup.what = "bar";
    mode = Points::Zero(3, part->mesh->n_nodes());
    for (int i = 0; i < part->mesh->n_nodes(); ++i) {
      const double z = part->mesh->nodes(2, i);
      mode(2, i) = std::sin(0.5 * std::numbers::pi * z / length);
      // It moves along itself alone.
      Held held;
      held.n = z == 0.0 ? 3 : 2;
      held.directions.col(0) = Vec3::UnitX();
      held.directions.col(1) = Vec3::UnitY();
      held.directions.col(2) = Vec3::UnitZ();
      setup.held[i] = held;
    }
    frequency = of_bar * std::sin(half) / half;
    longest = longest_explicit_step(body, setup.held);
  }

  // Marches from the mode at rest: displacement of its end, and what is left of the energy balance, J.
  std::vector<double> march(bool is_explicit, double dt, int n, double* open, double* damped) {
    setup.scheme = TimeScheme::implicit(dt);
    std::unique_ptr<Piece> piece;
    if (is_explicit)
      piece = std::make_unique<CentralDifferences>(setup, std::make_shared<const ExplicitOperator>(setup));
    else
      piece = make_piece(setup, false, {});
    piece->set_search_directions(Vec());
    const Points still = Points::Zero(3, mode.cols()), start = 1e-6 * mode;
    piece->set_state(start, still, still, still);
    piece->set_elongations(std::vector<Points>(part->material.damping.branches.size(), still));
    const IncrementEnergy first = piece->stored_energy();
    std::vector<double> end;
    *damped = 0.0;
    int top = 0;
    mode.row(2).maxCoeff(&top);
    const std::vector<int> at{top};
    IncrementEnergy now;
    for (int i = 0; i < n; ++i) {
      const IncrementEnergy of = advance(*piece, still, Vec(), {});
      *damped += of.damping;
      end.push_back(piece->displacement(at)(2, 0));
    }
    now = piece->stored_energy();
    *open = (first.strain - now.kinetic - now.strain - *damped) / first.strain;
    *damped /= first.strain;
    return end;
  }
};

// From half the way between a maximum and the next minimum, which leaves out what creeps; six periods apart.
struct Decay {
  double ratio, frequency;
};

Decay decay_of(const std::vector<double>& u, double dt) {
  std::vector<double> at, value;
  for (size_t i = 1; i + 1 < u.size(); ++i) {
    const double before = u[i] - u[i - 1], after = u[i + 1] - u[i];
    if (before * after >= 0.0) continue;
    const double shift = 0.5 * (before + after) / (before - after);
    at.push_back(dt * (static_cast<double>(i) + shift));
    value.push_back(u[i] + 0.25 * (before + after) * shift);
  }
  EXPECT_GT(at.size(), 20u);
  const auto swing = [&](size_t i) { return std::abs(value[i] - 0.5 * (value[i + 1] + value[i - 1])); };
  const double decrement = std::log(swing(7) / swing(19)) / 12.0 / std::numbers::pi;
  return {decrement / std::hypot(1.0, decrement), 6.0 * std::hypot(1.0, decrement) / (at[19] - at[7])};
}

// (1/s) of a mode of a body with branches: s^2 + w^2 K(s)/K = 0, by Newton's method.
std::complex<double> root_of(const Damping& damping, double frequency) {
  const double w = 2.0 * std::numbers::pi * frequency;
  std::complex<double> s(0.0, w);
  for (int i = 0; i < 50; ++i) {
    std::complex<double> value = s * s + w * w, slope = 2.0 * s;
    for (const Branch& b : damping.branches) {
      value += w * w * b.strength * s / (s + b.rate);
      slope += w * w * b.strength * b.rate / ((s + b.rate) * (s + b.rate));
    }
    s -= value / slope;
  }
  return s;
}

TEST(Branches, damp_a_bar_by_one_ratio_over_two_decades) {
  constexpr double ratio = 0.015;
  const Damping damping = damping_over(ratio, {100.0, 1e4});
  for (const double f : {100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4})
    for (const bool is_explicit : {false, true}) {
      Bar bar(f, damping);
      // Explicit at the limit, implicit at forty increments a period.
      const double dt = is_explicit ? 0.98 * bar.longest : 1.0 / (40.0 * f);
      double open = 0.0, damped = 0.0;
      const Decay found = decay_of(bar.march(is_explicit, dt, static_cast<int>(11.5 / (f * dt)), &open, &damped), dt);
      const std::complex<double> root = root_of(damping, bar.frequency);
      const double turn = 0.5 * std::abs(root) * dt, exact = -root.real() / std::abs(root);
      const double expected = (is_explicit ? std::asin(turn) : std::atan(turn)) / (std::numbers::pi * dt);
      printf("%8.0f Hz, %s: ratio %.5f (%.5f), frequency %.3f (%.3f), balance %.2g, damped %.3f\n", f,
             is_explicit ? "explicit" : "implicit", found.ratio, exact, found.frequency, expected, open, damped);
      EXPECT_NEAR(found.ratio, ratio, 0.1 * ratio) << f << ", " << is_explicit;
      EXPECT_NEAR(found.ratio, exact, 0.005 * ratio) << f << ", " << is_explicit;
      EXPECT_NEAR(found.frequency, expected, 1e-3 * expected) << f << ", " << is_explicit;
      EXPECT_LT(std::abs(open), 1e-9) << f << ", " << is_explicit;
      EXPECT_GT(damped, 0.8);
    }
}

TEST(Branches, damp_alike_whatever_the_time_step) {
  const Damping damping = damping_over(0.015, {100.0, 1e4});
  for (const double per_period : {10.0, 20.0, 80.0, 320.0}) {
    Bar bar(1e3, damping);
    const double dt = 1.0 / (1e3 * per_period);
    double open = 0.0, damped = 0.0;
    const Decay found = decay_of(bar.march(false, dt, static_cast<int>(12.0 * per_period), &open, &damped), dt);
    printf("%4.0f increments a period: ratio %.5f, balance %.2g\n", per_period, found.ratio, open);
    EXPECT_NEAR(found.ratio, 0.015, 0.0015) << per_period;
    EXPECT_LT(std::abs(open), 1e-9) << per_period;
  }
}

// Beyond the limit an explicit piece blows up, up to it no motion grows, where branches hardly relax in an increment.
TEST(Branches, leave_the_stable_increment_exact) {
  const Damping damping = damping_over(0.05, {20.0, 2e3});
  Bar bar(1e3, damping), undamped(1e3, {});
  EXPECT_NEAR(bar.longest, undamped.longest / std::sqrt(damping.of_sudden_motion()), 1e-12 * bar.longest);
  double open = 0.0, damped = 0.0;
  bar.mode =
      random_points(static_cast<int>(bar.mode.cols()), 1).cwiseProduct(Points::Constant(3, bar.mode.cols(), 1.0));
  bar.mode.topRows(2).setZero();
  for (int i = 0; i < bar.mode.cols(); ++i)
    if (bar.part->mesh->nodes(2, i) == 0.0) bar.mode.col(i).setZero();
  for (const double share : {0.98, 1.03}) {
    const std::vector<double> u = bar.march(true, share * bar.longest, 4000, &open, &damped);
    double last = 0.0;
    for (size_t i = u.size() - 20; i < u.size(); ++i) last = std::isfinite(u[i]) ? std::max(last, std::abs(u[i])) : 1.0;
    EXPECT_EQ(last < 2e-6, share < 1.0) << share << ": " << last;
    EXPECT_TRUE(share > 1.0 || std::abs(open) < 1e-9) << open;
  }
}

}  // namespace
}  // namespace dygita::branches_tests

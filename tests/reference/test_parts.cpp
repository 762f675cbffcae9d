// What the classic solvers are made of, each part against dense matrices or by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/dense.hpp"
#include "reference/critical_step.hpp"
#include "reference/explicit_run.hpp"
#include "reference/interface_newton.hpp"
#include "step/blocks.hpp"

namespace dygita::parts_tests {
namespace {

constexpr double parts_dt = 0.4e-6;

// Both cubes as one dense system: A V = r on all nodal directions, lower face of the first one held.
struct Whole {
  int n_one, n;
  Mat a, stiffness, mass, free, jump;  // jump: rates at the law rows, side 2 less side 1

  Whole(const Modelled& of, const MergedAssembly* assembly) {
    n_one = 3 * of.problem.substructures[0]->mesh->n_nodes();
    n = n_one + 3 * of.problem.substructures[1]->mesh->n_nodes();
    stiffness = mass = Mat::Zero(n, n);
    for (int part = 0, at = 0; part < 2; at = n_one, ++part) {
      const Mat k = Mat(*of.bodies[part].matrices->stiffness());
      stiffness.block(at, at, k.rows(), k.rows()) = k;
      for (int i = 0; i < k.rows(); ++i) mass(at + i, at + i) = of.bodies[part].mass->lumped[i / 3];
    }
    a = mass / parts_dt + 0.25 * parts_dt * stiffness;
    free = Mat::Zero(n, n - 3 * static_cast<int>(of.model.conditions.held[0].size()));
    for (int i = 0, c = 0; i < n; ++i)
      if (i >= n_one || !of.model.conditions.at(0, i / 3)) free(i, c++) = 1.0;
    if (!assembly) return;
    jump = Mat::Zero(assembly->n_rows(), n);
    for (size_t p = 0; p < of.model.exchange.points.size(); ++p) {
      const Point& point = of.model.exchange.points[p];
      for (int d = 0; d < 3; ++d) {
        const int row = assembly->row(p, d);
        if (row < 0) continue;
        jump.block<1, 3>(row, dof(of, point.first_port)) = -point.frame.col(d).transpose();
        jump.block<1, 3>(row, dof(of, point.first_port_2)) = point.frame.col(d).transpose();
      }
    }
  }
  int dof(const Modelled& of, int port) const {
    return (of.model.exchange.ports[port].part == 0 ? 0 : n_one) + 3 * of.model.exchange.ports[port].node;
  }
  Mat inverse() const { return free * solve_dense(free.transpose() * a * free, free.transpose()); }
};

void begin(Modelled& of, MergedAssembly& assembly) {
  start_step(of.model, of.state);
  of.model.loads->evaluate(0);
  std::vector<Points> displacement;
  for (size_t i = 0; i < of.model.pieces.size(); ++i) {
    displacement.push_back(of.model.pieces[i]->displacement());
    of.model.pieces[i]->begin(of.model.external_force(static_cast<int>(i), of.state), of.model.motion_velocities(0),
                              0.0);
  }
  assembly.begin(of.model.motion_velocities(0), displacement);
}

Problem struck(LawPtr law) {
  Problem problem = two_cubes(std::move(law), {});
  problem.steps = {dynamic_step("strike", 4, parts_dt,
                                {load("pressure", {top_of(problem)}, History::constant(80e6)),
                                 load("traction", {top_of(problem)}, History::constant(60e6), 0)})};
  return problem;
}

TEST(MergedAssembly, has_the_compliance_of_the_dense_system_at_the_law_rows) {
  for (const double friction : {0.0, 0.3}) {
    const Modelled of(struck(contact(friction)), 0, true);
    const MergedAssembly assembly(of.model);
    EXPECT_EQ(assembly.n_rows(), friction > 0.0 ? 27 : 9);
    const Whole whole(of, &assembly);
    const Mat expected = whole.jump * whole.inverse() * whole.jump.transpose();
    EXPECT_LT((assembly.compliance() - expected).norm(), 1e-9 * expected.norm());
    EXPECT_TRUE(assembly.softening().isZero(0.0));  // dynamics needs none
  }
}

TEST(MergedAssembly, moves_as_the_dense_system_under_loads_and_forces_at_the_law_rows) {
  Modelled of(struck(contact(0.3)), 0, true);
  MergedAssembly assembly(of.model);
  begin(of, assembly);
  const Whole whole(of, &assembly);
  Vec load(whole.n);
  for (int part = 0; part < 2; ++part)
    load.segment(part == 0 ? 0 : whole.n_one, part == 0 ? whole.n_one : whole.n - whole.n_one) =
        flat(of.model.external_force(part, of.state));
  EXPECT_LT((assembly.free_rate() - whole.jump * whole.inverse() * load).norm(), 1e-9 * assembly.free_rate().norm());
  const Vec force = 1e3 * random_vector(assembly.n_rows(), 1);  // on side 1
  assembly.finish(force);
  const Vec expected = whole.inverse() * (load - whole.jump.transpose() * force);
  EXPECT_LT((flat(of.model.pieces[0]->velocity()) - expected.head(whole.n_one)).norm(), 1e-9 * expected.norm());
  EXPECT_LT((flat(of.model.pieces[1]->velocity()) - expected.tail(whole.n - whole.n_one)).norm(),
            1e-9 * expected.norm());
}

TEST(MergedAssembly, takes_the_factor_of_the_step_before_where_its_matrices_are_the_same) {
  const Modelled of(struck(contact(0.3)), 0, true), same(struck(contact(0.3)), 0, true);
  const MergedAssembly first(of.model), second(same.model, first.factor());
  EXPECT_EQ(first.factor(), second.factor());
  Problem slower = struck(contact(0.3));
  slower.steps = {dynamic_step("strike", 4, 2.0 * parts_dt, {})};
  const Modelled other(std::move(slower), 0, true);
  EXPECT_NE(MergedAssembly(other.model, first.factor()).factor(), first.factor());
  const Modelled without_friction(struck(contact(0.0)), 0, true);  // other rows
  EXPECT_NE(MergedAssembly(without_friction.model, first.factor()).factor(), first.factor());
}

TEST(MergedAssembly, gives_tied_copies_one_motion_and_their_forces_to_the_ties) {
  Modelled of(struck(bonded()), 0, true);
  MergedAssembly assembly(of.model);
  EXPECT_EQ(assembly.n_rows(), 0);
  EXPECT_EQ(assembly.n_unknowns(), 3 * (2 * 27 - 9 - 9));
  begin(of, assembly);
  assembly.finish(Vec());
  const std::vector<Vec3> forces =
      assembly.port_forces(std::vector<Vec3>(of.model.exchange.points.size(), Vec3::Zero()));
  for (const Point& point : of.model.exchange.points) {
    const Port &one = of.model.exchange.ports[point.first_port], &two = of.model.exchange.ports[point.first_port + 1];
    EXPECT_LT(
        (of.model.pieces[one.part]->velocity().col(one.node) - of.model.pieces[two.part]->velocity().col(two.node))
            .norm(),
        1e-12);
    EXPECT_LT((forces[point.first_port] + forces[point.first_port + 1]).norm(), 1e-9 * forces[point.first_port].norm());
    EXPECT_GT(forces[point.first_port].norm(), 0.0);
  }
}

// Complementarity and Coulomb's law at every point, and rate = free - W F.
TEST(InterfaceNewton, solves_contact_with_friction) {
  Modelled of(struck(contact(0.3)), 0, true);
  MergedAssembly assembly(of.model);
  MonolithicSettings settings;
  settings.tolerance = 1e-13;
  InterfaceRows rows(of.model, assembly);
  InterfaceNewton newton(rows, settings);
  begin(of, assembly);
  std::vector<PointRecord> records;
  for (const Point& point : of.model.exchange.points) {
    records.push_back(start_point(of.model, point, of.state, port_motions(of.model, of.state)));
    begin_point(of.model, point, Vec3::Zero(), 0, records.back());
  }
  newton.start(records);
  const InterfaceNewton::Outcome outcome = newton.solve(records, Increment{of.model.scheme});
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.residual, 1e-13);
  Vec force(assembly.n_rows());
  for (size_t p = 0; p < records.size(); ++p)
    for (int d = 0; d < 3; ++d) force[assembly.row(p, d)] = records[p].force[d];
  const Vec rate = assembly.free_rate() - assembly.compliance() * force;
  int n_closed = 0, n_sliding = 0;
  for (size_t p = 0; p < records.size(); ++p) {
    const Vec3& f = records[p].force;
    const Vec3 slip(rate[assembly.row(p, 0)], rate[assembly.row(p, 1)], rate[assembly.row(p, 2)]);
    EXPECT_LE(f[0], 0.0);
    EXPECT_GE(slip[0], -1e-12);
    EXPECT_NEAR(f[0] * slip[0], 0.0, 1e-9);
    const double limit = 0.3 * std::abs(f[0]);
    EXPECT_LE(f.tail<2>().norm(), limit * (1.0 + 1e-9));
    n_closed += f[0] < 0.0;
    if (slip.tail<2>().norm() < 1e-12 || f[0] == 0.0) continue;
    ++n_sliding;
    EXPECT_NEAR(f.tail<2>().norm(), limit, 1e-6 * limit);
  }
  EXPECT_GT(n_closed, 0);
  EXPECT_LE(n_sliding, n_closed);
}

ExplicitSettings full_stiffness() {
  ExplicitSettings settings;
  settings.one_point = settings.bulk_viscosity = false;
  settings.penalty = 1.0;
  return settings;
}
std::vector<PointRecord> records_of(const Modelled& of) {
  std::vector<PointRecord> records;
  for (const Point& point : of.model.exchange.points)
    records.push_back(start_point(of.model, point, of.state, port_motions(of.model, of.state)));
  return records;
}

// Against the eigenvalues of all nodal directions; "within a percent, from above".
TEST(CriticalStep, is_that_of_the_highest_eigenvalue) {
  Problem problem = struck(bonded());
  problem.explicit_dynamics = full_stiffness();
  const Modelled of(problem, 0, true);
  InternalForce internal(of.bodies, *problem.explicit_dynamics);
  const std::vector<char> is_tied = tied_surfaces(of.model, of.state);
  ASSERT_TRUE(is_tied[0]);
  const SharedNodes shared(of.model, is_tied, internal);
  const PenaltySprings springs(of.model, records_of(of), is_tied, internal);
  EXPECT_EQ(springs.size(), 0);
  const Whole whole(of, nullptr);
  // Tied copies have one motion: the second cube's face follows the first one's.
  Mat merge = whole.free;
  std::vector<int> followers;
  for (const Point& point : of.model.exchange.points) {
    const int p = point.first_port;
    const int one = whole.dof(of, p), two = whole.dof(of, p + 1);
    for (int d = 0; d < 3; ++d) {
      merge.row(std::max(one, two) + d) = merge.row(std::min(one, two) + d);
    }
  }
  std::vector<Eigen::Index> columns;
  for (Eigen::Index c = 0; c < merge.cols(); ++c)
    if (merge.col(c).squaredNorm() > 0.0) columns.push_back(c);
  Mat kept(merge.rows(), static_cast<Eigen::Index>(columns.size()));
  for (size_t c = 0; c < columns.size(); ++c) kept.col(static_cast<Eigen::Index>(c)) = merge.col(columns[c]);
  const EigenPairs pairs =
      generalized_symmetric_eigen(kept.transpose() * whole.stiffness * kept, kept.transpose() * whole.mass * kept);
  const double highest = std::sqrt(pairs.values[pairs.values.size() - 1]);
  const Vec mass = whole.mass.diagonal();
  const double found = highest_frequency(internal, springs, shared, mass);
  EXPECT_GE(found, 0.9999 * highest);
  EXPECT_LE(found, 1.01 * highest);
  EXPECT_NEAR(critical_step(found, internal), 2.0 / found, 1e-12 * 2.0 / found);  // nothing is damped
}

TEST(CriticalStep, is_shorter_where_damping_lags) {
  Problem problem = struck(bonded());
  for (const int part : {0, 1})
    const_cast<Substructure&>(*problem.substructures[part]).material.damping.stiffness = 2e-8;
  problem.explicit_dynamics = full_stiffness();
  const Modelled of(problem, 0, true);
  const InternalForce internal(of.bodies, *problem.explicit_dynamics);
  const double frequency = 5e6, damping = 0.5 * 2e-8 * frequency;
  EXPECT_NEAR(critical_step(frequency, internal), 2.0 / frequency * (std::sqrt(1 + damping * damping) - damping),
              1e-18);
  EXPECT_EQ(critical_step(0.0, internal), std::numeric_limits<double>::infinity());
}

// The upper cube moved against the lower one as a rigid body.
struct Springs {
  Problem problem;
  Modelled of;
  InternalForce internal;
  PenaltySprings springs;

  explicit Springs(const Problem& asked)
      : problem(asked),
        of(asked, 0, true),
        internal(of.bodies, *problem.explicit_dynamics),
        springs(of.model, records_of(of), tied_surfaces(of.model, of.state), internal) {}
  // Force on the upper cube (N); the lower one feels the opposite.
  Vec3 force(const Vec3& moved) {
    Vec u = Vec::Zero(internal.n_dofs()), f = Vec::Zero(internal.n_dofs());
    for (int i = internal.first(1); i < internal.first(2); i += 3) u.segment<3>(i) = moved;
    springs.add_force(u, f);
    Vec3 sum = Vec3::Zero(), other = Vec3::Zero();
    for (int i = internal.first(1); i < internal.first(2); i += 3) sum -= f.segment<3>(i);
    for (int i = 0; i < internal.first(1); i += 3) other -= f.segment<3>(i);
    EXPECT_LT((sum + other).norm(), 1e-9 * (1.0 + sum.norm()));
    return sum;
  }
};
Problem sprung(LawPtr law) {
  Problem problem = struck(std::move(law));
  problem.explicit_dynamics = full_stiffness();
  return problem;
}

TEST(PenaltySprings, push_back_in_proportion_and_pull_at_nothing) {
  Springs of(sprung(contact(0.0)));
  EXPECT_EQ(of.springs.size(), 9);
  const Vec3 once = of.force({0.0, 0.0, -1e-7}), twice = of.force({0.0, 0.0, -2e-7});
  EXPECT_GT(once[2], 0.0);
  EXPECT_LT((twice - 2.0 * once).norm(), 1e-9 * once.norm());
  EXPECT_NEAR(once.head<2>().norm(), 0.0, 1e-9 * once[2]);
  // Of the stiffness of the cells there: E A / h and more, since they cannot spread.
  EXPECT_GT(once[2], 1e-7 * 200e9 * 1e-4 / 0.01);
  EXPECT_LT(once[2], 1e-7 * 10.0 * 200e9 * 1e-4 / 0.005);
  EXPECT_NEAR(of.springs.energy(), 0.5 * twice[2] * 2e-7, 1e-9 * twice[2] * 2e-7);
  EXPECT_LT(of.force({0.0, 0.0, 1e-7}).norm(), 1e-12);
  EXPECT_EQ(of.springs.energy(), 0.0);
}

TEST(PenaltySprings, leave_a_gap_to_close_first) {
  Springs of(sprung(contact(0.0, 1e-6)));
  EXPECT_LT(of.force({0.0, 0.0, -0.9e-6}).norm(), 1e-12);
  const Vec3 closed = of.force({0.0, 0.0, -1.1e-6});
  Springs none(sprung(contact(0.0)));
  EXPECT_LT((closed - none.force({0.0, 0.0, -0.1e-6})).norm(), 1e-9 * closed.norm());
}

TEST(PenaltySprings, hold_sideways_up_to_the_limit_of_friction) {
  Springs of(sprung(contact(0.3)));
  const double normal = of.force({0.0, 0.0, -1e-6})[2];
  const Vec3 sticking = of.force({1e-9, 0.0, -1e-6});
  EXPECT_LT(sticking[0], 0.0);
  EXPECT_LT(std::abs(sticking[0]), 0.1 * 0.3 * normal);
  const Vec3 sliding = of.force({1e-5, 0.0, -1e-6});
  EXPECT_NEAR(sliding[0], -0.3 * normal, 1e-9 * normal);
  EXPECT_NEAR(sliding[2], normal, 1e-9 * normal);
  EXPECT_NEAR(of.force({0.99e-5, 0.0, -1e-6})[0] - sliding[0], 0.0, 0.6 * normal);  // it comes back with the spring
}

TEST(PenaltySprings, of_a_plastic_interface_yield) {
  const double limit = 30e6 * 1e-4;
  Springs of(sprung(plastic(30e6)));
  const Vec3 elastic = of.force({0.0, 0.0, 1e-9});
  EXPECT_LT(elastic[2], 0.0);
  EXPECT_GT(elastic[2], -limit);
  EXPECT_NEAR(of.force({0.0, 0.0, 1e-4})[2], -limit, 1e-9 * limit);
}

}  // namespace
}  // namespace dygita::parts_tests

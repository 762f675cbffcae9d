// Condensed joints and assemblies: Goodman's exact loss, and superelements against the whole linear model.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <cmath>
#include <complex>
#include <numbers>
#include <regex>

#include "decks/deck_prints.hpp"
#include "marching/solve.hpp"
#include "numerics/factor.hpp"
#include "numerics/lowest_modes.hpp"
#include "reduction/craig_bampton.hpp"

namespace dygita::test::condensed_tests {
namespace {

TEST(Goodman, loses_what_his_solution_says) {
  const PrintedRun bar = run_printing("verification/goodman.lua", {{"n", "100"}, {"m", "16"}});
  EXPECT_TRUE(bar.runs.at(0).result->converged);
  EXPECT_EQ(bar.runs.at(0).part("bar", "cycles").n_rows(), 5);
  EXPECT_LT(bar.number("loss, largest error"), 2.0);
  EXPECT_LT(bar.number("displacement, largest error"), 2.0);
  EXPECT_NEAR(bar.number("exponent over the force"), 3.0, 0.02);
  EXPECT_NEAR(bar.number("exponent over the displacement"), 1.5, 0.02);
  // The area of the last loop is what the book-keeping of energies has friction take in it.
  const DeckRun& run = bar.runs.at(0);
  const std::vector<double>& work = run.column("sole", "friction_work");
  const double spent = work.at(11 * 16) - work.at(9 * 16);
  EXPECT_NEAR(run.part("bar", "cycles").column("loss").back(), spent, 0.01 * spent);
}

TEST(Goodman, comes_closer_with_mesh_and_increments) {
  const PrintedRun coarse = run_printing("verification/goodman.lua", {{"n", "50"}, {"m", "8"}});
  const PrintedRun fine = run_printing("verification/goodman.lua", {{"n", "100"}, {"m", "16"}});
  EXPECT_LT(fine.number("loss, largest error"), 0.6 * coarse.number("loss, largest error"));
}

TEST(CondensedJoint, slides_gradually_with_an_exponent_between_two_and_three) {
  const PrintedRun joint = run_printing("condensed_joint.lua");
  const DeckRun& run = joint.runs.at(0);
  EXPECT_TRUE(run.result->converged);
  const Table& cycles = run.part("ends", "cycles");
  ASSERT_EQ(cycles.n_rows(), 6);
  EXPECT_GT(run.findings("ends").values.at("exponent"), 2.0);
  EXPECT_LT(run.findings("ends").values.at("exponent"), 3.2);
  for (int i = 1; i < 6; ++i) {
    EXPECT_GT(cycles.column("exponent")[i], 2.0) << i;
    EXPECT_LT(cycles.column("exponent")[i], 3.2) << i;
  }
  // Goodman's loss for two parts that both stretch, from below: parts of a finite thickness hold on at the ends.
  for (int i = 0; i < 6; ++i) {
    const double force = cycles.column("force_amplitude")[i],
                 thin = std::pow(force, 3) / (3 * 70e9 * 10e-6 * 0.3 * 10e6 * 10e-3);
    const double ratio = cycles.column("loss")[i] / thin;
    EXPECT_GT(ratio, 0.84) << force;
    EXPECT_LT(ratio, 1.0) << force;
  }
  // The area of the last loop is the work of friction in that cycle: from increment 11 m to 13 m of the cycling step.
  const std::vector<double>& work = run.column("mating", "friction_work");
  const double spent = work.at(13 * 12) - work.at(11 * 12);
  EXPECT_NEAR(cycles.column("loss").back(), spent, 0.01 * spent);
  // Masing's rule from the first loading is what a system model will lose.
  for (int i = 2; i < 6; ++i)
    EXPECT_NEAR(cycles.column("masing_loss")[i], cycles.column("loss")[i], 0.06 * cycles.column("loss")[i]) << i;
}

// The whole linear model that a superelement stands for, caught at the end of its step.
class Capture : public Observer {
 public:
  explicit Capture(const Problem& problem) : problem_(problem) {}
  void begin_step(const Instant&) override {}
  void accept(const Instant& instant) override {
    if (instant.is_static() && instant.increment + 1 == instant.model.step->n_increments())
      full = linearise(instant, true);
  }
  LinearAssembly full;

 private:
  const Problem& problem_;
};

struct Condensed {
  Problem problem;
  std::shared_ptr<const RunResult> result;
  LinearAssembly full;

  const Output& output(const std::string& name = "element") const {
    for (const OutputPtr& o : problem.outputs)
      if (o->name == name) return *o;
    throw std::runtime_error("no output " + name);
  }
  const Superelement& element(const std::string& name = "element") const {
    return *std::any_cast<const SuperelementPtr&>(result->findings_of(output(name)).model);
  }
};

Condensed condensed_file(const std::filesystem::path& path, const Settings& settings = {}) {
  set_progress_enabled(false);
  Condensed condensed;
  const Engine engine{[&](const Problem& problem, const RunRequest& request) {
                        RunRequest quiet = request;
                        quiet.write_files = false;
                        Capture capture(problem);
                        solve(problem, capture, nullptr);
                        condensed = {problem, run_problem(problem, quiet), capture.full};
                        return condensed.result;
                      },
                      check_report};
  DeckOptions options;
  options.path = path;
  options.settings = settings;
  options.write_files = false;
  run_deck(options, engine);
  return condensed;
}

Condensed condensed_text(const std::string& text, const Settings& settings = {}) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("dygita_condensed_" + std::to_string(getpid()) + "_" + std::to_string(std::hash<std::string>{}(text)) + ".lua");
  std::ofstream(path) << text;
  const Condensed condensed = condensed_file(path, settings);
  std::filesystem::remove(path);
  return condensed;
}

// Natural frequencies (Hz) of the whole linear model, the first n.
Vec frequencies_of(const LinearAssembly& full, int n, double shift_frequency) {
  const double shift = std::pow(2 * std::numbers::pi * shift_frequency, 2);
  const SparseMatrix a = full.stiffness + shift * full.mass;
  const Factor factor(a, full.place_of_unknown, std::vector<char>(full.n(), 0), "the whole");
  const auto solve_all = [&](Eigen::Ref<Mat> x) {
    Mat y(x.rows(), x.cols());
    for (int i = 0; i < x.rows(); ++i) y.row(i) = x.row(factor.order()[i]);
    factor.solve(y);
    for (int i = 0; i < x.rows(); ++i) x.row(factor.order()[i]) = y.row(i);
  };
  const Modes modes = lowest_modes(full.n(), solve_all, full.mass, shift, {n, 0.0}, "the whole");
  return modes.values.unaryExpr([](double l) { return std::sqrt(std::max(0.0, l)) / (2 * std::numbers::pi); });
}

// Acceleration (m/s^2) of one interface coordinate for 1 N on another, harmonic, of the whole and of the superelement.
using Complex = std::complex<double>;
Complex full_response(const Condensed& c, int to, int from, double frequency) {
  const SparseMatrix w = interface_coordinates(c.full, c.problem, {"element", {}, c.element().on}).w;
  const double omega = 2 * std::numbers::pi * frequency;
  const Eigen::SparseMatrix<Complex> k = (c.full.stiffness - omega * omega * c.full.mass).cast<Complex>() +
                                         Complex(0, omega) * c.full.damping.cast<Complex>();
  const Eigen::SparseLU<Eigen::SparseMatrix<Complex>> lu(k);
  const Eigen::VectorXcd force = Vec(w.row(from).transpose()).cast<Complex>();
  return -omega * omega * Vec(w.row(to).transpose()).cast<Complex>().dot(lu.solve(force));
}
Complex condensed_response(const Superelement& e, int to, int from, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  const Eigen::MatrixXcd k =
      (e.stiffness - omega * omega * e.mass).cast<Complex>() + Complex(0, omega) * e.damping.cast<Complex>();
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(e.mass.rows());
  force[from] = 1.0;
  return -omega * omega * k.partialPivLu().solve(force)[to];
}

// First ten frequencies within 1 %, and the response up to the stated frequency. Prints what was measured.
void expect_like_the_whole(const Condensed& c, double largest_error_of_response) {
  const Superelement& e = c.element();
  const Vec full = frequencies_of(c.full, 10, 0.01 * e.valid_to);
  double worst = 0.0;
  const double floor = 1e-3 * full[9];  // rigid motions
  for (int i = 0; i < 10; ++i) worst = std::max(worst, std::abs(e.frequencies[i] - full[i]) / std::max(full[i], floor));
  std::cout << "first ten frequencies from " << full[0] << " to " << full[9] << " Hz: largest error " << 100 * worst
            << " %\n";
  EXPECT_LT(worst, 0.01);
  ASSERT_GT(e.damping.size(), 0);
  const int from = 2, to = 8;  // z of the first face, z of the second
  double difference = 0.0;
  for (const double share : {0.05, 0.2, 0.37, 0.5, 0.62, 0.78, 0.9, 1.0}) {
    const Complex a = full_response(c, to, from, share * e.valid_to),
                  b = condensed_response(e, to, from, share * e.valid_to);
    difference = std::max(difference, std::abs(a - b) / std::abs(a));
  }
  std::cout << "response from face to face up to " << e.valid_to << " Hz: largest error " << 100 * difference << " %\n";
  EXPECT_LT(difference, largest_error_of_response);
}

TEST(Superelement, of_the_tightened_flanges_is_the_whole_linear_model_up_to_its_frequency) {
  const Condensed c = condensed_file(deck("condensed_flanges.lua"));
  EXPECT_TRUE(c.result->converged);
  const Superelement& e = c.element();
  EXPECT_GT(e.n_tied, 0);
  EXPECT_GE(e.frequencies.size(), 20);
  expect_like_the_whole(c, 0.02);
}

// Two blocks pulled together by two bolts onto a seat between them, free in space; `joint` is how seat and upper block
// meet.
std::string blocks(const std::string& joint,
                   const std::string& on = "{ a:face 'zmin', b:face 'zmax' }, up_to = 40*kHz") {
  return R"(
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700, damping = 2e-8 }
local function box(name, x, z, size, cells)
  return substructure{ name = name, material = m, mesh = mesh.box{ origin = { x, 0, z }, size = size, cells = cells } }
end
local a     = box("a", 0, 0, { 40*mm, 16*mm, 10*mm }, { 10, 4, 3 })
local b     = box("b", 0, 20*mm, { 40*mm, 16*mm, 10*mm }, { 10, 4, 3 })
local seat  = box("seat", 12*mm, 10*mm, { 16*mm, 16*mm, 10*mm }, { 4, 4, 3 })
local left  = box("left", 0, 10*mm, { 8*mm, 16*mm, 10*mm }, { 2, 4, 3 })
local right = box("right", 32*mm, 10*mm, { 8*mm, 16*mm, 10*mm }, { 2, 4, 3 })
local ties, shanks = {}, {}
for _, part in ipairs{ left, right } do
  ties[#ties + 1] = interface.bonded{ name = "thread" .. #ties, between = { a:face "zmax", part:face "zmin" } }
  shanks[#shanks + 1] = interface.bonded{ name = "shank" .. #shanks, between = { part:face "zmax", b:face "zmin" } }
end
local foot = interface.bonded{ name = "foot", between = { a:face "zmax", seat:face "zmin" } }
local head = interface.)" +
         joint + R"(
local tighten = step.static{ name = "tighten", loads = { load.shortening{ on = shanks, by = 10*um } } }
local element = output.superelement{ name = "element", on = )" +
         on + R"( }
problem{ name = "blocks", substructures = { a, b, seat, left, right }, interfaces = { foot, head, ties[1], ties[2], shanks[1], shanks[2] },
  steps = { tighten }, outputs = { element } }:run{}
)";
}
const std::string sides = "name = 'head', between = { seat:face 'zmax', b:face 'zmin' }";
const std::string bonded = "bonded{ " + sides + " }", sticking = "contact{ " + sides + ", friction = 1000 }",
                  smooth = "contact{ " + sides + " }", open = "contact{ " + sides + ", gap = 50*um }";

TEST(Superelement, free_in_space_is_the_whole_with_six_rigid_motions_and_the_mass_of_the_parts) {
  const Condensed c = condensed_text(blocks(sticking));
  const Superelement& e = c.element();
  EXPECT_EQ(e.n_tied, 25);
  EXPECT_EQ(e.n_normal + e.n_open, 0);
  EXPECT_LT(e.frequencies[5], 1e-4 * e.frequencies[6]);
  EXPECT_GT(e.frequencies[6], 1000.0);
  const double mass = 2700 * (2 * 40e-3 + 16e-3 + 2 * 8e-3) * 16e-3 * 10e-3;
  EXPECT_NEAR(e.mass_of_parts, mass, 1e-9 * mass);
  for (int d = 0; d < 3; ++d) {
    Vec q = Vec::Zero(e.mass.rows());
    q[d] = q[6 + d] = 1.0;
    EXPECT_NEAR(q.dot(e.mass * q), mass, 1e-8 * mass);
    EXPECT_LT((e.stiffness * q).norm(), 1e-8 * e.stiffness.topLeftCorner(12, 12).norm());
    // Turning about the first face's centre carries the second's centre along.
    q.setZero();
    q[3 + d] = q[9 + d] = 1.0;
    const Vec3 arm = e.rows[6].place - e.rows[0].place, moved = Vec3::Unit(d).cross(arm);
    q.segment<3>(6) = moved;
    EXPECT_LT((e.stiffness * q).norm(), 1e-7 * e.stiffness.topLeftCorner(12, 12).norm());
  }
  expect_like_the_whole(c, 0.02);
}

TEST(Superelement, has_the_same_matrices_whether_a_joint_sticks_or_is_bonded) {
  const Superelement closed = condensed_text(blocks(sticking)).element(),
                     tied = condensed_text(blocks(bonded)).element();
  ASSERT_EQ(closed.mass.rows(), tied.mass.rows());
  const int n = 12;
  EXPECT_LT((closed.stiffness - tied.stiffness).norm(), 1e-9 * tied.stiffness.norm());
  EXPECT_LT((closed.mass - tied.mass).topLeftCorner(n, n).norm(), 1e-9 * tied.mass.topLeftCorner(n, n).norm());
  EXPECT_LT((closed.frequencies - tied.frequencies).norm(), 1e-9 * tied.frequencies.norm());
  EXPECT_EQ(tied.n_tied, 0);
}

TEST(Superelement, softens_where_a_joint_slides_and_more_where_it_is_open) {
  const Superelement tied = condensed_text(blocks(bonded)).element();
  const Superelement slides = condensed_text(blocks(smooth)).element();
  const Superelement parted = condensed_text(blocks(open)).element();
  EXPECT_EQ(slides.n_normal, 25);
  EXPECT_EQ(parted.n_open, 25);
  std::cout << "first elastic frequency, Hz: bonded " << tied.frequencies[6] << ", frictionless "
            << slides.frequencies[6] << ", open " << parted.frequencies[6] << "\n";
  EXPECT_LT(slides.frequencies[6], 0.99 * tied.frequencies[6]);
  EXPECT_LT(parted.frequencies[6], 0.995 * slides.frequencies[6]);
  EXPECT_LT(parted.frequencies[5], 1e-4 * parted.frequencies[6]);  // and no more rigid motions: the bolts hold
}

TEST(Superelement, by_nodes_has_the_same_frequencies_and_rigid_faces_are_stiffer) {
  const std::string faces = "{ a:face 'zmin', b:face 'zmax' }, up_to = 40*kHz, motion = ";
  const Superelement mean = condensed_text(blocks(bonded)).element();
  const Superelement nodes = condensed_text(blocks(bonded, faces + "'nodes'")).element();
  const Superelement rigid = condensed_text(blocks(bonded, faces + "'rigid'")).element();
  EXPECT_EQ(nodes.rows.size(), 2 * 55 * 3 + static_cast<size_t>(nodes.fixed_frequencies.size()));
  EXPECT_EQ(rigid.rows.size(), 12 + static_cast<size_t>(rigid.fixed_frequencies.size()));
  for (int i = 6; i < 14; ++i) {
    EXPECT_NEAR(nodes.frequencies[i], mean.frequencies[i], 1e-2 * mean.frequencies[i]) << i;
    EXPECT_GE(rigid.frequencies[i], (1 - 1e-3) * nodes.frequencies[i]) << i;
  }
  EXPECT_LT(rigid.frequencies[5], 1e-3 * rigid.frequencies[6]);
  EXPECT_LT(nodes.frequencies[5], 1e-3 * nodes.frequencies[6]);
}

TEST(Superelement, is_not_made_and_says_why_where_a_part_is_held_by_nothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::string text = blocks(open);
  const std::string tied =
      "local foot = interface.bonded{ name = \"foot\", between = { a:face \"zmax\", seat:face \"zmin\" } }";
  const size_t at = text.find(tied);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, tied.size(),
               "local foot = interface.contact{ name = \"foot\", gap = 1*um, between = { a:face \"zmax\", seat:face "
               "\"zmin\" } }");
  const Condensed c = condensed_text(text);
  const std::string said = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  EXPECT_FALSE(c.result->findings_of(c.output()).model.has_value());
  EXPECT_NE(said.find("superelement 'element': NOT MADE"), std::string::npos) << said;
  EXPECT_NE(said.find("is unconstrained (open joints, or contact that slides)"), std::string::npos) << said;
}

}  // namespace
}  // namespace dygita::test::condensed_tests

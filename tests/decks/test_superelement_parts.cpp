// substructure.superelement: parts of matrices in the place of meshes, against the meshes themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "base/error.hpp"
#include "decks/engine.hpp"
#include "intake/labelled_matrix.hpp"
#include "intake/matrix_market.hpp"
#include "intake/superelement_file.hpp"
#include "reduction/superelement_files.hpp"

namespace dygita::test::superelement_parts_tests {
namespace {

namespace fs = std::filesystem;

// A folder of this process's own, for files that decks read.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("dygita_superelements_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  // Runs a deck that condenses something, and writes the files of all its superelements.
  void condense(const std::string& text, const Settings& settings = {}) const {
    const DeckRun run = run_text(text, settings).at(0);
    for (const OutputPtr& output : run.problem.outputs) {
      ASSERT_TRUE(run.findings(output->name).files) << output->name << " was not made";
      for (const auto& [suffix, content] : run.findings(output->name).files())
        std::ofstream(path_ / (output->name + suffix)) << content;
    }
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  std::string of(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// Of two runs, the largest difference in a column.
double difference(const DeckRun& a, const DeckRun& b, const std::string& output, const std::string& column) {
  const std::vector<double>&x = a.column(output, column), &y = b.column(output, column);
  EXPECT_EQ(x.size(), y.size());
  double most = 0.0;
  for (size_t i = 0; i < std::min(x.size(), y.size()); ++i) most = std::max(most, std::abs(x[i] - y[i]));
  return most;
}

// --- two blocks, the lower one with all its modes: the same model in other coordinates

const std::string header = R"(
local p = param{ condensed = 0, law = 1, held = 0, turned = 0, gravity = 0, velocity = 0, shaken = 0, jump = 0, n = 27, cell = 1 }
local cell = ({ "hex8", "hex20", "prism15", "tet10" })[p.cell]
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = { mass = 40, stiffness = 2e-7 } }
local function block(z) return mesh.box{ origin = { 0, 0, z }, size = { 30*mm, 20*mm, 10*mm }, cells = { 2, 2, 2 }, cell = cell, order = p.cell == 1 and 1 or 2 } end
)";

const std::string condensing = header + R"(
local low = substructure{ name = "low", mesh = block(0), material = steel }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local symmetry = support.symmetry{ name = "symmetry", on = low:face "xmin" }
local on = p.held == 1 and { low:face "zmax" } or { low:face "zmax", low:face "zmin" }
problem{ name = "condense", substructures = { low }, supports = p.held == 1 and { base } or p.held == 2 and { symmetry } or {},
         steps = { step.static{ name = "rest", increments = 1 } },
         outputs = { output.superelement{ name = "low", on = on, modes = p.n, motion = "nodes" } } }:run{}
)";

std::string two_blocks(const std::string& part) {
  return header + R"(
local place = p.turned == 1 and { translate = { 10*mm, 20*mm, 30*mm }, rotate = { axis = { 1, 2, 3 }, angle = 0.7 } } or { 1*mm, 0, 0 }
local velocity = p.velocity == 1 and { 0.1, 0.2, -0.5 } or { 0, 0, 0 }
local low = p.condensed == 1 and )" +
         part +
         R"( or substructure{ name = "low", mesh = block(0), material = steel, place = place, velocity = velocity }
local up = substructure{ name = "up", mesh = block(10*mm), material = steel, place = place, velocity = velocity }
local between = { low:face "zmax", up:face "zmin" }
local joint = p.law == 1 and interface.contact{ name = "joint", between = between, friction = 0.3 }
  or p.law == 2 and interface.bonded{ name = "joint", between = between }
  or interface.plastic{ name = "joint", between = between, yield = 15*MPa }
local supports = {}
if p.jump == 0 and p.held == 0 or p.held == 1 and p.condensed == 0 then supports = { support.fixed{ name = "base", on = low:face "zmin" } } end
if p.held == 2 and p.condensed == 0 then supports = { support.symmetry{ name = "symmetry", on = low:face "xmin" } } end
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = up:face "zmax", history = 20*MPa } } }
local loads = {}
loads[1] = load.traction{ on = up:face "zmax", x = history.half_sine{ peak = 15*MPa, duration = 20*us },
                          y = history.half_sine{ peak = 4*MPa, duration = 15*us }, z = history.half_sine{ peak = -5*MPa, duration = 9*us } }
if p.held < 2 then loads[2] = load.pressure{ on = up:face "zmax", history = 20*MPa } end
if p.held == 2 and p.turned == 0 then loads[2] = load.gravity{ y = 5e5, z = -9e5 } end
if p.gravity == 1 then loads[#loads + 1] = load.gravity{ x = 9e5, z = -5e5 } end
if p.shaken == 1 then loads[#loads + 1] = load.base_acceleration{ on = supports[1], direction = { 0, 0.3, 1 }, history = history.half_sine{ peak = 1e5, duration = 20*us } } end
if p.jump == 1 then loads = { load.velocity{ on = low:face "zmin", z = -1, x = 0.2 } } end
local is_free = p.jump == 1 or p.velocity == 1 or p.held == 2
local shock = step.dynamic{ name = "shock", after = not is_free and press or nil, duration = 30*us, dt = 0.5*us, loads = loads }
local outputs = {
  output.history{ name = "top", on = up:face "zmax", quantity = "displacement" },
  output.history{ name = "below", on = low:face "zmax", quantity = "acceleration" },
  output.resultant{ name = "force", on = joint }, output.energy{} }
if #supports > 0 and p.held == 0 then outputs[#outputs + 1] = output.resultant{ name = "reaction", on = supports[1] } end
if p.held == 0 then outputs[#outputs + 1] = output.momentum{ name = "momentum" } end
problem{ name = "two", substructures = { low, up }, interfaces = { joint }, supports = supports,
         steps = is_free and { shock } or { press, shock }, solver = solver.latin{ integration = "implicit", tolerance = 1e-10, static_tolerance = 1e-11 },
         outputs = outputs }:run{}
)";
}

std::string from_file(const Folder& folder) {
  return "substructure.superelement{ name = \"low\", file = \"" + folder.of("low.json") +
         "\", place = place, velocity = velocity }";
}

// Both runs agree to what iterations leave; others: columns that are no matter of the solution alone.
void expect_the_same(const std::string& deck, Settings settings, const std::string& solver = "",
                     const std::set<std::string>& others = {}) {
  settings.emplace_back("condensed", "0");
  const DeckRun whole = run_text(deck, settings, 0, solver).at(0);
  settings.back().second = "1";
  const DeckRun condensed = run_text(deck, settings, 0, solver).at(0);
  EXPECT_TRUE(whole.result->converged && condensed.result->converged);
  for (const OutputPtr& output : whole.problem.outputs) {
    std::vector<std::string> names;
    double scale = 0.0;
    for (const Column& column : output->columns()) {
      if (column.name == "time" || column.name == "balance" || column.name == "scheme") continue;
      if (others.contains(output->name + "." + column.name)) continue;
      names.push_back(column.name);
      scale = std::max(scale, largest(whole.column(output->name, column.name)));
    }
    if (names.empty()) continue;
    ASSERT_GT(scale, 0.0) << output->name;
    for (const std::string& name : names)
      EXPECT_LT(difference(whole, condensed, output->name, name), 1e-7 * scale) << output->name << "." << name;
  }
}

TEST(SuperelementPart, with_all_modes_is_the_mesh_under_every_law_and_solver) {
  const Folder folder;
  folder.condense(condensing);
  const std::string deck = two_blocks(from_file(folder));
  for (const char* law : {"1", "2", "3"}) {
    expect_the_same(deck, {{"law", law}});
    expect_the_same(deck, {{"law", law}}, "monolithic");
  }
  for (const char* solver :
       {"latin{ integration = 'implicit', tolerance = 1e-10, static_tolerance = 1e-11, plain = true }",
        "latin{ integration = 'implicit', tolerance = 1e-10, static_tolerance = 1e-11, static_steps = 'assembled' }",
        "latin{ integration = 'implicit', tolerance = 1e-10, static_tolerance = 1e-11, window = 4 }",
        "latin{ integration = 'implicit', tolerance = 1e-10, static_tolerance = 1e-11, numerical_damping = 0.1 }"})
    expect_the_same(deck, {}, solver);
}

TEST(SuperelementPart, turns_moves_and_weighs_as_the_mesh) {
  const Folder folder;
  folder.condense(condensing);
  const std::string deck = two_blocks(from_file(folder));
  expect_the_same(deck, {{"turned", "1"}});
  expect_the_same(deck, {{"gravity", "1"}});
  expect_the_same(deck, {{"shaken", "1"}});
  expect_the_same(deck, {{"shaken", "1"}, {"turned", "1"}}, "monolithic");
  expect_the_same(deck, {{"velocity", "1"}});  // and is stopped by its support at once
  expect_the_same(deck, {{"velocity", "1"}, {"turned", "1"}}, "monolithic");
  expect_the_same(deck, {{"jump", "1"}, {"law", "2"}});  // a face that moves at once gives the inside no momentum
  expect_the_same(deck, {{"jump", "1"}, {"law", "2"}, {"turned", "1"}}, "monolithic");
}

// Their mass is consistent: what is held passes its jump on to what is free.
TEST(SuperelementPart, of_cells_of_order_two_is_driven_and_stopped_at_once_as_the_mesh) {
  for (const char* cell : {"2", "3", "4"}) {
    const Folder folder;
    folder.condense(condensing, {{"cell", cell}, {"n", "1000"}});
    const std::string deck = two_blocks(from_file(folder));
    expect_the_same(deck, {{"cell", cell}, {"jump", "1"}, {"law", "2"}});
    expect_the_same(deck, {{"cell", cell}, {"velocity", "1"}});
    expect_the_same(deck, {{"cell", cell}, {"velocity", "1"}, {"turned", "1"}}, "monolithic");
  }
}

TEST(SuperelementPart, keeps_the_support_that_was_condensed_with_it) {
  const Folder folder;
  folder.condense(condensing, {{"held", "1"}});
  expect_the_same(two_blocks(from_file(folder)), {{"held", "1"}});
  expect_the_same(two_blocks(from_file(folder)), {{"held", "1"}, {"turned", "1"}});
}

TEST(SuperelementPart, keeps_directions_of_its_faces_that_a_support_holds) {
  const Folder folder;
  folder.condense(condensing, {{"held", "2"}, {"n", "24"}});
  expect_the_same(two_blocks(from_file(folder)), {{"held", "2"}});
  expect_the_same(two_blocks(from_file(folder)), {{"held", "2"}, {"turned", "1"}}, "monolithic");
}

// --- matrices of another program

std::string matrix_text(const Mat& m, bool is_array) {
  std::string text = is_array ? "%%MatrixMarket matrix array real general\n"
                              : "%%MatrixMarket matrix coordinate real symmetric\n% other\n";
  text += std::to_string(m.rows()) + " " + std::to_string(m.cols());
  const auto number = [](double x) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.17g", x);
    return std::string(buffer);
  };
  std::string entries;
  int n = 0;
  for (int j = 0; j < m.cols(); ++j)
    for (int i = is_array ? 0 : j; i < m.rows(); ++i) {
      if (!is_array && m(i, j) == 0.0) continue;
      entries += (is_array ? "" : std::to_string(i + 1) + " " + std::to_string(j + 1) + " ") + number(m(i, j)) + "\n";
      ++n;
    }
  return text + (is_array ? "\n" : " " + std::to_string(n) + "\n") + entries;
}

// Matrix Market by coordinates and in full, points in another order, modes first.
TEST(SuperelementPart, reads_plain_matrices_with_points_in_any_order_of_rows) {
  const Folder folder;
  folder.condense(condensing);
  const MeshPtr mesh = read_superelement(folder.of("low.json"));
  const int n = 81;
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  std::vector<int> row_of(n);  // of each old row, in the new matrices
  for (int i = 0; i < n; ++i) row_of[order[i]] = i;
  const auto mixed = [&](const SparseMatrix& by_node) { return Mat(Mat(by_node)(order, order)); };
  folder.write("k.mtx", matrix_text(mixed(mesh->inside->matrices()->stiffness), false));
  folder.write("m.mtx", matrix_text(mixed(mesh->inside->matrices()->mass_matrix), true));
  folder.write("c.mtx", matrix_text(mixed(mesh->inside->damping), true));
  std::ostringstream points;
  points.precision(17);
  points << "# points of another program\nface;x;y;z;row_x;row_y;row_z\n";
  for (int node = 17; node >= 0; --node) {
    const Vec3 x = mesh->nodes.col(node);
    points << (x[2] > 0.005 ? "zmax" : "zmin") << ";" << x[0] << ";" << x[1] << ";" << x[2];
    for (int d = 0; d < 3; ++d) points << ";" << row_of[3 * node + d] + 1;
    points << "\n";
  }
  folder.write("points.csv", points.str());
  const std::string part = "substructure.superelement{ name = \"low\", stiffness = \"" + folder.of("k.mtx") +
                           "\", mass = \"" + folder.of("m.mtx") + "\", damping = \"" + folder.of("c.mtx") +
                           "\", points = \"" + folder.of("points.csv") + "\", place = place, velocity = velocity }";
  // A mean over points is one of all alike, and points have no normal.
  const std::set<std::string> others{"below.x", "below.y", "below.z", "reaction.normal", "reaction.shear"};
  expect_the_same(two_blocks(part), {}, "", others);
  expect_the_same(two_blocks(part), {{"law", "2"}, {"turned", "1"}}, "monolithic", others);
}

// Out as DMIG and in again: numbers to ten digits, and the motion of the block itself.
TEST(SuperelementPart, goes_to_nastran_and_comes_back_as_the_same) {
  const Folder folder;
  std::string exporting = condensing;
  exporting.replace(exporting.find("motion = \"nodes\""), 16, "motion = \"nodes\", format = \"dmig\"");
  folder.condense(exporting);
  const std::pair<const char*, MatrixRole> matrices[] = {
      {"stiffness", MatrixRole::stiffness}, {"mass", MatrixRole::mass}, {"damping", MatrixRole::damping}};
  for (const auto& [what, role] : matrices) {
    const Mat written = read_matrix_market(folder.of(std::string("low_") + what + ".mtx")).matrix;
    const LabelledMatrix read = read_matrix(folder.of("low.pch"), role, "");
    ASSERT_EQ(read.matrix.rows(), written.rows()) << what;
    EXPECT_LE(((read.matrix - written).array().abs() - 5.1e-10 * written.array().abs()).maxCoeff(), 1e-89) << what;
    EXPECT_EQ(read.rows.front().component, 1);
    EXPECT_EQ(read.rows.back().component, 0);  // a mode is a scalar point
  }
  const std::string file = "\"" + folder.of("low.pch") + "\"";
  const std::string part = "substructure.superelement{ name = \"low\", stiffness = " + file + ", mass = " + file +
                           ", damping = " + file + ", points = \"" + folder.of("low_points.csv") +
                           "\", units = \"m kg s\", total_mass = 0.0468, place = place, velocity = velocity }";
  const std::set<std::string> others{"below.x", "below.y", "below.z", "reaction.normal", "reaction.shear"};
  expect_the_same(two_blocks(part), {}, "", others);
  expect_the_same(two_blocks(part), {{"law", "2"}, {"turned", "1"}}, "monolithic", others);
}

// Rows that no point has, though they are no modes: the inside of a body as it is.
TEST(SuperelementPart, may_have_its_inside_uncondensed) {
  const Folder folder;
  folder.condense(condensing);
  const MeshPtr mesh = read_superelement(folder.of("low.json"));
  const Mat k = mesh->inside->matrices()->stiffness, m = mesh->inside->matrices()->mass_matrix;
  // The lower face's rows count as inside: a motion as a whole moves them too.
  folder.write("k.mtx", matrix_text(k, true));
  folder.write("m.mtx", matrix_text(m, true));
  std::ostringstream points;
  points.precision(17);
  points << "face,x,y,z,row_x,row_y,row_z\n";
  double mass = 0.0;
  for (int node = 0; node < 18; ++node) {
    const Vec3 x = mesh->nodes.col(node);
    if (x[2] > 0.005)
      points << "zmax," << x[0] << "," << x[1] << "," << x[2] << "," << 3 * node + 1 << "," << 3 * node + 2 << ","
             << 3 * node + 3 << "\n";
  }
  folder.write("points.csv", points.str());
  const MeshPtr open = read_matrices({folder.of("k.mtx"), folder.of("m.mtx"), {}, folder.of("points.csv")});
  EXPECT_EQ(open->inside->resisted_motions(open->nodes).cols(), 0);
  mass = 0.03 * 0.02 * 0.01 * 7800;
  EXPECT_NEAR(open->inside->matrices()->mass_of_parts, mass, 1e-9 * mass);
}

// --- faces that move as a whole

const std::string rod = R"(
local p = param{ condensed = 0, motion = 1, law = 1 }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0, density = 2700 }
local function bar(z, n) return mesh.box{ origin = { 0, 0, z }, size = { 6*mm, 6*mm, n*4*mm }, cells = { 2, 2, 2*n } } end
)";

// Without lateral contraction the ends of a rod that is pulled stay plane: a rigid face is no constraint.
TEST(SuperelementPart, with_rigid_faces_is_the_mesh_where_these_stay_plane) {
  for (const char* motion : {"1", "2"}) {
    const Folder folder;
    folder.condense(rod + R"(
local low = substructure{ name = "low", mesh = bar(0, 6), material = soft }
problem{ name = "condense", substructures = { low }, steps = { step.static{ name = "rest", increments = 1 } },
         outputs = { output.superelement{ name = "low", on = { low:face "zmin", low:face "zmax" }, up_to = 400*kHz, motion = p.motion == 1 and "mean" or "rigid" } } }:run{}
)",
                    {{"motion", motion}});
    const std::string deck = rod + R"(
local low = p.condensed == 1 and substructure.superelement{ name = "low", file = ")" +
                             folder.of("low.json") +
                             R"(" } or substructure{ name = "low", mesh = bar(0, 6), material = soft }
local up = substructure{ name = "up", mesh = bar(24*mm, 4), material = soft }
local between = { low:face "zmax", up:face "zmin" }
local joint = p.law == 1 and interface.bonded{ name = "joint", between = between } or interface.contact{ name = "joint", between = between, friction = 0.2 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local press = step.static{ name = "press", increments = 1, loads = { load.pressure{ on = up:face "zmax", history = 30*MPa } } }
local shock = step.dynamic{ name = "shock", after = press, duration = 40*us, dt = 0.2*us, loads = { load.pressure{ on = up:face "zmax",
  history = history.piecewise{ times = { 0, 8*us, 16*us, 24*us }, values = { 30*MPa, 90*MPa, p.law == 1 and -20*MPa or 10*MPa, 30*MPa } } } } }
problem{ name = "rods", substructures = { low, up }, interfaces = { joint }, supports = { base }, steps = { press, shock },
         solver = solver.latin{ integration = "implicit", tolerance = 1e-9 },
         outputs = { output.history{ name = "top", on = up:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } },
                     output.resultant{ name = "force", on = joint }, output.resultant{ name = "reaction", on = base } } }:run{}
)";
    for (const char* law : {"1", "2"}) {
      const DeckRun whole = run_text(deck, {{"law", law}}).at(0),
                    condensed = run_text(deck, {{"law", law}, {"condensed", "1"}}).at(0),
                    monolithic = run_text(deck, {{"law", law}, {"condensed", "1"}}, 0, "monolithic").at(0);
      EXPECT_TRUE(condensed.result->converged && monolithic.result->converged);
      EXPECT_NEAR(condensed.column("force", "normal").front(), whole.column("force", "normal").front(), 1e-7 * 1080);
      EXPECT_NEAR(condensed.column("top", "displacement").front(), whole.column("top", "displacement").front(),
                  1e-7 * largest(whole.column("top", "displacement")));
      EXPECT_LT(difference(whole, condensed, "top", "displacement"),
                2e-3 * largest(whole.column("top", "displacement")));
      EXPECT_LT(difference(whole, condensed, "force", "normal"), 1e-2 * largest(whole.column("force", "normal")));
      EXPECT_LT(difference(whole, condensed, "reaction", "z"), 1e-2 * largest(whole.column("reaction", "z")));
      // The same equations by two solvers.
      EXPECT_LT(difference(monolithic, condensed, "top", "displacement"),
                1e-6 * largest(whole.column("top", "displacement")));
      EXPECT_LT(difference(monolithic, condensed, "force", "normal"), 1e-6 * largest(whole.column("force", "normal")));
    }
  }
}

// A lever: a force on a rigid face turns it, as its rows have the moment.
TEST(SuperelementPart, turns_its_rigid_faces_as_its_matrices_say) {
  const Folder folder;
  folder.condense(rod + R"(
local low = substructure{ name = "low", mesh = bar(0, 6), material = soft }
problem{ name = "condense", substructures = { low }, supports = { support.fixed{ name = "base", on = low:face "zmin" } },
         steps = { step.static{ name = "rest", increments = 1 } },
         outputs = { output.superelement{ name = "low", on = low:face "zmax", up_to = 50*kHz, motion = "rigid" } } }:run{}
)");
  const Mat k = read_matrix_market(folder.of("low_stiffness.mtx")).matrix;
  Vec force = Vec::Zero(k.rows());
  force[0] = 100.0;         // along x on the face
  force[5] = 100.0 * 3e-3;  // and, on one edge of it, about z: the edge y = 0 is 3 mm off the middle
  const Vec expected = k.llt().solve(force);
  const DeckRun run =
      run_text(R"(
local low = substructure.superelement{ name = "low", file = ")" +
               folder.of("low.json") + R"(", place = { rotate = { axis = { 0, 0, 1 }, angle = 90*deg } } }
local edge = low:where(function(x, y, z) return near(x, 0) end)
local far = low:where(function(x, y, z) return near(x, -6*mm) end)
local push = step.static{ name = "push", increments = 1, loads = { load.force{ on = edge, y = 100 } } }
problem{ name = "lever", substructures = { low }, steps = { push },
         outputs = { output.history{ name = "near", on = edge, quantity = "displacement" }, output.history{ name = "far", on = far, quantity = "displacement" } } }:run{}
)")
          .at(0);
  // Turned by 90 degrees about z: what was along x is along y, and the edge y = 0 lies at x = 0.
  const double mean = 0.5 * (run.column("near", "y").back() + run.column("far", "y").back()),
               turn = (run.column("near", "y").back() - run.column("far", "y").back()) / 6e-3;
  EXPECT_NEAR(mean, expected[0], 1e-9 * std::abs(expected[0]));
  EXPECT_NEAR(turn, expected[5], 1e-9 * std::abs(expected[5]));
}

// --- copies, and superelements of superelements

// Amplitudes fill nodes by threes; what is left of the last node is no unknown.
TEST(SuperelementPart, has_the_frequencies_of_its_matrices_with_any_number_of_modes) {
  for (const char* n : {"3", "4", "5"}) {
    const Folder folder;
    folder.condense(condensing, {{"n", n}});
    const DeckRun modes = run_text(R"(
local low = substructure.superelement{ name = "low", file = ")" +
                                   folder.of("low.json") + R"(" }
problem{ name = "free", substructures = { low }, steps = { step.static{ name = "rest", increments = 1 } },
         outputs = { output.modes{ name = "modes", n = 10 } } }:run{}
)")
                              .at(0);
    const std::vector<double> expected = run_text(condensing, {{"n", n}}).at(0).column("low", "frequency"),
                              &found = modes.column("modes", "frequency");
    ASSERT_GE(found.size(), 9u) << n;
    for (size_t i = 6; i < 9; ++i) EXPECT_NEAR(found.at(i), expected.at(i), 1e-6 * expected.at(i)) << n << ", " << i;
  }
}

TEST(SuperelementPart, condensed_once_more_has_the_frequencies_it_had) {
  const Folder folder;
  folder.condense(condensing);
  const std::string deck = R"(
local low = substructure.superelement{ name = "low", file = ")" +
                           folder.of("low.json") + R"(" }
problem{ name = "again", substructures = { low }, steps = { step.static{ name = "rest", increments = 1 } },
         outputs = { output.superelement{ name = "again", on = { low:face "zmax", low:face "zmin" }, up_to = 60*kHz, motion = "nodes" } } }:run{}
)";
  const DeckRun again = run_text(deck).at(0), once = run_text(condensing).at(0);
  const std::vector<double>&of_again = again.column("again", "frequency"), &of_once = once.column("low", "frequency");
  for (size_t i = 6; i < 12; ++i) {
    EXPECT_NEAR(of_again.at(i), of_once.at(i), 1e-6 * of_once.at(i)) << i;
    EXPECT_NEAR(again.column("again", "damping").at(i), once.column("low", "damping").at(i), 1e-6) << i;
  }
}

TEST(SuperelementPart, in_a_circle_answers_alike) {
  const Folder folder;
  folder.condense(condensing);
  const DeckRun run = run_text(R"(
local low = substructure.superelement{ name = "low", file = ")" +
                               folder.of("low.json") + R"(", place = { 40*mm, 0, 0 } }
local all = pattern.circle{ of = low, n = 3, axis = { 0, 0, 1 } }
local loads, supports, outputs = {}, {}, {}
for i, part in ipairs(all) do
  loads[i] = load.pressure{ on = part:face "zmax", history = history.half_sine{ peak = 10*MPa, duration = 10*us } }
  supports[i] = support.fixed{ name = "base " .. i, on = part:face "zmin" }
  outputs[i] = output.history{ name = "top " .. i, on = part:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
end
problem{ name = "circle", substructures = all, supports = supports, steps = { step.dynamic{ name = "shock", duration = 20*us, dt = 0.5*us, loads = loads } },
         outputs = outputs }:run{}
)")
                          .at(0);
  const double scale = largest(run.column("top 1", "acceleration"));
  for (const char* other : {"top 2", "top 3"})
    for (size_t i = 0; i < run.column(other, "acceleration").size(); ++i)
      EXPECT_NEAR(run.column(other, "acceleration")[i], run.column("top 1", "acceleration")[i], 1e-9 * scale);
}

// Its surface is not there to be searched.
TEST(SuperelementPart, of_points_alone_is_attached_by_the_names_of_faces) {
  const Folder folder;
  folder.condense(condensing);
  const MeshPtr mesh = read_superelement(folder.of("low.json"));
  folder.write("k.mtx", matrix_text(mesh->inside->matrices()->stiffness, true));
  folder.write("m.mtx", matrix_text(mesh->inside->matrices()->mass_matrix, true));
  std::string points = "face,x,y,z\n";
  for (int node = 0; node < 18; ++node)
    points += std::string(mesh->nodes(2, node) > 0.005 ? "zmax" : "zmin") + "," + std::to_string(mesh->nodes(0, node)) +
              "," + std::to_string(mesh->nodes(1, node)) + "," + std::to_string(mesh->nodes(2, node)) + "\n";
  folder.write("points.csv", points);
  const std::string parts = header + "local low = substructure.superelement{ name = \"low\", stiffness = \"" +
                            folder.of("k.mtx") + "\", mass = \"" + folder.of("m.mtx") + "\", points = \"" +
                            folder.of("points.csv") + R"(" }
local up = substructure{ name = "up", mesh = block(10*mm), material = steel }
)";
  const auto refusal = [&](const std::string& rest) -> std::string {
    try {
      run_text(parts + rest);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal(R"(local i = interface.bonded{ name = "i", between = { low, up } })")
                .find("name its face and the opposite face"),
            std::string::npos);
  EXPECT_NE(refusal(R"(local i = interface.bonded{ name = "i", between = { low:face "zmax", up } })")
                .find("give the face of 'up' that lies on them"),
            std::string::npos);
  EXPECT_NE(refusal(R"(
local fine = substructure{ name = "fine", mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 30*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 } }, material = steel }
local i = interface.bonded{ name = "i", between = { low:face "zmax", fine:face "zmin" }, within = 16*mm })")
                .find("two nodes lie within 16 mm of one point"),
            std::string::npos);
  EXPECT_NE(
      refusal(R"(local i = interface.bonded{ name = "i", between = "all touching" })").find("no two of 2 parts touch"),
      std::string::npos);
}

// --- one flange of the bolted flanges

// The bolt force at all times, and the spectra on both sides of the joint below the frequency of use.
TEST(SuperelementPart, of_a_bolted_flange_has_the_bolt_force_and_the_spectra_of_the_mesh) {
  const Folder folder;
  const std::string mesh = (fs::path(DYGITA_SOURCE_DIR) / "meshes" / "bolted_flanges.geo").string();
  const std::string parts = R"(
local p = param{ condensed = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = 2e-8 }
local flanges = mesh.gmsh{ file = ")" +
                            mesh + R"(", set = { size = 7*mm } }
local function part(name) return substructure{ name = name, mesh = flanges:volume(name), material = steel } end
)";
  folder.condense(parts + R"(
local lower = part "lower"
problem{ name = "condense", substructures = { lower }, supports = { support.fixed{ name = "base", on = lower:face "base" } },
         steps = { step.static{ name = "rest", increments = 1 } },
         outputs = { output.superelement{ name = "lower", on = { lower:face "upper", lower:face "nut", lower:face "side" }, up_to = 150*kHz, motion = "nodes" } } }:run{}
)");
  const std::string deck = parts + R"(
local lower = p.condensed == 1 and substructure.superelement{ name = "lower", file = ")" +
                           folder.of("lower.json") + R"(" } or part "lower"
local upper, rod, head, nut = part "upper", part "rod", part "head", part "nut"
local thread = interface.bonded{ name = "thread", between = { rod:face "nut_end", nut:face "rod_end" } }
local seat   = interface.bonded{ name = "seat", between = { nut:face "lower", lower:face "nut" } }
local shank  = interface.plastic{ name = "shank", between = { rod:face "head_end", head:face "rod_end" }, yield = 640*MPa, hardening = 50*MPa/mm }
local mating = interface.contact{ name = "mating", between = { lower:face "upper", upper:face "lower" }, friction = 0.2 }
local under  = interface.contact{ name = "under_head", between = { upper:face "head", head:face "upper" }, friction = 0.2 }
local supports = p.condensed == 1 and {} or { support.fixed{ name = "base", on = lower:face "base" } }
local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = shank, by = 0.06*mm } } }
local shock = step.dynamic{ name = "shock", after = tighten, duration = 200*us, dt = 1*us,
  loads = { load.traction{ on = upper:face "top", z = history.haversine{ peak = 3*MPa, duration = 100*us } } } }
local above = output.history{ name = "above", on = upper:face "top", quantity = "acceleration", direction = { 0, 0, 1 } }
local below = output.history{ name = "below", on = lower:face "side", quantity = "acceleration", direction = { 0, 0, 1 } }
problem{ name = "flanges", substructures = { lower, upper, rod, head, nut }, interfaces = { mating, under, thread, seat, shank },
         supports = supports, steps = { tighten, shock }, solver = solver.latin{ integration = "implicit", tolerance = 1e-8 },
         outputs = { above, below, output.srs{ name = "srs_above", of = above, from = 5*kHz, to = 60*kHz }, output.srs{ name = "srs_below", of = below, from = 5*kHz, to = 60*kHz },
                     output.joint{ name = "bolt", on = shank }, output.joint{ name = "joint", on = mating } } }:run{}
)";
  const DeckRun whole = run_text(deck).at(0), condensed = run_text(deck, {{"condensed", "1"}}).at(0);
  EXPECT_TRUE(whole.result->converged && condensed.result->converged);
  EXPECT_GT(largest(whole.column("joint", "friction_work")), 0.0);  // it slides
  EXPECT_LT(difference(whole, condensed, "bolt", "normal"), 1e-5 * largest(whole.column("bolt", "normal")));
  EXPECT_LT(difference(whole, condensed, "joint", "normal"), 1e-4 * largest(whole.column("joint", "normal")));
  for (const char* spectrum : {"srs_above", "srs_below"})
    EXPECT_LT(difference(whole, condensed, spectrum, "maximax"), 1e-3 * largest(whole.column(spectrum, "maximax")))
        << spectrum;
  const std::vector<double>&of_whole = whole.column("srs_above", "maximax"),
        &of_condensed = condensed.column("srs_above", "maximax");
  for (size_t i = 0; i < of_whole.size(); ++i) EXPECT_NEAR(of_condensed[i], of_whole[i], 1e-3 * of_whole[i]) << i;
}

}  // namespace
}  // namespace dygita::test::superelement_parts_tests

// report.html from a run's folder: what it says, what it leaves out, what it does with damage.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "drawing/svg_checks.hpp"
#include "files/scratch.hpp"
#include "law/law.hpp"
#include "recording/given_output.hpp"
#include "report/report.hpp"
#include "result/scenes.hpp"
#include "run/run_files.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SubstructurePtr tetrahedron(const std::string& name, double z) {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes.resize(3, 4);
  mesh->nodes << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  mesh->blocks = {{CellType::tet4, {0, 1, 2, 3}}};
  auto part = std::make_shared<Substructure>();
  part->name = name;
  part->mesh = mesh;
  part->material.name = "steel";
  part->place = {0, 0, z};
  return part;
}

StepSummary summary(const std::string& name, bool is_static, int increments, long iterations, double indicator,
                    double seconds) {
  StepSummary step;
  step.name = name;
  step.is_static = is_static;
  step.increments = increments;
  step.iterations = iterations;
  step.worst_indicator = indicator;
  step.seconds = seconds;
  return step;
}

// A bolted pair, tightened and shocked, with every kind of output.
struct Example {
  Problem problem;
  RunResult result;
  RunIdentity identity;
  std::vector<std::string> warnings;

  Example() {
    problem.name = "pair";
    problem.substructures = {tetrahedron("lower", 0.0), tetrahedron("upper", 2.0)};
    auto touch = std::make_shared<Interface>();
    touch->name = "touch";
    touch->law = make_law("contact", {{"friction", 0.25}, {"gap", 0.0}});
    touch->side_1 = {problem.substructures[0], "top"};
    touch->side_2 = {problem.substructures[1], "bottom"};
    problem.interfaces = {touch};
    problem.steps = {step("tighten", true), step("shock", false)};
    result.steps = {summary("tighten", true, 2, 30, 5e-9, 0.1), summary("shock", false, 3, 12, 8e-7, 0.2)};
    const std::vector<int> rows = {0, 0, 1, 1, 1};
    const std::vector<double> time = {0, 0, 1e-6, 2e-6, 3e-6};
    const OutputPtr history = add(make_history("above", {}, "acceleration"),
                                  {{"time", "acceleration"}, {"s", "m/s^2"}, {time, {0, 0, 10, 20, -5}}, rows});
    GivenArguments spectrum = given_spectrum("srs", "srs");
    spectrum.outputs["of"] = history;
    spectrum.specifications["specification"] =
        std::make_shared<Specification>(Specification{{100.0, 1000.0}, {10.0, 10.0}, "deck"});
    add(make_output(spectrum), {{"frequency", "maximax", "positive", "negative"},
                                {"Hz", "m/s^2", "m/s^2", "m/s^2"},
                                {{100, 500, 1000}, {5, 25, 8}, {4, 25, 8}, {5, 20, 7}},
                                {}});
    add(make_output(given_output("joint", "grip", {InterfacePtr(touch)})),
        {{"time", "normal", "shear", "opening", "slip", "plastic_opening", "open_area", "stick_area", "slip_area",
          "friction_work", "plastic_work"},
         {"s", "N", "N", "m", "m", "m", "m^2", "m^2", "m^2", "J", "J"},
         {time,
          {-1e3, -2e3, -1e3, 0, -500},
          {0, 0, 100, 0, 50},
          {0, 0, 0, 1e-6, 0},
          {0, 0, 1e-7, 2e-7, 2e-7},
          {0, 0, 0, 0, 0},
          {0, 0, 0, 1e-4, 0},
          {1e-4, 1e-4, 0, 0, 1e-4},
          {0, 0, 1e-4, 0, 0},
          {0, 0, 1e-4, 1e-4, 1e-4},
          {0, 0, 0, 0, 0}},
         rows});
    add(make_output(given_output("energy", "")),
        {{"time", "kinetic", "strain", "loads", "friction", "plastic", "damping", "scheme", "balance"},
         {"s", "J", "J", "J", "J", "J", "J", "J", "J"},
         {time,
          {0, 0, 1, 2, 1},
          {0, 1, 1, 1, 1},
          {0, 1, 2, 3, 2},
          {0, 0, 0, 0, 0},
          {0, 0, 0, 0, 0},
          {0, 0, 0, 0, 0},
          {0, 0, 0, 0, 0},
          {0, 0, 0, 0, 0}},
         rows});
    result.convergence = {{"time", "iterations", "indicator", "converged"},
                          {"s", "", "", ""},
                          {time, {20, 10, 4, 4, 4}, {5e-9, 4e-9, 8e-7, 7e-7, 6e-7}, {1, 1, 1, 1, 1}},
                          rows};
    result.figures.energy_imbalance = 0.02;
    result.figures.numerical_dissipation = 0.1;
    result.figures.energy_gain = 0.0;
    result.figures.largest_energy = 3.0;
    result.figures.mesh_error = 12.0;
    result.seconds = {{"factor", 0.1}, {"all", 0.4}};
    result.n_dofs = 24;
    result.iterations = 42;
    result.mean_iterations = 8.4;
    identity.deck_path = "pair.lua";
    identity.parameters = {{"mu", 0.25}};
    identity.case_name = "stiff";
  }

  static StepPtr step(const std::string& name, bool is_static) {
    auto step = std::make_shared<Step>();
    step->name = name;
    step->is_static = is_static;
    step->increments = 2;
    step->duration = 3e-6;
    step->dt = 1e-6;
    return step;
  }

  OutputPtr add(const OutputPtr& output, Table table) {
    problem.outputs.push_back(output);
    result.tables[output.get()] = std::move(table);
    return output;
  }

  void draw() {
    auto scenes = std::make_shared<Scenes>();
    for (const bool is_static : {true, false})
      scenes->assembly.push_back({is_static ? "tighten" : "shock",
                                  is_static,
                                  2e-6,
                                  {Points::Constant(3, 4, 1e-3), Points::Zero(3, 4)},
                                  {Vec::Constant(4, 3e6), Vec::Zero(4)}});
    JointScenes joint;
    joint.name = "touch";
    joint.has_slip = true;
    joint.points.resize(3, 3);
    joint.points << 0, 1, 0, 0, 0, 1, 0, 0, 0;
    joint.facets = {Facet{FacetType::tri3, {0, 1, 2}}};
    for (const double time : {0.0, 1e-6})
      joint.instants.push_back({"shock", false, time, {0, 1, 2}, {1e6f, 2e6f, 0.0f}, {0.0f, 1e-6f, 2e-6f}, {}});
    scenes->joints = {joint};
    result.scenes = scenes;
  }

  std::string write(const fs::path& folder) const {
    RunWriter writer(folder, problem.name);
    write_run_files(writer, problem, result, identity, warnings);
    return text_of(folder / "report.html");
  }
};

const std::vector<std::string> void_elements = {"meta"};

void expect_all(const std::string& page, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(page.find(part), std::string::npos) << part;
}

std::string fault(const fs::path& folder) {
  try {
    report_html(folder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Report, tells_verdict_what_was_computed_and_every_output) {
  const Scratch scratch;
  Example run;
  run.draw();
  run.warnings = {"the mesh is <coarse> & \"old\""};
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(test::xml_fault(page, void_elements), "");
  expect_all(page,
             {"<h1>pair</h1>", "case stiff", "deck pair.lua", "Converged: all 5 increments",
              "the mesh is &lt;coarse&gt; &amp; &quot;old&quot;", "1 warning", "friction 0.25", "<h2>The assembly</h2>",
              "<h2>Shock response spectra</h2>", "<h2>Histories</h2>", "<h2>Joints</h2>", "<h2>Energy</h2>",
              "<h2>Convergence</h2>", "<h2>Cost</h2>", "It opens on up to 100 % of its area, by up to 1\u00a0µm",
              "tighten (static)", "laid flat", "von Mises stress up to 3\u00a0MPa"});
  EXPECT_EQ(page.find("<h2>Bolts"), std::string::npos);
  for (const char* from_elsewhere : {"<script src", "<script type=\"module", "import(", "fetch(", "XMLHttpRequest",
                                     "href", "src=", "@import", "url("})
    EXPECT_EQ(page.find(from_elsewhere), std::string::npos) << from_elsewhere;
}

// A record of 20 ms, from 50 Hz on.
Example long_record() {
  Example run;
  run.result.steps[1].increments = 20000;
  return run;
}

std::string verdict_of_page(const std::string& page) {
  const size_t from = page.find("<p class=\"verdict");
  return page.substr(from, page.find("</p>", from) - from);
}

ContactSummary contact(const std::string& name, double sliding, double used) {
  const ContactStep still{.step = 0,
                          .lowest = 900,
                          .highest = 900,
                          .shear = 10,
                          .closed = 1.0,
                          .sliding = 0.0,
                          .slip = 1e-8,
                          .friction_used = 0.05};
  const ContactStep moving{.step = 1,
                           .lowest = 500,
                           .highest = 1200,
                           .shear = 150,
                           .closed = 0.75,
                           .opening = 2e-7,
                           .sliding = sliding,
                           .slip = 3e-6,
                           .friction_used = used};
  return {.name = name, .area = 1e-4, .friction = 0.25, .steps = {still, moving}};
}

TEST(Report, says_in_words_what_the_run_shows_and_its_tiles_agree) {
  const Scratch scratch;
  Example run = long_record();
  run.result.figures.mesh_error = 5.0;
  for (const auto& [name, last] : {std::pair{"M5 a", 9.5e3}, {"M5 b", 9.34e3}}) {
    BoltSummary bolt;
    bolt.name = name;
    bolt.area = 5e-5;
    bolt.tightened = bolt.highest = 1e4;
    bolt.last = last;
    bolt.lowest = 8.85e3;
    run.result.bolts.push_back(bolt);
  }
  run.result.contacts = {contact("seat", 0.3, 0.6), contact("pad", 0.1, 0.2)};
  const std::string red = verdict_of_page(run.write(scratch.path()));
  expect_all(red, {"class=\"verdict bad\"", "&#39;srs&#39; exceeds its specification by 8.0\u00a0dB at 500\u00a0Hz",
                   "All 2 bolts keep 93\u00a0% or more of their preload, at the lowest 88\u00a0% in the motion",
                   "No contact slides as a whole (at most 60\u00a0% of the friction is used, in &#39;seat&#39;)",
                   "Converged: all "});
  run.result.tables[run.problem.outputs[1].get()].columns[1] = {5, 5, 5};
  const std::string page = run.write(scratch.path());
  expect_all(verdict_of_page(page),
             {"class=\"verdict good\"", "&#39;srs&#39; stays below its specification, nearest by 6.0\u00a0dB"});
  EXPECT_EQ(page.find("card poor"), std::string::npos);
  EXPECT_EQ(page.find("card fair"), std::string::npos);
}

// What spreads under a head slips at all its points at once, and carries no shear; what has no friction has none to
// use.
TEST(Report, counts_what_slides_one_way_of_what_has_friction) {
  const Scratch scratch;
  Example run = long_record();
  ContactSummary smooth = contact("smooth", 0.0, 0.0);
  smooth.friction = 0.0;
  for (ContactStep& step : smooth.steps) step.sliding = step.slip = step.friction_used = std::nullopt;
  run.result.contacts = {contact("seat", 0.3, 0.6), contact("washer", 1.0, 0.05), smooth};
  expect_all(verdict_of_page(run.write(scratch.path())),
             {"No contact slides as a whole (at most 60\u00a0% of the friction is used, in &#39;seat&#39;); 1 without "
              "friction slides freely"});
  run.result.contacts = {contact("pad", 1.0, 1.0), smooth};
  expect_all(verdict_of_page(run.write(scratch.path())), {"1 of 1 contacts slides as a whole"});
  run.result.contacts = {smooth};
  expect_all(verdict_of_page(run.write(scratch.path())), {"The contact has no friction"});
}

TEST(Report, of_a_bolt_that_has_come_loose_and_a_contact_that_slides_is_not_green) {
  const Scratch scratch;
  Example run = long_record();
  run.problem.outputs.clear();
  run.result.tables.clear();
  run.result.figures.mesh_error = 5.0;
  run.result.contacts = {contact("seat", 0.3, 0.6), contact("pad", 1.0, 1.0)};
  expect_all(verdict_of_page(run.write(scratch.path())),
             {"class=\"verdict fair\"", "1 of 2 contacts slides as a whole, by up to 3\u00a0µm: &#39;pad&#39;"});
  BoltSummary bolt;
  bolt.name = "M5";
  bolt.tightened = 1e4;
  bolt.last = 4e3;
  bolt.lowest = -1.0;
  run.result.bolts = {bolt};
  expect_all(verdict_of_page(run.write(scratch.path())),
             {"class=\"verdict bad\"",
              "Bolt &#39;M5&#39; keeps 40\u00a0% of its preload; &#39;M5&#39; goes slack in the motion"});
}

TEST(Report, has_a_table_of_every_contact_those_that_slide_first) {
  const Scratch scratch;
  Example run;
  run.result.contacts = {contact("seat", 0.3, 0.6), contact("pad", 1.0, 1.0), contact("rim", 0.0, 0.1)};
  const std::string page = run.write(scratch.path());
  expect_all(page, {"Every contact (3)",
                    "<tr><td>pad (slides)</td><td>0.9\u00a0kN</td><td>0.5\u00a0kN</td><td>1.2\u00a0kN</td>"
                    "<td>0.15\u00a0kN</td><td>75\u00a0%</td><td>200\u00a0nm</td><td>100\u00a0%</td><td>3\u00a0µm</td>"
                    "<td>100\u00a0%</td></tr>"});
  EXPECT_LT(page.find("<td>pad (slides)"), page.find("<td>seat</td>"));
  EXPECT_LT(page.find("<td>seat</td>"), page.find("<td>rim</td>"));
}

TEST(Report, draws_no_chart_of_a_joint_that_stays_as_it_is) {
  const Scratch scratch;
  Example run;
  Table& joint = run.result.tables[run.problem.outputs[2].get()];
  for (const char* state : {"open_area", "slip_area"})
    for (size_t c = 0; c < joint.names.size(); ++c)
      if (joint.names[c] == state) joint.columns[c] = {1e-4, 0, 0, 0, 0};  // while it is tightened
  for (size_t c = 0; c < joint.names.size(); ++c)
    if (joint.names[c] == "stick_area") joint.columns[c] = {0, 1e-4, 1e-4, 1e-4, 1e-4};
  const std::string page = run.write(scratch.path());
  expect_all(page, {"<h2>Joints", "Without charts, since nothing opens, slides or yields: &#39;grip&#39;"});
  EXPECT_EQ(page.find("It stays closed"), std::string::npos);
  EXPECT_EQ(page.find("Force through the joint"), std::string::npos);
}

TEST(Report, tells_warnings_of_a_kind_together_and_the_first_three_kinds_in_full) {
  const Scratch scratch;
  Example run;
  for (const char* name : {"a", "b", "c", "d"})
    run.warnings.push_back(std::string("deck.lua:6: interface.bonded '") + name + "': 'core' and '" + name +
                           "' pass into each other by up to 0.86 mm");
  run.warnings.push_back("deck.lua:7: interface.bonded: 'core' and 'e' pass into each other by up to 0.5 mm");
  for (const char* other : {"the mesh leaves 12 %", "the step is long", "the record is short", "a bolt is loose"})
    run.warnings.push_back(other);
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(test::xml_fault(page, void_elements), "");
  expect_all(page, {"<h3>9 warnings of 5 kinds</h3>", "<summary>4 more of this kind</summary>",
                    "<summary>2 further kinds of warnings</summary>"});
  const size_t folded = page.find("2 further kinds");
  for (const char* shown : {"the mesh leaves 12 %", "the step is long"}) EXPECT_LT(page.find(shown), folded) << shown;
  for (const char* hidden : {"the record is short", "a bolt is loose"}) EXPECT_GT(page.find(hidden), folded) << hidden;
}

// Three directions of one place in one chart; what does not move in words.
TEST(Report, draws_a_chart_a_place_and_says_which_direction_carries_only_rounding) {
  const Scratch scratch;
  Example run = long_record();
  const auto add = [&](const std::string& name, double peak) {
    GivenArguments spectrum = given_spectrum("srs", name);
    spectrum.outputs["of"] = run.problem.outputs[0];
    run.add(make_output(spectrum),
            {{"frequency", "maximax", "positive", "negative"},
             {"Hz", "m/s^2", "m/s^2", "m/s^2"},
             {{100, 500, 1000}, {1e-9 * peak, peak, peak}, {peak, peak, peak}, {peak, peak, peak}},
             {}});
  };
  run.problem.outputs.erase(run.problem.outputs.begin() + 1);
  add("unit x", 20.0);
  add("unit y", 10.0);
  add("unit z", 3e-14);
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(test::xml_fault(page, void_elements), "");
  expect_all(page,
             {"Shock response spectra of acceleration, unit\"", "data-name=\"x (Q", "data-name=\"y (Q",
              "Not drawn, since it carries nothing but rounding beside the largest of the run: &#39;unit z&#39;"});
  EXPECT_EQ(page.find("data-name=\"z (Q"), std::string::npos);
  // From the peak of 20 m/s^2 80 dB down.
  const size_t at = page.find("data-y=\"", page.find("<h2>Shock response spectra"));
  EXPECT_NEAR(std::stod(page.substr(at + 8)), 20e-4, 1e-9);
}

TEST(Report, is_a_function_of_the_folder) {
  const Scratch scratch;
  Example run;
  run.draw();
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(report_html(scratch.path()), page);
  const auto files = nlohmann::json::parse(text_of(scratch.path() / "run.json"))["files"];
  for (const char* file : {"scenes.json", "report.html", "run.json"})
    EXPECT_EQ(std::count(files.begin(), files.end(), file), 1) << file;
}

constexpr const char* card_of_srs = "\"><small>&#39;srs&#39; ";

TEST(Report, says_by_how_much_a_spectrum_leaves_its_specification) {
  const Scratch scratch;
  const std::string page = long_record().write(scratch.path());
  expect_all(page, {"Spectrum &#39;srs&#39; exceeds its specification by up to +8.0\u00a0dB at 500\u00a0Hz",
                    "Judged from 100\u00a0Hz to 1\u00a0kHz", "±3 dB", "±6 dB", "specification",
                    std::string("card poor") + card_of_srs});
  const auto record = nlohmann::json::parse(text_of(scratch.path() / "run.json"));
  EXPECT_NEAR(record["outputs"][1]["specification"]["exceedance"]["decibels"].get<double>(), 20 * std::log10(2.5),
              1e-9);
  ReportRequest other;
  other.specifications[""] =
      std::make_shared<Specification>(Specification{{100.0, 1000.0}, {100.0, 100.0}, "other.csv"});
  expect_all(report_html(scratch.path(), other),
             {"is below its specification over the judged range, closest at 500\u00a0Hz with −12.0\u00a0dB",
              "Specification: other.csv", std::string("card fine") + card_of_srs});
}

// The page of a run whose specification asks for a margin, dB.
std::string page_with_margin(const std::filesystem::path& folder, double margin, std::vector<double> maximax) {
  Example run = long_record();
  run.result.figures.mesh_error = 5.0;
  run.result.tables[run.problem.outputs[1].get()].columns[1] = std::move(maximax);
  run.write(folder);
  auto record = nlohmann::json::parse(text_of(folder / "run.json"));
  record["outputs"][1]["specification"]["margin"] = margin;
  std::ofstream(folder / "run.json") << record;
  return report_html(folder);
}

TEST(Report, holds_a_spectrum_against_the_margin_that_is_asked) {
  const Scratch scratch;
  const std::string missed = page_with_margin(scratch.path(), 3.0, {5, 9, 8});
  expect_all(
      missed,
      {"class=\"verdict bad\"",
       "&#39;srs&#39; stays below its specification by 0.9\u00a0dB at 500\u00a0Hz, of the 3\u00a0dB that are asked",
       "closest at 500\u00a0Hz with −0.9\u00a0dB, where 3\u00a0dB of margin are asked", "specification − 3 dB",
       std::string("card poor") + card_of_srs});
  const std::string kept = page_with_margin(scratch.path(), 3.0, {5, 5, 5});
  expect_all(
      kept,
      {"class=\"verdict good\"",
       "&#39;srs&#39; stays below its specification and keeps the 3\u00a0dB that are asked, nearest by 6.0\u00a0dB",
       std::string("card fine") + card_of_srs});
  expect_all(page_with_margin(scratch.path(), 3.0, {5, 25, 8}),
             {"&#39;srs&#39; exceeds its specification by 8.0\u00a0dB at 500\u00a0Hz"});
  EXPECT_EQ(page_with_margin(scratch.path(), 0.0, {5, 9, 8}).find("are asked"), std::string::npos);
}

TEST(Report, judges_a_spectrum_only_where_the_record_allows_it) {
  const Scratch scratch;
  Example run = long_record();
  run.result.steps[1].increments = 5000;  // 5 ms, from 200 Hz on
  run.result.tables[run.problem.outputs[1].get()].columns[1] = {500, 9, 14};
  const std::string page = run.write(scratch.path());
  expect_all(page, {"exceeds its specification by up to +2.9\u00a0dB at 1\u00a0kHz",
                    "Of the specification not judged: 100\u00a0Hz to 200\u00a0Hz (the record is too short",
                    "the record is too short", std::string("card poor") + card_of_srs});
  EXPECT_EQ(page.find("+34.0"), std::string::npos);  // at 100 Hz, where nothing is judged
}

TEST(Report, marks_each_range_above_the_specification_with_its_figure) {
  const Scratch scratch;
  Example run = long_record();
  run.result.tables[run.problem.outputs[1].get()].columns[1] = {14, 5, 25};
  expect_all(run.write(scratch.path()),
             {"by up to +8.0\u00a0dB at 1\u00a0kHz, +2.9\u00a0dB at 100\u00a0Hz", ">+8.0\u00a0dB<", ">+2.9\u00a0dB<"});
}

TEST(Report, says_that_a_spectrum_and_its_specification_do_not_meet) {
  const Scratch scratch;
  const std::string page = Example().write(scratch.path());  // 3 us: from 333 kHz on
  expect_all(page, {"is not compared with its specification (100\u00a0Hz to 1\u00a0kHz)", "not judged",
                    std::string("card poor") + card_of_srs});
  ReportRequest far;
  far.specifications[""] = std::make_shared<Specification>(Specification{{2e3, 9e3}, {1.0, 1.0}, "far.csv"});
  long_record().write(scratch.path());
  expect_all(report_html(scratch.path(), far), {"they have no common frequency that can be judged",
                                                "2\u00a0kHz to 9\u00a0kHz", std::string("card poor") + card_of_srs});
  far.specifications[""] = std::make_shared<Specification>(Specification{{500.0, 9e3}, {1e3, 1e3}, "half.csv"});
  expect_all(report_html(scratch.path(), far),
             {"1\u00a0kHz to 9\u00a0kHz (the spectrum ends at 1\u00a0kHz)", std::string("card fair") + card_of_srs});
}

TEST(Report, is_not_green_where_a_margin_is_within_what_is_uncertain) {
  const Scratch scratch;
  Example run = long_record();
  const Output* srs = run.problem.outputs[1].get();
  run.result.tables[srs].columns[1] = {5, 9, 5};
  Findings& findings = run.result.findings[srs];
  findings.values = {{"judged_from", 50.0}, {"judged_to", 5e5}};
  findings.band = {{"frequency", "all"}, {"Hz", "dB"}, {{100, 500, 1000}, {0.5, 2.0, 0.5}}, {}};
  expect_all(run.write(scratch.path()), {"closest at 500\u00a0Hz with −0.9\u00a0dB; uncertain there by 2.0\u00a0dB",
                                         std::string("card fair") + card_of_srs});
}

TEST(Report, grades_mesh_errors_in_three_steps) {
  const Scratch scratch;
  Example run;
  for (const auto& [percent, grade] : {std::pair{9.0, "fine"}, {20.0, "fair"}, {31.0, "poor"}}) {
    run.result.figures.static_mesh_error = percent;
    run.result.figures.mesh_error.reset();
    const std::string card = std::string("<div class=\"card ") + grade + "\"><small>mesh error</small>";
    EXPECT_NE(run.write(scratch.path()).find(card), std::string::npos) << percent;
  }
}

TEST(Report, has_one_definition_of_the_largest_energy) {
  const Scratch scratch;
  expect_all(Example().write(scratch.path()), {"Largest energy 3\u00a0J: the top of the chart"});
}

TEST(Report, tells_first_what_matters) {
  const Scratch scratch;
  Example run;
  run.draw();
  auto part = std::make_shared<Substructure>(*run.problem.substructures[0]);
  part->material = {"steel", 210e9, 0.3, 7800.0, {}};
  part->yield = 640e6;
  run.problem.substructures[0] = part;
  run.result.stresses = {{.part = 0,
                          .largest = 800e6,
                          .allowed = 640e6,
                          .time = 2e-6,
                          .step = 1,
                          .place = {0.01, 0, 0.5},
                          .above = 0.125}};
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(test::xml_fault(page, void_elements), "");
  size_t last = 0;
  for (const char* section :
       {"<h2>Verdict", "<h2>Shock response spectra", "<h2>The assembly", "<h2>Stress against yield", "<h2>Joints",
        "<h2>Peaks", "<h2>Parts", "<h2>Energy", "<h2>What was computed"}) {
    const size_t place = page.find(section);
    ASSERT_NE(place, std::string::npos) << section;
    EXPECT_GT(place, last) << section;
    last = place;
  }
  // A tetrahedron of a sixth of a cubic metre; the largest of each history with its instant.
  expect_all(page, {"<td>1.3\u00a0t</td>", "1 × 1 × 1\u00a0m", "210\u00a0GPa", "7800\u00a0kg/m³",
                    "<td>2.04\u00a0g</td><td>shock, 2\u00a0µs</td>", "<td>−20\u00a0%</td><td>12\u00a0%</td>",
                    "(10, 0, 500)", "Not monitored, since their material has no yield: upper",
                    "card poor\"><small>smallest margin against yield"});
}

TEST(Report, splits_the_loss_of_a_bolt_and_keeps_to_one_unit_of_force) {
  const Scratch scratch;
  Example run;
  BoltSummary bolt;
  bolt.name = "M8";
  bolt.area = 5e-5;
  bolt.tightened = 30e3;
  bolt.last = 27e3;
  bolt.lowest = 850;
  bolt.stiffness = 1e9;
  bolt.yielded = 2e-6;
  bolt.before_motion = 29.4e3;
  run.result.bolts = {bolt};
  expect_all(run.write(scratch.path()),
             {"<td>0.85\u00a0kN</td>",
              "<th>by yielding</th><th>by other bolts, static loads</th><th>by the joint in the motion</th>",
              "<td>10\u00a0%</td><td>6.67\u00a0%</td><td>2\u00a0%</td><td>1.33\u00a0%</td>", "Loss of preload",
              "yielding of the bolt"});
}

TEST(Report, folds_long_tables_and_opens_them_in_print) {
  const Scratch scratch;
  Example run;
  EXPECT_EQ(run.write(scratch.path()).find("<summary>Interfaces"), std::string::npos);
  for (int i = 0; i < 12; ++i) {
    auto more = std::make_shared<Interface>(*run.problem.interfaces[0]);
    more->name += std::to_string(i);
    run.problem.interfaces.push_back(more);
  }
  expect_all(run.write(scratch.path()), {"<details>\n<summary>Interfaces (13)</summary>", "::details-content"});
}

// Versions before the table of laws wrote kind and parameters only: a bolt must not pass for a contact.
TEST(Report, knows_the_laws_of_earlier_records) {
  const Scratch scratch;
  Example run;
  auto shank = std::make_shared<Interface>(*run.problem.interfaces[0]);
  shank->law = make_law("plastic", {{"yield", 640e6}, {"hardening", 0.0}, {"compression", 0.0}});
  run.problem.interfaces[0] = shank;
  const std::string page = run.write(scratch.path());
  expect_all(page, {"yields at 640\u00a0MPa", "It yields on up to 100 % of its area"});
  auto record = nlohmann::ordered_json::parse(text_of(scratch.path() / "run.json"));
  record["interfaces"][0].erase("law");
  put(scratch.path() / "run.json", record.dump());
  EXPECT_EQ(report_html(scratch.path()), page);
  record["interfaces"][0].erase("yield");
  put(scratch.path() / "run.json", record.dump());
  EXPECT_NE(fault(scratch.path()).find("does not tell the law of interface 'touch' (plastic)"), std::string::npos);
  record["interfaces"][0]["kind"] = "glued";
  put(scratch.path() / "run.json", record.dump());
  EXPECT_NE(fault(scratch.path()).find("run the deck again"), std::string::npos);
}

TEST(Report, names_what_did_not_converge_first) {
  const Scratch scratch;
  Example run;
  run.result.converged = false;
  run.result.steps[1].increments_not_converged = 1;
  run.result.steps[1].worst_indicator = 3e-4;
  run.result.convergence.columns[3][3] = 0.0;
  const std::string page = run.write(scratch.path());
  expect_all(page, {"NOT converged: 1 of the 3 increments of step &#39;shock&#39; (worst indicator 3·10⁻⁴)",
                    "The increment above the tolerance", "missed the tolerance"});
  EXPECT_LT(page.find("NOT converged"), page.find("<h2>What was computed"));
}

TEST(Report, says_how_far_an_interrupted_run_came) {
  const Scratch scratch;
  Example run;
  run.result.interrupted = true;
  run.result.steps[1].increments = 1;
  expect_all(run.write(scratch.path()), {"Interrupted by the user: 3 of 5 increments were computed"});
}

TEST(Report, has_a_table_of_bolts_where_there_are_bolts) {
  const Scratch scratch;
  Example run;
  BoltSummary bolt;
  bolt.name = "M8 <a>";
  bolt.area = 5e-5;
  bolt.after_static = {30.6e3};
  bolt.target = 31e3;
  bolt.shortening = 6e-5;
  bolt.lowest = 12e3;
  bolt.highest = 40e3;
  bolt.last = 25e3;
  run.result.bolts = {bolt};
  expect_all(run.write(scratch.path()), {"<h2>Bolts</h2>", "M8 &lt;a&gt;", "asked for", "31\u00a0kN", "40\u00a0kN",
                                         "25\u00a0kN", "500\u00a0MPa", "60\u00a0µm"});
}

TEST(Report, of_a_run_without_outputs_is_short_and_sound) {
  const Scratch scratch;
  Example run;
  run.problem.outputs.clear();
  run.result.tables.clear();
  run.result.convergence = {};
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(test::xml_fault(page, void_elements), "");
  expect_all(page, {"Converged", "<h2>What was computed</h2>", "<h2>Cost</h2>"});
  for (const char* section : {"spectra", "Histories", "Joints", "Energy</h2>", "The assembly"})
    EXPECT_EQ(page.find(section), std::string::npos) << section;
}

TEST(Report, draws_around_what_is_not_a_number) {
  const Scratch scratch;
  Example run;
  run.draw();
  for (auto& [output, table] : run.result.tables)
    for (size_t c = 1; c < table.columns.size(); ++c) table.columns[c].back() = nan;
  run.result.figures.energy_imbalance = nan;
  run.result.convergence.columns[2].back() = std::numeric_limits<double>::infinity();
  auto scenes = std::make_shared<Scenes>(*run.result.scenes);
  scenes->assembly[1].displacement[0](0, 0) = nan;
  scenes->joints[0].instants[0].pressure[0] = std::nanf("");
  run.result.scenes = scenes;
  const std::string page = run.write(scratch.path());
  EXPECT_EQ(test::xml_fault(page, void_elements), "");
  expect_all(page, {"not a number", "displacements are not finite; drawn undeformed"});
  for (const char* leak : {"\"nan", " nan", "Mnan", "\"inf", "NaN"})
    EXPECT_EQ(page.find(leak), std::string::npos) << leak;
}

TEST(Report, tells_what_the_folder_lacks) {
  const Scratch scratch;
  Example run;
  run.draw();
  run.write(scratch.path());
  fs::remove(scratch.path() / "grip.csv");
  put(scratch.path() / "above.csv", "time [s],step,acceleration [m/s^2]\n0,shock\n");
  put(scratch.path() / "scenes.json", "{");
  const std::string page = report_html(scratch.path());
  expect_all(page, {"grip.csv is missing: it is left out",
                    "above.csv line 2 has 2 cells where the header has 3: it is left out", "scenes.json is damaged"});
  EXPECT_EQ(page.find("<h2>Joints"), std::string::npos);
}

TEST(Report, of_a_folder_without_a_run_is_an_input_error) {
  const Scratch scratch;
  EXPECT_NE(fault(scratch.path() / "nowhere").find("no folder '"), std::string::npos);
  EXPECT_NE(fault(scratch.path()).find("holds no run.json"), std::string::npos);
  Example().write(scratch.path() / "base");
  EXPECT_NE(fault(scratch.path()).find("there is one in '" + (scratch.path() / "base").string()), std::string::npos);
  put(scratch.path() / "run.json", "{\"problem\": 3}");
  EXPECT_NE(fault(scratch.path()).find("not the record of a run"), std::string::npos);
  put(scratch.path() / "run.json",
      "{\"problem\": \"a\", \"verdict\": \"converged\", \"steps\": [], \"substructures\": 7}");
  EXPECT_NE(fault(scratch.path()), "none");
  put(scratch.path() / "run.json", "not json");
  EXPECT_NE(fault(scratch.path()).find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace dygita

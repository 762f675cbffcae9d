// From the deck's words to the model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "deck/fake_engine.hpp"
#include "law/law.hpp"
#include "model/load.hpp"
#include "model/output.hpp"
#include "recording/recorder.hpp"
#include "result/result.hpp"

namespace dygita::test::build_tests {

namespace {

// The problem of a deck of two blocks with more in it.
Problem built(const std::string& text, const std::string& more = "") {
  FakeEngine fake;
  run_text(std::string(two_blocks) + text +
               "\nlocal p = problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, "
               "supports = { base }, steps = { s }, " +
               more + " }\np:run{}",
           fake);
  return fake.problems.at(0);
}

LoadPtr load_built(const std::string& load,
                   const std::string& step = "step.dynamic{ name = 's', duration = 4*us, dt = 1*us") {
  return built("local l = " + load + "\nlocal s = " + step + ", loads = { l } }").steps.at(0)->loads.at(0);
}

TEST(Build, makes_materials_and_substructures) {
  FakeEngine fake;
  run_text(R"(
local soft = material.elastic{ name = "soft", young = 4.2*GPa, poisson = 0.35, density = 1200,
                               damping = { mass = 3, stiffness = 2*us } }
local bar = substructure{ name = "bar", material = soft, place = { 1*mm, 2*mm, 3*mm }, velocity = { 0, 0, -5 },
                          mesh = mesh.box{ size = { 1*mm, 2*mm, 3*mm }, cells = { 1, 2, 3 }, origin = { 0, 0, 1*mm } } }
local s = step.dynamic{ name = "s", duration = 1*us, dt = 0.1*us }
problem{ name = "p", substructures = { bar }, steps = { s },
         supports = { support.fixed{ name = "f", on = bar:face "zmin" } } }:run{}
)",
           fake);
  const Substructure& bar = *fake.problems.at(0).substructures.at(0);
  EXPECT_EQ(bar.material.young(), 4.2e9);
  EXPECT_EQ(bar.material.damping.mass, 3.0);
  EXPECT_EQ(bar.material.damping.stiffness, 2e-6);
  EXPECT_EQ(bar.place, Vec3(1e-3, 2e-3, 3e-3));
  EXPECT_EQ(bar.velocity, Vec3(0, 0, -5));
  EXPECT_EQ(bar.mesh->n_cells(), 6);
  EXPECT_DOUBLE_EQ(bar.mesh->nodes.row(2).minCoeff(), 1e-3);
  EXPECT_EQ(fake.problems.at(0).steps.at(0)->n_increments(), 10);
}

double parameter(const Interface& interface, const std::string& name) {
  for (const LawParameter& parameter : interface.law->parameters())
    if (parameter.name == name)
      return std::visit([](auto value) { return static_cast<double>(value); }, parameter.value);
  ADD_FAILURE() << "no parameter " << name;
  return 0.0;
}

TEST(Build, makes_interfaces) {
  FakeEngine fake;
  run_text(std::string(two_blocks) + R"(
local faces = { low:face "zmax", high:face "zmin" }
local function run(interface)
  problem{ name = interface.name, substructures = { low, high }, interfaces = { interface }, supports = { base },
           steps = { hold } }:run{}
end
run(interface.contact{ name = "c", between = faces, friction = 0.2, gap = 10*um })
run(interface.plastic{ name = "p", between = faces, yield = 640*MPa, hardening = 50*MPa/mm, compression = true })
)",
           fake);
  const Interface& contact = *fake.problems.at(0).interfaces.at(0);
  EXPECT_EQ(contact.law->word(), "contact");
  EXPECT_EQ(parameter(contact, "friction"), 0.2);
  EXPECT_DOUBLE_EQ(parameter(contact, "gap"), 1e-5);
  EXPECT_EQ(contact.side_1.label(), "low.zmax");
  EXPECT_EQ(contact.side_2.label(), "high.zmin");
  const Interface& plastic = *fake.problems.at(1).interfaces.at(0);
  EXPECT_EQ(plastic.law->word(), "plastic");
  EXPECT_EQ(parameter(plastic, "yield"), 640e6);
  EXPECT_DOUBLE_EQ(parameter(plastic, "hardening"), 5e10);
  EXPECT_EQ(parameter(plastic, "compression"), 1.0);
}

TEST(Build, makes_regions_of_the_nodes_in_place) {
  const Problem problem = built(R"(
local s = hold
local top = high:where(function(x, y, z) return near(z, 20*mm) end)
local top_too = high:where(function(x, y, z) return not near(z, 20*mm) and near(x, 0) end)
local h = output.history{ name = "h", on = { top, top_too }, quantity = "velocity", direction = { 0, 3, 4 } })",
                                "outputs = { h }");
  const Notes notes = problem.outputs.at(0)->record({}, {});
  const auto noted = [&](const std::string& name) {
    return std::find_if(notes.begin(), notes.end(), [&](const Note& note) { return note.name == name; })->value;
  };
  EXPECT_EQ(std::get<std::vector<std::string>>(noted("on")),
            (std::vector<std::string>{"high (4 nodes)", "high (2 nodes)"}));
  const auto direction = std::get<std::vector<double>>(noted("direction"));
  EXPECT_NEAR((Vec3(direction.at(0), direction.at(1), direction.at(2)) - Vec3(0, 0.6, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_EQ(std::get<std::string>(noted("quantity")), "velocity");
}

TEST(Build, knows_numbers_from_histories_in_loads) {
  const LoadPtr load =
      load_built("load.traction{ on = high:face 'zmax', x = 3*MPa, z = history.ramp{ to = 1*MPa, duration = 2*us } }");
  EXPECT_EQ(load->path, "load.traction");
  EXPECT_TRUE(load->values[0]->is_number);
  EXPECT_EQ(load->values[0]->history.value(1.0), 3e6);
  EXPECT_FALSE(load->values[1].has_value());
  EXPECT_FALSE(load->values[2]->is_number);
  EXPECT_DOUBLE_EQ(load->values[2]->history.value(1e-6), 5e5);
}

TEST(Build, makes_every_history) {
  const auto value = [](const std::string& history, double t) {
    return load_built("load.pressure{ on = high:face 'zmax', history = " + history + " }")->values[0]->history.value(t);
  };
  EXPECT_EQ(value("history.constant{ value = 5 }", 1.0), 5.0);
  EXPECT_EQ(value("history.step{ value = 5, at = 2*us }", 1e-6), 0.0);
  EXPECT_EQ(value("history.step{ value = 5, at = 2*us }", 3e-6), 5.0);
  EXPECT_DOUBLE_EQ(value("history.ramp{ from = 1, to = 3, duration = 2*us }", 1e-6), 2.0);
  EXPECT_DOUBLE_EQ(value("history.half_sine{ peak = 8, duration = 2*us }", 1e-6), 8.0);
  EXPECT_NEAR(value("history.haversine{ peak = 8, duration = 2*us }", 0.5e-6), 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(value("history.pulse{ peak = 8, rise = 1*us, hold = 1*us, fall = 2*us }", 3e-6), 4.0);
  EXPECT_DOUBLE_EQ(value("history.piecewise{ times = { 0, 1*us }, values = { 2, 4 } }", 0.5e-6), 3.0);
}

TEST(Build, reads_files_beside_the_deck) {
  const Folder folder;
  folder.write("pulse.csv", "time,value\n0,0\n1e-6,10\n");
  FakeEngine fake;
  DeckOptions options;
  options.path = folder.write("deck.lua", std::string(two_blocks) + R"(
local push = load.pressure{ on = high:face "zmax", history = history.file{ file = "pulse.csv" } }
local s = step.dynamic{ name = "s", duration = 1*us, dt = 0.1*us, loads = { push } }
problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { s } }:run{})");
  run_deck(options, fake.engine());
  EXPECT_DOUBLE_EQ(fake.problems.at(0).steps[0]->loads[0]->values[0]->history.value(0.5e-6), 5.0);
}

// What bolts clamp slides freely where friction is left out, and nothing shows it in a green report.
TEST(Build, doubts_a_contact_without_friction_where_bolts_are_tightened) {
  const auto doubts = [](const std::string& friction, const std::string& load) {
    FakeEngine fake;
    take_warnings();
    run_text(std::string(two_blocks) + R"(
local third = substructure{ name = "third", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }, material = steel, place = { 0, 0, 20*mm } }
local touch = interface.contact{ name = "touch", between = { high:face "zmax", third:face "zmin" })" +
                 friction + R"( }
local s = step.static{ name = "s", loads = { )" +
                 load + R"( } }
problem{ name = "p", substructures = { low, high, third }, interfaces = { glue, touch }, supports = { base }, steps = { s } }:run{})",
             fake);
    int n = 0;
    for (const std::string& warning : take_warnings())
      n += warning.find("interface.contact 'touch' has no 'friction' and slides freely") != std::string::npos;
    return n;
  };
  const std::string bolt = "load.shortening{ on = glue, by = 1*um }",
                    push = "load.pressure{ on = third:face 'zmax', history = 1*MPa }";
  EXPECT_EQ(doubts("", bolt), 1);
  EXPECT_EQ(doubts(", friction = 0", bolt), 0);
  EXPECT_EQ(doubts(", friction = 0.2", bolt), 0);
  EXPECT_EQ(doubts("", push), 0);
}

TEST(Build, makes_the_other_loads) {
  const LoadPtr shake = load_built("load.base_acceleration{ on = base, direction = { 0, 0, 2 }, history = 100*g0 }");
  const std::vector<Effect> shaken = shake->effects();
  EXPECT_EQ(std::get<BaseMotion>(shaken.at(0)).direction, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(std::get<BaseMotion>(shaken.at(0)).acceleration.value(0.0), 980.665);
  EXPECT_EQ(std::get<SupportPtr>(shake->on.at(0))->name, "base");
  const LoadPtr tighten =
      load_built("load.shortening{ on = glue, by = 40*um }", "step.static{ name = 's', increments = 2");
  EXPECT_EQ(tighten->path, "load.shortening");
  EXPECT_TRUE(tighten->values[0]->is_number);
  EXPECT_DOUBLE_EQ(tighten->values[0]->history.value(0.0), 40e-6);
  const LoadPtr release = load_built("load.release{ on = { glue }, at = 2*us }");
  EXPECT_DOUBLE_EQ(std::get<Release>(release->effects().at(0)).at, 2e-6);
  const LoadPtr gravity = load_built("load.gravity{ z = -g0 }", "step.static{ name = 's'");
  EXPECT_TRUE(gravity->on.empty());
  EXPECT_DOUBLE_EQ(gravity->values[2]->history.value(0.0), -9.80665);
}

TEST(Build, makes_steps_with_supports_of_their_own) {
  const Problem problem = built("local s = step.dynamic{ name = 's', duration = 1*us, dt = 1*us, supports = {} }");
  ASSERT_TRUE(problem.steps.at(0)->supports.has_value());
  EXPECT_TRUE(problem.steps.at(0)->supports->empty());
  EXPECT_FALSE(built("local s = hold").steps.at(0)->supports.has_value());
}

TEST(Build, fills_in_the_solver) {
  const LatinSettings standard = built("local s = hold").solver,
                      empty = built("local s = hold", "solver = solver.latin{}").solver;
  EXPECT_EQ(empty.tolerance, standard.tolerance);
  EXPECT_EQ(empty.static_tolerance, standard.static_tolerance);
  EXPECT_EQ(empty.window, standard.window);
  EXPECT_EQ(empty.relaxation, standard.relaxation);
  EXPECT_EQ(empty.anderson, standard.anderson);
  EXPECT_EQ(empty.max_iterations, standard.max_iterations);
  EXPECT_EQ(empty.numerical_damping, standard.numerical_damping);
  EXPECT_EQ(empty.push_out, standard.push_out);
  EXPECT_EQ(empty.search_direction, standard.search_direction);
  EXPECT_EQ(empty.plain, standard.plain);
  const LatinSettings asked =
      built("local s = hold", "solver = solver.latin{ window = 'whole', relaxation = 0.8, anderson = 0, plain = true }")
          .solver;
  EXPECT_EQ(asked.window, 0);
  EXPECT_EQ(asked.relaxation, 0.8);
  EXPECT_EQ(asked.anderson, 0);
  EXPECT_TRUE(asked.plain);
}

TEST(Build, makes_outputs) {
  const Problem problem = built(R"(
local s = step.dynamic{ name = "s", duration = 4*us, dt = 1*us }
local a = output.history{ name = "a", on = high:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local r = output.srs{ name = "r", of = a, q_factor = 25, from = 1*kHz, to = 50*kHz, per_octave = 24 }
local f = output.resultant{ name = "f", on = { glue, base } })",
                                "outputs = { a, r, f, output.vtk{ frames = 7 }, output.energy{} }");
  const auto told = [&](size_t i, const std::string& name) {
    for (const Note& note : problem.outputs.at(i)->record({}, {}))
      if (note.name == name) return note.value;
    throw std::runtime_error("no " + name);
  };
  EXPECT_EQ(std::get<std::string>(told(1, "of")), "a");
  EXPECT_EQ(std::get<double>(told(1, "q_factor")), 25.0);
  EXPECT_EQ(std::get<std::vector<std::string>>(told(2, "on")), (std::vector<std::string>{"glue", "base"}));
  EXPECT_EQ(std::get<int>(told(3, "frames")), 7);
  const std::vector<std::string> fields = {"displacement", "velocity", "stress", "von_mises", "stress_error"};
  EXPECT_EQ(std::get<std::vector<std::string>>(told(3, "fields")), fields);
  EXPECT_EQ(problem.outputs[4]->word, "energy");
  // From 1 kHz by 24 an octave, and 50 kHz.
  RunResult run;
  run.tables[problem.outputs[0].get()] = {{"time", "a"}, {"s", "m/s^2"}, {{0, 1e-6, 2e-6}, {0, 1, 0}}, {0, 0, 0}};
  Table spectrum;
  Findings findings;
  problem.outputs[1]->conclude({problem, run, {}}, spectrum, findings);
  ASSERT_EQ(spectrum.n_rows(), 2 + static_cast<int>(24 * std::log2(50.0)));
  EXPECT_EQ(spectrum.columns[0].front(), 1e3);
  EXPECT_EQ(spectrum.columns[0].back(), 5e4);
}

TEST(Build, doubts_a_part_of_implausible_size) {
  take_warnings();
  FakeEngine fake;
  run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bolt = substructure{ name = "bolt", material = steel, mesh = mesh.box{ size = { 80, 1, 1 }, cells = { 1, 1, 1 } } }
)",
           fake);
  const std::vector<std::string> warnings = take_warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings[0].find("deck.lua:3: substructure 'bolt' measures 80 m"), 0u) << warnings[0];
}

TEST(Objects, answer_their_arguments) {
  EXPECT_EQ(message_of(std::string(two_blocks) + R"(
assert(steel.young == 210*GPa and near(math.sqrt(steel.young / steel.density), 5188.745))
assert(ring.dt == 1*us and ring.after == hold and low.material == steel)
local place = high.place
place[3] = 7
assert(high.place[3] == 10*mm)
assert(tostring(steel) == "material 'steel'")
)"),
            "");
}

}  // namespace

}  // namespace dygita::test::build_tests

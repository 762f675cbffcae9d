// A deck run ever finer, against an engine whose figures are known functions of its parameters.
#include <gtest/gtest.h>

#include <cmath>

#include "deck/converge.hpp"
#include "deck/fake_engine.hpp"

namespace dygita::test::converge_tests {
namespace {

// bolt.normal = 5 + 0.1 size^2 + 0.02 / n N, in 1 / size^3 s unless `seconds` says otherwise; `spoil` may add to it.
struct PowerLaws {
  std::vector<std::map<std::string, double>> asked;
  std::function<double(std::map<std::string, double>)> spoil = [](const auto&) { return 0.0; };
  std::function<double(std::map<std::string, double>)> seconds = [](auto at) { return std::pow(at["size"], -3); };
  std::function<bool(std::map<std::string, double>)> tuned = nullptr;  // is the mass of the lower block?
  bool converged = true;

  Engine engine() {
    return {[this](const Problem& problem, const RunRequest& request) {
              std::map<std::string, double> at(request.identity.parameters.begin(), request.identity.parameters.end());
              asked.push_back(at);
              auto result = std::make_shared<RunResult>();
              Table table;
              table.names = {"time", "normal"};
              table.units = {"s", "N"};
              table.columns = {{0.0, 1.0}, {0.0, 5.0 + 0.1 * std::pow(at["size"], 2) + 0.02 / at["n"] + spoil(at)}};
              for (const OutputPtr& output : problem.outputs) result->tables[output.get()] = table;
              if (tuned && tuned(at)) result->steps.emplace_back().tuned_parts = {"low"};
              result->seconds["all"] = seconds(at);
              result->converged = converged;
              return result;
            },
            check_report};
  }
};

const std::string refined_deck = std::string("local p = param{ size = 4, n = 3 }\nlocal used = p.size + p.n\n") +
                                 two_blocks +
                                 "problem{ name = 'pair', substructures = { low, high }, interfaces = { glue }, "
                                 "supports = { base }, steps = { hold, ring }, outputs = { joint } }:run{}\n";

class Converging : public ::testing::Test {
 protected:
  Folder folder;
  PowerLaws laws;
  ConvergeOptions options;
  std::string deck = refined_deck;

  ConvergeOutcome run(const std::vector<std::string>& vary, const std::vector<std::string>& outputs) {
    options.deck.path = folder.write("deck.lua", deck);
    options.deck.out = folder.path() / "out";
    options.variations.clear();
    for (const std::string& text : vary) options.variations.push_back(parse_variation(text));
    options.outputs = outputs;
    ::testing::internal::CaptureStdout();
    try {
      const ConvergeOutcome outcome = converge(options, laws.engine());
      said = ::testing::internal::GetCapturedStdout();
      return outcome;
    } catch (...) {
      said = ::testing::internal::GetCapturedStdout();
      throw;
    }
  }
  std::string refusal(const std::vector<std::string>& vary, const std::vector<std::string>& outputs) {
    try {
      run(vary, outputs);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  bool says(const std::string& text) const { return said.find(text) != std::string::npos; }

  std::string said;
};

TEST_F(Converging, refines_each_parameter_twice_from_the_decks_values) {
  EXPECT_TRUE(run({"size", "n*2"}, {"bolt.normal.max"}).is_met);
  ASSERT_EQ(laws.asked.size(), 5u);
  EXPECT_EQ(laws.asked[0], (std::map<std::string, double>{{"size", 4.0}, {"n", 3.0}}));
  EXPECT_EQ(laws.asked[1], (std::map<std::string, double>{{"size", 2.0}, {"n", 3.0}}));
  EXPECT_EQ(laws.asked[2], (std::map<std::string, double>{{"size", 4.0}, {"n", 6.0}}));
  EXPECT_EQ(laws.asked[4], (std::map<std::string, double>{{"size", 4.0}, {"n", 12.0}}));
  EXPECT_TRUE(says("bolt.normal.max: in the limit 5")) << said;
  EXPECT_TRUE(says("size = 4, 2, 1: 6.6067, 5.4067, 5.1067 N; order 2.00; the last within 2.5 %: asymptotic")) << said;
  EXPECT_TRUE(says("n = 3, 6, 12: 6.6067, 6.6033, 6.6017 N; order 1.00")) << said;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/deck_converge/converge.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/deck_converge/converge.svg"));
}

TEST_F(Converging, goes_on_with_what_matters_until_the_aim_is_met_and_runs_the_cheapest_setting) {
  options.aim = 0.01;
  EXPECT_TRUE(run({"size", "n*2"}, {"bolt.normal.max"}).is_met);
  // 1.25 x 0.1 size^2 / 5 < 1 % takes size = 0.5; n = 3 is good enough: 1.25 x 0.02 / 3 / 5 = 0.17 %.
  EXPECT_EQ(laws.asked.size(), 6u);
  EXPECT_EQ(laws.asked.back().at("size"), 0.5);
  EXPECT_TRUE(says("cheapest setting within 1 %: size = 0.5, n = 3, about 8 s")) << said;
  EXPECT_TRUE(says("bolt.normal.max: 0.63 % from the limit, 0.79 % predicted at most") ||
              says("bolt.normal.max: 0.63 % from the limit, 0.79 predicted at most"))
      << said;
  EXPECT_TRUE(says("--set size=0.5 --set n=3")) << said;
}

TEST_F(Converging, begins_no_run_beyond_its_budget) {
  options.aim = 0.001;
  options.budget = 3.0;
  const ConvergeOutcome outcome = run({"size"}, {"bolt.normal.max"});
  EXPECT_FALSE(outcome.is_whole);
  EXPECT_FALSE(outcome.is_met);
  EXPECT_EQ(laws.asked.size(), 3u);  // 1/64 + 1/8 + 1 s; the next would take 8
  EXPECT_TRUE(says("size = 0.5 would take about 8 s, beyond the budget: 1.14 of 3 s are spent")) << said;
}

// Three times as many increments cost three times as much, not the 81 times of cells a third as large in each
// direction.
TEST_F(Converging, knows_from_increments_and_nodes_what_a_first_refinement_costs) {
  deck.replace(deck.find("steps = { hold, ring }"), 22,
               "steps = { hold, ring, step.dynamic{ name = 'long', after = ring, duration = 30*ms, dt = 30*us/p.n } }");
  laws.seconds = [](auto at) { return 1.5 * at["n"]; };
  options.budget = 100.0;  // 4.5 + 13.5 + 40.5 s
  EXPECT_TRUE(run({"n*3"}, {"bolt.normal.max"}).is_whole);
  ASSERT_EQ(laws.asked.size(), 3u);
  EXPECT_TRUE(says("== n = 9\n  about 13.4 s") || says("== n = 9\n  about 13.5 s")) << said;
}

TEST_F(Converging, names_what_has_no_limit) {
  laws.spoil = [](std::map<std::string, double> at) { return 10.0 / at["size"]; };
  options.aim = 0.01;
  EXPECT_FALSE(run({"size"}, {"bolt.normal.max"}).is_met);
  EXPECT_TRUE(says("no limit in these runs")) << said;
}

TEST_F(Converging, says_where_masses_make_it_no_one_sequence) {
  laws.tuned = [](std::map<std::string, double> at) { return at["size"] > 1.5; };
  EXPECT_FALSE(run({"size"}, {"bolt.normal.max"}).is_met);
  EXPECT_TRUE(says("these runs do not form one sequence: the mass of 'low' was tuned in some and lumped in others"))
      << said;
  laws.tuned = [](std::map<std::string, double>) { return true; };
  EXPECT_TRUE(run({"size"}, {"bolt.normal.max"}).is_met);
  EXPECT_FALSE(says("not form one sequence")) << said;
}

TEST_F(Converging, leaves_out_runs_that_did_not_converge) {
  laws.converged = false;
  const ConvergeOutcome outcome = run({"size"}, {"bolt.normal.max"});
  EXPECT_FALSE(outcome.is_whole);
  EXPECT_FALSE(says("in the limit"));
}

TEST_F(Converging, refuses_what_the_deck_does_not_have_before_anything_runs) {
  EXPECT_EQ(refusal({"sise"}, {"bolt.normal.max"}),
            "--vary sise: the deck has no parameter 'sise'\n    did you mean 'size'? known: n, size");
  EXPECT_EQ(refusal({"size"}, {"bolt.norml.max"}).substr(0, 76),
            "--output bolt.norml.max: output.joint 'bolt' has no column 'norml'\n    did y");
  EXPECT_EQ(refusal({"size"}, {"bold.normal"}),
            "--output bold.normal: problem 'pair' has no output 'bold'\n    did you mean 'bolt'? known: bolt");
  EXPECT_EQ(refusal({"size"}, {"bolt.normal.most"}),
            "--output bolt.normal.most: 'most' is no figure of a column\n    known: last, max, mean, min");
  EXPECT_EQ(refusal({"size"}, {"bolt"}),
            "--output bolt: output.joint 'bolt' is no spectrum: name a column of it too, as bolt.normal.max");
  EXPECT_TRUE(laws.asked.empty());
}

TEST(ConvergeOptions, are_read_as_people_write_them) {
  EXPECT_DOUBLE_EQ(parse_variation("size").ratio, 2.0);
  EXPECT_DOUBLE_EQ(parse_variation("size/1.5").ratio, 1.5);
  EXPECT_TRUE(parse_variation("n*3").is_count);
  for (const char* wrong : {"", "/2", "size/", "size/0.5", "size/1", "size*x", "n*20"})
    EXPECT_THROW(parse_variation(wrong), InputError) << wrong;
  EXPECT_DOUBLE_EQ(parse_share("--to", "1%"), 0.01);
  EXPECT_DOUBLE_EQ(parse_share("--to", "0.05"), 0.05);
  for (const char* wrong : {"1", "100%", "-1%", "x", "1 dB", "0"})
    EXPECT_THROW(parse_share("--to", wrong), InputError) << wrong;
  EXPECT_DOUBLE_EQ(parse_duration("--budget", "10min"), 600.0);
  EXPECT_DOUBLE_EQ(parse_duration("--budget", "90"), 90.0);
  for (const char* wrong : {"min", "3 weeks", "-1s", "0", "nan"})
    EXPECT_THROW(parse_duration("--budget", wrong), InputError) << wrong;
}

}  // namespace
}  // namespace dygita::test::converge_tests

// dygita continue: continuing from the kept fields gives what had been asked for at first, and whatever fails leaves
// the old results.
#include <gtest/gtest.h>

#include <iterator>

#include "deck/continue_run.hpp"
#include "decks/engine.hpp"
#include "files/csv.hpp"
#include "files/run_record.hpp"

namespace dygita::test::continue_tests {
namespace {

namespace fs = std::filesystem;

// The bolted flanges on coarse cells: prestress, friction, a bolt that yields; with cases = 1 another case is computed
// first.
std::string bolted_flanges() {
  std::ifstream file(deck("bench/even_flanges.lua"));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& what, const std::string& by) {
    const size_t at = text.find(what);
    if (at == std::string::npos) throw std::runtime_error("the deck has no '" + what + "'");
    text.replace(at, what.size(), by);
  };
  replace("param{ mu", "param{ cases = 0, mu");
  replace("../../meshes/", std::string(DYGITA_SOURCE_DIR) + "/meshes/");
  replace("local result = bolted(p.mu):run{}",
          "local first = p.cases == 1 and bolted(0.1):run{ case = 'first' } or nil\n"
          "if first then print(first[bolt].normal.last) end\n"
          "local result = bolted(p.mu):run{ start_from = first }");
  return text;
}

using Columns = std::map<std::string, std::vector<double>>;

// A folder for decks and results of one test.
class Continue : public testing::Test {
 protected:
  Continue() {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("dygita_continue_" + test + "_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    set_progress_enabled(false);
    put("flanges.lua", bolted_flanges());
  }
  ~Continue() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  static std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // Runs the deck into folder_/<out>; answers the run's folder.
  fs::path run(const std::string& out, const std::string& solver, const Settings& settings = {},
               bool write_state = true) const {
    DeckOptions options;
    options.path = folder_ / "flanges.lua";
    options.settings = {{"size", "6*mm"}};
    if (settings.empty() || settings.front().first != "duration") options.settings.emplace_back("duration", "60*us");
    options.settings.insert(options.settings.end(), settings.begin(), settings.end());
    options.solver = solver;
    options.out = folder_ / out;
    options.threads = 1;
    options.write_state = write_state;
    run_deck(options, {run_problem, check_report});
    return folder_ / out / "bolted_flanges" / "base";
  }
  static ContinueOptions options_for(const fs::path& run) {
    ContinueOptions options;
    options.run = run;
    options.threads = 1;
    return options;
  }
  static std::string refusal(const ContinueOptions& options) {
    try {
      continue_run(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static Columns columns(const fs::path& run) {
    Columns columns;
    for (const char* file : {"above", "below", "bolt", "joint", "energy"}) {
      const Table table = read_csv(run / (std::string(file) + ".csv"), {"tighten", "shock"});
      for (size_t i = 0; i < table.names.size(); ++i)
        columns[std::string(file) + "." + table.names[i]] = table.columns[i];
    }
    return columns;
  }
  // Largest difference of what matters, each over its own largest value.
  static double largest_difference(const fs::path& a, const fs::path& b) {
    const Columns of_a = columns(a), of_b = columns(b);
    double worst = 0.0;
    for (const char* name : {"above.acceleration", "below.acceleration", "bolt.normal", "bolt.plastic_opening",
                             "joint.normal", "joint.slip", "energy.kinetic", "energy.friction"})
      worst = std::max(worst, difference(of_b.at(name), of_a.at(name)));
    return worst;
  }
  static long iterations(const fs::path& run) { return read_run_record(run)->iterations; }

  fs::path folder_;
};

TEST_F(Continue, to_a_tighter_tolerance_gives_what_that_tolerance_gives_and_takes_fewer_iterations) {
  for (const char* more : {"", ", pieces = 2", ", precision = \"single\"", ", window = 5", ", mass = \"tuned\""}) {
    const std::string loose = std::string("latin{ integration = 'implicit', tolerance = 1e-3") + more + " }",
                      tight =
                          std::string("latin{ integration = 'implicit', tolerance = 1e-7, static_tolerance = 1e-9") +
                          more + " }";
    const fs::path run_at_once = run("at_once", tight), going_on = run("going_on", loose);
    const long before = iterations(going_on), fresh = iterations(run_at_once);
    const double difference_before = largest_difference(run_at_once, going_on);
    ContinueOptions options = options_for(going_on);
    options.tolerance = 1e-7;
    EXPECT_TRUE(continue_run(options).not_converged.empty());
    const double after = largest_difference(run_at_once, going_on);
    std::cout << "latin{" << more << " }: first run " << before << " iterations, continued with "
              << iterations(going_on) << ", a fresh run at 1e-7 takes " << fresh << "; difference from it "
              << difference_before << " before, " << after << " after\n";
    // What an iteration leaves goes with its tolerance, here by 1e-4; both runs leave it. Windows leave less at 1e-3
    // than single steps do, and as much at 1e-7.
    EXPECT_LT(after, std::max(2e-4 * difference_before, 2e-6)) << more;
    // A window of several steps begins anew what its steps tell each other.
    EXPECT_LT(static_cast<double>(iterations(going_on)),
              (std::string(more).find("window") == std::string::npos ? 0.9 : 1.1) * static_cast<double>(fresh))
        << more;
  }
}

TEST_F(Continue, with_more_iterations_comes_as_near_as_they_lead_and_ends_at_round_off) {
  const fs::path exact = run(
      "exact", "latin{ integration = 'implicit', tolerance = 1e-11, static_tolerance = 1e-12, max_iterations = 2000 }");
  const fs::path few = run("few", "latin{ integration = 'implicit', tolerance = 1e-2 }");
  const double before = largest_difference(exact, few);
  ContinueOptions options = options_for(few);
  options.more_iterations = 3;
  EXPECT_TRUE(continue_run(options).not_converged.empty());
  const double after_three = largest_difference(exact, few);
  EXPECT_LT(after_three, 0.2 * before);
  EXPECT_LE(iterations(few), 4 * 62);  // 2 + 60 increments
  options.more_iterations = 300;
  continue_run(options);
  std::cout << "difference " << before << ", " << after_three << " after 3 iterations more, "
            << largest_difference(exact, few) << " at round-off\n";
  EXPECT_LT(largest_difference(exact, few), 1e-7);
  EXPECT_LT(iterations(few), 100 * 62);
}

TEST_F(Continue, until_later_gives_what_the_longer_run_gives_and_repeats_with_one_iteration_each) {
  const fs::path tight = run(
      "tight", "latin{ integration = 'implicit', tolerance = 1e-9, static_tolerance = 1e-11, max_iterations = 1000 }",
      {{"duration", "100*us"}});
  for (const char* solver : {"latin{ integration = 'implicit' }", "latin{ integration = 'implicit', pieces = 2 }",
                             "latin{ integration = 'implicit', window = 5 }"}) {
    const fs::path longer = run("longer", solver, {{"duration", "100*us"}}), going_on = run("going_on", solver);
    const long fresh = iterations(longer), before = iterations(going_on);
    ContinueOptions options = options_for(going_on);
    options.until = 100e-6;
    EXPECT_TRUE(continue_run(options).not_converged.empty());
    std::cout << solver << ": " << before << " iterations to 60 us, " << iterations(going_on) << " to go on to 100 us, "
              << fresh << " of a run to 100 us\n";
    EXPECT_LT(largest_difference(longer, going_on), 1e-4);
    EXPECT_LT(iterations(going_on), fresh - before + 2 * 62);
    // And on once more, now tighter: the state knows of the time that was added.
    options.until.reset();
    options.tolerance = 1e-9;
    continue_run(options);
    EXPECT_EQ(columns(going_on).at("above.time").size(), columns(longer).at("above.time").size());
    EXPECT_LT(largest_difference(tight, going_on), 2e-4);
  }
}

TEST_F(Continue, finishes_what_was_interrupted) {
  const fs::path whole = run("whole", "latin{ integration = 'implicit' }"),
                 part = run("part", "latin{ integration = 'implicit' }");
  // As a run leaves it that was stopped in its tenth increment.
  RunState state = read_state(part / state_file_name);
  auto fields = std::make_shared<InterfaceFields>(1e9);
  Vec q;
  for (const size_t step : {0, 1}) {
    fields->begin_step();
    for (size_t i = 0; i < (step == 0 ? 2u : 10u); ++i) {
      ASSERT_TRUE(state.fields->read(step, i, state.fields->size(step, i), q));
      fields->append(q);
    }
  }
  state.fields = fields;
  state.interrupted = true;
  write_state(part / state_file_name, state);
  fs::remove(part / "above.csv");
  EXPECT_TRUE(continue_run(options_for(part)).not_converged.empty());
  EXPECT_LT(largest_difference(whole, part), 1e-5);  // what 1e-6 leaves in either
  EXPECT_NE(refusal(options_for(part)).find("the run is complete and has converged"), std::string::npos);
}

TEST_F(Continue, streams_fields_beyond_the_memory_for_them) {
  const fs::path in_memory = run("in_memory", "latin{ integration = 'implicit' }"),
                 in_file = run("in_file", "latin{ integration = 'implicit', history_memory = 0 }");
  EXPECT_EQ(fs::file_size(in_memory / state_file_name),
            fs::file_size(in_file / state_file_name) - std::string(" history_memory = 0 ").size());
  ContinueOptions options = options_for(in_file);
  options.tolerance = 1e-8;
  continue_run(options);
  EXPECT_LT(largest_difference(
                run("tight", "latin{ integration = 'implicit', tolerance = 1e-8, static_tolerance = 1e-10 }"), in_file),
            1e-6);
}

TEST_F(Continue, goes_on_with_the_text_that_the_run_kept) {
  const fs::path kept = run("kept", "latin{ integration = 'implicit', tolerance = 1e-4 }");
  put("flanges.lua", "error 'another deck'");
  put("notes.txt", "");
  ContinueOptions options = options_for(kept);
  options.tolerance = 1e-6;
  testing::internal::CaptureStderr();
  continue_run(options);
  EXPECT_NE(testing::internal::GetCapturedStderr().find(
                "has changed since the run or is missing: the run continues with its stored text"),
            std::string::npos);
  put("flanges.lua", bolted_flanges());
  EXPECT_LT(largest_difference(run("again", "latin{ integration = 'implicit', tolerance = 1e-6 }"), kept), 1e-4);
}

TEST_F(Continue, reads_other_cases_of_the_deck_from_their_folders) {
  const fs::path base = run("cases", "latin{ integration = 'implicit', tolerance = 1e-4 }", {{"cases", "1"}});
  ContinueOptions options = options_for(base);
  options.tolerance = 1e-6;
  testing::internal::CaptureStdout();
  continue_run(options);
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("case 'first': read from"), std::string::npos) << said;
  EXPECT_NE(said.find("bolt force"), std::string::npos) << said;
  // The other way round: what comes after the case continued may be missing.
  options.run = base.parent_path() / "first";
  fs::remove_all(base);
  testing::internal::CaptureStdout();
  EXPECT_FALSE(continue_run(options).interrupted);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("execution ends here"), std::string::npos);
}

TEST_F(Continue, says_what_is_wrong_and_leaves_the_old_results) {
  ContinueOptions options = options_for(folder_ / "out" / "nothing");
  options.tolerance = 1e-8;
  EXPECT_NE(refusal(options).find("no folder '"), std::string::npos) << refusal(options);
  options.run = folder_;
  EXPECT_NE(refusal(options).find("is not the folder of a run"), std::string::npos) << refusal(options);
  options.run = run("none", "latin{ integration = 'implicit' }", {}, false);
  EXPECT_FALSE(fs::exists(options.run / state_file_name));
  EXPECT_NE(refusal(options).find("the run used --no-state"), std::string::npos) << refusal(options);
  options.run = run("other", "monolithic{}");
  EXPECT_NE(refusal(options).find("was computed by solver.monolithic, which stores nothing to continue from"),
            std::string::npos)
      << refusal(options);

  options.run = run("good", "latin{ integration = 'implicit', precision = \"single\" }", {});
  const std::string tip = text_of(options.run / "above.csv"), record = text_of(options.run / "run.json");
  EXPECT_NE(record.find(state_file_name), std::string::npos);
  options.tolerance = 1e-8;
  EXPECT_NE(refusal(options).find("'precision' = \"single\" of the deck allows no tolerance below 1e-7"),
            std::string::npos)
      << refusal(options);
  options.tolerance.reset();
  options.until = 5e-6;
  EXPECT_NE(refusal(options).find("--until 5e-06: the run reaches 6e-05 s already"), std::string::npos)
      << refusal(options);
  options.until.reset();
  options.tolerance = 1e-2;  // looser than reached
  testing::internal::CaptureStdout();
  EXPECT_EQ(continue_run(options).n_runs, 0);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("nothing to do"), std::string::npos);

  RunState state = read_state(options.run / state_file_name);
  const RunState good = state;
  options.tolerance = 1e-7;
  state.mesh_digests.at(1).second = "another";
  write_state(options.run / state_file_name, state);
  EXPECT_NE(refusal(options).find("the mesh of substructure 'upper' ("), std::string::npos) << refusal(options);
  state = good;
  for (double& value : state.loads) value *= 1.1;
  write_state(options.run / state_file_name, state);
  EXPECT_NE(refusal(options).find("have changed since the run"), std::string::npos) << refusal(options);
  std::string damaged = text_of(options.run / state_file_name);
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(options.run / state_file_name, std::ios::binary) << damaged;
  EXPECT_NE(refusal(options).find("its checksum does not match"), std::string::npos) << refusal(options);
  EXPECT_EQ(text_of(options.run / "above.csv"), tip);
  EXPECT_EQ(text_of(options.run / "run.json"), record);
  for (const auto& entry : fs::directory_iterator(options.run.parent_path())) EXPECT_EQ(entry.path(), options.run);
}

}  // namespace
}  // namespace dygita::test::continue_tests

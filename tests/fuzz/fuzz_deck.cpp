// Decks, changed as their grammar allows: read, built and checked as `dygita check` does. Compiled with
// DYGITA_FUZZ_RUNS, scenes that are tiny are also run to their end.
#include <algorithm>
#include <cmath>

#include "checks/check_problem.hpp"
#include "deck/deck.hpp"
#include "fuzz/deck_mutator.hpp"
#include "fuzz/target.hpp"
#include "result/hollow_result.hpp"

namespace dygita::fuzz {

namespace {

constexpr size_t longest_deck = 20000;

#ifdef DYGITA_FUZZ_RUNS

// Of all that a run of it computes.
double size_of(const Problem& problem) {
  double nodes = 0.0, increments = 0.0;
  for (const SubstructurePtr& part : problem.substructures) nodes += part->mesh->n_nodes();
  for (const StepPtr& step : problem.steps) increments += step->is_static ? step->increments : step->n_increments();
  return nodes * nodes * (1.0 + 0.1 * increments);
}

void demand_finite(const RunResult& result) {
  for (const auto& [output, table] : result.tables)
    for (size_t i = 0; i < table.columns.size(); ++i)
      for (const double x : table.columns[i])
        demand(std::isfinite(x) || output->word != "history", "a history that is computed is finite");
}

std::shared_ptr<const RunResult> run_small(const Problem& problem, const RunRequest& request) {
  check_problem(problem);
  if (!(size_of(problem) < 2e6)) {
    check_report(problem);
    return hollow_result(problem);
  }
  auto result = run_problem(problem, request);
  if (!result->interrupted) demand_finite(*result);
  return result;
}

#endif

DeckOptions options_for(std::string text) {
  DeckOptions options;
  options.path = std::string(DYGITA_SOURCE_DIR) + "/tests/wrong_decks/fuzzed.lua";
  options.text = std::move(text);
  options.threads = 1;
  options.time_limit = 5.0;
  options.memory_limit = 100.0;
  options.meshes.time = 10.0;
  options.meshes.box_memory = 2e6;  // 20,000 cells
  options.write_files = options.write_frames = options.write_state = false;
  return options;
}

void read_deck(const std::string& text) {
  const DeckOptions options = options_for(text);
#ifdef DYGITA_FUZZ_RUNS
  attempt([&] { run_deck(options, {run_small, check_report}); });
#else
  attempt([&] { check_deck(options, {run_problem, check_report}); });
#endif
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  if (size <= longest_deck) read_deck(text_of(data, size));
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace dygita::fuzz;
  Random random(seed);
  if (chance(0.03, random)) return LLVMFuzzerMutate(data, size, most);
  const std::string deck = changed_deck(text_of(data, size), random);
  const size_t n = std::min({deck.size(), most, longest_deck});
  std::copy_n(deck.begin(), n, reinterpret_cast<char*>(data));
  return n;
}

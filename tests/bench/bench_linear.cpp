// The linear run of a deck's last dynamic step (linear.hpp), timed. CSV on standard output.
//
// Run: ./run.sh bench headline, or build/release/tests/bench_linear DECK [NAME=VALUE ...] [--threads 1,2] [--steps 200]
//
// For each number of threads: OpenBLAS with one and, where there are more, with all of them, on a few steps; then the
// whole step with the faster one and a product with K per step, and 50 steps by the recurrence.
#include <cstdio>
#include <cstring>
#include <sstream>

#include "base/threads.hpp"
#include "bench/linear.hpp"
#include "decks/engine.hpp"

namespace {

using namespace dygita;
using namespace dygita::bench;

constexpr int n_trial_steps = 12, n_recurrence_steps = 50;

struct Asked {
  std::string deck;
  test::Settings settings;
  std::vector<int> threads{1, 2};
  int n_steps = 0;
};

std::vector<int> numbers(const std::string& text) {
  std::vector<int> list;
  std::stringstream stream(text);
  for (std::string one; std::getline(stream, one, ',');) list.push_back(std::stoi(one));
  return list;
}

Asked parse(int argc, char** argv) {
  Asked asked;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--threads" && i + 1 < argc)
      asked.threads = numbers(argv[++i]);
    else if (word == "--steps" && i + 1 < argc)
      asked.n_steps = std::stoi(argv[++i]);
    else if (const size_t equals = word.find('='); equals != std::string::npos)
      asked.settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    else
      asked.deck = word;
  }
  if (asked.deck.empty()) throw std::runtime_error("bench_linear DECK [NAME=VALUE ...] [--threads 1,2] [--steps n]");
  return asked;
}

// The problem that a deck declares, nothing computed.
Problem problem_of(const Asked& asked) {
  struct Enough {};
  set_progress_enabled(false);
  std::vector<Problem> problems;
  const Engine engine{[&](const Problem& problem, const RunRequest&) -> std::shared_ptr<const RunResult> {
                        problems.push_back(problem);
                        throw Enough{};
                      },
                      check_report};
  DeckOptions options;
  options.path = asked.deck;
  options.settings = asked.settings;
  options.write_files = false;
  try {
    run_deck(options, engine);
  } catch (...) {  // the deck's interpreter turns Enough into an error of its own
    if (problems.empty()) throw;
  }
  return problems.at(0);
}

void line(const LinearAnalysis& body, int threads, const char* form, int blas_threads, const LinearSeconds& s) {
  std::printf("%d,%d,%s,%d,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", body.n_dofs(), threads, form,
              blas_threads, s.n_steps, s.all, s.solve, s.right_hand_side, s.update, 1e3 * s.median_solve,
              body.factor_entries(), body.factor_bytes(), body.assembly_seconds(), body.analysis_seconds(),
              body.factor_seconds());
  std::fflush(stdout);
}

void run(const Asked& asked) {
  const Problem problem = problem_of(asked);
  LinearAnalysis body(problem);
  std::puts(
      "dofs,threads,form,blas_threads,steps,all [s],solve [s],right-hand side [s],update [s],median solve [ms],factor "
      "entries,"
      "factor [bytes],assembly [s],analysis [s],factor [s]");
  for (const int threads : asked.threads) {
    body.factorise(threads);
    LinearOptions options{RightHandSide::recurrence, threads, 1, n_trial_steps};
    const double one = body.run(options).median_solve;
    options.blas_threads = threads;
    if (threads == 1 || body.run(options).median_solve > one) options.blas_threads = 1;
    options.n_steps = asked.n_steps > 0 ? std::min(asked.n_steps, n_recurrence_steps) : n_recurrence_steps;
    line(body, threads, "recurrence", options.blas_threads, body.run(options));
    options.n_steps = asked.n_steps;
    options.right_hand_side = RightHandSide::stiffness_product;
    line(body, threads, "product", options.blas_threads, body.run(options));
  }
}

}  // namespace

int main(int argc, char** argv) {
  dygita::prepare_process(argv);
  try {
    run(parse(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}

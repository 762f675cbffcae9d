// The main job, timed by phase: decks/bolted_flanges.lua, no files written. Reports; judges nothing.
//
// Run: ./run.sh bench      (one thread and all threads in one run: compare as ratios, machines differ)
#include <benchmark/benchmark.h>
#include <omp.h>

#include "decks/engine.hpp"

namespace {

using namespace dygita::test;

// arg 0: element size, um; arg 1: threads.
void bolted_flanges(benchmark::State& state) {
  const std::string size = std::to_string(state.range(0)) + "*um";
  DeckRun run;
  for (auto _ : state) run = run_file(deck("bolted_flanges.lua"), {{"size", size}}, static_cast<int>(state.range(1))).at(0);
  const auto& seconds = run.result->seconds;
  const double steps = run.result->steps.back().increments;
  state.counters["dof"] = static_cast<double>(run.result->n_dofs);
  state.counters["interface"] = static_cast<double>(run.result->n_interface_unknowns);
  state.counters["iterations/step"] = static_cast<double>(run.result->steps.back().iterations) / steps;
  state.counters["factor_s"] = seconds.at("factor");
  state.counters["shock_s"] = run.result->steps.back().seconds;
  for (const char* phase : {"forward", "interface operator", "local stage", "acceleration", "backward", "output"})
    state.counters[std::string(phase) + "_ms/step"] = 1e3 * seconds.at(phase) / steps;
}

}  // namespace

BENCHMARK(bolted_flanges)
    ->ArgNames({"size_um", "threads"})
    ->Args({4000, 1})->Args({4000, 2})->Args({3000, 1})->Args({3000, 2})->Args({2000, 1})->Args({2000, 2})
    ->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);

int main(int argc, char** argv) {
  dygita::prepare_process(argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// What the runs' own error estimates are worth: estimated over true. CSV on standard output.
//
// Run: ./run.sh report, or build/release/tests/effectivity
//
// True errors: of the iteration against a tolerance of 1e-11 (dynamic steps only); of the time step against the same
// mesh with dt / 16; of the mesh against cells 8 times shorter and the same dt, on the fine mesh.
#include "decks/effectivity.hpp"

#include <cstdio>

namespace {

using namespace dygita::test;

void line(const char* scene, const char* knob, const std::string& value, double estimate, double truth) {
  std::printf("%s,%s,%s,%.4g,%.4g,%.3g\n", scene, knob, value.c_str(), estimate, truth, estimate / truth);
  std::fflush(stdout);
}

void study_tolerance(const char* scene, const std::filesystem::path& path, const Settings& settings = {}) {
  const EstimatedRun converged = run_estimated(path, settings, 1e-11);
  for (const char* tolerance : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6"}) {
    const EstimatedRun r = run_estimated(path, settings, std::stod(tolerance));
    line(scene, "tolerance", tolerance, r.figures.iteration_error.value(), true_error(r, converged));
  }
}

void study_bar(const char* scene, const char* text) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dygita_effectivity.lua";
  std::ofstream(path) << text;
  study_tolerance(scene, path);
  for (const int steps : {96, 192, 384, 768}) {
    const EstimatedRun r = run_estimated(path, {{"steps", std::to_string(steps)}});
    const EstimatedRun fine = run_estimated(path, {{"steps", std::to_string(16 * steps)}});
    line(scene, "steps", std::to_string(steps), r.figures.time_step_error.value(), true_error(r, fine));
  }
  for (const int n : {20, 40, 80, 160}) {
    const std::string steps = std::to_string(48 * n);
    const EstimatedRun r = run_estimated(path, {{"n", std::to_string(n)}, {"steps", steps}});
    const EstimatedRun fine = run_estimated(path, {{"n", std::to_string(8 * n)}, {"steps", steps}});
    line(scene, "cells", std::to_string(n), r.figures.mesh_error.value(), true_error(r, fine, n / 2, 4 * n));
  }
  // Mesh and time step together, as one refines them; the same fine run for both masses.
  for (const int n : {20, 40, 80, 160}) {
    const auto settings = [](int cells) {
      return Settings{{"n", std::to_string(cells)}, {"steps", std::to_string(24 * cells / 5)}};
    };
    const EstimatedRun fine = run_estimated(path, settings(8 * n), 0.0, true);
    for (const bool is_tuned : {false, true}) {
      const EstimatedRun r = run_estimated(path, settings(n), 0.0, is_tuned);
      const double estimate = std::hypot(r.figures.time_step_error.value(), r.figures.mesh_error.value());
      line(scene, is_tuned ? "cells and steps (tuned mass)" : "cells and steps", std::to_string(n), estimate,
           true_error(r, fine, n / 2, 4 * n));
    }
  }
  std::filesystem::remove(path);
}

}  // namespace

int main(int, char** argv) {
  dygita::prepare_process(argv);
  std::puts("scene,knob,value,estimated [%],true [%],effectivity");
  study_bar("pulse", pulse);
  study_bar("impact", impact);
  study_bar("yielding", yielding);
  study_tolerance("crush", deck("crush.lua"));
  study_tolerance("bolted flanges", deck("bench/even_flanges.lua"));
  return 0;
}

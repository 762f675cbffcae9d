// What the runs' own error estimates are worth: estimated over true. CSV on standard output.
//
// Run: ./run.sh report, or build/release/tests/effectivity; with `scenes` those of scenes.lua alone, with numbers after
// it some of them.
//
// True errors: of the iteration against a tolerance of 1e-11 (dynamic steps only); of the time step against the same
// mesh with dt / 16; of the mesh against cells 8 times shorter and the same dt, on the fine mesh. In scenes.lua against
// dt / 4 and against cells 3 times shorter, frequencies and amplitudes apart: the time of the finer run is stretched
// until its velocities are nearest; for the frequencies, until what both hold about the mean frequency is.
#include <cstdio>

#include "decks/apart.hpp"

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

SpectraRun run_scene(int scene, int n, int finer) {
  return run_spectra(std::filesystem::path(DYGITA_SOURCE_DIR) / "tests/bench/scenes.lua",
                     {{"scene", std::to_string(scene)}, {"n", std::to_string(n)}, {"finer", std::to_string(finer)}}, {},
                     0.0, 0.0);
}

// Means over the frequencies of all spectra.
void bands(const char* scene, const char* column, const SpectraRun& run, const SpectraRun& better, double of_all) {
  double band = 0.0, truth = 0.0;
  for (size_t i = 0; i < run.spectra.size(); ++i) {
    const BandWorth worth = band_worth(run.spectra[i], better.spectra.at(i), column);
    band += worth.band / static_cast<double>(run.spectra.size());
    truth += of_all * worth.truth / static_cast<double>(run.spectra.size());
  }
  line(scene, "spectrum (dB)", column, band, truth);
}

// The errors of a run that is `finer` times better are this much smaller: what the difference has to be multiplied by.
double of_all(double finer) { return 1.0 / (1.0 - 1.0 / (finer * finer)); }

// swings: the velocities seen are not those of a whole that flies or spins, beside which nothing shows of a frequency.
void study_motion(const char* name, int scene, bool swings) {
  const int finer_dt = 4, finer_mesh = 3;
  const SpectraRun run = run_scene(scene, 1, 1), in_time = run_scene(scene, 1, finer_dt),
                   in_space = run_scene(scene, finer_mesh, 1);
  const dygita::Figures& figures = run.result->figures;
  const double mean = figures.mean_frequency.value();
  const Apart time = apart(run, in_time, mean, true), space = apart(run, in_space, mean, false);
  if (swings) {
    line(name, "frequency", "time step", figures.step_frequency_error.value(), 100 * of_all(finer_dt) * time.frequency);
    line(name, "frequency", "mesh", figures.mesh_frequency_error.value(), 100 * of_all(finer_mesh) * space.frequency);
    line(name, "amplitude", "mesh", figures.mesh_amplitude_error.value(), 100 * of_all(finer_mesh) * space.amplitude);
  }
  bands(name, "time_step", run, in_time, of_all(finer_dt));
  bands(name, "mesh", run, in_space, of_all(finer_mesh));
}

// Of a load that is given the strain energy is off by the energy of the error.
void study_static(const char* name, int scene) {
  const auto strain = [](const SpectraRun& run) {
    for (const dygita::OutputPtr& output : run.problem.outputs)
      if (output->word == "energy") return run.result->tables.at(output.get()).column("strain").back();
    return 0.0;
  };
  const SpectraRun run = run_scene(scene, 1, 1);
  const double exact = strain(run_scene(scene, scene == 23 ? 3 : 6, 1)), own = strain(run);
  line(name, "static", "mesh", run.result->figures.static_mesh_error.value(),
       100 * std::sqrt(std::abs(exact - own) / own));
}

struct NamedScene {
  int number;
  const char* name;
  bool swings = true;
};

constexpr NamedScene motions[] = {{1, "impedance"},
                                  {2, "block on bar"},
                                  {3, "shaken cantilever"},
                                  {4, "pushed block"},
                                  {5, "bracket"},
                                  {6, "cap on posts"},
                                  {7, "joint that yields"},
                                  {8, "falling block"},
                                  {9, "tet10 cantilever"},
                                  {11, "hex20 cantilever"},
                                  {10, "twisted bar 2 cells"},
                                  {12, "twisted bar 1 cell"},
                                  {13, "ring-down"},
                                  {14, "two plates shaken"},
                                  {15, "board on standoffs"},
                                  {16, "stepped bar"},
                                  {17, "plate with a mass"},
                                  {18, "lapped plates"},
                                  {19, "bracket on feet"},
                                  {20, "damped frame"},
                                  {26, "block that flies", false},
                                  {27, "block that spins", false},
                                  {28, "block that slides"},
                                  {29, "bar off a wall"},
                                  {30, "block kicked off"},
                                  {31, "bars that spin"},
                                  {32, "nut that rattles"},
                                  {33, "free bar of two metals"},
                                  {34, "damped plate"},
                                  {35, "damped cantilever"}};
constexpr NamedScene statics[] = {{21, "static torsion 1 cell"},
                                  {22, "static torsion 2 cells"},
                                  {23, "static torsion 4 cells"},
                                  {24, "static bending 1 cell"},
                                  {25, "static bending 2 cells"}};

void study_scenes(const std::vector<int>& asked) {
  const auto is_asked = [&](int scene) {
    return asked.empty() || std::find(asked.begin(), asked.end(), scene) != asked.end();
  };
  for (const NamedScene& scene : statics)
    if (is_asked(scene.number)) study_static(scene.name, scene.number);
  for (const NamedScene& scene : motions)
    if (is_asked(scene.number)) study_motion(scene.name, scene.number, scene.swings);
}

}  // namespace

int main(int argc, char** argv) {
  dygita::prepare_process(argv);
  std::puts("scene,knob,value,estimated [%],true [%],effectivity");
  if (argc > 1 && std::string(argv[1]) == "scenes") {
    std::vector<int> asked;
    for (int i = 2; i < argc; ++i) asked.push_back(std::stoi(argv[i]));
    study_scenes(asked);
    return 0;
  }
  study_scenes({});
  study_bar("pulse", pulse);
  study_bar("impact", impact);
  study_bar("yielding", yielding);
  study_tolerance("crush", deck("crush.lua"));
  study_tolerance("bolted flanges", deck("bench/even_flanges.lua"));
  return 0;
}

// What the bands of uncertainty of shock response spectra are worth: band against true difference. CSV on standard
// output.
//
// Run: build/release/tests/spectrum_bands (some minutes)
//
// True differences: of the iteration against a tolerance of 1e-9; of the time step against dt / 8; of the mesh against
// finer cells and the same dt; and what passes that stop when spectra stand still cost beside one run. Of each
// spectrum: means over its frequencies (dB), share of them where the difference lies within the band, median of band
// over difference.
#include <cstdio>

#include "decks/spectra.hpp"

namespace {

using namespace dygita::test;

struct Scene {
  std::string name;
  std::filesystem::path path;
  std::vector<Place> places;
  double from, to;
};

void lines(const Scene& scene, const char* knob, const std::string& value, const char* column, const SpectraRun& run,
           const SpectraRun& better) {
  for (size_t i = 0; i < run.spectra.size(); ++i) {
    const BandWorth worth = band_worth(run.spectra[i], better.spectra.at(i), column);
    std::printf("%s,%s,%s,%s,%.3g,%.3g,%.0f,%.3g\n", scene.name.c_str(), run.spectra[i].name.c_str(), knob,
                value.c_str(), worth.band, worth.truth, 100.0 * worth.covered, worth.ratio);
  }
  std::fflush(stdout);
}

SpectraRun run(const Scene& scene, const Settings& settings, double tolerance = 0.0) {
  return run_spectra(scene.path, settings, scene.places, scene.from, scene.to, tolerance);
}

void study_tolerance(const Scene& scene) {
  const SpectraRun converged = run(scene, {}, 1e-9);
  for (const char* tolerance : {"1e-2", "1e-3", "1e-4"})
    lines(scene, "tolerance", tolerance, "iteration", run(scene, {}, std::stod(tolerance)), converged);
}

// knob: parameter of the deck; for each value the better one that it is held against.
void study(const Scene& scene, const char* knob, const char* column,
           const std::vector<std::pair<std::string, std::string>>& values, const Settings& more = {}) {
  for (const auto& [value, better] : values) {
    Settings coarse = more, fine = more;
    coarse.emplace_back(knob, value);
    fine.emplace_back(knob, better);
    lines(scene, knob, value, column, run(scene, coarse), run(scene, fine));
  }
}

double largest_of_moves(const SpectraRun& a, const SpectraRun& b) {
  double worst = 0.0;
  for (size_t i = 0; i < a.spectra.size(); ++i)
    worst = std::max(worst, dygita::largest_move(a.spectra[i].srs, b.spectra.at(i).srs));
  return worst;
}

// One run at each tolerance against passes that stop when the spectra move by less than 0.1 dB; output.column: what
// else is watched, at its largest.
void study_passes(const Scene& scene, const std::string& output, const std::string& column) {
  const SpectraRun converged = run(scene, {}, 1e-9);
  const auto print = [&](const std::string& what, const SpectraRun& r, long iterations, double seconds) {
    const double off = 100.0 * std::abs(r.largest(output, column) / converged.largest(output, column) - 1.0);
    std::printf("%s,%s,%ld,%.2f,%.2g,%.2g\n", scene.name.c_str(), what.c_str(), iterations, seconds,
                largest_of_moves(r, converged), off);
    std::fflush(stdout);
  };
  for (const char* tolerance : {"1e-3", "1e-4", "1e-5", "1e-6"}) {
    const SpectraRun r = run(scene, {}, std::stod(tolerance));
    print(std::string("one run at ") + tolerance, r, r.result->iterations, r.result->seconds.at("all"));
  }
  SpectraRun before;
  long iterations = 0;
  double seconds = 0.0;
  for (int n = 1; n <= 4; ++n) {
    SpectraRun r = run_spectra(scene.path, {}, scene.places, scene.from, scene.to, std::pow(10.0, -2 - n),
                               before.result ? before.result->interface_fields.get() : nullptr);
    iterations += r.result->iterations;
    seconds += r.result->seconds.at("all");
    const bool is_last = n > 1 && largest_of_moves(r, before) < 0.1;
    if (is_last || n == 4) return print(std::to_string(n) + " passes", r, iterations, seconds);
    before = std::move(r);
  }
}

// The bar's text with another duration, in times a wave takes along it: records end while the places at hand are at
// rest.
std::string lasting(std::string text, const std::string& before, const std::string& after) {
  for (size_t at = 0; (at = text.find(before, at)) != std::string::npos; at += after.size())
    text.replace(at, before.size(), after);
  return text;
}

void study_bar(const char* name, const std::string& text, double from, double to, const std::vector<Place>& places) {
  Scene scene{name, std::filesystem::temp_directory_path() / "dygita_spectrum_bands.lua", places, from, to};
  std::ofstream(scene.path) << text;
  study_tolerance(scene);
  study(scene, "steps", "time_step", {{"96", "768"}, {"192", "1536"}, {"384", "3072"}});
  study(scene, "n", "mesh", {{"20", "160"}, {"40", "320"}, {"80", "640"}}, {{"steps", "1920"}});
  std::filesystem::remove(scene.path);
}

}  // namespace

int main(int, char** argv) {
  dygita::prepare_process(argv);
  std::puts("scene,spectrum,knob,value,band [dB],true [dB],covered [%],band / true");
  // From one over the record on.
  study_bar("pulse", lasting(pulse, "2.4 * T", "1.9 * T"), 55e3, 400e3, {{"upper", "zmax"}, {"lower", "zmin"}});
  study_bar("impact", impact, 450e3, 4e6, {{"left", "zmin"}, {"right", "zmin"}});
  study_bar("yielding", lasting(yielding, "1.2 * T", "1.9 * T"), 55e3, 400e3, {{"upper", "zmax"}, {"lower", "zmin"}});
  const Scene crush{
      "crush", deck("crush.lua"), {{"punch", "zmax"}, {"specimen", "zmax"}, {"specimen", "xmax"}}, 20e3, 300e3};
  study_tolerance(crush);
  study(crush, "dt", "time_step", {{"0.6*us", "0.075*us"}, {"0.3*us", "0.0375*us"}});
  study(crush, "n", "mesh", {{"2", "8"}, {"4", "8"}});
  const Scene flanges{"bolted flanges", deck("bench/even_flanges.lua"), {}, 0.0, 0.0};
  study_tolerance(flanges);
  study(flanges, "dt", "time_step", {{"1*us", "0.125*us"}, {"0.5*us", "0.0625*us"}});
  study(flanges, "size", "mesh", {{"4*mm", "2.5*mm"}, {"3*mm", "2.5*mm"}});
  std::puts("\nscene,how,iterations,seconds,spectra off by at most [dB],other off [%]");
  study_passes(flanges, "bolt", "normal");
  study_passes(crush, "spread", "displacement");
  Scene blocks{"pulse",
               std::filesystem::temp_directory_path() / "dygita_spectrum_bands.lua",
               {{"upper", "zmax"}, {"lower", "zmin"}},
               55e3,
               400e3};
  std::ofstream(blocks.path) << lasting(pulse, "2.4 * T", "1.9 * T");
  study_passes(blocks, "a_lower_zmin", "acceleration");
  std::filesystem::remove(blocks.path);
  return 0;
}

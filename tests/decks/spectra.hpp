// Runs with spectra at places that a test chooses, and what their bands are worth against a better run.
#pragma once

#include <chrono>

#include "decks/effectivity.hpp"
#include "estimates/spectrum_band.hpp"
#include "recording/given_output.hpp"

namespace dygita::test {

struct Place {
  std::string part, face;
};

struct SpectraRun {
  struct Spectrum {
    std::string name;
    Table srs, band;
  };
  std::vector<Spectrum> spectra;
  Problem problem;
  std::shared_ptr<const RunResult> result;

  double largest(const std::string& output, const std::string& column) const {
    for (const OutputPtr& o : problem.outputs)
      if (o->name == output) return test::largest(result->tables.at(o.get()).column(column));
    throw std::runtime_error("no output named " + output);
  }
};

// Accelerations along z of the places (none: the deck's own spectra), from..to in Hz; tolerance 0: the deck's.
// start_from: fields of a run at another tolerance.
inline SpectraRun run_spectra(const std::filesystem::path& path, const Settings& settings,
                              const std::vector<Place>& places, double from, double to, double tolerance = 0.0,
                              const InterfaceFields* start_from = nullptr) {
  set_progress_enabled(false);
  SpectraRun done;
  const Engine engine{
      [&](Problem problem, const RunRequest&) {
        if (tolerance > 0.0) {
          problem.solver.tolerance = tolerance;
          problem.solver.integration = IntegrationChoice::implicitly;  // explicit ones are not iterated
        }
        for (const Place& place : places) {
          std::vector<Target> on;
          for (const SubstructurePtr& part : problem.substructures)
            if (part->name == place.part) on = {Face{part, place.face}};
          const OutputPtr history =
              make_history("a_" + place.part + "_" + place.face, on, "acceleration", Vec3::UnitZ());
          GivenArguments arguments = given_spectrum("srs", place.part + "." + place.face, from, to);
          arguments.outputs["of"] = history;
          const OutputPtr srs = make_output(arguments);
          problem.outputs.insert(problem.outputs.end(), {history, srs});
        }
        PartWatch parts(problem);
        Collector collector(problem, parts, nullptr);
        Observers observers({&parts, &collector});
        const auto start = std::chrono::steady_clock::now();
        const SolverFigures figures = solve(problem, observers, start_from);
        auto result = std::make_shared<RunResult>();
        parts.settle();
        collector.finish(*result);
        result->seconds["all"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        result->interface_fields = figures.interface_fields;
        for (const OutputPtr& output : problem.outputs)
          if (output->settles())
            done.spectra.push_back({output->name, result->tables.at(output.get()), result->findings_of(*output).band});
        for (const StepFigures& step : figures.steps) result->iterations += step.iterations;
        done.problem = problem;
        done.result = result;
        return std::shared_ptr<const RunResult>(result);
      },
      check_report};
  DeckOptions options;
  options.path = path;
  options.settings = settings;
  options.write_files = false;
  options.threads = 1;
  run_deck(options, engine);
  return done;
}

// A column of the band against the true difference from a better run: means over the frequencies, share of frequencies
// where the difference lies within the band, median of band over difference.
struct BandWorth {
  double band = 0.0, truth = 0.0, covered = 0.0, ratio = 0.0;
};

inline BandWorth band_worth(const SpectraRun::Spectrum& run, const SpectraRun::Spectrum& better,
                            const std::string& column) {
  const std::vector<double>&a = run.srs.column("maximax"), &b = better.srs.column("maximax"),
        &band = run.band.column(column);
  BandWorth worth;
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i) {
    const double truth = std::abs(20.0 * std::log10(a[i] / b.at(i)));
    worth.band += band[i] / static_cast<double>(a.size());
    worth.truth += truth / static_cast<double>(a.size());
    worth.covered += (truth <= band[i] ? 1.0 : 0.0) / static_cast<double>(a.size());
    ratios.push_back(band[i] / std::max(truth, 1e-12));
  }
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
  worth.ratio = ratios[ratios.size() / 2];
  return worth;
}

}  // namespace dygita::test

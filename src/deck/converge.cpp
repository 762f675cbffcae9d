#include "deck/converge.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "base/names.hpp"
#include "report/convergence_files.hpp"

namespace dygita {

namespace {

constexpr int most_refinements = 6;

// Ends a deck before it computes.
struct BeyondBudget : std::exception {};

class Converge {
 public:
  Converge(const ConvergeOptions& options, const Engine& engine)
      : options_(options), engine_(engine), study_(known_variations()) {}

  ConvergeOutcome run() {
    if (refine_twice()) refine_until_met();
    if (outcome_.interrupted) return outcome_;
    conclude();
    return outcome_;
  }

 private:
  // The deck's parameters and outputs, by a check: before anything is computed, what is misspelt is told.
  std::vector<Variation> known_variations() {
    const Engine look{nullptr, [this](const Problem& problem) {
                        note_names(problem);
                        return std::string();
                      }};
    const DeckOutcome checked = check_deck(options_.deck, look);
    if (checked.n_runs == 0) throw InputError("the deck runs no problem");
    for (const std::string& name : options_.outputs)
      if (!known_names_.count(name)) WatchedName(*last_problem_, name, "--output");  // throws
    std::vector<std::string> known;
    for (const auto& [name, value] : checked.parameters) known.push_back(name);
    std::vector<Variation> variations = options_.variations;
    for (Variation& variation : variations) {
      const auto found = std::find(known.begin(), known.end(), variation.parameter);
      if (found == known.end())
        throw InputError(fmt::format("--vary {}: the deck has no parameter '{}'\n    {}", variation.parameter,
                                     variation.parameter, did_you_mean(variation.parameter, known)));
      variation.base = checked.parameters[static_cast<size_t>(found - known.begin())].second;
      if (!(variation.base > 0.0))
        throw InputError(fmt::format("--vary {}: its value in the deck is {:g}; it must be above zero",
                                     variation.parameter, variation.base));
    }
    return variations;
  }

  void note_names(const Problem& problem) {
    last_problem_ = std::make_shared<Problem>(problem);
    for (const std::string& name : options_.outputs.empty() ? watched_by_default(problem) : options_.outputs) {
      try {
        WatchedName(problem, name, "--output");
        known_names_.insert(name);
      } catch (const InputError&) {  // of another problem of the deck, or told later
      }
    }
  }

  // A run's figures; of the deck's last run that has them.
  void note_figures(const Problem& problem, const RunResult& result, ConvergenceRun& run) const {
    for (const std::string& name : options_.outputs.empty() ? watched_by_default(problem) : options_.outputs) {
      const bool is_here = std::any_of(problem.outputs.begin(), problem.outputs.end(), [&](const OutputPtr& output) {
        return name == output->name || name.rfind(output->name + ".", 0) == 0;
      });
      const auto figure = is_here ? WatchedName(problem, name, "--output").of(result) : std::nullopt;
      if (!figure) continue;
      const auto same = [&](const WatchedFigure& known) { return known.name == name; };
      if (std::erase_if(run.figures, same) > 0 && said_last_of_.insert(name).second)
        say("'" + name + "' occurs in several runs of the deck: its values are those of the last");
      run.figures.push_back(*figure);
    }
    run.converged &= result.converged;
    for (const StepSummary& step : result.steps) run.tuned.insert(step.tuned_parts.begin(), step.tuned_parts.end());
    if (const auto all = result.seconds.find("all"); all != result.seconds.end()) run.seconds += all->second;
  }

  // Runs a setting unless it has been run or exceeds the budget; false: it was not.
  bool compute(const Levels& levels) {
    if (study_.runs().count(levels)) return true;
    say("== " + setting_text(study_, levels));
    ConvergenceRun run;
    const Engine engine{[&](const Problem& problem, const RunRequest& request) {
                          if (run.work == 0.0) afford(levels, run.work = work_of(problem));
                          auto result = engine_.run(problem, request);
                          note_figures(problem, *result, run);
                          return result;
                        },
                        engine_.check};
    try {
      outcome_.interrupted = run_deck(deck_at(levels), engine).interrupted;
    } catch (const BeyondBudget&) {
      outcome_.is_whole = false;
      return false;
    }
    outcome_.is_whole &= run.converged;
    if (!run.converged) say("  this run did not converge: its values are omitted");
    spent_ += run.seconds;
    study_.add(levels, std::move(run));
    return !outcome_.interrupted;
  }

  // Once the deck has made its meshes it is known how much there is to do.
  void afford(const Levels& levels, double work) const {
    if (study_.runs().empty()) return;
    const double predicted = study_.predicted_seconds(levels, work);
    if (spent_ + predicted > options_.budget) {
      say(fmt::format("{} would take about {:.3g} s, beyond the budget: {:.3g} of {:.3g} s are spent",
                      setting_text(study_, levels), predicted, spent_, options_.budget));
      throw BeyondBudget();
    }
    say(fmt::format("  about {:.3g} s", predicted));
  }

  DeckOptions deck_at(const Levels& levels) const {
    DeckOptions deck = options_.deck;
    deck.write_files = deck.write_frames = deck.write_state = deck.is_study = false;
    for (size_t i = 0; i < levels.size(); ++i) {
      const Variation& variation = study_.variations()[i];
      std::erase_if(deck.settings, [&](const auto& setting) { return setting.first == variation.parameter; });
      deck.settings.emplace_back(variation.parameter, fmt::format("{:.17g}", variation.value(levels[i])));
    }
    return deck;
  }

  bool refine_twice() {
    if (!compute(study_.coarsest())) return false;
    for (int level = 1; level <= 2; ++level)
      for (size_t i = 0; i < study_.variations().size(); ++i)
        if (!compute(study_.along(i, level))) return false;
    return true;
  }

  // Figures that have a limit in these runs: others can meet no aim.
  std::vector<FigureConvergence> with_limit() const {
    std::vector<FigureConvergence> figures = study_.figures();
    std::erase_if(figures, [&](const FigureConvergence& figure) {
      return !std::isfinite(figure.at(study_.variations(), study_.finest()));
    });
    return figures;
  }

  void refine_until_met() {
    while (options_.aim > 0.0) {
      const std::vector<FigureConvergence> figures = with_limit();
      if (figures.empty() || study_.meets(figures, study_.finest(), options_.aim)) return;
      const size_t worst = study_.worst_variation(figures, options_.aim);
      const int level = study_.deepest(worst) + 1;
      if (level > most_refinements || !compute(study_.along(worst, level))) return;
    }
  }

  bool has_enough() const {
    for (size_t i = 0; i < study_.variations().size(); ++i)
      if (study_.runs().empty() || study_.deepest(i) < 2) return false;
    return true;
  }

  void conclude() {
    if (!has_enough()) {
      outcome_.is_met = options_.aim == 0.0;
      say("an order of convergence requires two refinements of each parameter: raise --budget, or start coarser "
          "(--set)");
      return;
    }
    outcome_.figures = study_.figures();
    const std::vector<FigureConvergence>& figures = outcome_.figures;
    say(fmt::format("\n{} runs in {:.3g} s:", study_.runs().size(), spent_));
    say(convergence_text(study_, figures));
    if (options_.aim > 0.0) recommend(figures);
    doubt_masses();
    const std::filesystem::path folder = options_.deck.out / (options_.deck.path.stem().string() + "_converge");
    write_convergence(folder, options_.deck.path.stem().string(), study_, figures);
    say(fmt::format("table and figure: {}, {}", (folder / "converge.csv").string(),
                    (folder / "converge.svg").string()));
  }

  // Two kinds of mass go to one limit, but not in one sequence.
  void doubt_masses() {
    std::set<std::string> in_some, in_all = study_.runs().begin()->second.tuned;
    for (const auto& [levels, run] : study_.runs()) {
      in_some.insert(run.tuned.begin(), run.tuned.end());
      std::erase_if(in_all, [&tuned = run.tuned](const std::string& name) { return !tuned.contains(name); });
    }
    std::erase_if(in_some, [&](const std::string& name) { return in_all.contains(name); });
    if (in_some.empty()) return;
    outcome_.is_met = false;
    say(fmt::format(
        "these runs do not form one sequence: the mass of {} was tuned in some and lumped in others; say which, "
        "--solver \"latin{{ mass = 'tuned' }}\" or 'lumped'",
        list_of_names({in_some.begin(), in_some.end()})));
  }

  // The cheapest setting that is predicted to meet the aim, computed and compared with the limit.
  void recommend(const std::vector<FigureConvergence>& all) {
    const std::vector<FigureConvergence> figures = with_limit();
    outcome_.is_met = !figures.empty() && (options_.outputs.empty() || figures.size() == options_.outputs.size());
    if (figures.size() < all.size() || !outcome_.is_met)
      say("quantities without a limit, or of runs that did not converge, cannot meet a target");
    const auto levels = figures.empty() ? std::nullopt : study_.cheapest(figures, options_.aim);
    if (!levels) {
      outcome_.is_met = false;
      say(fmt::format("no tested setting is within {:g} % of every limit", 100.0 * options_.aim));
      return;
    }
    const std::string setting = setting_text(study_, *levels);
    say(fmt::format("cheapest setting within {:g} %: {}, about {:.3g} s", 100.0 * options_.aim, setting,
                    study_.predicted_seconds(*levels, 0.0)));
    if (!compute(*levels)) {
      say("  this setting has not been run: its error is predicted from the runs along each parameter");
    } else if (!study_.runs().at(*levels).converged) {
      outcome_.is_met = false;
    } else {
      compare(figures, *levels);
    }
    std::string command = "dygita run " + options_.deck.path.string();
    for (const auto& [name, value] : options_.deck.settings) {
      const bool is_varied = std::any_of(study_.variations().begin(), study_.variations().end(),
                                         [&, &of = name](const Variation& v) { return v.parameter == of; });
      if (!is_varied) command += " --set " + name + "=" + value;
    }
    for (size_t i = 0; i < levels->size(); ++i)
      command +=
          fmt::format(" --set {}={:.9g}", study_.variations()[i].parameter, study_.variations()[i].value((*levels)[i]));
    say("  " + command);
  }

  // What the predictions are worth where several parameters are refined at once.
  void compare(const std::vector<FigureConvergence>& figures, const Levels& levels) {
    for (const FigureConvergence& figure : figures) {
      double off = std::numeric_limits<double>::quiet_NaN();
      for (const WatchedFigure& found : study_.runs().at(levels).figures)
        if (found.name == figure.name) {
          off = 0.0;
          for (size_t k = 0; k < found.values.size(); ++k)
            off = std::max(off, std::abs(found.values[k] - figure.limit[k]) / figure.scale);
        }
      const bool is_level = figure.unit == "dB";
      const double predicted = figure.at(study_.variations(), levels), unit = is_level ? 1.0 : 100.0;
      const double together = apart_from_sum(figure, levels);
      say(fmt::format("  {}: {:.2g} {} from the limit, {:.2g} predicted at most", figure.name, unit * off,
                      is_level ? "dB" : "%", unit * predicted));
      if (off + together <= figure.allowed(options_.aim)) continue;
      outcome_.is_met = false;
      if (off <= figure.allowed(options_.aim))
        say(
            fmt::format("    but {:.2g} {} from the sum of the separate effects: the limit, also such a sum, is no "
                        "more accurate\n    refine the coarsest run (--set), or one parameter at a time",
                        unit * together, is_level ? "dB" : "%"));
    }
  }

  // By how much a run differs from the sum of what its refinements change alone, relative as an error.
  double apart_from_sum(const FigureConvergence& figure, const Levels& levels) const {
    const auto values_of = [&](const Levels& of) {
      const std::vector<WatchedFigure>& figures = study_.runs().at(of).figures;
      const auto found = std::find_if(figures.begin(), figures.end(),
                                      [&](const WatchedFigure& known) { return known.name == figure.name; });
      return found == figures.end() ? std::vector<double>() : found->values;
    };
    const std::vector<double> found = values_of(levels), coarsest = values_of(study_.coarsest());
    double apart = 0.0;
    for (size_t k = 0; k < found.size() && k < coarsest.size(); ++k) {
      double sum = coarsest[k];
      for (size_t i = 0; i < levels.size(); ++i) {
        const std::vector<double> alone = values_of(study_.along(i, levels[i]));
        if (alone.size() != found.size()) return std::numeric_limits<double>::infinity();
        sum += alone[k] - coarsest[k];
      }
      apart = std::max(apart, std::abs(found[k] - sum) / figure.scale);
    }
    return apart;
  }

  const ConvergeOptions& options_;
  const Engine& engine_;
  std::shared_ptr<const Problem> last_problem_;
  std::set<std::string> known_names_;
  mutable std::set<std::string> said_last_of_;
  ConvergenceStudy study_;
  ConvergeOutcome outcome_;
  double spent_ = 0.0;
};

}  // namespace

namespace {

// A number, and what follows on it.
std::pair<double, std::string> number_and_rest(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return {end == text.c_str() ? std::numeric_limits<double>::quiet_NaN() : number, end};
}

}  // namespace

Variation parse_variation(const std::string& text) {
  Variation variation;
  const size_t sign = text.find_first_of("/*");
  variation.parameter = text.substr(0, sign);
  variation.is_count = sign != std::string::npos && text[sign] == '*';
  std::string rest;
  if (sign != std::string::npos) std::tie(variation.ratio, rest) = number_and_rest(text.substr(sign + 1));
  if (variation.parameter.empty() || !rest.empty() || !(variation.ratio > 1.0) || !(variation.ratio <= 10.0))
    throw InputError("--vary " + text +
                     ": write a parameter and its refinement factor, above 1 and at most 10: size (halved), size/1.5, "
                     "n*2 (a number of cells or steps)");
  return variation;
}

double parse_share(const std::string& what, const std::string& text) {
  const auto [number, rest] = number_and_rest(text);
  const double share = rest == "%" ? number / 100.0 : number;
  if ((!rest.empty() && rest != "%") || !(share > 0.0) || !(share < 1.0))
    throw InputError(what + " " + text + ": write a fraction as 1% or 0.01, above 0 and below 100%");
  return share;
}

double parse_duration(const std::string& what, const std::string& text) {
  const auto [number, rest] = number_and_rest(text);
  const std::map<std::string, double> seconds = {{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}};
  const auto unit = seconds.find(rest);
  if (unit == seconds.end() || !(number > 0.0) || !std::isfinite(number))
    throw InputError(what + " " + text + ": write a time as 90s, 10min or 2h");
  return number * unit->second;
}

double parse_interval(const std::string& what, const std::string& text) {
  return text == "0" ? 0.0 : parse_duration(what, text);
}

ConvergeOutcome converge(const ConvergeOptions& options, const Engine& engine) {
  return Converge(options, engine).run();
}

}  // namespace dygita

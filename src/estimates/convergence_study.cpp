#include "estimates/convergence_study.hpp"

#include <algorithm>
#include <cmath>

#include "result/case_summary.hpp"

namespace dygita {

namespace {

constexpr double rounding = 1e-9;  // of a figure's largest value
constexpr double of_static = 8.0;  // dynamic increments that cost as much as a static one

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

double work_of(const Problem& problem) {
  double nodes = 0.0, increments = 0.0;
  for (const SubstructurePtr& part : problem.substructures) nodes += part->mesh->n_nodes();
  for (const StepPtr& step : problem.steps) increments += (step->is_static ? of_static : 1.0) * step->n_increments();
  return increments * std::pow(nodes, 4.0 / 3.0);
}

double Variation::value(int level) const {
  const double factor = std::pow(ratio, level);
  return is_count ? std::round(base * factor) : base / factor;
}

double Variation::size(int level) const { return is_count ? base / value(level) : value(level) / base; }

double FigureConvergence::share_of(const std::vector<Variation>& variations, const Levels& levels,
                                   size_t variation) const {
  return by[variation].at(variations[variation].size(levels[variation])) / scale;
}

double FigureConvergence::at(const std::vector<Variation>& variations, const Levels& levels) const {
  double sum = 0.0;
  for (size_t i = 0; i < by.size(); ++i) sum += share_of(variations, levels, i);
  return sum;
}

double FigureConvergence::allowed(double aim) const { return unit == "dB" ? 20.0 * std::log10(1.0 + aim) : aim; }

ConvergenceStudy::ConvergenceStudy(std::vector<Variation> variations) : variations_(std::move(variations)) {}

Levels ConvergenceStudy::along(size_t variation, int level) const {
  Levels levels = coarsest();
  levels[variation] = level;
  return levels;
}

int ConvergenceStudy::deepest(size_t variation) const {
  int level = 0;
  while (runs_.count(along(variation, level + 1))) ++level;
  return level;
}

Levels ConvergenceStudy::finest() const {
  Levels levels;
  for (size_t i = 0; i < variations_.size(); ++i) levels.push_back(deepest(i));
  return levels;
}

double ConvergenceStudy::predicted_seconds(const Levels& levels, double work) const {
  if (const auto known = runs_.find(levels); known != runs_.end()) return known->second.seconds;
  const ConvergenceRun& coarsest_run = run(coarsest());
  const double base = std::max(coarsest_run.seconds, 1e-3);
  double seconds = base;
  for (size_t i = 0; i < variations_.size(); ++i) {
    const int deep = deepest(i);
    const int known = std::min(levels[i], deep);
    const double there = std::max(run(along(i, known)).seconds, 1e-3);
    seconds *= there / base;
    const double growth =
        deep == 0 ? work / coarsest_run.work : there / std::max(run(along(i, deep - 1)).seconds, 1e-3);
    if (levels[i] > known) seconds *= std::pow(std::max(1.0, growth), levels[i] - known);
  }
  return seconds;
}

std::vector<FigureConvergence> ConvergenceStudy::figures() const {
  std::vector<FigureConvergence> all;
  const std::vector<WatchedFigure>& base = run(coarsest()).figures;
  for (size_t f = 0; f < base.size(); ++f) {
    FigureConvergence one{base[f].name, base[f].unit, {}, base[f].values, 0.0};
    const bool is_level = one.unit == "dB";
    const double noise = is_level ? 1e-6 : std::max(noise_of(one.unit), rounding * largest_of(base[f].values));
    bool is_whole = true;
    for (size_t i = 0; i < variations_.size() && is_whole; ++i) {
      std::vector<double> sizes;
      std::vector<std::vector<double>> values;
      for (int level = 0; level <= deepest(i); ++level) {
        const ConvergenceRun& there = run(along(i, level));
        is_whole &= there.converged && there.figures.size() == base.size() &&
                    there.figures[f].values.size() == base[f].values.size();
        if (!is_whole) break;
        sizes.push_back(variations_[i].size(level));
        values.push_back(there.figures[f].values);
      }
      if (!is_whole) break;
      one.by.push_back(grid_convergence(sizes, values, noise));
      for (size_t k = 0; k < one.limit.size(); ++k) one.limit[k] += one.by.back().limit[k] - base[f].values[k];
    }
    one.scale = is_level ? 1.0 : largest_of(one.limit);
    if (is_whole && (is_level || one.scale > noise)) all.push_back(std::move(one));
  }
  return all;
}

bool ConvergenceStudy::meets(const std::vector<FigureConvergence>& figures, const Levels& levels, double aim) const {
  return std::all_of(figures.begin(), figures.end(), [&](const FigureConvergence& figure) {
    return figure.at(variations_, levels) <= figure.allowed(aim);
  });
}

size_t ConvergenceStudy::worst_variation(const std::vector<FigureConvergence>& figures, double aim) const {
  const Levels levels = finest();
  double worst = -1.0;
  size_t at = 0;
  for (const FigureConvergence& figure : figures)
    for (size_t i = 0; i < variations_.size(); ++i) {
      const double share = figure.share_of(variations_, levels, i) / figure.allowed(aim);
      if (share > worst) {
        worst = share;
        at = i;
      }
    }
  return at;
}

std::optional<Levels> ConvergenceStudy::cheapest(const std::vector<FigureConvergence>& figures, double aim) const {
  const Levels last = finest();
  std::optional<Levels> best;
  double seconds = 0.0;
  for (Levels levels = coarsest();;) {
    const double cost = predicted_seconds(levels, 0.0);  // none is deeper than what has been run
    if (meets(figures, levels, aim) && (!best || cost < seconds)) {
      best = levels;
      seconds = cost;
    }
    size_t i = 0;
    while (i < levels.size() && levels[i] == last[i]) levels[i++] = 0;
    if (i == levels.size()) return best;
    ++levels[i];
  }
}

}  // namespace dygita

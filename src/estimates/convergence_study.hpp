// Runs of one deck at several sizes of its cells and time steps: what they say together.
#pragma once

#include <map>
#include <set>
#include <string>

#include "estimates/grid_convergence.hpp"
#include "result/watched_figures.hpp"

namespace dygita {

// A parameter of a deck that is refined: divided by `ratio` where it is a size, multiplied where it is a count.
struct Variation {
  std::string parameter;
  double ratio = 2.0;
  bool is_count = false;
  double base = 0.0;  // its value in the coarsest run

  double value(int level) const;  // a whole one where it is a count
  double size(int level) const;   // relative to the coarsest, 1 at level 0
};

// How often each variation was refined.
using Levels = std::vector<int>;

struct ConvergenceRun {
  std::vector<WatchedFigure> figures;
  double seconds = 0.0;
  bool converged = true;
  double work = 0.0;                 // work_of the first problem of the deck
  std::set<std::string> tuned = {};  // substructures whose mass was tuned (manual, eq. S15)
};

// How much there is to compute, to compare runs of one deck: increments times the 4/3rd power of the nodes, which
// solving with factors of a mesh in three dimensions takes; a static increment as several dynamic ones.
double work_of(const Problem& problem);

// What became of a figure: by variation, and in the limit of all of them.
struct FigureConvergence {
  std::string name, unit;
  std::vector<GridConvergence> by;  // variation
  std::vector<double> limit;        // of all, as if their errors added up
  double scale = 0.0;               // modulus of the limit that errors are relative to; dB: 1

  // Uncertainty of a run, relative to the scale (dB: in dB).
  double at(const std::vector<Variation>& variations, const Levels& levels) const;
  double share_of(const std::vector<Variation>& variations, const Levels& levels, size_t variation) const;
  // What an aim in relative terms is for it: a spectrum has it in dB.
  double allowed(double aim) const;
};

class ConvergenceStudy {
 public:
  explicit ConvergenceStudy(std::vector<Variation> variations);

  const std::vector<Variation>& variations() const { return variations_; }
  const std::map<Levels, ConvergenceRun>& runs() const { return runs_; }
  void add(const Levels& levels, ConvergenceRun run) { runs_[levels] = std::move(run); }
  Levels coarsest() const { return Levels(variations_.size(), 0); }
  // The coarsest run with one variation refined to `level`.
  Levels along(size_t variation, int level) const;
  int deepest(size_t variation) const;  // level along it that has been run
  Levels finest() const;                // the deepest of each

  // Seconds that a run will take, from those along each variation; before one has been refined, from how much more work
  // it is than the coarsest run.
  double predicted_seconds(const Levels& levels, double work) const;
  // Of figures whose runs all have converged and that are more than rounding. Needs two refinements of each variation.
  std::vector<FigureConvergence> figures() const;
  // The variation whose error counts most at the finest levels, in the figure that is farthest from the aim.
  size_t worst_variation(const std::vector<FigureConvergence>& figures, double aim) const;
  // Do all figures meet the aim there?
  bool meets(const std::vector<FigureConvergence>& figures, const Levels& levels, double aim) const;
  // The cheapest levels, up to the deepest run of each, that do; none: not even the finest.
  std::optional<Levels> cheapest(const std::vector<FigureConvergence>& figures, double aim) const;

 private:
  const ConvergenceRun& run(const Levels& levels) const { return runs_.at(levels); }

  std::vector<Variation> variations_;
  std::map<Levels, ConvergenceRun> runs_;
};

}  // namespace dygita

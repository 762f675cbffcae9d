// Runs a deck again and again, its cells and time steps ever finer, until its figures are known as well as asked for.
#pragma once

#include <limits>

#include "deck/deck.hpp"
#include "estimates/convergence_study.hpp"

namespace dygita {

struct ConvergeOptions {
  DeckOptions deck;                   // files of single runs are not written
  std::vector<Variation> variations;  // parameters of the deck
  std::vector<std::string> outputs;   // figures by name (WatchedName); empty: those of studies, and spectra
  double aim = 0.0;                   // relative; 0: three runs of each variation, whatever they say
  double budget = std::numeric_limits<double>::infinity();  // s; no run is begun that would exceed it
};

struct ConvergeOutcome {
  bool is_met = true;    // the aim, by the figures asked for
  bool is_whole = true;  // every run has converged, none was left out for the budget
  bool interrupted = false;
  std::vector<FigureConvergence> figures;  // empty where too little was run
};

// "size" and "size/1.5": a size, divided by 2 or by that; "n*2": a count, multiplied. Throws InputError.
Variation parse_variation(const std::string& text);

// "1%" and "0.01" as 0.01, below 1; "90s", "10min", "2h" and "90" in s. `what` names the option. Throws InputError.
double parse_share(const std::string& what, const std::string& text);
double parse_duration(const std::string& what, const std::string& text);
// The same, and 0 for never.
double parse_interval(const std::string& what, const std::string& text);

// Checks the deck, runs it with each variation refined twice, then further those that matter until the aim is met, and
// the cheapest setting that is predicted to meet it. Says a table; writes <out>/<deck>_converge/converge.csv and .svg.
// Throws InputError (deck, no such parameter or output, a parameter that is no number above zero), NumericalError.
ConvergeOutcome converge(const ConvergeOptions& options, const Engine& engine);

}  // namespace dygita

// Members of an ensemble, one problem with parameters drawn from their distributions, and what they come to.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "estimates/random_design.hpp"
#include "estimates/scatter.hpp"
#include "result/result.hpp"

namespace dygita {

struct EnsembleMember {
  std::string name;            // of its case
  std::vector<double> values;  // of the parameters, SI
  std::shared_ptr<const Problem> problem;
  std::shared_ptr<const RunResult> result;
};

struct Ensemble {
  std::string name;  // of its case
  Design design = Design::latin_hypercube;
  std::int64_t seed = 1;
  std::vector<std::string> parameters;
  std::vector<EnsembleMember> members;

  // Corners are chosen, not drawn: no share of units lies below a level of theirs.
  bool is_sample() const { return design != Design::corners; }
  // Those whose increments have all converged: the others have no answer that could be counted.
  std::vector<const EnsembleMember*> counted() const;
};

// What drives a figure of an output.
struct Drive {
  std::string figure;  // "bolt.normal last"
  std::string parameter;
  RankCorrelation correlation;
  double share() const { return correlation.value * correlation.value; }  // of the spread of ranks
};

struct OutputScatter {
  OutputPtr output;  // the first member's
  // Tables of scatter_of, by column; none where members' rows do not correspond.
  std::vector<std::pair<std::string, Table>> columns;
  std::vector<Drive> drives;  // figure by figure, the strongest first
  Table drives_at;            // of a spectrum: rank correlation with each parameter at each frequency; else empty
  bool is_spectrum = false;
};

// Of the outputs that have tables, in the problem's order.
std::vector<OutputScatter> scatter_of(const Ensemble& ensemble);

// Values of a reduction ("last", "first", "max", "min") of a column, one of each counted member. Throws InputError
// where a member has no row.
std::vector<double> sample_of(const Ensemble& ensemble, const std::string& output, const std::string& column,
                              const std::string& reduction);

// Those in a row.
std::vector<double> values_at(const Ensemble& ensemble, const std::string& output, const std::string& column,
                              size_t row);

// "half of the spread is mu": of the strongest drive; empty where none stands out of the noise of n members.
std::string drive_text(const std::vector<Drive>& drives, const std::string& figure);

}  // namespace dygita

// A column of an output against its first column, and what a deck asks of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

struct Series {
  std::shared_ptr<const Problem> problem;
  std::string name;      // "bolt.normal", for messages
  std::string abscissa;  // "time" or "frequency"
  std::vector<double> values, at;
  std::vector<int> step;   // problem's step of each row; empty for spectra
  bool is_hollow = false;  // stands for one that a run would give, of as many rows as it will have
};

// max, min, first or last; nothing for another key. Throws InputError on an empty series.
std::optional<double> summary_of(const Series& series, const std::string& key, const Origin& origin);

// Linear between rows; where time does not advance the last row of that time. Half a row's spacing beyond either end
// answers the end's value, since means over a time step carry its middle. Throws InputError farther out.
double value_at_abscissa(const Series& series, double x, const Origin& origin);

// The last row of a step of the series' problem. Throws InputError if the step is not in it or gave no row.
double value_at_step(const Series& series, const Step& step, const Origin& origin);

}  // namespace dygita

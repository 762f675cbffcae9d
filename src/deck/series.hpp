// What a series answers, without Lua.
#pragma once

#include <optional>

#include "deck/object.hpp"

namespace dygita {

// max, min, first or last; nothing for another key. Throws InputError on an empty series.
std::optional<double> summary_of(const Series& series, const std::string& key, const Origin& origin);

// Linear between rows; where time stands still the last row of that time. Half a row's spacing beyond either end
// answers the end's value, since means over a time step carry its middle. Throws InputError farther out.
double value_at_abscissa(const Series& series, double x, const Origin& origin);

// The last row of a step of the series' problem. Throws InputError if the step is not in it or gave no row.
double value_at_step(const Series& series, const Step& step, const Origin& origin);

// A result with one row of nan per step, for decks that are checked and not run.
std::shared_ptr<const RunResult> hollow_result(const Problem& problem);

}  // namespace dygita

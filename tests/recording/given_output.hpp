// Outputs as decks declare them, built without a deck.
#pragma once

#include "model/given_arguments.hpp"
#include "recording/output_table.hpp"

namespace dygita {

inline TimeValue given_number(double value) { return {History::constant(value), true}; }

// Arguments of output.<word>; an empty name is none.
inline GivenArguments given_output(const std::string& word, const std::string& name, std::vector<Target> on = {},
                                   int line = 50) {
  GivenArguments arguments("output." + word, {"deck.lua", line});
  if (!name.empty()) arguments.words["name"] = name;
  arguments.on = std::move(on);
  return arguments;
}

inline OutputPtr make_history(const std::string& name, std::vector<Target> on, const std::string& quantity,
                              const std::optional<Vec3>& direction = {}) {
  GivenArguments arguments = given_output("history", name, std::move(on));
  arguments.words["quantity"] = quantity;
  if (direction) arguments.lists["direction"] = {direction->begin(), direction->end()};
  return make_output(arguments);
}

// With the defaults of decks and these frequencies, Hz.
inline GivenArguments given_spectrum(const std::string& word, const std::string& name, double from = 100.0,
                                     double to = 1e4, int line = 51) {
  GivenArguments arguments = given_output(word, name, {}, line);
  arguments.words["quantity"] = "absolute_acceleration";
  for (const auto& [key, value] : {std::pair{"from", from}, {"to", to}, {"per_octave", 12.0}})
    arguments.values_of_time[key] = given_number(value);
  return arguments;
}

}  // namespace dygita

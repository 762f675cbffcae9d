// Figures of a run by the name a user gives them: "bolt.normal.max", "above.z.last", "srs_above".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

struct WatchedFigure {
  std::string name, unit;
  std::vector<double> values;  // one; of a spectrum its level at each frequency, dB
};

// A word of "max" (the largest modulus), "min", "last", "mean" after an output's column; nothing after it means "max".
// An output alone: a spectrum.
class WatchedName {
 public:
  // Throws InputError where the problem has no such output, column or word; `what` opens the message ("--output").
  WatchedName(const Problem& problem, const std::string& text, const std::string& what);

  const std::string& text() const { return text_; }
  // None where the run has no such table.
  std::optional<WatchedFigure> of(const RunResult& result) const;

 private:
  std::string text_, column_, word_ = "max";
  const Output* output_ = nullptr;
  bool is_spectrum_ = false;
};

// What a problem is watched by where nothing is named: the figures of studies, and its spectra.
std::vector<std::string> watched_by_default(const Problem& problem);

}  // namespace dygita

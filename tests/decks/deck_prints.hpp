// What a deck prints, beside its runs: numbers after "name:" lines, for decks that compute their own errors.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "decks/engine.hpp"

namespace dygita::test {

struct PrintedRun {
  std::vector<DeckRun> runs;
  std::string text;

  // The first number after `label` and the next colon; throws where the deck prints no such label.
  double number(const std::string& label) const {
    const size_t at = text.find(label), colon = at == std::string::npos ? at : text.find(':', at + label.size());
    if (colon == std::string::npos) throw std::runtime_error("the deck prints no '" + label + "'\n" + text);
    const char* begin = text.c_str() + colon + 1;
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    if (end == begin) throw std::runtime_error("no number after '" + label + "'\n" + text);
    return value;
  }
};

inline PrintedRun run_printing(const std::string& name, const Settings& settings = {}, const std::string& solver = "") {
  testing::internal::CaptureStdout();
  PrintedRun printed;
  try {
    printed.runs = run_file(deck(name), settings, 1, solver);
  } catch (...) {
    testing::internal::GetCapturedStdout();
    throw;
  }
  printed.text = testing::internal::GetCapturedStdout();
  std::cout << printed.text;
  return printed;
}

// Every table and figure of a run is a number.
inline bool is_finite(const DeckRun& run) {
  for (const auto& [output, table] : run.result->tables)
    for (const std::vector<double>& column : table.columns)
      for (const double v : column)
        if (!std::isfinite(v)) return false;
  for (const auto& [name, value] : run.figures())
    if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace dygita::test

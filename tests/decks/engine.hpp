// Runs decks through the real engine and keeps what they gave; no files are written.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "deck/deck.hpp"
#include "result/recorded_figures.hpp"

namespace dygita::test {

struct DeckRun {
  Problem problem;
  std::shared_ptr<const RunResult> result;

  const Output& output(const std::string& name) const {
    for (const OutputPtr& o : problem.outputs)
      if (o->name == name) return *o;
    throw std::runtime_error("no output named " + name);
  }
  const Table& table(const std::string& name) const { return result->tables.at(&output(name)); }
  const Findings& findings(const std::string& name) const { return result->findings_of(output(name)); }
  // A table beside an output's own.
  const Table& part(const std::string& name, const std::string& of) const {
    for (const auto& [part, table] : findings(name).parts)
      if (part == of) return table;
    throw std::runtime_error("no " + of + " of " + name);
  }
  const std::vector<double>& column(const std::string& name, const std::string& of) const {
    return table(name).column(of);
  }
  // As the run record tells them.
  std::map<std::string, double> figures() const { return recorded_figures(*result); }
  double figure(const std::string& name) const { return figures().at(name); }
};

using Settings = std::vector<std::pair<std::string, std::string>>;

inline std::vector<DeckRun> run_file(const std::filesystem::path& path, const Settings& settings = {}, int threads = 0,
                                     const std::string& solver = "") {
  set_progress_enabled(false);
  std::vector<DeckRun> runs;
  const Engine engine{[&](const Problem& problem, const RunRequest& request) {
                        RunRequest quiet = request;
                        quiet.write_files = false;
                        runs.push_back({problem, run_problem(problem, quiet)});
                        return runs.back().result;
                      },
                      check_report};
  DeckOptions options;
  options.path = path;
  options.settings = settings;
  options.threads = threads;
  options.solver = solver;
  options.write_files = false;
  run_deck(options, engine);
  return runs;
}

// A deck given as text; its file is this process's own, since tests run side by side.
inline std::vector<DeckRun> run_text(const std::string& text, const Settings& settings = {}, int threads = 0,
                                     const std::string& solver = "") {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("dygita_test_" + std::to_string(getpid()) + "_" + std::to_string(std::hash<std::string>{}(text)) + ".lua");
  std::ofstream(path) << text;
  std::vector<DeckRun> runs = run_file(path, settings, threads, solver);
  std::filesystem::remove(path);
  return runs;
}

inline std::filesystem::path deck(const std::string& name) {
  return std::filesystem::path(DYGITA_SOURCE_DIR) / "decks" / name;
}

inline double largest(const std::vector<double>& values) {
  double max = 0.0;
  for (const double v : values) max = std::max(max, std::abs(v));
  return max;
}

// Largest difference of two equally long series over the largest value of the first.
inline double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) throw std::runtime_error("series of different lengths");
  double max = 0.0;
  for (size_t i = 0; i < a.size(); ++i) max = std::max(max, std::abs(a[i] - b[i]));
  return max / largest(a);
}

}  // namespace dygita::test

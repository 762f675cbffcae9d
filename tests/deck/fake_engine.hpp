// An engine that computes nothing: it notes what it was asked and answers what a test prepared.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace dygita::test {

// Tables by the name of their output.
using Tables = std::map<std::string, Table>;

struct FakeEngine {
  Tables tables;
  bool converged = true, interrupted = false;
  std::function<void(const Problem&)> during;  // what the engine does while it runs

  std::vector<Problem> problems;
  std::vector<RunRequest> requests;
  int n_checks = 0;

  Engine engine() {
    return {[this](const Problem& problem, const RunRequest& request) { return run(problem, request); },
            [this](const Problem& problem) {
              ++n_checks;
              return "would compute " + problem.name;
            }};
  }

 private:
  std::shared_ptr<const RunResult> run(const Problem& problem, const RunRequest& request) {
    problems.push_back(problem);
    requests.push_back(request);
    if (during) during(problem);
    auto result = std::make_shared<RunResult>();
    for (const OutputPtr& output : problem.outputs) {
      const auto found = tables.find(output->name);
      if (found != tables.end()) result->tables[output.get()] = found->second;
    }
    result->iterations = 42;
    result->mean_iterations = 3.5;
    result->converged = converged;
    result->interrupted = interrupted;
    return result;
  }
};

// A folder for one test, removed with it.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "dygita_deck_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// A bar of two bonded cells that is pulled: lines to begin a deck with (13 of them).
inline const char* const two_blocks = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, k)
  return substructure{ name = name, material = steel, place = { 0, 0, k*10*mm },
                       mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
end
local low, high = block("low", 0), block("high", 1)
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local pull = load.traction{ on = high:face "zmax", z = 1*MPa }
local hold = step.static{ name = "hold", loads = { pull } }
local ring = step.dynamic{ name = "ring", after = hold, duration = 4*us, dt = 1*us, loads = { pull } }
local joint = output.joint{ name = "bolt", on = glue }
)";

// Runs `text` as deck.lua with the engine; settings as on the command line.
inline DeckOutcome run_text(const std::string& text, FakeEngine& fake, const std::vector<std::string>& settings = {},
                            const std::string& solver = "") {
  const Folder folder;
  DeckOptions options;
  options.path = folder.write("deck.lua", text);
  options.time_limit = 20.0;
  options.solver = solver;
  for (const std::string& setting : settings) options.settings.push_back(parse_setting(setting));
  return run_deck(options, fake.engine());
}

// The message of the error that a deck ends with; empty if it does not.
inline std::string message_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  FakeEngine fake;
  try {
    run_text(text, fake, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace dygita::test

#include <spdlog/fmt/fmt.h>

#include "base/names.hpp"
#include "model/check.hpp"
#include "model/load.hpp"
#include "model/output.hpp"
#include "model/own_files.hpp"

namespace dygita::check {

void is_on(const Problem& problem, const Output& output, const std::vector<Target>& on,
           const std::function<std::string(const Target&)>& refused) {
  if (on.empty()) fail(problem, output.origin, output.known_as() + " is on nothing");
  for (const Target& target : on) {
    target_exists(problem, output.origin, output.known_as() + " is on", target, all_supports(problem));
    const std::string hint = refused(target);
    if (!hint.empty()) fail(problem, output.origin, output.known_as() + " cannot be on " + describe(target), hint);
  }
}

void names_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes) {
  for (const std::string& suffix : suffixes)
    for (const OutputPtr& other : problem.outputs)
      if (other->name == output.name + suffix)
        fail(problem, other->origin,
             fmt::format("output '{}' would overwrite {}.csv of {}", other->name, other->name, output.known_as()));
}

void files_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes) {
  for (const std::string& suffix : suffixes) {
    const std::string file = file_name_of(output.name) + suffix;
    if (const char* what = own_file_called(file))
      fail(problem, output.origin, fmt::format("{} would overwrite {}, which is {}", output.known_as(), file, what),
           "take another name");
  }
}

void outputs(const Problem& problem) {
  for (const OutputPtr& output : problem.outputs) output->check(problem);
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      if (const OutputPtr of = load->made_of())
        listed(problem, fmt::format("{} of step '{}' is made of", load->path, step->name), *of, problem.outputs,
               "outputs");
}

}  // namespace dygita::check

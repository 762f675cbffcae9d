#include "base/names.hpp"

#include <algorithm>
#include <set>

#include "checks/parts.hpp"
#include "model/load.hpp"
#include "model/output.hpp"
#include "model/own_files.hpp"

namespace dygita::check {

namespace {

// Names become file names in the output directory.
bool is_fit_for_a_file(const std::string& name) {
  return name.front() != '.' && std::none_of(name.begin(), name.end(), [](unsigned char c) {
           return c < 0x20 || c == 0x7f || c == '/' || c == '\\';
         });
}

// Records are in UTF-8, and would name another file.
bool is_utf8(const std::string& text) {
  size_t more = 0;  // bytes of the character that are to come
  for (const unsigned char c : text) {
    const bool is_within = (c & 0xc0) == 0x80;
    if (is_within != (more > 0)) return false;
    if (is_within)
      --more;
    else if (c >= 0x80)
      more = c >= 0xc2 && c < 0xe0 ? 1 : c >= 0xe0 && c < 0xf0 ? 2 : c >= 0xf0 && c < 0xf5 ? 3 : text.size();
  }
  return more == 0;
}

// besides: characters that this kind of name may have, of which no file is called after.
void has_name(const Problem& problem, const Named& object, const std::string& what, const std::string& besides = "") {
  if (object.name.empty()) fail(problem, object.origin, what + " has no name");
  if (!is_utf8(object.name)) fail(problem, object.origin, what + ": its name is not UTF-8", "save the deck as UTF-8");
  std::string name = object.name;
  std::erase_if(name, [&](char c) { return besides.find(c) != std::string::npos; });
  if (name.empty() || !is_fit_for_a_file(name)) {
    fail(problem, object.origin, what + " '" + object.name + "': a name is used as a file name",
         "allowed: anything without '/', '\\', control characters and a '.' in front");
  }
}

template <class T>
void has_unique_names(const Problem& problem, const std::vector<std::shared_ptr<const T>>& list,
                      const std::string& what, const std::string& besides = "") {
  for (size_t i = 0; i < list.size(); ++i) {
    has_name(problem, *list[i], what, besides);
    for (size_t j = 0; j < i; ++j) {
      if (list[j] == list[i]) fail(problem, problem.origin, what + " '" + list[i]->name + "' is listed twice");
      if (list[j]->name != list[i]->name) continue;
      const Origin& first = list[j]->origin;
      fail(problem, list[i]->origin, "two " + what + "s are called '" + list[i]->name + "'",
           first.file.empty() ? "" : "the other is declared at " + first.file + ":" + std::to_string(first.line));
    }
  }
}

bool tightens_bolts(const Problem& problem) {
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (tightening(effect)) return true;
  return false;
}

// Tables are <name>.csv beside energy.csv and convergence.csv; ParaView's files and the energies come once a problem.
void outputs_keep_apart(const Problem& problem) {
  std::vector<OutputPtr> tables;
  std::set<std::string> seen;
  for (const OutputPtr& output : problem.outputs) {
    if (output->is_named) {
      if (output->name == "energy" || output->name == "convergence") {
        fail(problem, output->origin, "output '" + output->name + "' would overwrite " + output->name + ".csv",
             "'energy' and 'convergence' are the names of tables of the run itself");
      }
      if (output->name == "bolts" && tightens_bolts(problem))
        fail(problem, output->origin, "output 'bolts' would overwrite bolts.csv",
             "'bolts' is the name of the table of all tightened interfaces");
      if (output->name.ends_with(".vtu") || output->name.ends_with(".pvtu"))
        fail(problem, output->origin, "output '" + output->name + "' has the name of a frame's file",
             "the name of an output does not end with '.vtu' or '.pvtu'");
      tables.push_back(output);
    } else if (!seen.insert(output->word).second) {
      fail(problem, output->origin, "'outputs' has more than one output." + output->word);
    }
  }
  has_unique_names(problem, tables, "output");
}

}  // namespace

void names(const Problem& problem) {
  has_name(problem, problem, "the problem");
  const std::string frames = file_name_of(problem.name) + ".pvd";
  if (const char* what = own_file_called(frames))
    fail(problem, problem.origin, "the list of its frames would be " + frames + ", which is " + what,
         "take another name");
  if (problem.substructures.empty()) fail(problem, problem.origin, "'substructures' is empty");
  if (problem.steps.empty()) {
    fail(problem, problem.origin, "'steps' is empty", "at least one step.static or step.dynamic is required");
  }
  has_unique_names(problem, problem.substructures, "substructure");
  has_unique_names(problem, problem.interfaces, "interface", "/");
  has_unique_names(problem, problem.steps, "step");
  for (const StepPtr& step : problem.steps) has_unique_names(problem, supports_of(problem, *step), "support");
  has_unique_names(problem, all_supports(problem), "support");
  outputs_keep_apart(problem);
}

}  // namespace dygita::check

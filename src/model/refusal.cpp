#include "model/refusal.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/log.hpp"
#include "base/names.hpp"
#include "model/output.hpp"
#include "model/own_files.hpp"
#include "model/places.hpp"

namespace dygita::check {

void fail(const Problem& problem, const Origin& origin, const std::string& text, const std::string& hint) {
  throw InputError(origin.file.empty() ? problem.origin : origin,
                   "problem '" + problem.name + "': " + text + (hint.empty() ? "" : "\n    " + hint));
}

namespace {

std::string placed(const Problem& problem, const Origin& origin, const std::string& text) {
  return (origin.file.empty() ? problem.origin : origin).prefix() + "problem '" + problem.name + "': " + text;
}

}  // namespace

void doubt(const Problem& problem, const Origin& origin, const std::string& text) {
  warn(placed(problem, origin, text));
}

void doubt(const Problem& problem, const Origin& origin, const std::string& text, const KindOfWarning& of) {
  warn(placed(problem, origin, text), of);
}

void place_exists(const Problem& problem, const Origin& origin, const std::string& who, const FaceOrRegion& place) {
  listed(problem, who + " substructure", part_of(place), problem.substructures, "substructures");
  const Substructure& part = part_of(place);
  if (const Face* face = std::get_if<Face>(&place); face && face->picked) {
    if (face->picked->empty()) fail(problem, origin, who + " face '" + face->label() + "', which has no facet");
  } else if (face) {
    const auto found = part.mesh->faces.find(face->group);
    if (found == part.mesh->faces.end()) {
      std::vector<std::string> known;
      for (const auto& [group, facets] : part.mesh->faces) known.push_back(group);
      fail(problem, origin, who + " face '" + face->group + "', which substructure '" + part.name + "' does not have",
           did_you_mean(face->group, known));
    }
    if (found->second.empty()) fail(problem, origin, who + " face '" + face->label() + "', which has no facet");
  } else if (std::get<Region>(place).nodes.empty()) {
    fail(problem, origin, who + " a region of substructure '" + part.name + "' that has no node",
         "its function answered true for no node");
  }
}

void target_exists(const Problem& problem, const Origin& origin, const std::string& who, const Target& target,
                   const std::vector<SupportPtr>& supports) {
  if (const InterfacePtr* interface = std::get_if<InterfacePtr>(&target)) {
    listed(problem, who + " interface", **interface, problem.interfaces, "interfaces");
  } else if (const SupportPtr* support = std::get_if<SupportPtr>(&target)) {
    listed(problem, who + " support", **support, supports, "supports");
  } else {
    place_exists(problem, origin, who, *place_of(target));
  }
}

std::string why_not_listed(const Named& object, const std::vector<const Named*>& list, const std::string& list_name) {
  std::vector<std::string> known;
  for (const Named* other : list) {
    if (other->name == object.name) {
      const std::string where = other->origin.file.empty()
                                    ? ""
                                    : ", declared at " + other->origin.file + ":" + std::to_string(other->origin.line);
      return "'" + list_name + "' has another one of that name" + where + ": is one object declared twice?";
    }
    known.push_back(other->name);
  }
  return "add it to '" + list_name + "'; " + did_you_mean(object.name, known);
}

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

}  // namespace dygita::check

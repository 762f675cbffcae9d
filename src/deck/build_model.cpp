#include "deck/build_model.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/names.hpp"
#include "model/load.hpp"
#include "ranks/machine_copies.hpp"

namespace dygita {

namespace {

bool begins_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

Content build_load(const Declaration& declaration) { return make_load(declaration.arguments); }

Builder builder_of(const std::string& path) {
  if (begins_with(path, "load.")) return build_load;
  for (const Builders* builders : {&part_builders(), &history_builders(), &study_builders()}) {
    const auto found = builders->find(path);
    if (found != builders->end()) return found->second;
  }
  CHECK(false, "lua/schema.lua has '" + path + "', which nothing builds");
  return nullptr;
}

}  // namespace

Content build(const Declaration& declaration) {
  const Builder builder = builder_of(declaration.path);
  const LikePages like;
  try {
    return builder(declaration);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (begins_with(message, declaration.lua.deck_name() + ":")) throw;
    const bool names_itself = begins_with(message, declaration.path);
    throw InputError(declaration.origin, names_itself ? message : declaration.path + ": " + message);
  }
}

MeshPtr volume_of(const GmshMeshes& file, const std::string& name, const Origin& origin) {
  try {
    return file.volume(name);
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
}

Face face_of(const SubstructurePtr& part, const std::string& group, const Origin& origin) {
  const auto& faces = part->mesh->faces;
  if (faces.count(group) || part->mesh->point_groups.count(group)) return {part, group};
  std::vector<std::string> known;
  for (const auto& [name, nodes] : part->mesh->point_groups) known.push_back(name);
  for (const auto& [name, facets] : faces) known.push_back(name);
  if (!part->mesh->has_cells())
    throw InputError(origin, fmt::format("superelement '{}' was condensed without face '{}'\n    {}", part->name, group,
                                         did_you_mean(group, known)));
  throw InputError(origin, fmt::format("substructure '{}' has no face '{}' in its mesh\n    {}", part->name, group,
                                       did_you_mean(group, known)));
}

}  // namespace dygita

#include "deck/build_model.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/names.hpp"

namespace dygita {

namespace {

Builder builder_of(const std::string& path) {
  for (const Builders* builders : {&part_builders(), &load_builders(), &study_builders()}) {
    const auto found = builders->find(path);
    if (found != builders->end()) return found->second;
  }
  CHECK(false, "lua/schema.lua has '" + path + "', which nothing builds");
  return nullptr;
}

bool begins_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

}  // namespace

Content build(const Declaration& declaration) {
  const Builder builder = builder_of(declaration.path);
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
  if (faces.count(group)) return {part, group};
  std::vector<std::string> known;
  for (const auto& [name, facets] : faces) known.push_back(name);
  throw InputError(origin, fmt::format("substructure '{}' has no face '{}' in its mesh\n    {}", part->name, group,
                                       did_you_mean(group, known)));
}

}  // namespace dygita

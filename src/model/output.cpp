#include "model/output.hpp"

#include "model/arguments.hpp"

namespace dygita {

Output::Output(const ModelArguments& arguments)
    : Named{arguments.has("name") ? arguments.text("name") : arguments.word(), arguments.origin()},
      word(arguments.word()),
      is_named(arguments.has("name")) {}

void note_targets(const std::vector<Target>& on, Notes& notes) {
  std::vector<std::string> labels;
  for (const Target& target : on) labels.push_back(label(target));
  if (!labels.empty()) notes.push_back({"on", std::move(labels)});
}

void note_direction(const std::optional<Vec3>& direction, Notes& notes) {
  if (direction) notes.push_back({"direction", std::vector<double>(direction->begin(), direction->end())});
}

std::string Output::known_as() const { return "output." + word + " '" + name + "'"; }

}  // namespace dygita

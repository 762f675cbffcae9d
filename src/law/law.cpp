#include "law/law.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "law/law_arguments.hpp"

namespace dygita {

LawPtr example_of(const LawEntry& entry) {
  LawArguments arguments;
  for (const std::string& name : entry.arguments)
    if (!is_optional(name)) arguments[name] = 1.0;
  return entry.make(arguments);
}

LawPtr make_law(const std::string& word, const LawArguments& arguments) {
  const auto entry =
      std::find_if(law_table().begin(), law_table().end(), [&](const LawEntry& e) { return e.word == word; });
  CHECK(entry != law_table().end(), "no file of src/law/laws makes the law '" + word + "'");
  const auto takes = [&](const std::string& name) {
    return std::find(entry->arguments.begin(), entry->arguments.end(), name) != entry->arguments.end();
  };
  for (const auto& [name, value] : arguments)
    CHECK(takes(name) || takes(name + "?") || takes(name.substr(0, name.find('[')) + "[]"),
          "law '" + word + "' takes other arguments than '" + name + "'");
  for (const std::string& name : entry->arguments)
    CHECK(is_optional(name) || arguments.contains(name), "law '" + word + "' has not been given '" + name + "'");
  return entry->make(arguments);
}

double friction_of(const Law& law) {
  for (const LawParameter& parameter : law.parameters())
    if (parameter.name == "friction") return std::get<double>(parameter.value);
  return 0.0;
}

}  // namespace dygita

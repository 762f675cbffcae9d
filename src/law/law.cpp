#include "law/law.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace dygita {

LawPtr example_of(const LawEntry& entry) {
  LawArguments arguments;
  for (const std::string& name : entry.arguments) arguments[name] = 1.0;
  return entry.make(arguments);
}

LawPtr make_law(const std::string& word, const LawArguments& arguments) {
  const auto entry =
      std::find_if(law_table().begin(), law_table().end(), [&](const LawEntry& e) { return e.word == word; });
  CHECK(entry != law_table().end(), "no file of src/law/laws makes the law '" + word + "'");
  CHECK(arguments.size() == entry->arguments.size(), "law '" + word + "' takes other arguments");
  for (const std::string& name : entry->arguments)
    CHECK(arguments.contains(name), "law '" + word + "' has not been given '" + name + "'");
  return entry->make(arguments);
}

}  // namespace dygita

#include "model/support.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "law/law.hpp"

namespace dygita {

SupportKindPtr example_of(const SupportEntry& entry) {
  LawArguments arguments;
  for (const std::string& name : entry.arguments) arguments[name] = 1.0;
  return entry.make(arguments);
}

SupportKindPtr make_support(const std::string& word, const LawArguments& arguments) {
  const std::vector<SupportEntry>& table = support_table();
  const auto entry = std::find_if(table.begin(), table.end(), [&](const SupportEntry& e) { return e.word == word; });
  CHECK(entry != table.end(), "no file of src/model/supports makes the support '" + word + "'");
  CHECK(arguments.size() == entry->arguments.size(), "support '" + word + "' takes other arguments");
  for (const std::string& name : entry->arguments)
    CHECK(arguments.contains(name), "support '" + word + "' has not been given '" + name + "'");
  return entry->make(arguments);
}

}  // namespace dygita

#include "base/name_list.hpp"

namespace dygita {

std::string list_of_names(const std::vector<std::string>& names) {
  constexpr size_t shown = 6;
  const size_t n = names.size() > shown + 1 ? shown : names.size();
  std::string text;
  for (size_t i = 0; i < n; ++i) text += (i > 0 ? ", '" : "'") + names[i] + "'";
  return n < names.size() ? text + " and " + std::to_string(names.size() - n) + " more" : text;
}

}  // namespace dygita

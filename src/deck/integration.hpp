// The words for how a substructure is integrated.
#pragma once

#include "model/model.hpp"

namespace dygita {

// Of "implicit", "automatic" and "explicit".
inline IntegrationChoice integration_of(const std::string& word) {
  if (word == "explicit") return IntegrationChoice::explicitly;
  return word == "automatic" ? IntegrationChoice::as_cheapest : IntegrationChoice::implicitly;
}

}  // namespace dygita

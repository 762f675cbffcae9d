// What a deck says of a material.
#pragma once

#include <optional>

#include "material/elastic.hpp"

namespace dygita {

struct Material : Elastic {
  std::optional<double> yield;  // Pa, von Mises: what margins refer to; the material stays elastic beyond it
};

}  // namespace dygita

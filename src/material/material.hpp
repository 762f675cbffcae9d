// What a deck says of a material, and every kind of it there is.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "material/elastic.hpp"

namespace dygita {

struct Material : Elastic {
  std::optional<double> yield;  // Pa, von Mises: what margins refer to; the material stays elastic beyond it
};

// Numbers by the names of the deck, SI.
using MaterialNumbers = std::map<std::string, double>;

struct MaterialEntry {
  std::string word;                    // "elastic" of material.elastic
  std::vector<std::string> arguments;  // numbers, beside the density
  // With every argument and "density". Throws InputError where they contradict each other.
  std::function<Elastic(const MaterialNumbers&)> make;
};

// Every kind there is: one entry for each file of materials/, in the order of their names. CMake writes this function.
const std::vector<MaterialEntry>& material_table();

}  // namespace dygita

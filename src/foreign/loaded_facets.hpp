// Facets that a card loads by lists of cells: what is said twice of one adds up, as in CalculiX.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "foreign/cards.hpp"
#include "foreign/foreign_model.hpp"

namespace dygita {

class LoadedFacets {
 public:
  // Facets of one value, and the line of the first of them.
  struct Alike {
    double value;
    const DataLine* line;
    std::vector<ForeignFacet> facets;
  };

  void add(const ForeignFacet& facet, double value, const DataLine& line);
  // In the order of the values' first facets.
  std::vector<Alike> by_value() const;

 private:
  struct Loaded {
    ForeignFacet facet;
    double value;
    const DataLine* line;
  };
  std::vector<Loaded> all_;
  std::map<std::pair<int, std::array<int, 4>>, size_t> known_;
};

}  // namespace dygita

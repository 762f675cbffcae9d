#include "foreign/loaded_facets.hpp"

namespace dygita {

void LoadedFacets::add(const ForeignFacet& facet, double value, const DataLine& line) {
  const auto [at, is_new] = known_.try_emplace({facet.cell, facet.corners}, all_.size());
  if (is_new)
    all_.push_back({facet, value, &line});
  else
    all_[at->second].value += value;
}

std::vector<LoadedFacets::Alike> LoadedFacets::by_value() const {
  std::vector<Alike> alike;
  std::map<double, size_t> known;
  for (const auto& [facet, value, line] : all_) {
    const auto [at, is_new] = known.try_emplace(value, alike.size());
    if (is_new) alike.push_back({value, line, {}});
    alike[at->second].facets.push_back(facet);
  }
  return alike;
}

}  // namespace dygita

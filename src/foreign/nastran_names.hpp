// Names that preprocessors write into the comments of a Nastran file: HyperMesh, Femap, Patran, ANSA, Simcenter.
#pragma once

#include <map>
#include <string>

#include "foreign/bulk_cards.hpp"

namespace dygita {

struct NastranNames {
  std::map<long, std::string> properties, materials, sets;
  std::map<long, int> kinds_of_sets;  // 1: nodes, 2: elements, as HyperMesh says
};

NastranNames nastran_names(const BulkFile& file);

}  // namespace dygita

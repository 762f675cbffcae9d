#include "foreign/abaqus_cells.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace dygita {

namespace {

using FaceCorners = std::vector<std::vector<int>>;

const FaceCorners hexahedron = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
const FaceCorners tetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
// Nodes 2 and 3 of the file are 2 and 1 here: its first triangle turns the other way (mesh/cell_shape.hpp).
const FaceCorners prism = {{0, 2, 1}, {3, 4, 5}, {0, 3, 5, 2}, {2, 5, 4, 1}, {1, 4, 3, 0}};

std::vector<int> as_they_come(int n) {
  std::vector<int> order;
  for (int a = 0; a < n; ++a) order.push_back(a);
  return order;
}

const std::vector<AbaqusCell>& abaqus_cells() {
  static const std::vector<AbaqusCell> cells = {
      {"C3D4", CellType::tet4, as_they_come(4), tetrahedron},
      {"C3D6", CellType::prism6, {0, 2, 1, 3, 5, 4}, prism},
      {"C3D8", CellType::hex8, as_they_come(8), hexahedron},
      {"C3D10", CellType::tet10, as_they_come(10), tetrahedron},
      {"C3D15", CellType::prism15, {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13}, prism},
      {"C3D20", CellType::hex20, as_they_come(20), hexahedron},
  };
  return cells;
}

}  // namespace

const AbaqusCell* abaqus_cell(const std::string& type, std::string& suffix) {
  const size_t end = std::min(type.find_last_of("0123456789") + 1, type.size());
  suffix = type.substr(end);
  if (suffix.find_first_not_of("RIHM") != std::string::npos) return nullptr;
  for (const AbaqusCell& cell : abaqus_cells())
    if (type.substr(0, end) == cell.name) return &cell;
  return nullptr;
}

std::string abaqus_cell_names() {
  std::string names;
  for (const AbaqusCell& cell : abaqus_cells()) names += (names.empty() ? "" : ", ") + std::string(cell.name);
  return names;
}

const AbaqusCell& abaqus_cell_of(CellType type) {
  const auto& all = abaqus_cells();
  const auto found = std::find_if(all.begin(), all.end(), [&](const AbaqusCell& one) { return one.type == type; });
  CHECK(found != all.end(), "cells of a file are of types that its reader knows");
  return *found;
}

bool is_between_points(const std::string& type) {
  for (const char* name : {"MASS", "ROTARYI", "SPRING", "DASHPOT", "GAP", "CONN", "DCOUP", "KCOUP", "ITS", "JOINTC"})
    if (type.starts_with(name)) return true;
  return false;
}

}  // namespace dygita

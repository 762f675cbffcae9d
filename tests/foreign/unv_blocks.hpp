// Blocks of every solid element as a universal file has them, from the order of nodes in the description of dataset
// 2412: nothing here comes from the program's own tables.
#pragma once

#include <cstdio>

#include "foreign/abaqus_blocks.hpp"

namespace dygita {

struct UnvShape {
  int descriptor, of_facets;  // types of elements
  AbaqusShape shape;
  std::vector<std::array<int, 2>> sequence;  // corners {1, 1}, and nodes between two
};

inline std::vector<UnvShape> unv_shapes() {
  const std::vector<AbaqusShape> plain = abaqus_shapes();
  const auto corners = [](int n) {
    std::vector<std::array<int, 2>> sequence;
    for (int a = 1; a <= n; ++a) sequence.push_back({a, a});
    return sequence;
  };
  return {{115, 94, plain[0], corners(8)},
          {116, 95, plain[1], {{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 4}, {4, 4}, {4, 1}, {1, 5}, {2, 6},
                               {3, 7}, {4, 8}, {5, 5}, {5, 6}, {6, 6}, {6, 7}, {7, 7}, {7, 8}, {8, 8}, {8, 5}}},
          {112, 91, plain[2], corners(6)},
          {113,
           92,
           plain[3],
           {{1, 1},
            {1, 2},
            {2, 2},
            {2, 3},
            {3, 3},
            {3, 1},
            {1, 4},
            {2, 5},
            {3, 6},
            {4, 4},
            {4, 5},
            {5, 5},
            {5, 6},
            {6, 6},
            {6, 4}}},
          {111, 41, plain[4], corners(4)},
          {118, 42, plain[5], {{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}, {4, 4}}}};
}

inline std::string unv_line(const std::vector<int>& numbers) {
  std::string text;
  char field[24];
  for (const int number : numbers) {
    std::snprintf(field, sizeof field, "%10d", number);
    text += field;
  }
  return text + "\n";
}

inline std::string unv_dataset(int number, const std::string& lines) {
  return "    -1\n" + std::to_string(number) + "\n" + lines + "    -1\n";
}

inline std::string unv_units(double factor) {
  char text[160];
  std::snprintf(text, sizeof text, "%25.16E%25.16E%25.16E\n%25.16E\n", factor, 1.0, 1.0, 273.15);
  std::string lines = unv_line({5}) + text;
  std::replace(lines.begin(), lines.end(), 'E', 'D');
  return unv_dataset(164, lines);
}

inline std::string unv_node(int number, const std::array<double, 3>& x) {
  char text[160];
  std::snprintf(text, sizeof text, "%25.16E%25.16E%25.16E\n", x[0], x[1], x[2]);
  return unv_line({number, 1, 1, 11}) + text;
}

inline std::string unv_element(int number, int descriptor, const std::vector<int>& nodes) {
  std::string text = unv_line({number, descriptor, 1, 1, 7, static_cast<int>(nodes.size())});
  for (size_t i = 0; i < nodes.size(); i += 8)
    text += unv_line(
        {nodes.begin() + static_cast<long>(i), nodes.begin() + static_cast<long>(std::min(i + 8, nodes.size()))});
  return text;
}

// Entities: pairs of a kind (7: nodes, 8: elements) and a number.
inline std::string unv_group(int number, const std::string& name, const std::vector<std::array<int, 2>>& entities) {
  std::string text = unv_line({number, 0, 0, 0, 0, 0, 0, static_cast<int>(entities.size())}) + name + "\n";
  for (size_t i = 0; i < entities.size(); i += 2) {
    std::vector<int> line = {entities[i][0], entities[i][1], 0, 0};
    if (i + 1 < entities.size()) line.insert(line.end(), {entities[i + 1][0], entities[i + 1][1], 0, 0});
    text += unv_line(line);
  }
  return text;
}

// In millimetres: cells in the group "block", facets of its top in "TOP", nodes on x = 0, y = 0, z = 0 in "X0", ...
inline std::string unv_block(const UnvShape& of, int n) {
  const AbaqusBlock block(of.shape, n);
  std::string nodes, elements, groups;
  for (const auto& [number, x] : block.places()) nodes += unv_node(number, x);
  std::vector<std::array<int, 2>> solids, top;
  std::map<std::array<int, 2>, int> middle;  // between nodes of the file
  int last = 0;
  for (const AbaqusBlock::Cell& cell : block.cells()) {
    for (size_t e = 0; e < of.shape.edges.size(); ++e) {
      const auto& [a, b] = of.shape.edges[e];
      const int one = cell.numbers[static_cast<size_t>(a)], other = cell.numbers[static_cast<size_t>(b)];
      middle[{std::min(one, other), std::max(one, other)}] =
          cell.numbers[1 + static_cast<size_t>(of.shape.n_corners) + e];
    }
    std::vector<int> numbers;
    for (const auto& [a, b] : of.sequence) {
      const int one = cell.numbers[static_cast<size_t>(a)], other = cell.numbers[static_cast<size_t>(b)];
      numbers.push_back(a == b ? one : middle.at({std::min(one, other), std::max(one, other)}));
    }
    elements += unv_element(cell.numbers[0], of.descriptor, numbers);
    solids.push_back({8, cell.numbers[0]});
    last = std::max(last, cell.numbers[0]);
  }
  for (const AbaqusBlock::TopFacet& facet : block.top()) {
    std::vector<int> numbers;
    for (size_t a = 0; a < facet.corners.size(); ++a) {
      const int one = facet.corners[a], other = facet.corners[(a + 1) % facet.corners.size()];
      numbers.push_back(one);
      if (!of.shape.edges.empty()) numbers.push_back(middle.at({std::min(one, other), std::max(one, other)}));
    }
    elements += unv_element(++last, of.of_facets, numbers);
    top.push_back({8, last});
  }
  groups += unv_group(1, "block", solids) + unv_group(2, "TOP", top);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::array<int, 2>> on;
    for (const auto& [number, x] : block.places())
      if (std::abs(x[static_cast<size_t>(axis)]) < 1e-9) on.push_back({7, number});
    groups += unv_group(3 + axis, std::string(1, "XYZ"[axis]) + "0", on);
  }
  return unv_dataset(151, "a header\n") + unv_units(1000.0) + unv_dataset(2411, nodes) + unv_dataset(2412, elements) +
         unv_dataset(2467, groups);
}

}  // namespace dygita

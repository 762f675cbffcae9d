// Blocks of every solid element as an .inp has them, from the coordinates that the manuals of Abaqus and CalculiX give
// for nodes and faces: nothing here comes from the program's own tables.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace dygita {

struct AbaqusShape {
  std::string type;
  int n_corners;
  std::vector<std::array<int, 2>> edges;  // of each further node, its two corners; numbers from 1
  std::vector<std::vector<int>> faces;    // S1, S2, ...: corners
};

inline std::vector<AbaqusShape> abaqus_shapes() {
  const std::vector<std::array<int, 2>> hexahedron = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7},
                                                      {7, 8}, {8, 5}, {1, 5}, {2, 6}, {3, 7}, {4, 8}};
  const std::vector<std::array<int, 2>> prism = {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6},
                                                 {6, 4}, {1, 4}, {2, 5}, {3, 6}};
  const std::vector<std::array<int, 2>> tetrahedron = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
  const std::vector<std::vector<int>> of_hexahedron = {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2},
                                                       {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};
  const std::vector<std::vector<int>> of_prism = {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}};
  const std::vector<std::vector<int>> of_tetrahedron = {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}};
  return {{"C3D8", 8, {}, of_hexahedron},  {"C3D20", 8, hexahedron, of_hexahedron},
          {"C3D6", 6, {}, of_prism},       {"C3D15", 6, prism, of_prism},
          {"C3D4", 4, {}, of_tetrahedron}, {"C3D10", 4, tetrahedron, of_tetrahedron}};
}

// n^3 cubes of 10 in a block, their inner corners moved, each filled with elements of one shape. Sets of all elements
// ("E"), of nodes on x = 0, y = 0, z = 0 ("X0", "Y0", "Z0"), and the surface of facets on the top ("TOP").
class AbaqusBlock {
 public:
  AbaqusBlock(const AbaqusShape& shape, int n) : shape_(shape), n_(n) {
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) fill({i, j, k});
  }

  struct Cell {
    std::vector<int> numbers;  // its own, its nodes
  };
  struct TopFacet {
    int cell;                          // its number
    std::vector<int> corners, others;  // on the facet in turn, and off it
  };
  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<TopFacet>& top() const { return top_facets_; }
  const std::map<int, std::array<double, 3>>& places() const { return places_; }

  std::string text() const {
    std::ostringstream text;
    text << "*NODE, NSET=ALL\n";
    text.precision(17);
    for (const auto& [number, x] : places_) text << number << ", " << x[0] << ", " << x[1] << ", " << x[2] << "\n";
    text << "*ELEMENT, TYPE=" << shape_.type << ", ELSET=E\n" << elements_.str();
    for (int axis = 0; axis < 3; ++axis) {
      text << "*NSET, NSET="
           << "XYZ"[axis] << "0\n";
      for (const auto& [number, x] : places_)
        if (std::abs(x[static_cast<size_t>(axis)]) < 1e-9) text << number << ",\n";
    }
    text << "*SURFACE, NAME=TOP, TYPE=ELEMENT\n" << top_.str();
    return text.str();
  }

 private:
  using Corner = std::array<int, 3>;
  using Place = std::array<double, 3>;

  // Inner corners are off the grid; those on the block's planes stay in them.
  Place place(const Corner& c) const {
    Place x{};
    for (size_t d = 0; d < 3; ++d) {
      const bool is_inner = c[d] > 0 && c[d] < n_;
      x[d] =
          10.0 * c[d] +
          (is_inner ? 1.5 * std::sin(1.0 + 3.0 * c[0] + 5.0 * c[1] + 7.0 * c[2] + 2.0 * static_cast<double>(d)) : 0.0);
    }
    return x;
  }

  int number(const Place& x) {
    std::array<long, 3> key{};
    for (size_t d = 0; d < 3; ++d) key[d] = std::lround(1e6 * x[d]);
    const auto [known, is_new] = numbers_.emplace(key, 7 + 3 * static_cast<int>(numbers_.size()));
    if (is_new) places_[known->second] = x;
    return known->second;
  }

  void fill(const Corner& at) {
    std::vector<Corner> cube;
    for (const Corner& step :
         {Corner{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
      cube.push_back({at[0] + step[0], at[1] + step[1], at[2] + step[2]});
    const std::map<int, std::vector<std::vector<int>>> cuts = {
        {8, {{1, 2, 3, 4, 5, 6, 7, 8}}},
        {6, {{1, 2, 3, 5, 6, 7}, {1, 3, 4, 5, 7, 8}}},
        {4, {{1, 2, 3, 7}, {1, 3, 4, 7}, {1, 4, 8, 7}, {1, 8, 5, 7}, {1, 5, 6, 7}, {1, 6, 2, 7}}}};
    for (const std::vector<int>& cut : cuts.at(shape_.n_corners)) {
      std::vector<Place> corners;
      for (const int corner : cut) corners.push_back(place(cube[static_cast<size_t>(corner) - 1]));
      add(corners);
    }
  }

  void add(const std::vector<Place>& corners) {
    const int own = 100 + 2 * n_elements_++;
    std::vector<int> numbers = {own};
    for (const Place& x : corners) numbers.push_back(number(x));
    for (const auto& edge : shape_.edges) {
      const Place &a = corners[static_cast<size_t>(edge[0]) - 1], &b = corners[static_cast<size_t>(edge[1]) - 1];
      numbers.push_back(number({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}));
    }
    cells_.push_back({numbers});
    constexpr size_t on_a_line = 12;
    for (size_t i = 0; i < numbers.size(); ++i)
      elements_ << numbers[i] << (i + 1 == numbers.size() ? "\n" : i % on_a_line == on_a_line - 1 ? ",\n " : ", ");
    for (size_t k = 0; k < shape_.faces.size(); ++k) {
      bool is_on_top = true;
      for (const int corner : shape_.faces[k])
        is_on_top = is_on_top && std::abs(corners[static_cast<size_t>(corner) - 1][2] - 10.0 * n_) < 1e-9;
      if (!is_on_top) continue;
      top_ << own << ", S" << k + 1 << "\n";
      TopFacet facet{own, {}, {}};
      for (const int corner : shape_.faces[k]) facet.corners.push_back(numbers[static_cast<size_t>(corner)]);
      for (int a = 1; a <= shape_.n_corners; ++a)
        if (std::find(shape_.faces[k].begin(), shape_.faces[k].end(), a) == shape_.faces[k].end())
          facet.others.push_back(numbers[static_cast<size_t>(a)]);
      top_facets_.push_back(facet);
    }
  }

  AbaqusShape shape_;
  int n_, n_elements_ = 0;
  std::map<std::array<long, 3>, int> numbers_;
  std::map<int, Place> places_;
  std::ostringstream elements_, top_;
  std::vector<Cell> cells_;
  std::vector<TopFacet> top_facets_;
};

}  // namespace dygita

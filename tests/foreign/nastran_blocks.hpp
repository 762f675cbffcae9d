// Blocks of every solid element as a Nastran file has them, from the order of nodes in the Quick Reference Guide:
// nothing here comes from the program's own tables.
#pragma once

#include <cstdio>
#include <numbers>

#include "foreign/abaqus_blocks.hpp"

namespace dygita {

struct NastranShape {
  const char* name;
  AbaqusShape shape;  // edges in Nastran's order
};

inline std::vector<NastranShape> nastran_shapes() {
  const std::vector<AbaqusShape> plain = abaqus_shapes();
  const AbaqusShape &hexahedron = plain[0], &prism = plain[2], &tetrahedron = plain[4];
  AbaqusShape hexahedron_20 = hexahedron, prism_15 = prism, tetrahedron_10 = tetrahedron;
  hexahedron_20.edges = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 6},
                         {3, 7}, {4, 8}, {5, 6}, {6, 7}, {7, 8}, {8, 5}};
  prism_15.edges = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5}, {3, 6}, {4, 5}, {5, 6}, {6, 4}};
  tetrahedron_10.edges = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
  return {{"CHEXA", hexahedron}, {"CHEXA", hexahedron_20}, {"CPENTA", prism},
          {"CPENTA", prism_15},  {"CTETRA", tetrahedron},  {"CTETRA", tetrahedron_10}};
}

// A card in free, small or large fields, with its continuations.
inline std::string nastran_card(const std::string& name, const std::vector<std::string>& fields, int format) {
  std::string text;
  const size_t n = format == 2 ? 4 : 8;
  for (size_t i = 0; i < fields.size() || i == 0; i += n) {
    const std::string first = i == 0 ? name + (format == 2 ? "*" : "") : format == 2 ? "*" : "+";
    text += format == 0 ? first : (first + std::string(8, ' ')).substr(0, 8);
    for (size_t a = i; a < std::min(i + n, fields.size()); ++a)
      text += format == 0 ? "," + fields[a] : std::string((format == 2 ? 16 : 8) - fields[a].size(), ' ') + fields[a];
    text += "\n";
  }
  return text;
}

inline std::string nastran_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9E", value);
  return text;
}

// A block on rollers at x = 0, y = 0, z = 0, pressed with 100 from above. Nodes are given in turns in the file's own
// system, in a cylinder (7) and in a box that is turned and moved (8), and held in the axes of the latter.
class NastranBlock {
 public:
  NastranBlock(const NastranShape& shape, int n) : shape_(shape), block_(shape.shape, n) {}

  std::string text() const {
    std::string text = "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nPSOLID,1,1\nMAT1,1,2.+5,,0.3,8.-9\n" + systems();
    int i = 0;
    for (const auto& [number, x] : block_.places()) text += grid(number, x, i++);
    for (const auto& cell : block_.cells()) {
      std::vector<std::string> fields = {std::to_string(cell.numbers[0]), "1"};
      for (size_t a = 1; a < cell.numbers.size(); ++a) fields.push_back(std::to_string(cell.numbers[a]));
      text += nastran_card(shape_.name, fields, i++ % 3);
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      std::vector<std::string> nodes = {"1", std::to_string((axis + 2) % 3 + 1)};  // axis 1 of system 8 is y
      for (const auto& [number, x] : block_.places())
        if (std::abs(x[axis]) < 1e-9) nodes.push_back(std::to_string(number));
      text += nastran_card("SPC1", nodes, static_cast<int>(axis));
    }
    for (const auto& facet : block_.top()) {
      const bool is_tetrahedron = shape_.shape.n_corners == 4;
      const std::string opposite = is_tetrahedron              ? std::to_string(facet.others[0])
                                   : facet.corners.size() == 3 ? ""
                                                               : std::to_string(facet.corners[2]);
      text += nastran_card(
          "PLOAD4", {"2", std::to_string(facet.cell), "100.", "", "", "", std::to_string(facet.corners[0]), opposite},
          i++ % 3);
    }
    return text + "ENDDATA\n";
  }

 private:
  // System 7: a cylinder about the z axis through (-40, -50, 0). System 8: its axes 1, 2, 3 are y, z, x; at (3, 4, 5).
  static std::string systems() {
    return "CORD2C,7,,-40.,-50.,0.,-40.,-50.,1.\n+,-39.,-50.,0.\n" +
           nastran_card("CORD2R", {"8", "", "3.", "4.", "5.", "4.", "4.", "5.", "3.", "5.", "5."}, 1);
  }

  static std::string grid(int number, const std::array<double, 3>& x, int i) {
    std::array<double, 3> given = x;
    std::string system;
    if (i % 3 == 1) {
      const double dx = x[0] + 40, dy = x[1] + 50;
      given = {std::hypot(dx, dy), std::atan2(dy, dx) * 180 / std::numbers::pi, x[2]};
      system = "7";
    }
    if (i % 3 == 2) {
      given = {x[1] - 4, x[2] - 5, x[0] - 3};
      system = "8";
    }
    return nastran_card("GRID",
                        {std::to_string(number), system, nastran_number(given[0]), nastran_number(given[1]),
                         nastran_number(given[2]), "8"},
                        i % 2 == 0 ? 2 : 0);
  }

  NastranShape shape_;
  AbaqusBlock block_;
};

}  // namespace dygita

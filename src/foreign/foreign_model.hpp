// What a file of another program says of meshes, the same whichever program it is; and the parts made of it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "intake/step_assembly.hpp"
#include "mesh/cut_mesh.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

struct ForeignCell {
  CellType type;
  int first;       // of its nodes in the connectivity
  int group = -1;  // of ForeignModel::groups
  int file, line;  // where it is declared
  long number;     // in the file
};

// Facets by their corners; -1: of a facet with three.
struct ForeignFacet {
  int cell;
  std::array<int, 4> corners;
};

// What makes cells one part, as far as they are connected.
struct ForeignGroup {
  std::string name;                   // of its parts
  std::string material, orientation;  // names; empty: none
  std::string instance;               // empty: the file has none
};

struct ForeignSet {
  std::string name;
  std::vector<int> nodes;
};

struct ForeignFace {
  std::string name;
  std::vector<ForeignFacet> facets;
  std::string where;  // "plate.inp:45"
};

// In the units of the file.
struct ForeignMaterial {
  std::string name, where;
  std::string word;                      // "elastic" or "orthotropic"; empty: no elasticity
  std::map<std::string, double> moduli;  // stresses, by the names of that word
  std::map<std::string, double> ratios;
  std::optional<double> density;
  std::optional<double> expansion;  // 1/K, where it is one number
  double mass_damping = 0.0, stiffness_damping = 0.0;
  std::string doubt;  // why it is not the material of the file: "depends on temperature (plate.inp:12)"
};

// Engineering constants e1, e2, e3, nu12, nu13, nu23, g12, g13, g23 of an orthotropic material.
void set_constants(const std::vector<double>& constants, ForeignMaterial& material);
// Of stiffnesses D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323; a doubt where they are not positive
// definite.
void set_stiffnesses(const std::string& where, const std::vector<double>& d, ForeignMaterial& material);

struct ForeignModel {
  std::string file;
  // What the file calls elasticity and density, for messages.
  const char *elasticity = "*ELASTIC", *density = "*DENSITY";
  std::vector<std::string> files;  // with those that it includes
  std::vector<Vec3> nodes;         // m
  std::vector<int> connectivity;   // nodes of cells, in the order of their types
  std::vector<ForeignCell> cells;
  std::vector<ForeignGroup> groups;
  std::vector<ForeignSet> node_sets;
  std::vector<ForeignFace> surfaces;
  std::vector<ForeignMaterial> materials;
  std::vector<std::string> told;    // what is read as something else, for the user at once
  std::vector<std::string> unused;  // what is not used, line by line

  const int* nodes_of(const ForeignCell& cell) const { return connectivity.data() + cell.first; }
  std::string where(const ForeignCell& cell) const;
};

struct ForeignPart : StepPart {
  int group = -1;
  std::vector<int> file_nodes;                      // the model's number of each node, increasing
  std::map<std::string, std::vector<int>> regions;  // nodes of the part by the names of sets
  std::string cut_from, cut_by;                     // of a half: the part and its surface; which half: is_second
  bool is_second = false;
  std::map<std::string, std::vector<InnerFacet>> inner_surfaces;  // by which mesh:cut divides it
};

// Sets of nodes of a part as far as a half of it has them.
std::map<std::string, std::vector<int>> regions_of_half(const std::map<std::string, std::vector<int>>& regions,
                                                        const MeshHalf& half);

// The connected cells of each group: one part, or several that are called name[1], name[2], ...
// Faces: surfaces, and sets that have all nodes of facets on the boundary, unless a surface has their name. Throws
// InputError with the line of a cell that is inverted, flat or doubled. Adds to `told`.
std::vector<ForeignPart> parts_of(ForeignModel& model);

}  // namespace dygita

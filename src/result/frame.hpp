// One frame for ParaView: the fields asked for of every substructure and of every interface at one instant.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace dygita {

struct NamedField {
  std::string name;  // "displacement", "pressure", ...
  Mat values;        // n_components x n_nodes, SI; 6 components: xx yy zz xy yz zx
};

struct PartFrame {
  const Substructure* part = nullptr;
  Points displacement;             // 3 x n_nodes, always there
  std::vector<NamedField> fields;  // as asked for, displacement among them if asked
  // Of a part that several ranks have: they, increasing, and whose cells these are; those cells, with the nodes that
  // they have; of these nodes, which belong to this rank. Elsewhere empty: the part's own mesh, all of it.
  std::vector<int> ranks{};
  int rank = 0;
  MeshPtr cells{};
  std::vector<char> is_own{};

  const Mesh& mesh() const { return cells ? *cells : *part->mesh; }
  bool is_in_pieces() const { return !ranks.empty(); }
};

// Interface (or wall) surface: points are the interface's own.
struct InterfaceFrame {
  std::string name;
  Points points;              // 3 x n, undeformed
  std::vector<Facet> facets;  // node numbers into `points`
  std::vector<NamedField>
      fields;  // pressure gap slip friction_traction plastic_opening state displacement constitutive_error
};

struct Frame {
  double time = 0.0;        // s, of the whole run; static increments stand still, see `label_time`
  double label_time = 0.0;  // strictly increasing over the frames of a run: what the .pvd carries
  std::string step;
  bool converged = true;  // the increment that ends there
  int missed = 0;         // increments up to there, of all steps, that have not converged
  std::vector<PartFrame> parts;
  std::vector<InterfaceFrame> interfaces;
};

}  // namespace dygita

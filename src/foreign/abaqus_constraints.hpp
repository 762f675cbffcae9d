// Equations between nodes, nodes that stay on a plane or a line, and springs between nodes that no cell need have.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "foreign/abaqus_model.hpp"
#include "foreign/file_actions.hpp"

namespace dygita {

// Along each of some axes, the sum of factors times the mean displacements of sets of nodes is zero; along none of
// them, one sum of terms that have axes of their own.
struct AbaqusEquation {
  struct Term {
    std::string place;
    double factor;
    Vec3 along = Vec3::Zero();
  };
  std::vector<Term> terms;
  std::array<bool, 3> along = {};
  std::string where;
  bool has_axes() const { return along[0] || along[1] || along[2]; }
};

// Adds a set for nodes that a card lists by numbers, called by its line: "boundary 45".
std::string place_of(ForeignModel& model, const std::string& prefix, const DataLine& line, std::vector<int> nodes);

class AbaqusConstraints {
 public:
  explicit AbaqusConstraints(AbaqusModel& model);

  // *EQUATION, *MPC, *SPRING or *DASHPOT. turned: axes of the nodes of *TRANSFORM. Throws InputError with the line.
  void read(const PlacedCard& placed, const std::map<int, Mat3>& turned);
  // Ends of springs that are of no cell are no nodes of a deck: what is held of them is the ground. Are these all such?
  bool hold_ends(const std::array<double, 6>& says, const std::vector<int>& nodes);
  // The springs, once everything is read.
  void finish(std::vector<FileSpring>& springs, std::vector<std::string>& untranslated);

  std::vector<AbaqusEquation> equations;

 private:
  // Terms of one equation: nodes by their factor.
  struct Terms {
    int axis = -1;
    std::map<double, std::vector<int>> nodes;
    bool operator==(const Terms& other) const { return nodes == other.nodes; }
  };
  struct Spring {
    std::string where;
    const DataLine* line;
    int one, other;
    double stiffness, damping;
  };
  using Given = std::vector<std::pair<const DataLine*, std::string>>;

  void find_loose_ends();
  void read_equations(const PlacedCard& placed);
  void add_equation(const PlacedCard& placed, const DataLine& first, const Given& given, Terms& last);
  void add_along_axes(const DataLine& first, const std::map<int, Vec3>& of_nodes);
  bool note_end(const Terms& terms);
  void read_spring(const PlacedCard& placed);
  int end_of(const PlacedCard& placed, LineFields& fields) const;
  void add_spring(const Spring& spring, std::vector<FileSpring>& springs);
  void read_constraints(const PlacedCard& placed);
  void follow(const FileCard& card, int node, const std::vector<std::pair<int, double>>& others,
              const std::vector<Vec3>& along);
  void keep_straight(const FileCard& card, const std::vector<int>& nodes);
  void keep_plane(const FileCard& card, const std::vector<int>& nodes);

  AbaqusModel& model_;
  const CardFile& file_;
  std::map<int, Mat3> turned_;  // axes of nodes
  std::set<int> loose_ends_;
  std::map<int, std::array<bool, 3>> held_ends_;
  std::map<std::pair<int, int>, std::vector<int>> ends_as_means_;  // by node and axis
  std::vector<Spring> springs_;
};

}  // namespace dygita

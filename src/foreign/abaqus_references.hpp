// *RIGID BODY and *COUPLING: nodes that move with a reference node, rigidly or in the mean, and what is said of that.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "foreign/abaqus_constraints.hpp"
#include "foreign/abaqus_model.hpp"
#include "foreign/file_actions.hpp"

namespace dygita {

struct AbaqusAnalysis;

class AbaqusReferences {
 public:
  // Of all cards of the model; what cannot be read is told by finish.
  explicit AbaqusReferences(AbaqusModel& model);
  static bool has_read(const std::string& keyword);

  // A line of *BOUNDARY or *CLOAD (is_held) on directions from ... to of these nodes, in a step (-1: before the first).
  // False where none of them is a reference. Throws InputError with the line.
  struct Line {
    const PlacedCard& placed;
    const DataLine& data;
    int step;
  };
  bool read(const Line& line, bool is_held, const std::vector<int>& nodes, std::pair<long, long> directions, double by);
  // *MASS: of elements on references; those on other nodes are told by finish.
  void read_mass(const PlacedCard& placed);
  // Actions, equations and bodies, once everything is read.
  void finish(AbaqusAnalysis& analysis);

 private:
  using Six = std::array<double, 6>;  // displacements and rotations, or forces and moments
  struct Said {
    std::array<bool, 6> is_held{}, is_loaded{};
    Six motion{}, force{};
    const DataLine *held_at = nullptr, *loaded_at = nullptr;
    std::string motion_amplitude, force_amplitude;
  };
  struct Reference {
    const FileCard* card;
    int node, turning;  // REF NODE, ROT NODE (-1: none)
    bool is_mean;
    std::array<bool, 3> along;
    std::string place;      // a set of the feet; of the mean a surface
    std::vector<int> feet;  // nodes
    double area = 0.0, mass = 0.0;
    Vec3 middle = Vec3::Zero();           // of the area
    std::map<int, Said> said = {};        // by step
    std::vector<std::string> three = {};  // sets of a foot each, which say how it moves
    std::vector<int> three_nodes = {};
  };

  void add_rigid_body(const PlacedCard& placed);
  void add_coupling(const PlacedCard& placed, const FileCard* kind);
  int node_of(const PlacedCard& placed, const char* option) const;
  void take_surface(const std::string& name, Reference& reference);
  const Vec3& place(int node) const { return model_.model().nodes[static_cast<size_t>(node)]; }
  double size_of(const Reference& reference) const;
  void choose_three(Reference& reference);
  std::vector<Vec3> shared(const Reference& reference, const Vec3& force, const Vec3& moment) const;
  std::string foot(Reference& reference, size_t i);
  bool say_held(Reference& reference, AbaqusAnalysis& analysis);
  void say_loads(Reference& reference, AbaqusAnalysis& analysis);
  void say_body(const Reference& reference, AbaqusAnalysis& analysis);
  void say(Reference& reference, AbaqusAnalysis& analysis);
  std::string where(const DataLine& line) const { return file_.where(line.file, line.line); }

  AbaqusModel& model_;
  const CardFile& file_;
  std::vector<Reference> references_;
  std::map<int, std::pair<size_t, bool>> of_node_;  // which reference, and is it the ROT NODE?
  std::vector<std::string> untranslated_, loose_masses_;
};

}  // namespace dygita

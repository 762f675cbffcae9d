// What an .inp asks for beside its meshes: supports, loads, joints and steps, in the units of the file; and what it
// asks for that no deck says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "foreign/abaqus_axes.hpp"
#include "foreign/abaqus_constraints.hpp"
#include "foreign/abaqus_model.hpp"
#include "foreign/abaqus_ring.hpp"
#include "foreign/file_actions.hpp"

namespace dygita {

struct AbaqusStep {
  std::string procedure, where;  // "STATIC"; empty: none that is known
  std::vector<double> numbers;   // of its line of data
  bool is_perturbation = false, is_explicit = false;
  bool is_of_diameter_0 = false;                     // its modes, of a sector
  bool drops_supports = false, drops_loads = false;  // OP = NEW
  std::vector<FileAction> actions;
  std::map<int, double> temperatures;  // of nodes of the model, K
  std::string temperatures_where;
};

struct AbaqusJoint {
  bool is_tie = false, is_adjusted = false;
  std::string one, other;  // faces
  double friction = 0.0;
  std::optional<double> clearance;  // everywhere, in place of the gap of the geometry
  std::optional<AbaqusRing> ring;   // of a tie between the cut faces of a sector
  std::string where;
};

struct AbaqusAnalysis {
  std::vector<FileAction> before;  // the first step
  std::vector<AbaqusStep> steps;
  std::map<int, double> temperatures;  // of nodes of the model, K, without stress
  std::vector<AbaqusJoint> joints;
  std::vector<AbaqusEquation> equations;
  std::vector<FileSpring> springs;
  std::vector<FileBody> bodies;
  std::vector<ObliqueHold> obliques;
  std::vector<std::string> cuts;                          // surfaces inside parts that are tightened there
  std::map<std::string, std::vector<double>> amplitudes;  // times and values in turns, by names in capitals
  std::vector<std::string> remarks;                       // what is said otherwise
  std::vector<std::string> untranslated;                  // "plate.inp:45: *SPRING: ..."
};

// Nodes and facets that a card lists by numbers become sets of the model, called by the card and the line of the first
// of them: "boundary 45". What cannot be read is untranslated, and no error.
AbaqusAnalysis analysis_of(AbaqusModel& model);

}  // namespace dygita

// What a report draws beside tables: the deformed assembly at a few instants, and the state of joints at a few more.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/model.hpp"
#include "result/skin_motion.hpp"

namespace dygita {

struct AssemblyScene {
  std::string step;
  bool is_static = false;
  double time = 0.0;                 // s, of the run
  std::vector<Points> displacement;  // m, 3 x n_nodes, one per substructure
  std::vector<Vec> von_mises;        // Pa, one per substructure
  int missed = 0;                    // increments up to here, of all steps, that have not converged
};

// The part with the smallest margin against yield or failure, at the sampled instant of the smallest.
struct StressedPart {
  int part = -1;  // index in problem.substructures; -1: none is watched
  bool is_index = false;
  std::string step;
  double time = 0.0;  // s, of the run
  Vec value;          // at its nodes: von Mises stress, Pa, or failure index
};

struct JointScene {
  std::string step;
  bool is_static = false;
  double time = 0.0;                   // s, of the run
  std::vector<unsigned char> status;   // PointState of each point
  std::vector<float> pressure;         // Pa, compression positive
  std::vector<float> slip;             // m, modulus
  std::vector<float> plastic_opening;  // m
  int missed = 0;                      // increments up to here, of all steps, that have not converged
};

// An interface or wall that an output has mapped that opens (contact) or yields (plastic).
struct JointScenes {
  std::string name;
  bool is_contact = true;
  bool has_slip = false;             // contact with friction
  Points points;                     // 3 x n, m, undeformed
  std::vector<Facet> facets;         // node numbers into `points`
  std::vector<JointScene> instants;  // in the order of time, six at most
};

struct Scenes {
  std::vector<AssemblyScene>
      assembly;  // the end of tightening, the instant of the largest strain energy in the dynamic steps
  StressedPart stressed;
  std::vector<JointScenes> joints;
  SkinMotion motion;
};

}  // namespace dygita

// What is asked of a condensed assembly, and what it is.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace dygita {

// Dense matrices of this many unknowns of the faces take about 1 GB in all.
inline constexpr int most_face_unknowns = 6000;

// What of a face moves with the interface of a superelement (manual, eq. D2).
enum class FaceMotion { mean, rigid, nodes };

struct SuperelementRequest {
  std::string name;        // of the output
  Origin origin;           // of the output
  std::vector<Target> on;  // faces and regions
  FaceMotion motion = FaceMotion::mean;
  int modes = 0;              // fixed-interface modes kept; 0: all up to twice `up_to`
  double up_to = 0.0;         // Hz, frequency up to which it is to be used
  bool ties_sliding = false;  // contact points at the limit of friction are tied along their tangents too
  bool as_dmig = false;       // writes what Nastran reads, too
};

// Mass and stiffness of an assembly on its interface coordinates and modes (manual, eq. D1-D6). Rows: those of the
// faces in the order of `on`, then the modes.
struct Superelement {
  struct Row {
    int on = -1;        // index in `on`; -1: a mode
    int node = -1;      // of that part's mesh; -1: a motion of the whole face
    int direction = 0;  // 0 1 2: translation along x y z, 3 4 5: rotation about them; of a mode its number from 0
    Vec3 place = Vec3::Zero();  // m, of the node, or the point about which the face turns
  };
  std::vector<Row> rows;
  std::vector<Row> dependent;    // motions of the faces that rows before have: tied to another face of `on`
  std::vector<Target> on;        // faces and regions that rows refer to
  Mat mass, stiffness, damping;  // n_rows x n_rows; damping empty where no material has any
  Vec fixed_frequencies;         // Hz, of the modes: with the interface coordinates held
  int n_residual = 0;            // how many of them, the last ones, stand for those that were left out
  Vec frequencies;               // Hz, of the superelement itself, increasing
  Vec damping_ratios;            // of each, of critical damping
  double valid_to = 0.0;         // Hz
  double mass_of_parts = 0.0;    // kg
  int n_unknowns = 0;            // of the assembly
  std::string step;
  int missed = 0;                            // increments up to there, of all steps, that have not converged
  int n_tied = 0, n_normal = 0, n_open = 0;  // contact points: tied, tied along their normal, open
  int n_damped = 0;                          // points of interfaces that are in the damping matrix
};
using SuperelementPtr = std::shared_ptr<const Superelement>;

}  // namespace dygita

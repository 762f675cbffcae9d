// Unconstrained rigid motions of the substructures in a static step.
#pragma once

#include <string>
#include <vector>

#include "exchange/rigid_frame.hpp"

namespace dygita {

// "translation along x", "rotation about (0.866, 0.5, 0)": by the larger of its two parts, along an axis where it is
// within 8 degrees of one.
std::string name_of(const RigidMotion& motion);

// Does the substructure have a rigid motion that its own supports leave free?
bool is_floating(const Substructure& part, const std::unordered_map<int, Held>& held);

// Rigid motions of the assembly that neither supports nor laws resist. Contact counts as resisting in its normal
// direction.
struct FreeMotions {
  std::vector<RigidFrame> frames;  // of each substructure
  Mat columns;                     // one a motion, of six entries a substructure, in its frame; orthonormal
  Mat whole;                       // of these the six of all substructures as one, where nothing holds them; else none

  // The same of all substructures as one, whether they are free or not: unit translations, and turns of one radian
  // about axes through `centre`.
  Mat of_whole(const Vec3& centre) const;
  RigidMotion of_part(int part, const Vec& amounts) const {
    return columns.middleRows(6 * static_cast<Eigen::Index>(part), 6) * amounts;
  }
};
FreeMotions find_free_motions(const Problem& problem, const Exchange& exchange, const Conditions& conditions);

// Throws InputError, naming a substructure and its motion, when loads drive free motions. work: J, of a unit of each
// motion; forces: N, the sum of their magnitudes.
void check_unloaded(const Problem& problem, const Step& step, const FreeMotions& free, const Vec& work, double forces);

// Holds one direction of one node for each free motion, and warns of those that are not the whole's: since nothing
// loads them, pins carry nothing.
void pin_free_motions(const Problem& problem, const Step& step, const Exchange& exchange, const FreeMotions& motions,
                      Conditions& conditions);

}  // namespace dygita

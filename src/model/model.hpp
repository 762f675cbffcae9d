// What a deck declared: plain, checked, immutable. Objects refer to each other by shared pointers to const.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "law/law_fwd.hpp"
#include "material/elastic.hpp"
#include "material/layup.hpp"
#include "meeting/meeting_options.hpp"
#include "mesh/mesh.hpp"
#include "model/support.hpp"
#include "signal/history.hpp"

namespace dygita {

struct Named {
  std::string name;
  Origin origin;
};

// How a substructure's motion is integrated in dynamic steps of LATIN.
enum class IntegrationChoice { implicitly, as_cheapest, explicitly };

struct Substructure : Named {
  MeshPtr mesh;
  Elastic material;
  Vec3 place = Vec3::Zero();                     // m, added to every node
  Vec3 velocity = Vec3::Zero();                  // m/s, at the start of the first dynamic step
  std::optional<double> yield;                   // Pa, von Mises, of its material: what margins of stress refer to
  std::optional<IntegrationChoice> integration;  // none: as the solver has it
};
using SubstructurePtr = std::shared_ptr<const Substructure>;

// A named group of facets of a substructure's mesh, or facets of it that were picked by their place.
struct Face {
  SubstructurePtr part;
  std::string group;                                      // or what they were picked by
  std::shared_ptr<const std::vector<Facet>> picked = {};  // null: the mesh's group

  // None where the group is of points alone.
  const std::vector<Facet>& facets() const {
    static const std::vector<Facet> none;
    if (picked) return *picked;
    return part->mesh->point_groups.contains(group) ? none : part->mesh->faces.at(group);
  }
  std::string label() const { return part->name + "." + group; }
};

// A set of nodes of a substructure (`part:where`).
struct Region {
  SubstructurePtr part;
  std::vector<int> nodes;
  std::string label() const { return part->name + " (" + std::to_string(nodes.size()) + " nodes)"; }
};

// A sector's cut faces, of which the second one, turned about the axis, is the first one.
struct CyclicSymmetry {
  Vec3 through, along;  // a point of the axis (m), its direction
  int n;                // sectors of the ring
  Mat3 turn;
  MeshPtr turned;  // the mesh of side 2 in the assembly, turned

  double distance(const Vec3& x) const { return along.cross(x - through).norm(); }  // m, from the axis
};

struct Interface : Named {
  Face side_1, side_2;
  LawPtr law;  // its own
  // Where the meshes do not match.
  Carrier points = Carrier::automatic;
  std::optional<double> within;      // m, how far apart the faces may be; else by the size of the assembly
  bool has_gap_of_geometry = false;  // the initial gap is that of the places, else the law's
  bool is_gap_drawn = false;         // taken from round surfaces without a word in the deck
  // m, added to the gap of the places, by the nodes of either side; none: nothing is.
  std::array<std::unordered_map<int, double>, 2> form;
  std::optional<MeanBy> means;  // joins the mean motions of its faces, which deform freely; none: point by point
  std::optional<CyclicSymmetry> cyclic;  // joins the cut faces of one sector of a ring
};
using InterfacePtr = std::shared_ptr<const Interface>;

using FaceOrRegion = std::variant<Face, Region>;

struct Support : Named {
  SupportKindPtr kind;
  std::vector<FaceOrRegion> on;
  std::vector<double> factors;   // of an equation or a spring, one a place; else none
  std::vector<Vec3> terms;       // of an equation of one line: instead of them, along x, y and z of each place
  Mat3 axes = Mat3::Identity();  // of an equation or a spring: its x, y and z
};
using SupportPtr = std::shared_ptr<const Support>;

// What an output or a load can be on.
using Target = std::variant<Face, Region, InterfacePtr, SupportPtr>;

// "lower.base", "rod (12 nodes)", an interface's or a support's name.
std::string label(const Target& target);

class Load;
using LoadPtr = std::shared_ptr<const Load>;

struct Step : Named {
  bool is_static = false;
  std::shared_ptr<const Step> after;  // null: from the undeformed state
  int increments = 1;                 // static
  bool inertia_relief = false;        // static: loads accelerate what nothing holds
  double duration = 0.0, dt = 0.0;    // dynamic, s
  std::vector<LoadPtr> loads;
  std::optional<std::vector<SupportPtr>> supports;  // replaces the problem's in this step

  int n_increments() const;  // dynamic: round(duration / dt)
};
using StepPtr = std::shared_ptr<const Step>;

// What stands for the mass of the cells in dynamic steps.
struct MassSettings {
  bool is_tuned = false;  // between lumped and consistent, so that mesh and time step undo each other's error
  bool is_moved_from_contact = false;  // nodes in contact have none
  bool is_chosen = false;              // of explicit substructures, by what their loads bring: tuned or lumped
};

// How static steps are solved: all parts in one system, part by part, or whichever is likely to cost less.
enum class StaticSteps { automatic, assembled, iterated };

// solver.latin; negative or zero means "the default of the manual's table".
struct LatinSettings {
  double tolerance = 1e-6;
  double static_tolerance = 1e-8;
  int window = 1;           // steps; 0: the whole interval
  double relaxation = 0.0;  // 0: .95 dynamic, .8 static and windows of many steps
  int anderson = -1;        // -1: 10 dynamic, 40 static, windows of several steps 5, 0 beyond 20
  int max_iterations = 0;   // 0: as many as bring the indicator down, see the table
  double numerical_damping = 0.0;
  double push_out = 0.0;          // b of the contact law
  double search_direction = 1.0;  // multiplies every k (studies, hard cases)
  MassSettings mass{.is_chosen = true};
  IntegrationChoice integration = IntegrationChoice::as_cheapest;  // of substructures that do not say
  std::optional<Precision>
      precision;                  // of the stored factors in dynamic steps; none: single where a substructure is large
  int pieces = 0;                 // of each substructure; 0: large ones are cut
  double history_memory = 512e6;  // bytes of interface fields kept in memory for later cases; more goes to a file
  double spectra = 0.0;  // dB: passes at tighter tolerances until spectra move by less; 0: one run at `tolerance`
  int more_iterations =
      0;  // dygita continue: of an increment that has a start, at most, down to round-off; 0: as tolerance asks
  StaticSteps static_steps = StaticSteps::automatic;
  bool plain = false;  // iterate with full solves instead of the condensed interface (the plain path)
};

// solver.monolithic: the whole assembly in one implicit system.
struct MonolithicSettings {
  double tolerance = 1e-10;
  int max_iterations = 50;  // of an increment
  double numerical_damping = 0.0;
  MassSettings mass;
  bool plain = false;  // a factor for every tangent (the plain path)
};

// solver.explicit: central differences with lumped mass, penalty contact.
struct ExplicitSettings {
  double safety = 0.9;    // of the critical time step
  double penalty = 0.1;   // of the stiffness of the layer of elements at an interface
  bool one_point = true;  // hexahedra: one point and hourglass control; false: the stiffness of the other solvers
  double hourglass = 0.1;
  bool bulk_viscosity = true;
};

class Output;
using OutputPtr = std::shared_ptr<const Output>;

struct Problem : Named {
  std::vector<SubstructurePtr> substructures;
  std::vector<InterfacePtr> interfaces;
  std::vector<SupportPtr> supports;
  std::vector<StepPtr> steps;
  std::vector<OutputPtr> outputs;
  LatinSettings solver;
  std::optional<MonolithicSettings> monolithic;  // where set, takes the place of LATIN

  std::optional<ExplicitSettings> explicit_dynamics;  // the same

  const char* solver_name() const { return explicit_dynamics ? "explicit" : monolithic ? "monolithic" : "latin"; }
  MassSettings mass() const {
    if (explicit_dynamics) return {};
    return monolithic ? monolithic->mass : solver.mass;
  }
  double numerical_damping() const {
    if (explicit_dynamics) return 0.0;
    return monolithic ? monolithic->numerical_damping : solver.numerical_damping;
  }
};

// Volume (m^3) of each substructure; 0 of those without cells.
std::vector<double> volumes(const Problem& problem);
// Mass (kg) of a substructure of that volume.
double mass_of(const Substructure& part, double volume);

// Supports in force in a step.
const std::vector<SupportPtr>& supports_of(const Problem& problem, const Step& step);

// Index of an object in a list by identity, or -1.
template <class T>
int index_of(const std::vector<std::shared_ptr<const T>>& list, const T* object) {
  for (size_t i = 0; i < list.size(); ++i)
    if (list[i].get() == object) return static_cast<int>(i);
  return -1;
}

}  // namespace dygita

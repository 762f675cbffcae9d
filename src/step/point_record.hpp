// The memory of one interface point through a step, and where its force and works go: the same for any solver.
#pragma once

#include <span>

#include "step/step_model.hpp"

namespace dygita {

// What an increment is to a law. push_out: b of the contact law.

// Vectors in the point's frame; members of one point share it.
struct PointRecord {
  LawState law;                    // at the start of the increment
  Trial trial;                     // jump, shortening and area are set by begin_point; s and y are the solver's
  Vec3 given_rate = Vec3::Zero();  // m/s, where the trial says that it is given
  bool is_released = false;
  Vec3 force = Vec3::Zero();    // N, found by the solver
  double shortening_old = 0.0;  // m
  double first_gap = 0.0;       // m, of the undeformed state
};

// How the ports of the exchange move when a step starts, in global axes: m, m/s. Collective: those of all pieces.
struct PortMotion {
  Vec3 displacement = Vec3::Zero(), velocity = Vec3::Zero();
};
std::vector<PortMotion> port_motions(const StepModel& model, const State& start);

// The record a step starts from, for a point with or without a law. ports: of the exchange.
PointRecord start_point(const StepModel& model, const Point& point, const State& start,
                        const std::vector<PortMotion>& ports);
// Jump (m, u' - u), shortening and release of an increment, for a point with a law.
void begin_point(const StepModel& model, const Point& point, const Vec3& jump, int increment, PointRecord& record);
// Rates (m/s) that supports and prescribed motions give a point with a law, of motions with these velocities at the end
// of the increment. moved: m, how far its sides are from where the deck has them.
void give_rates(const StepModel& model, const Point& point, const std::vector<double>& motions, double moved,
                PointRecord& record);
// The law's state at the end of the increment, with the force found.
LawState end_of_point(const Point& point, const PointRecord& record, const Increment& increment);
// Do its sides depend on each other then, by a force whose square times y is above `least` (W), or whatever it is?
bool links(const Point& point, const PointRecord& record, double least);
// How far (m) its sides may come together then, infinite where nothing keeps them apart.
double gap_of(const Point& point, const PointRecord& record, const Increment& increment);
// Largest difference between a contact law's gap and that of the displacements, m; zero for other laws.
double gap_difference(const Point& point, const PointRecord& record);

// Where the work of a point goes: what its law dissipates, the tool that shortens the bolt, and the scheme (impacts,
// residuals). on_pieces: work of the interface on the substructures during the increment, J.
void book_work(const Point& point, const PointRecord& record, const LawState& end, const Increment& increment,
               double on_pieces, State& state);
// The same, of a point that is booked with a piece.
void book_work(const Point& point, const PointRecord& record, const LawState& end, const Increment& increment,
               double on_pieces, State& state, IncrementEnergy& energy);
// What a law has dissipated and stored, into its surfaces; and into the energies.
void book_on_surfaces(const Point& point, const Work& work, State& state);
void book_dissipation(const Point& point, const Work& work, State& state);
// A point with a law into the surfaces' state, once record.law is that of the end: forces, gaps and slips, which no
// other point writes; what a surface has of its bolt and its release, which all its points write; both.
void show_law(const Point& point, const LawState& law, State& state);
void show_record(const Point& point, const PointRecord& record, State& state);
void show_point(const Point& point, const PointRecord& record, State& state);
// A substructure's force inside a group, split over its bonded interfaces: least norm weighted with nodal areas.
// port_force: of the interfaces on each of the point's ports, in its frame, N.
void show_ties(const StepModel& model, const Point& point, const PointRecord& record, std::span<const Vec3> port_force,
               State& state);
// The same of all points that are iterated, from the forces on all ports.
void show_ties(const StepModel& model, const std::vector<PointRecord>& records, const std::vector<Vec3>& port_force,
               State& state);

}  // namespace dygita

// The parts of check_problem. Each throws InputError with the origin of the object at fault.
#pragma once

#include "model/places.hpp"
#include "model/refusal.hpp"

namespace dygita::check {

// Names: given, unique in their list, fit for a file; no object listed twice.
void names(const Problem& problem);

// Interfaces and supports: their parts are listed, their faces exist, no face is under two supports in one step.
void interfaces(const Problem& problem);
void supports(const Problem& problem);

// Steps: one line in the order listed, times and increments, a static step first where there is an interference.
void steps(const Problem& problem);

// Cells: of order one where a solver's setting wants the mass at the nodes.
void cells(const Problem& problem);

// Loads of every step: on what they can act, listed, in a step where they mean something, nothing prescribed twice.
void loads(const Problem& problem);

// Sectors of rings: one axis and one number of sectors for all cut faces, base motions and body forces alike around it.
void cyclic(const Problem& problem);

// Outputs: on what they can be, listed, spectra of a scalar acceleration.
void outputs(const Problem& problem);

// Substructures that are to be explicit can be.
void integration(const Problem& problem);

// What is allowed but hardly meant: said with warn().
void doubts(const Problem& problem);

// Forces on nodes whose motion is prescribed: said with warn(). Throws where preloads leave a substructure without
// equilibrium.
void balance(const Problem& problem);

// A time step or a mesh too coarse for what the loads bring and the spectra ask for: said with warn(), with the
// figures.
void resolution(const Problem& problem);

// Histories of loads and the steps they act in: pulses that a step cuts off or a time step swallows, records held
// beyond their ends, peaks that no step reaches: said with warn(). Throws where a record is in another unit than its
// load.
void histories(const Problem& problem);

}  // namespace dygita::check

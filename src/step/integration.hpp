// How each substructure is integrated in a dynamic step, and in how many increments the time step of the deck is made
// (manual, eq. S11): explicitly where that costs less, or as the deck asks.
#pragma once

#include <string>
#include <vector>

#include "interfaces/conditions.hpp"
#include "interfaces/surfaces.hpp"
#include "partition/cut.hpp"
#include "pieces/body.hpp"

namespace dygita {

struct Integration {
  struct Part {
    bool is_explicit = false;
    double longest = 0.0;    // s, increment that is stable; 0: nobody has asked
    std::string why_not;     // it cannot be explicit; empty: it can
    bool is_tuned = false;   // its mass, where it is explicit (manual, eq. S13)
    double phase = 0.0;      // rad, that this was decided by (eq. S15); 0: the deck did
    std::string why_lumped;  // though the phase asks for more
  };
  std::vector<char> is_explicit;  // of each piece; empty: none is
  int n_substeps = 1;             // increments in each time step of the deck
  std::vector<Part> parts;        // of each substructure; empty in static steps and where all are to be implicit
  double cost = 1.0;              // of a time step, estimated, of what it would be with all implicit

  bool is_explicit_piece(int i) const { return !is_explicit.empty() && is_explicit[i]; }
  bool has_explicit() const { return !is_explicit.empty(); }
};

// bodies: of the pieces. Throws InputError where a substructure is to be
// explicit and cannot be.
Integration choose_integration(const Problem& problem, const Step& step, const std::vector<Body>& bodies,
                               const Cut& cut, const Conditions& conditions, const std::vector<Surface>& surfaces);

// What the deck says of a substructure: implicit, as the program chooses, or explicit.
IntegrationChoice asked_of(const Problem& problem, const Substructure& part);

// "explicit: 'a', 'b' (12 increments of 0.08 us in each dt, stable to 0.09 us); implicit: 'c' (it has cells of order
// two, whose mass couples the nodes)"; empty: all are implicit and none was to be anything else.
std::string describe(const Integration& integration, const Problem& problem, const Step& step);

}  // namespace dygita

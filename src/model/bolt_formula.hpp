// A bolted joint by hand: resiliences of bolt and clamped parts after VDI 2230 Part 1 (manual, eq. B3-B6).
#pragma once

namespace dygita {

// One whole bolt, as a drawing has it; lengths in m, moduli in Pa.
struct BoltDimensions {
  double diameter = 0.0;     // of the shank, which is the nominal one
  double grip = 0.0;         // length clamped between head and nut (or first engaged thread)
  double head = 0.0;         // outer diameter of the bearing surface under the head
  double hole = 0.0;         // diameter of the hole in the clamped parts
  double outer = 0.0;        // diameter of the clamped parts, or of the circle that fits into them
  double young = 0.0;        // of the bolt
  double plate_young = 0.0;  // of the clamped parts
  double core = 0.0;         // diameter of the thread's core
  double thread = 0.0;       // length of the grip that is thread
  bool is_tapped = false;    // screwed into the last part, no nut
};

struct BoltResilience {
  double bolt = 0.0, plates = 0.0;  // m/N

  double sum() const { return bolt + plates; }
  // Share of a working load on the heads that the bolt carries (concentric; VDI 2230 calls it Phi_K).
  double load_factor() const { return plates / sum(); }
};

// Needs 0 < diameter <= hole < head, hole < outer, 0 < core <= diameter, 0 <= thread <= grip (ContractError).
BoltResilience bolt_resilience(const BoltDimensions& bolt);

}  // namespace dygita

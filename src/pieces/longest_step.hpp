// Whether a body can be integrated explicitly, and how long an increment of it may be (manual, eq. S11).
#pragma once

#include <string>
#include <unordered_map>

#include "interfaces/conditions.hpp"
#include "pieces/body.hpp"

namespace dygita {

// Why a body cannot be integrated explicitly: "it has a node without mass"; empty: it can.
std::string why_not_explicit(const Body& body, double numerical_damping);

// Longest stable increment (s) of a body by itself, from its highest frequency by Lanczos' iteration: within a percent,
// and not above it. held: of its nodes.
double longest_explicit_step(const Body& body, const std::unordered_map<int, Held>& held);
// The same where its mass is tuned to that step and to waves of that speed, m/s (manual, eq. S13).
double longest_tuned_step(const Body& body, const std::unordered_map<int, Held>& held, double speed);
// Speed (m/s) of the waves that a tuned mass keeps at theirs: shear waves, which are the shortest of a frequency; where
// supports leave a bar no motion but along it, compression. held: of all of its nodes.
double tuned_wave_speed(const Substructure& part, const std::unordered_map<int, Held>& held);

}  // namespace dygita

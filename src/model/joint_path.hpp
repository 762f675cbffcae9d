// What a shock passes on its way from one place to another, and what the handbooks' rule of thumb takes off it.
#pragma once

#include <string>

#include "model/model.hpp"

namespace dygita {

struct JointPath {
  int bolted = 0, bonded = 0, isolators = 0;
  double distance = 0.0;  // m, from place to place
  bool is_connected = true;

  double rule() const;       // dB, negative
  std::string text() const;  // "1 bolted joint, 0.12 m"
};

// A bushing or a damper: its parts move each by itself.
bool is_isolator(const Interface& interface);

// The way on which the rule takes least. Parts that touch are bolted (or riveted), also by an interface.bonded that a
// load tightens; bushings and dampers isolate unless they are tightened.
JointPath joint_path(const Problem& problem, const FaceOrRegion& from, const FaceOrRegion& to);

}  // namespace dygita

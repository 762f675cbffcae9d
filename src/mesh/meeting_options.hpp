// What may be said of how two faces meet.
#pragma once

namespace dygita {

// Which side carries the points of faces that do not match: the one with the larger facets, or as declared.
enum class Carrier { coarser, first, second };

struct MeetingOptions {
  double within = 0.0;  // m, how far apart faces may be that touch, beside their sagittas
  Carrier points = Carrier::coarser;
  bool is_second_softer = false;  // decides where neither face is coarser nor covered more completely
};

}  // namespace dygita

// What may be said of how two faces meet.
#pragma once

namespace dygita {

// Which side carries the points of faces that do not match: as the faces lie on each other, or as declared.
enum class Carrier { automatic, first, second };

// What counts in the mean motion of a face: the area behind its nodes, or each node alike.
enum class MeanBy { area, nodes };

struct MeetingOptions {
  double within = 0.0;  // m, how far apart faces may be that touch, beside their sagittas
  Carrier points = Carrier::automatic;
  bool is_second_preferred = false;  // decides where the faces are alike in all else
  // The law acts on the area of each point: facets whose nodes have none of their own (tri6, quad8) take the points of
  // their sub-facets even where they match node for node.
  bool acts_by_area = false;
  // The law has a normal of its own: where faces turn around a sharp edge each smooth surface has points there with its
  // own normal, not one point with the mean.
  bool splits_at_edges = false;
  // The law has a stiffness or a damping of its own, spread over the face: of two faces alike the finer one has the
  // points.
  bool is_layer = false;
};

}  // namespace dygita

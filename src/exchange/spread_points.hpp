// Points between faces whose meshes do not match: each by itself, one port a side, which moves with several nodes.
#pragma once

#include "exchange/point_frames.hpp"

namespace dygita {

class SpreadPoints {
 public:
  // All outlive this object; points and ports are added to the exchange.
  SpreadPoints(const Problem& problem, const Step& step, const Cut& cut, const Conditions& conditions,
               const FrameAxes& axes, Exchange& exchange)
      : problem_(problem), step_(step), cut_(cut), conditions_(conditions), axes_(axes), exchange_(exchange) {}

  // Those of a surface, the s-th of all, within reach.
  void add(const Surface& surface, int s, const Reach& reach);

 private:
  void add_point(const Surface& surface, int s, int i);
  Mat3 frame(const Surface& surface, int i) const;
  Port port(const Surface& surface, int side, int i, const Mat3& frame) const;
  void refuse_driven(const Surface& surface, const Point& point) const;
  bool is_tied_to_plane(const Surface& surface, const Point& point, int d) const;
  bool has_held_node_at(const Port& port, const Surface& surface, const Point& point, int d) const;
  bool moves_apart(const Port& port, int part, int node, const Vec3& axis) const;

  const Problem& problem_;
  const Step& step_;
  const Cut& cut_;
  const Conditions& conditions_;
  const FrameAxes& axes_;
  Exchange& exchange_;
};

}  // namespace dygita

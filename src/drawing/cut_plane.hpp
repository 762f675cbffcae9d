// Where the assembly is cut open: through its bolts.
#pragma once

#include <optional>
#include <string>

#include "drawing/picture.hpp"

namespace dygita {

struct CutPlane {
  Vec3 normal = Vec3::Zero();  // unit, towards the reader
  Vec3 point = Vec3::Zero();   // m
  std::string text;            // "through 'b1', 'b2', the plane y = 12 mm"
};

// The plane that holds the axes of the most bolts, which are the interfaces that some step tightens, and is seen from
// where the view is; of equals the one that cuts the most parts. None where no bolt is.
std::optional<CutPlane> plane_through_bolts(const Problem& problem, const View& view);

// "the plane y = 12 mm"; "a plane" where its normal is no axis.
std::string plane_text(const Vec3& normal, const Vec3& point);

}  // namespace dygita

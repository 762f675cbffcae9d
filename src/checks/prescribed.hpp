// The motions that the loads of a step prescribe: asked for once a step, since a load makes its effects anew each time.
#pragma once

#include <vector>

#include "model/load.hpp"
#include "model/model.hpp"

namespace dygita::check {

struct Prescribed {
  LoadPtr load;
  PrescribedMotion motion;
};

inline std::vector<Prescribed> prescribed_in(const Step& step) {
  std::vector<Prescribed> all;
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects())
      if (const auto* motion = std::get_if<PrescribedMotion>(&effect)) all.push_back({load, *motion});
  return all;
}

}  // namespace dygita::check

// An output that is of places, for those made of it.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace dygita {

class Placed {
 public:
  virtual ~Placed() = default;
  virtual const std::vector<Target>& places() const = 0;
};

}  // namespace dygita

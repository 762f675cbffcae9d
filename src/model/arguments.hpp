// Arguments that are objects of the model: for loads and outputs.
#pragma once

#include "base/arguments.hpp"
#include "model/model.hpp"
#include "signal/specification.hpp"

namespace dygita {

class ModelArguments : public Arguments {
 public:
  virtual TimeValue value(const char* key) const = 0;
  virtual std::vector<Target> targets(const char* key) const = 0;  // empty when absent
  virtual std::vector<SubstructurePtr> substructures(const char* key) const = 0;
  virtual StepPtr step(const char* key) const = 0;                // null when absent
  virtual std::vector<StepPtr> steps(const char* key) const = 0;  // empty when absent
  virtual OutputPtr output(const char* key) const = 0;            // null when absent
  // A list of points of the deck or a file beside it; null when absent. Throws InputError on one that makes no sense.
  virtual std::shared_ptr<const Specification> specification(const char* key) const = 0;

  Vec3 vector(const char* key) const;
  // A vector at unit length. Throws InputError on a zero one.
  Vec3 unit_vector(const char* key) const;
  std::vector<FaceOrRegion> places(const char* key) const;  // faces and regions among the targets
};

}  // namespace dygita

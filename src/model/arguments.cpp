#include "model/arguments.hpp"

namespace dygita {

Vec3 ModelArguments::vector(const char* key) const {
  const std::vector<double> values = numbers(key);
  CHECK(values.size() == 3, std::string("argument '") + key + "' is not a vector");
  return {values[0], values[1], values[2]};
}

Vec3 ModelArguments::unit_vector(const char* key) const {
  const Vec3 direction = vector(key);
  if (direction.norm() > 0.0) return direction.normalized();
  throw InputError(origin(), path() + ": '" + key + "' is zero\n    as in " + key + " = { 0, 0, 1 }");
}

std::vector<FaceOrRegion> ModelArguments::places(const char* key) const {
  std::vector<FaceOrRegion> found;
  for (const Target& target : targets(key)) {
    if (const auto* face = std::get_if<Face>(&target)) found.emplace_back(*face);
    if (const auto* region = std::get_if<Region>(&target)) found.emplace_back(*region);
  }
  return found;
}

}  // namespace dygita

#include "model/model.hpp"

#include <cmath>

namespace dygita {

const char* support_kind_name(SupportKind kind) {
  switch (kind) {
    case SupportKind::fixed:
      return "fixed";
    case SupportKind::symmetry:
      return "symmetry";
    case SupportKind::wall:
      return "wall";
    case SupportKind::absorbing:
      return "absorbing";
  }
  CHECK(false, "unknown kind of support");
  return "";
}

std::string label(const Target& target) {
  if (const auto* face = std::get_if<Face>(&target)) return face->label();
  if (const auto* region = std::get_if<Region>(&target)) return region->label();
  if (const auto* interface = std::get_if<InterfacePtr>(&target)) return (*interface)->name;
  return std::get<SupportPtr>(target)->name;
}

int Step::n_increments() const {
  if (is_static) return increments;
  CHECK(dt > 0.0 && duration >= dt, "a dynamic step needs 0 < dt <= duration");
  return static_cast<int>(std::lround(duration / dt));
}

const std::vector<SupportPtr>& supports_of(const Problem& problem, const Step& step) {
  return step.supports ? *step.supports : problem.supports;
}

}  // namespace dygita

#include "model/model.hpp"

#include <cmath>

namespace dygita {

const char* output_kind_name(OutputKind kind) {
  switch (kind) {
    case OutputKind::vtk:
      return "vtk";
    case OutputKind::history:
      return "history";
    case OutputKind::resultant:
      return "resultant";
    case OutputKind::srs:
      return "srs";
    case OutputKind::srs_field:
      return "srs_field";
    case OutputKind::attenuation:
      return "attenuation";
    case OutputKind::joint:
      return "joint";
    case OutputKind::energy:
      return "energy";
    case OutputKind::loop:
      return "loop";
    case OutputKind::superelement:
      return "superelement";
  }
  CHECK(false, "unknown kind of output");
  return "";
}

const char* quantity_name(Quantity quantity) {
  switch (quantity) {
    case Quantity::displacement:
      return "displacement";
    case Quantity::velocity:
      return "velocity";
    case Quantity::acceleration:
      return "acceleration";
    case Quantity::stress:
      return "stress";
    case Quantity::von_mises:
      return "von_mises";
    case Quantity::pressure:
      return "pressure";
  }
  CHECK(false, "unknown quantity");
  return "";
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

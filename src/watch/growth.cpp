#include "watch/growth.hpp"

#include "model/growth.hpp"

namespace dygita {

double growth_at(const Instant& instant, int part) {
  const Step& step = *instant.model.step;
  double growth = 0.0;
  for (const LoadPattern& pattern : instant.model.loads->patterns()) {
    if (pattern.part != part || pattern.key.empty()) continue;
    const std::optional<double> expansion = expansion_of(pattern.key);
    if (!expansion) continue;
    growth += *expansion * (step.is_static ? pattern.value.at_static(instant.increment, step.increments)
                                           : pattern.value.history.value((instant.increment + 1) * step.dt));
  }
  return growth;
}

Points strained_piece(const Instant& instant, int piece) {
  const int part = instant.model.cut->piece(piece).part;
  const double growth = growth_at(instant, part);
  Points displacement = instant.piece_displacement(piece);
  if (growth == 0.0) return displacement;
  return without_growth(std::move(displacement), growth,
                        instant.model.cut->on_piece(piece, instant.model.problem->substructures[part]->mesh->nodes));
}

}  // namespace dygita

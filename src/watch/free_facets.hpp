// Where nothing acts on the surface of a part.
#pragma once

#include "fem/free_surface.hpp"
#include "step/step_model.hpp"

namespace dygita {

// Of the boundary facets of a part those that no interface, support or load is on in a step.
FacetKeys free_facets(const StepModel& model, int part, const std::vector<Facet>& boundary);

}  // namespace dygita

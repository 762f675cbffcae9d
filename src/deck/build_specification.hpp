// The specification of a spectrum as a deck gives it.
#pragma once

#include <memory>

#include "deck/build_model.hpp"

namespace dygita {

// `specification` of output.srs: a CSV file beside the deck, or a list of { frequency, level }; null where it is left
// out. Throws InputError.
std::shared_ptr<const Specification> specification_of(const Declaration& declaration);

}  // namespace dygita

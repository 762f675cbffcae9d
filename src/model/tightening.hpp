// What loads that tighten a bolt have in common.
#pragma once

#include "model/arguments.hpp"
#include "model/effects.hpp"

namespace dygita {

// The bolt that `hand` describes; none where it is left out. Throws InputError on dimensions that do not go together.
std::optional<BoltDimensions> bolt_by_hand(const Arguments& arguments);

// What the bolt may carry, by 'size' and 'class' or as 'proof_load'; none where they are left out. Throws InputError on
// arguments that do not go together.
std::optional<BoltRating> bolt_rating(const ModelArguments& arguments);

// Interfaces that can be tightened, in the deck's words, and whether a target is one.
std::string tightened_interfaces();
bool can_be_tightened(const Target& target);

constexpr const char* tighten_before = "tighten in a preceding step.static; the bolt keeps its length afterwards";

}  // namespace dygita

#include "model/tightening.hpp"

#include <spdlog/fmt/fmt.h>

#include "law/law.hpp"

namespace dygita {

std::optional<BoltDimensions> bolt_by_hand(const Arguments& arguments) {
  if (!arguments.has("hand")) return std::nullopt;
  std::map<std::string, double> given = arguments.settings("hand");
  BoltDimensions b{given["diameter"], given["grip"],  given["head"],       given["hole"],
                   given["outer"],    given["young"], given["plate_young"]};
  b.core = given.contains("core") ? given["core"] : b.diameter;
  b.thread = given["thread"];
  b.is_tapped = given["tapped"] != 0.0;
  const auto refuse = [](const char* what, double value, const char* other, double bound, bool below) {
    throw InputError(fmt::format("'hand.{}' = {:g} m must not be {} 'hand.{}' = {:g} m", what, value,
                                 below ? "below" : "above", other, bound));
  };
  if (b.hole < b.diameter) refuse("hole", b.hole, "diameter", b.diameter, true);
  if (b.core > b.diameter) refuse("core", b.core, "diameter", b.diameter, false);
  if (b.thread > b.grip) refuse("thread", b.thread, "grip", b.grip, false);
  for (const auto& [what, value] : {std::pair{"head", b.head}, {"outer", b.outer}})
    if (value <= b.hole)
      throw InputError(fmt::format("'hand.{}' = {:g} m must be above 'hand.hole' = {:g} m", what, value, b.hole));
  return b;
}

std::optional<BoltRating> bolt_rating(const ModelArguments& a) {
  const bool is_standard = a.has("size") || a.has("class");
  if (!is_standard && !a.has("proof_load")) {
    for (const char* of_rating : {"joint", "safety"})
      if (a.has(of_rating))
        throw InputError(
            fmt::format("'{}' is for margins, which require 'size' and 'class', or 'proof_load'", of_rating));
    return std::nullopt;
  }
  if (is_standard && a.has("proof_load")) throw InputError("'proof_load' takes the place of 'size' and 'class'");
  if (is_standard && !(a.has("size") && a.has("class"))) throw InputError("'size' and 'class' go together");
  BoltRating rating;
  rating.safety = a.number_or("safety", 1.0);
  if (is_standard) {
    const Thread thread = thread_of(a.text("size"));
    rating.proof_load = thread.stress_area() * proof_stress(a.text("class"), thread);
  } else {
    rating.proof_load = a.number("proof_load");
  }
  for (const Target& target : a.targets("joint")) {
    const auto& interface = std::get<InterfacePtr>(target);
    if (!interface->law->shown().gap)
      throw InputError(
          fmt::format("'joint' has interface.{} '{}', which is no contact: a bolt clamps contacts, whose "
                      "friction carries its shear",
                      interface->law->word(), interface->name));
    rating.joint.push_back(interface);
  }
  return rating;
}

std::string tightened_interfaces() {
  std::string text;
  for (const LawEntry& entry : law_table())
    if (example_of(entry)->can_be_tightened())
      text += (text.empty() ? "an interface." : " or an interface.") + entry.word;
  return text;
}

bool can_be_tightened(const Target& target) {
  const InterfacePtr* interface = std::get_if<InterfacePtr>(&target);
  return interface && (*interface)->law->can_be_tightened();
}

}  // namespace dygita

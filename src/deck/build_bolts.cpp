#include "deck/build_bolts.hpp"

#include <spdlog/fmt/fmt.h>

namespace dygita {

namespace {

double torque_force(const Arguments& a, double share) {
  for (const char* needed : {"friction_factor", "diameter"})
    if (!a.has(needed))
      throw InputError(
          fmt::format("'torque' needs '{}'\n    the force is torque / (friction_factor diameter)", needed));
  return share * a.number("torque") / (a.number("friction_factor") * a.number("diameter"));
}

BoltDimensions dimensions(const Arguments& a) {
  std::map<std::string, double> given = a.settings("hand");
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

}  // namespace

void read_bolt(const Declaration& d, Load& load) {
  const LuaArguments& a = d.arguments;
  if (a.has("hand")) load.hand = dimensions(a);
  load.share = a.number_or("share", 1.0);
  if (load.kind == LoadKind::shortening) {
    if (a.has("share") && !a.has("hand"))
      throw InputError("'share' is of the bolt that 'hand' describes, and there is no 'hand'");
    return;
  }
  const bool has_force = a.has("force"), has_torque = a.has("torque");
  if (has_force == has_torque)
    throw InputError(has_force ? "'force' and 'torque' exclude each other"
                               : "give 'force', or 'torque' with 'friction_factor' and 'diameter'");
  if (has_torque) {
    load.value[0] = History::constant(torque_force(a, load.share));
    load.is_number[0] = true;
    return;
  }
  for (const char* of_torque : {"friction_factor", "diameter"})
    if (a.has(of_torque)) throw InputError(fmt::format("'{}' goes with 'torque', and 'force' is given", of_torque));
  if (a.has("share") && !a.has("hand"))
    throw InputError(
        "'share' goes with 'torque' or 'hand'\n    'force' is what goes through the modelled interface: a quarter "
        "model takes a quarter");
}

}  // namespace dygita

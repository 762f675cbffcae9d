// load.preload: tightens an interface until a force goes through it, given as such or by the torque on the nut.
#include <spdlog/fmt/fmt.h>

#include "model/load.hpp"
#include "model/tightening.hpp"

namespace dygita {

namespace {

double torque_force(const ModelArguments& a) {
  for (const char* needed : {"friction_factor", "diameter"})
    if (!a.has(needed))
      throw InputError(
          fmt::format("'torque' requires '{}'\n    the force is torque / (friction_factor diameter)", needed));
  return a.number_or("share", 1.0) * a.number("torque") / (a.number("friction_factor") * a.number("diameter"));
}

TimeValue force_of(const ModelArguments& a) {
  const bool has_force = a.has("force"), has_torque = a.has("torque");
  if (has_force == has_torque)
    throw InputError(has_force ? "'force' and 'torque' are mutually exclusive"
                               : "give 'force', or 'torque' with 'friction_factor' and 'diameter'");
  if (has_torque) return {History::constant(torque_force(a)), true};
  for (const char* of_torque : {"friction_factor", "diameter"})
    if (a.has(of_torque)) throw InputError(fmt::format("'{}' goes with 'torque', and 'force' is given", of_torque));
  if (a.has("share") && !a.has("hand") && !a.has("size") && !a.has("proof_load"))
    throw InputError(
        "'share' requires 'torque', 'hand' or 'size'\n    'force' acts through the modelled interface: a quarter model "
        "takes a "
        "quarter");
  return a.value("force");
}

class Preload final : public Load {
 public:
  explicit Preload(const ModelArguments& a) : Preload(a, bolt_by_hand(a), bolt_rating(a)) {}

  std::string acts_on() const override { return tightened_interfaces(); }
  bool can_act_on(const Target& target) const override { return can_be_tightened(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "N"; }
  std::optional<Complaint> complaint(const Step& step) const override {
    if (!step.is_static) return static_only(step, tighten_before);
    for (int i = 1; i <= step.increments; ++i)
      if (const double force = values[0]->history.value(static_cast<double>(i) / step.increments); force < 0.0)
        return Complaint{
            fmt::format(" asks for {:.6g} N in increment {}: a bolt force is tensile and cannot be negative", force, i),
            ""};
    return std::nullopt;
  }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const Target& target : on)
      all.push_back(PreloadForce{{std::get<InterfacePtr>(target), *values[0], hand_, share_, rating_}});
    return all;
  }
  Settings settings() const override { return {}; }

 private:
  Preload(const ModelArguments& a, std::optional<BoltDimensions> hand, std::optional<BoltRating> rating)
      : Load(a, {force_of(a)}), hand_(std::move(hand)), rating_(std::move(rating)), share_(a.number_or("share", 1.0)) {}

  std::optional<BoltDimensions> hand_;
  std::optional<BoltRating> rating_;
  double share_;
};

}  // namespace

namespace loads {
LoadEntry preload() { return {"preload", new_load<Preload>}; }
}  // namespace loads

}  // namespace dygita

// load.base_acceleration: a support that is shaken, as on a shock table.
#include "law/law.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

class BaseAcceleration final : public Load {
 public:
  explicit BaseAcceleration(const ModelArguments& a)
      : Load(a, one_value(a, "history")), direction_(a.unit_vector("direction")) {}

  std::string acts_on() const override {
    std::string text;
    for (const SupportEntry& entry : support_table())
      if (example_of(entry)->can_be_shaken()) text += (text.empty() ? "a support." : " or a support.") + entry.word;
    return text;
  }
  bool can_act_on(const Target& target) const override {
    const SupportPtr* support = std::get_if<SupportPtr>(&target);
    return support && (*support)->kind->can_be_shaken();
  }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "m/s^2"; }
  std::optional<Complaint> complaint(const Step& step) const override {
    return dynamic_only(step, "use load.gravity for a steady acceleration of the whole assembly");
  }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const Target& target : on)
      all.push_back(BaseMotion{std::get<SupportPtr>(target), direction_, values[0]->history});
    return all;
  }
  Settings settings() const override { return {{"direction", {direction_[0], direction_[1], direction_[2]}}}; }

 private:
  Vec3 direction_;
};

}  // namespace

namespace loads {
LoadEntry base_acceleration() { return {"base_acceleration", new_load<BaseAcceleration>}; }
}  // namespace loads

}  // namespace dygita

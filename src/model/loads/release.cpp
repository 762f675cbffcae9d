// load.release: an interface lets go.
#include <spdlog/fmt/fmt.h>

#include "model/load.hpp"

namespace dygita {

namespace {

class LetGo final : public Load {
 public:
  explicit LetGo(const ModelArguments& a) : Load(a, one_value(a, "at")) {}

  std::string acts_on() const override { return "an interface"; }
  bool can_act_on(const Target& target) const override { return std::holds_alternative<InterfacePtr>(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "s"; }
  std::optional<Complaint> complaint(const Step& step) const override {
    const double end = step.is_static ? 1.0 : step.duration;
    if (at() >= 0.0 && at() <= end) return std::nullopt;
    return Complaint{
        fmt::format(".at = {:g}, outside the step [0, {:g}]", at(), end),
        step.is_static ? "a static step runs from 0 to 1" : "'at' counts in seconds from the step's start"};
  }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const Target& target : on) all.push_back(Release{std::get<InterfacePtr>(target), at()});
    return all;
  }
  Settings settings() const override { return {}; }

 private:
  double at() const { return values[0]->history.value(0.0); }
};

}  // namespace

namespace loads {
LoadEntry release() { return {"release", new_load<LetGo>}; }
}  // namespace loads

}  // namespace dygita

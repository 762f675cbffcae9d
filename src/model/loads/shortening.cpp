// load.shortening: draws the two sides of an interface together by a length, as a nut does.
#include <spdlog/fmt/fmt.h>

#include "model/load.hpp"
#include "model/tightening.hpp"

namespace dygita {

namespace {

class Shorten final : public Load {
 public:
  explicit Shorten(const ModelArguments& a)
      : Load(a, one_value(a, "by")),
        hand_(bolt_by_hand(a)),
        rating_(bolt_rating(a)),
        share_(a.number_or("share", 1.0)) {
    if (a.has("share") && !hand_ && !rating_)
      throw InputError("'share' refers to the bolt described by 'hand' or 'size', which are missing");
  }

  std::string acts_on() const override { return tightened_interfaces(); }
  bool can_act_on(const Target& target) const override { return can_be_tightened(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "m"; }
  std::optional<Complaint> complaint(const Step& step) const override {
    if (!step.is_static) return static_only(step, tighten_before);
    for (int i = 1; i <= step.increments; ++i)
      if (const double by = values[0]->history.value(static_cast<double>(i) / step.increments); by < 0.0)
        return Complaint{
            fmt::format(
                " asks for {:.6g} m in increment {}: a nut draws the sides together, so 'by' cannot be negative", by,
                i),
            "by = 0 loosens the bolt; to push two sides apart, use interface.contact with a negative 'gap'"};
    return std::nullopt;
  }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const Target& target : on)
      all.push_back(Shortening{{std::get<InterfacePtr>(target), *values[0], hand_, share_, rating_}});
    return all;
  }
  Settings settings() const override { return {}; }

 private:
  std::optional<BoltDimensions> hand_;
  std::optional<BoltRating> rating_;
  double share_;
};

}  // namespace

namespace loads {
LoadEntry shortening() { return {"shortening", new_load<Shorten>}; }
}  // namespace loads

}  // namespace dygita

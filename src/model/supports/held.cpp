// support.held: no displacement along some axes.
#include "base/error.hpp"
#include "model/support.hpp"

namespace dygita {

namespace {

class HeldAlongAxes final : public SupportKind {
 public:
  explicit HeldAlongAxes(const Directions& held) : held_(held) {}

  std::string word() const override { return "held"; }
  bool takes_regions() const override { return true; }
  Directions holds(bool) const override { return held_; }
  Directions claims() const override { return held_; }
  bool absorbs() const override { return false; }
  LawPtr law() const override { return nullptr; }
  Directions sums() const override { return Directions::none; }
  std::optional<SpringAlong> spring(int) const override { return std::nullopt; }

 private:
  Directions held_;
};

SupportKindPtr new_held(const LawArguments& arguments) {
  Directions held;
  for (size_t axis = 0; axis < 3; ++axis) held.axes[axis] = arguments.at(std::string(1, "xyz"[axis])) != 0.0;
  if (held == Directions::none) throw InputError("it holds nothing\n    give it x, y or z = true, or leave it out");
  return std::make_shared<const HeldAlongAxes>(held);
}

}  // namespace

namespace supports {
SupportEntry held() { return {"held", {"x", "y", "z"}, new_held}; }
}  // namespace supports

}  // namespace dygita

// support.spring: springs and dampers on the mean motion of a place, or between those of two (manual, eq. J7, J8).
#include <algorithm>

#include "base/error.hpp"
#include "law/law.hpp"
#include "model/support.hpp"

namespace dygita {

namespace {

class Spring final : public SupportKind {
 public:
  Spring(const std::array<SpringAlong, 6>& along, LawPtr law) : along_(along), law_(std::move(law)) {}

  std::string word() const override { return "spring"; }
  bool takes_regions() const override { return true; }
  Directions holds(bool) const override { return Directions::none; }
  Directions claims() const override { return Directions::none; }
  bool absorbs() const override { return false; }
  LawPtr law() const override { return law_; }
  Directions sums() const override {
    Directions axes;
    for (size_t axis = 0; axis < 3; ++axis)
      axes.axes[axis] = along_[axis].stiffness > 0.0 || along_[3 + axis].stiffness > 0.0;
    return axes;
  }
  std::optional<SpringAlong> spring(int axis) const override { return along_[static_cast<size_t>(axis)]; }

 private:
  std::array<SpringAlong, 6> along_;
  LawPtr law_;  // of its kind: what surfaces have is by their area
};

SupportKindPtr new_spring(const LawArguments& arguments) {
  std::array<SpringAlong, 6> along;
  for (size_t axis = 0; axis < 6; ++axis) {
    const std::string name = (axis < 3 ? "" : "about_") + std::string(1, "xyz"[axis % 3]);
    along[axis] = {arguments.at(name), arguments.at(name + "_damping")};
    if (along[axis].damping > 0.0 && along[axis].stiffness == 0.0)
      throw InputError("'" + name + "_damping' goes with the stiffness '" + name + "', which is missing");
  }
  double stiffest = 0.0;
  for (const SpringAlong& spring : along) stiffest = std::max(stiffest, spring.stiffness);
  if (stiffest == 0.0)
    throw InputError("it holds nothing\n    give it a stiffness along x, y or z, or about them (about_x ...)");
  return std::make_shared<const Spring>(along, law_of_spring({stiffest, 0.0}, 1.0));
}

}  // namespace

LawPtr law_of_spring(const SpringAlong& spring, double area) {
  return make_law("bushing", {{"normal", spring.stiffness / area},
                              {"tangential", 0.0},
                              {"normal_damping", spring.damping / area},
                              {"tangential_damping", 0.0},
                              {"loss", 0.0},
                              {"frequency", 0.0}});
}

namespace supports {
SupportEntry spring() {
  return {"spring",
          {"x", "y", "z", "x_damping", "y_damping", "z_damping", "about_x", "about_y", "about_z", "about_x_damping",
           "about_y_damping", "about_z_damping"},
          new_spring};
}
}  // namespace supports

}  // namespace dygita

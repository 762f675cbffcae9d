// support.equation: a weighted sum of the motions of several places stays zero (manual, eq. J7).
#include "base/error.hpp"
#include "law/law.hpp"
#include "model/support.hpp"

namespace dygita {

namespace {

class Equation final : public SupportKind {
 public:
  explicit Equation(const Directions& along) : along_(along), law_(make_law("bonded")) {}

  std::string word() const override { return "equation"; }
  bool takes_regions() const override { return true; }
  Directions holds(bool) const override { return Directions::none; }
  Directions claims() const override { return Directions::none; }
  bool absorbs() const override { return false; }
  LawPtr law() const override { return law_; }
  Directions sums() const override { return along_; }
  std::optional<SpringAlong> spring(int) const override { return std::nullopt; }

 private:
  Directions along_;
  LawPtr law_;
};

SupportKindPtr new_equation(const LawArguments& arguments) {
  Directions along;
  for (size_t axis = 0; axis < 3; ++axis) along.axes[axis] = arguments.at(std::string(1, "xyz"[axis])) != 0.0;
  if (along == Directions::none) throw InputError("it holds nothing\n    give it x, y or z = true, or leave it out");
  return std::make_shared<const Equation>(along);
}

}  // namespace

namespace supports {
SupportEntry equation() { return {"equation", {"x", "y", "z"}, new_equation}; }
}  // namespace supports

}  // namespace dygita

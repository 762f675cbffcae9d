// support.wall: a rigid wall, unilateral contact with friction.
#include "law/law.hpp"
#include "model/support.hpp"

namespace dygita {

namespace {

class Wall final : public SupportKind {
 public:
  explicit Wall(const LawArguments& friction_and_gap) : law_(make_law("contact", friction_and_gap)) {}

  std::string word() const override { return "wall"; }
  bool takes_regions() const override { return false; }
  Directions holds(bool) const override { return Directions::none; }
  Directions claims() const override { return Directions::normal; }
  bool absorbs() const override { return false; }
  LawPtr law() const override { return law_; }
  Directions sums() const override { return Directions::none; }
  std::optional<SpringAlong> spring(int) const override { return std::nullopt; }

 private:
  LawPtr law_;
};

SupportKindPtr new_wall(const LawArguments& arguments) { return std::make_shared<const Wall>(arguments); }

}  // namespace

namespace supports {
SupportEntry wall() { return {"wall", {"friction", "gap"}, new_wall}; }
}  // namespace supports

}  // namespace dygita

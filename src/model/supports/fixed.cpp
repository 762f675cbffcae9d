// support.fixed: no displacement.
#include "model/support.hpp"

namespace dygita {

namespace {

class Fixed final : public SupportKind {
 public:
  std::string word() const override { return "fixed"; }
  bool takes_regions() const override { return true; }
  Directions holds(bool) const override { return Directions::all; }
  Directions claims() const override { return Directions::all; }
  bool absorbs() const override { return false; }
  LawPtr law() const override { return nullptr; }
  Directions sums() const override { return Directions::none; }
  std::optional<SpringAlong> spring(int) const override { return std::nullopt; }
};

}  // namespace

namespace supports {
SupportEntry fixed() { return {"fixed", {}, new_support<Fixed>}; }
}  // namespace supports

}  // namespace dygita

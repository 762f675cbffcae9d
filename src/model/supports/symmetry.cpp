// support.symmetry: no displacement along the normal.
#include "model/support.hpp"

namespace dygita {

namespace {

class Symmetry final : public SupportKind {
 public:
  std::string word() const override { return "symmetry"; }
  bool takes_regions() const override { return false; }
  Directions holds(bool) const override { return Directions::normal; }
  Directions claims() const override { return Directions::normal; }
  bool absorbs() const override { return false; }
  LawPtr law() const override { return nullptr; }
  Directions sums() const override { return Directions::none; }
  std::optional<SpringAlong> spring(int) const override { return std::nullopt; }
};

}  // namespace

namespace supports {
SupportEntry symmetry() { return {"symmetry", {}, new_support<Symmetry>}; }
}  // namespace supports

}  // namespace dygita

// support.absorbing: lets waves out; holds in a static step, and keeps that reaction (manual, eq. S5).
#include "model/support.hpp"

namespace dygita {

namespace {

class Absorbing final : public SupportKind {
 public:
  std::string word() const override { return "absorbing"; }
  bool takes_regions() const override { return false; }
  Directions holds(bool is_static) const override { return is_static ? Directions::all : Directions::none; }
  Directions claims() const override { return Directions::all; }
  bool absorbs() const override { return true; }
  LawPtr law() const override { return nullptr; }
  Directions sums() const override { return Directions::none; }
  std::optional<SpringAlong> spring(int) const override { return std::nullopt; }
};

}  // namespace

namespace supports {
SupportEntry absorbing() { return {"absorbing", {}, new_support<Absorbing>}; }
}  // namespace supports

}  // namespace dygita

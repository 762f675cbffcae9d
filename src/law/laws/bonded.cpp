// Sides held together, the jump itself held (manual, eq. L1): no drift, and the way a bolt is shortened.
#include <limits>

#include "law/tie.hpp"

namespace dygita {

namespace {

class Bonded final : public Law, public TieSprings {
 public:
  std::string word() const override { return "bonded"; }
  std::vector<LawParameter> parameters() const override { return {}; }
  std::vector<LawRemark> remarks() const override { return {}; }
  Shown shown() const override { return {.states = true}; }

  bool is_tie() const override { return true; }
  bool joins_its_like() const override { return false; }
  bool can_be_tightened() const override { return true; }
  TensionLimit tension_limit() const override { return {}; }
  bool allows_massless_nodes() const override { return false; }

  bool acts_on(int, bool) const override { return true; }
  std::vector<MemoryEntry> memory() const override { return {}; }
  void set_initial(LawState&) const override {}
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override {
    return force_for_rate(trial, closing_rate(trial, increment, start.plastic_opening));
  }
  LawState advance(const Trial& trial, const Increment&, const LawState& start, const Vec3& force) const override {
    return held_end(trial, start, force);
  }
  void let_go(LawState&) const override {}
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState&, const LawState&, const Increment&, double) const override { return {}; }
  double opening(const LawState&) const override { return 0.0; }
  Tangent tangent(const LawState&, bool) const override { return {{true, true, true}}; }
  ExplicitForm explicit_form() const override { return {this, nullptr, {}}; }
};

}  // namespace

namespace laws {

LawEntry bonded() {
  return {"bonded", {}, [](const LawArguments&) -> LawPtr { return std::make_shared<Bonded>(); }};
}

}  // namespace laws

}  // namespace dygita

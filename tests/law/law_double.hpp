// A law that does nothing, for tests that change one of its answers.
#pragma once

#include "law/law.hpp"

namespace dygita {

class LawDouble : public Law {
 public:
  std::string word() const override { return "double"; }
  std::vector<LawParameter> parameters() const override { return {}; }
  std::vector<LawRemark> remarks() const override { return {}; }
  Shown shown() const override { return {}; }
  bool is_tie() const override { return false; }
  bool joins_its_like() const override { return false; }
  bool can_be_tightened() const override { return false; }
  TensionLimit tension_limit() const override { return {}; }
  bool allows_massless_nodes() const override { return false; }
  bool acts_on(int, bool) const override { return true; }
  std::vector<MemoryEntry> memory() const override { return {}; }
  void set_initial(LawState&) const override {}
  Vec3 force(const Trial&, const Increment&, const LawState&) const override { return Vec3::Zero(); }
  LawState advance(const Trial&, const Increment&, const LawState& start, const Vec3&) const override { return start; }
  void let_go(LawState&) const override {}
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState&, const LawState&, const Increment&, double) const override { return {}; }
  double opening(const LawState&) const override { return 0.0; }
  Tangent tangent(const LawState&, bool) const override { return {}; }
  ExplicitForm explicit_form() const override { return {nullptr, nullptr, "it has none"}; }
};

}  // namespace dygita

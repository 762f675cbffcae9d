// A damper: a traction in proportion to the relative velocity, pulling and pushing (manual, eq. L7).
#include <limits>

#include "law/law.hpp"

namespace dygita {

namespace {

class Viscous final : public Law {
 public:
  // Pa s/m along the normal and along the tangents; a direction without is free.
  Viscous(double normal, double tangential) : coefficient_(normal, tangential, tangential) {}

  std::string word() const override { return "viscous"; }
  std::vector<LawParameter> parameters() const override {
    return {{"normal", "Pa s/m", coefficient_[0]}, {"tangential", "Pa s/m", coefficient_[1]}};
  }
  std::vector<LawRemark> remarks() const override {
    return {{"damps by {} along the normal", coefficient_[0], "Pa s/m"},
            {"{} along the tangents", coefficient_[1], "Pa s/m"}};
  }
  Shown shown() const override { return {.followed = Followed::opening_and_slip}; }

  bool is_tie() const override { return false; }
  bool joins_its_like() const override { return false; }
  bool can_be_tightened() const override { return false; }
  TensionLimit tension_limit() const override { return {}; }
  bool allows_massless_nodes() const override { return false; }

  bool acts_on(int direction, bool is_static) const override { return !is_static && coefficient_[direction] > 0.0; }
  std::vector<MemoryEntry> memory() const override { return {}; }
  void set_initial(LawState& state) const override { state.status = PointState::slip; }

  // The force of a step is that of the mean of its two rates: it takes F . motion exactly, and never gives.
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override {
    Vec3 force = Vec3::Zero();
    for (int d = 0; d < 3; ++d) {
      if (!(trial.y[d] > 0.0 || trial.is_given[d]) || !acts_on(d, increment.is_static)) continue;
      const double c = trial.area * coefficient_[d];
      force[d] = c * increment.mean(start.rate[d], trial.s[d]) / (1.0 + increment.from_end(c) * trial.y[d]);
    }
    return force;
  }
  LawState advance(const Trial& trial, const Increment&, const LawState& start, const Vec3& force) const override {
    LawState end = start;
    end.rate = trial.s - trial.y.cwiseProduct(force);
    end.force = force;
    return end;
  }
  void let_go(LawState&) const override {}
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState& start, const LawState& end, const Increment& increment, double) const override {
    return {.damping = end.force.dot(motion_of(start, end, increment))};
  }
  double opening(const LawState&) const override { return 0.0; }
  Tangent tangent(const LawState&, bool) const override { return {{}, coefficient_}; }
  ExplicitForm explicit_form() const override { return {nullptr, this, {}}; }

 private:
  Vec3 coefficient_;
};

}  // namespace

namespace laws {

LawEntry viscous() {
  return {"viscous", {"normal", "tangential"}, [](const LawArguments& a) -> LawPtr {
            return std::make_shared<Viscous>(a.at("normal"), a.at("tangential"));
          }};
}

}  // namespace laws

}  // namespace dygita

// A linear spring and damper between the sides, pulling and pushing: an isolator, a gasket, a layer of adhesive, what
// other programs call CBUSH (manual, eq. L8).
#include <numbers>

#include "law/law.hpp"

namespace dygita {

namespace {

class Bushing final : public Law, public PenaltyForm {
 public:
  // Stiffness (Pa/m) and damping (Pa s/m); loss: factor of the stiffness that damps at a frequency (Hz), beside them.
  explicit Bushing(const LawArguments& a)
      : arguments_(a),
        stiffness_(a.at("normal"), a.at("tangential"), a.at("tangential")),
        damping_(a.at("normal_damping"), a.at("tangential_damping"), a.at("tangential_damping")) {
    if (a.at("loss") > 0.0) damping_ += a.at("loss") / (2.0 * std::numbers::pi * a.at("frequency")) * stiffness_;
    if (!damping_.isZero(0.0)) damper_ = make_law("viscous", {{"normal", damping_[0]}, {"tangential", damping_[1]}});
  }

  std::string word() const override { return "bushing"; }
  std::vector<LawParameter> parameters() const override {
    return {{"normal", "Pa/m", arguments_.at("normal")},
            {"tangential", "Pa/m", arguments_.at("tangential")},
            {"normal_damping", "Pa s/m", arguments_.at("normal_damping")},
            {"tangential_damping", "Pa s/m", arguments_.at("tangential_damping")},
            {"loss", "", arguments_.at("loss")},
            {"frequency", "Hz", arguments_.at("frequency")}};
  }
  std::vector<LawRemark> remarks() const override {
    std::vector<LawRemark> remarks = {{"a spring of {} along the normal", stiffness_[0], "Pa/m"},
                                      {"{} along the tangents", stiffness_[1], "Pa/m"}};
    if (damping_[0] > 0.0) remarks.push_back({"damps by {} along the normal", damping_[0], "Pa s/m"});
    if (damping_[1] > 0.0) remarks.push_back({"damps by {} along the tangents", damping_[1], "Pa s/m"});
    return remarks;
  }
  Shown shown() const override { return {.followed = Followed::opening_and_slip}; }

  bool is_tie() const override { return false; }
  bool joins_its_like() const override { return false; }
  bool can_be_tightened() const override { return true; }
  TensionLimit tension_limit() const override { return {}; }
  bool allows_massless_nodes() const override { return false; }

  bool acts_on(int direction, bool is_static) const override {
    return stiffness_[direction] > 0.0 || (!is_static && damping_[direction] > 0.0);
  }
  std::vector<MemoryEntry> memory() const override { return {{"elongation", "m", MemoryEntry::Kind::vector}}; }
  void set_initial(LawState& state) const override { state.status = PointState::slip; }
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  void let_go(LawState& state) const override { state.memory.clear(); }
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState& start, const LawState& end, const Increment& increment, double area) const override;
  double opening(const LawState& state) const override { return state.memory.vector(0)[0]; }
  Tangent tangent(const LawState&, bool) const override { return {{}, damping_, stiffness_}; }

  ExplicitForm explicit_form() const override { return {this, damper_.get(), ""}; }
  Vec3 stiffness(double area, double, double) const override { return area * stiffness_; }
  void begin(SpringPoint&) const override {}
  void move(SpringPoint& point, const Vec3& jump) const override;
  double penalty_energy(const SpringPoint&) const override { return 0.0; }
  double plastic_work(const LawState&, double) const override { return 0.0; }
  double stored_energy(const LawState& state, double area) const override {
    return 0.5 * area * stiffness_.dot(state.memory.vector(0).cwiseAbs2());
  }

 private:
  LawArguments arguments_;
  Vec3 stiffness_, damping_;
  LawPtr damper_;
};

// m, at the start of the increment, with the shortening of its end: that changes in static steps alone.
Vec3 elongation_of(const Trial& trial) { return trial.jump + Vec3(trial.shortening, 0.0, 0.0); }

Vec3 Bushing::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  const Vec3 elongation = elongation_of(trial);
  Vec3 force = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    if (!(trial.y[d] > 0.0 || trial.is_given[d])) continue;
    const double k = trial.area * stiffness_[d], c = increment.is_static ? 0.0 : trial.area * damping_[d];
    // Of the elongation's mean and of the mean rate, by which the elongation grows.
    const double by_rate = increment.from_end(increment.dt) * k + c, slope = increment.from_end(by_rate);
    const double before = k * elongation[d] + by_rate * increment.from_start(start.rate[d]);
    force[d] = (before + slope * trial.s[d]) / (1.0 + slope * trial.y[d]);
  }
  return force;
}

LawState Bushing::advance(const Trial& trial, const Increment& increment, const LawState& start,
                          const Vec3& force) const {
  LawState end = start;
  end.rate = trial.s - trial.y.cwiseProduct(force);
  end.force = force;
  end.memory.vector(0) = elongation_of(trial) + motion_of(start, end, increment);
  return end;
}

Work Bushing::work(const LawState& start, const LawState& end, const Increment& increment, double area) const {
  Work work{.stored = stored_energy(end, area) - stored_energy(start, area)};
  if (end.status == PointState::open)  // released
    work.damping = -work.stored;
  else if (!increment.is_static)
    work.damping = area / increment.dt * damping_.dot(motion_of(start, end, increment).cwiseAbs2());
  return work;
}

void Bushing::move(SpringPoint& point, const Vec3& jump) const {
  point.now.memory.vector(0) = point.start.memory.vector(0) + jump;
  point.now.force = point.stiffness.cwiseProduct(point.now.memory.vector(0));
}

}  // namespace

namespace laws {

LawEntry bushing() {
  return {"bushing",
          {"normal", "tangential", "normal_damping", "tangential_damping", "loss", "frequency"},
          [](const LawArguments& a) -> LawPtr { return std::make_shared<Bushing>(a); }};
}

}  // namespace laws

}  // namespace dygita

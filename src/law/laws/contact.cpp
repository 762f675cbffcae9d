// Unilateral contact with Coulomb friction, dynamic impacts without push-out (manual, eq. L4-L6).
#include <algorithm>
#include <cmath>
#include <limits>

#include "law/friction_disc.hpp"
#include "law/law.hpp"
#include "law/rough_contact.hpp"
#include "law/slip.hpp"

namespace dygita {

namespace {

// How fast the sides may come together at the end of the increment (m/s). In dynamics a gap may close, a penetration is
// not thrown back but for `push_out`, and sides that were parting may come back as fast: the mean of the two rates
// never opens under pressure, so the normal force never feeds energy in, and the gap is at worst what it was (manual,
// eq. L4).
double closing_speed(const Increment& increment, const LawState& start) {
  if (increment.is_static) return start.gap / increment.dt;
  const double gap = std::max(start.gap, increment.push_out * start.gap);
  const double parting = increment.undoing(start.rate[0]);
  return parting > 0.0 ? std::max(gap / increment.dt, parting) : gap / increment.dt;
}

class Contact final : public Law, public PenaltyForm {
 public:
  Contact(double friction, double gap) : friction_(friction), gap_(gap) {}

  std::string word() const override { return "contact"; }
  std::vector<LawParameter> parameters() const override { return {{"friction", "", friction_}, {"gap", "m", gap_}}; }
  std::vector<LawRemark> remarks() const override;
  Shown shown() const override {
    const bool rubs = friction_ > 0.0;
    return {.gap = true,
            .slip = rubs,
            .states = true,
            .followed = rubs ? Followed::nothing : Followed::slip_between_touches};
  }

  bool is_tie() const override { return false; }
  bool joins_its_like() const override { return true; }
  bool can_be_tightened() const override { return false; }
  TensionLimit tension_limit() const override { return {0.0, "it cannot pull", ""}; }
  bool allows_massless_nodes() const override { return true; }

  bool acts_on(int direction, bool) const override { return direction == 0 || friction_ > 0.0; }
  std::vector<MemoryEntry> memory() const override { return {}; }
  void set_initial(LawState& state) const override {
    state.gap = gap_;
    state.status = PointState::open;
  }
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  void let_go(LawState&) const override {}
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState& start, const LawState& end, const Increment& increment, double area) const override;
  double opening(const LawState& state) const override { return std::max(state.gap, 0.0); }
  Tangent tangent(const LawState& state, bool ties_sliding) const override;

  ExplicitForm explicit_form() const override { return {this, nullptr, {}}; }
  Vec3 stiffness(double, double cells, double penalty) const override { return Vec3::Constant(penalty * cells); }
  void begin(SpringPoint& point) const override;
  void move(SpringPoint& point, const Vec3& jump) const override;
  double penalty_energy(const SpringPoint& point) const override { return energy_of_springs(point); }
  double plastic_work(const LawState&, double) const override { return 0.0; }
  double stored_energy(const LawState&, double) const override { return 0.0; }

 private:
  double friction_, gap_;
};

std::vector<LawRemark> Contact::remarks() const {
  std::vector<LawRemark> remarks = {{"friction {}", friction_, ""}};
  if (gap_ > 0.0) remarks.push_back({"gap {}", gap_, "m"});
  if (gap_ < 0.0) remarks.push_back({"interference {}", -gap_, "m"});
  return remarks;
}

Vec3 Contact::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  Vec3 force = Vec3::Zero();
  if (trial.y[0] <= 0.0) return force;
  const double closing = -closing_speed(increment, start);
  force[0] = std::min((trial.s[0] - closing) / trial.y[0], 0.0);
  if (friction_ <= 0.0) return force;
  const GivenRates given{{trial.is_given[1], trial.is_given[2]}, start.force.tail<2>()};
  force.tail<2>() = project_on_disc(trial.s.tail<2>(), trial.y.tail<2>(), friction_ * std::abs(force[0]), given).force;
  return force;
}

LawState Contact::advance(const Trial& trial, const Increment& increment, const LawState& start,
                          const Vec3& force) const {
  LawState end = start;
  end.rate = trial.s - trial.y.cwiseProduct(force);
  const Vec3 moved = motion_of(start, end, increment);
  end.gap = start.gap + moved[0];
  end.force = force;
  follow_slip(moved.tail<2>(), force[0] != 0.0, end);
  const double limit = friction_ * std::abs(force[0]);
  if (force[0] == 0.0) {
    end.status = PointState::open;
  } else {
    end.status = force.tail<2>().norm() >= (1.0 - 1e-9) * limit ? PointState::slip : PointState::stick;
  }
  return end;
}

Work Contact::work(const LawState& start, const LawState& end, const Increment& increment, double) const {
  const Vec3 force = working_force(start, end, increment), motion = motion_of(start, end, increment);
  Work work;
  work.friction = force.tail<2>().dot(motion.tail<2>());
  // Where friction turns around within a static increment the mean of both forces is not what it slides against.
  if (increment.is_static) work.friction = std::max(0.0, work.friction);
  // An interference pressed out in a static step is work done from outside: as far as it goes, so that a gap which is
  // zero but for rounding adds nothing.
  if (increment.is_static && start.gap < 0.0) work.given = -force[0] * std::clamp(motion[0], 0.0, -start.gap);
  return work;
}

Tangent Contact::tangent(const LawState& state, bool ties_sliding) const {
  if (state.status == PointState::open) return {};
  const bool sticks = friction_ > 0.0 && (state.status == PointState::stick || ties_sliding);
  return {{true, sticks, sticks}};
}

// What pressed at the start keeps pressing; what overlapped without force is let be (eq. X9).
void Contact::begin(SpringPoint& point) const {
  const LawState& start = point.start;
  point.offset = start.force[0] < 0.0 ? start.force[0] / point.stiffness[0] - start.gap : std::max(0.0, -start.gap);
}

// Normal force of the gap, friction by radial return (eq. X9, X10).
void Contact::move(SpringPoint& point, const Vec3& jump) const {
  const Vec3 moved = jump - point.jump;
  LawState& now = point.now;
  now.gap = point.start.gap + jump[0];
  now.force[0] = point.stiffness[0] * std::min(0.0, now.gap + point.offset);
  const bool touches = now.force[0] != 0.0;
  now.status = touches ? PointState::slip : PointState::open;
  if (point.stiffness[1] == 0.0) {
    if (!touches) now.force.tail<2>().setZero();
    return follow_slip(moved.tail<2>(), touches, now);
  }
  const double limit = friction_ * -now.force[0];
  const Eigen::Vector2d trial = now.force.tail<2>() + point.stiffness[1] * moved.tail<2>();
  const double norm = trial.norm();
  const bool sticks = touches && norm <= limit;
  now.force.tail<2>() = sticks        ? trial
                        : limit > 0.0 ? Eigen::Vector2d(trial * (limit / norm))
                                      : Eigen::Vector2d::Zero();
  if (sticks) now.status = PointState::stick;
  const Eigen::Vector2d slid = (trial - now.force.tail<2>()) / point.stiffness[1];
  follow_slip(slid, touches, now);
  point.friction_work += now.force.tail<2>().dot(slid);
}

}  // namespace

namespace laws {

LawEntry contact() {
  std::vector<std::string> arguments = {"friction", "gap"};
  arguments.insert(arguments.end(), compliance_arguments().begin(), compliance_arguments().end());
  return {"contact", arguments, [](const LawArguments& a) -> LawPtr {
            if (is_rough(a)) return make_rough_contact(a);
            return std::make_shared<Contact>(a.at("friction"), a.at("gap"));
          }};
}

}  // namespace laws

}  // namespace dygita

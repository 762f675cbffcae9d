// Rigid-plastic in the normal direction, bonded in the tangents (manual, eq. L2-L3). The plastic opening follows the
// same two-point sum as the jump does: with p + dt l the sides would be pushed apart at each yielding step, without
// bound at large steps.
#include <cmath>
#include <limits>

#include "law/tie.hpp"

namespace dygita {

namespace {

// Of its own memory.
constexpr int hardening_opening = 0, opening_rate = 1;

class Plastic final : public Law, public TieSprings {
 public:
  // yield (Pa), hardening (Pa per metre of plastic opening), compression: yields in compression too.
  Plastic(double yield, double hardening, bool compression)
      : yield_(yield), hardening_(hardening), compression_(compression) {}

  std::string word() const override { return "plastic"; }
  std::vector<LawParameter> parameters() const override {
    return {{"yield", "Pa", yield_}, {"hardening", "Pa/m", hardening_}, {"compression", "", compression_}};
  }
  std::vector<LawRemark> remarks() const override;
  Shown shown() const override { return {.plastic_opening = true, .states = true}; }

  bool is_tie() const override { return false; }
  bool joins_its_like() const override { return false; }
  bool can_be_tightened() const override { return true; }
  TensionLimit tension_limit() const override {
    if (hardening_ > 0.0) return {};
    return {yield_, "it yields at {} without hardening", "give it 'hardening'"};
  }
  bool allows_massless_nodes() const override { return false; }

  bool acts_on(int, bool) const override { return true; }
  // What hardens is accumulated without sign; the rate is that of the last dynamic increment, zero after a static one.
  std::vector<MemoryEntry> memory() const override { return {{"hardening opening", "m"}, {"opening rate", "m/s"}}; }
  void set_initial(LawState&) const override {}
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  void let_go(LawState&) const override {}
  void begin_to_part(LawState& state, double rate) const override { state.memory.scalar(opening_rate) = rate; }
  Work work(const LawState& start, const LawState& end, const Increment& increment, double area) const override;
  double opening(const LawState& state) const override { return state.plastic_opening; }
  // Unloading is rigid.
  Tangent tangent(const LawState&, bool) const override { return {{true, true, true}}; }

  ExplicitForm explicit_form() const override { return {this, nullptr, {}}; }
  void begin(SpringPoint& point) const override { point.now.memory.scalar(opening_rate) = 0.0; }
  void move(SpringPoint& point, const Vec3& jump) const override;
  double plastic_work(const LawState& state, double area) const override;

 private:
  double rate_of_opening(const Trial& trial, const Increment& increment, const LawState& start) const;

  double yield_, hardening_;
  bool compression_;
};

std::vector<LawRemark> Plastic::remarks() const {
  std::vector<LawRemark> remarks = {{"yields at {}", yield_, "Pa"}};
  if (hardening_ > 0.0) remarks.push_back({"hardens by {} per mm", 1e-3 * hardening_, "Pa"});
  if (compression_) remarks.push_back({"in compression too", 0.0, ""});
  return remarks;
}

double Plastic::rate_of_opening(const Trial& trial, const Increment& increment, const LawState& start) const {
  const double z = trial.s[0] - closing_rate(trial, increment, start.plastic_opening)[0];
  // A dynamic force is the mean of the increment: it hardens with the opening half way, and its work is then exact.
  const double half = increment.is_static ? 1.0 : 0.5;
  const double had = start.memory.scalar(hardening_opening), before = start.memory.scalar(opening_rate);
  const double hardened = had + half * increment.motion(std::abs(before), 0.0);
  const double limit = trial.area * (yield_ + hardening_ * hardened);
  const double excess = (compression_ ? std::abs(z) : z) - trial.y[0] * limit;
  if (excess <= 0.0 || trial.y[0] <= 0.0) return 0.0;
  const double slope = trial.area * hardening_ * half * increment.from_end(increment.dt);
  const double rate = excess / (1.0 + trial.y[0] * slope);
  return z < 0.0 ? -rate : rate;
}

Vec3 Plastic::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  Vec3 c = closing_rate(trial, increment, start.plastic_opening);
  c[0] += rate_of_opening(trial, increment, start);
  return force_for_rate(trial, c);
}

LawState Plastic::advance(const Trial& trial, const Increment& increment, const LawState& start,
                          const Vec3& force) const {
  LawState end = held_end(trial, start, force);
  const double rate = rate_of_opening(trial, increment, start), before = start.memory.scalar(opening_rate);
  end.plastic_opening += increment.motion(before, rate);
  double& hardened = end.memory.scalar(hardening_opening);
  hardened += increment.motion(std::abs(before), std::abs(rate));
  end.memory.scalar(opening_rate) = increment.is_static ? 0.0 : rate;
  if (rate != 0.0) end.status = PointState::slip;
  return end;
}

double Plastic::plastic_work(const LawState& state, double area) const {
  const double p = state.memory.scalar(hardening_opening);
  return area * (yield_ * p + 0.5 * hardening_ * p * p);
}

Work Plastic::work(const LawState& start, const LawState& end, const Increment& increment, double area) const {
  Work work;
  work.plastic = plastic_work(end, area) - plastic_work(start, area);
  // A static increment that crosses yield bends the path: what the mean of both ends leaves out is work of whatever
  // drives it.
  if (increment.is_static)
    work.given = work.plastic - working_force(start, end, increment)[0] * (end.plastic_opening - start.plastic_opening);
  return work;
}

// Elastic, then return mapping with hardening in the normal direction (eq. X11).
void Plastic::move(SpringPoint& point, const Vec3& jump) const {
  TieSprings::move(point, jump);
  const double yield = point.area * yield_, hardening = point.area * hardening_;
  LawState& now = point.now;
  double& hardened = now.memory.scalar(hardening_opening);
  const double limit = yield + hardening * hardened;
  const double pull = compression_ ? std::abs(now.force[0]) : now.force[0];
  if (pull <= limit) return;
  const double opened = (pull - limit) / (point.stiffness[0] + hardening);
  const double sign = now.force[0] < 0.0 ? -1.0 : 1.0;
  now.force[0] -= sign * point.stiffness[0] * opened;
  now.plastic_opening += sign * opened;
  hardened += opened;
  now.status = PointState::slip;
}

}  // namespace

namespace laws {

LawEntry plastic() {
  return {"plastic", {"yield", "hardening", "compression"}, [](const LawArguments& a) -> LawPtr {
            return std::make_shared<Plastic>(a.at("yield"), a.at("hardening"), a.at("compression") != 0.0);
          }};
}

}  // namespace laws

}  // namespace dygita

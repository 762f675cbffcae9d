// One law, whose force, books, tangent and explicit form say the same thing four times: hence its length.
#include "law/rough_contact.hpp"

#include <algorithm>
#include <cmath>

#include "law/friction_disc.hpp"
#include "law/law.hpp"
#include "law/pressure_curve.hpp"
#include "law/slip.hpp"

namespace dygita {

namespace {

using Vec2 = Eigen::Vector2d;

// Of its own memory: scalars, and the one vector.
constexpr int approach_now = 0, approach_largest = 1, tangential_slope = 2, stretch = 0;

std::vector<double> numbered(const LawArguments& a, const std::string& name) {
  std::vector<double> list;
  for (auto it = a.end(); (it = a.find(name + "[" + std::to_string(list.size() + 1) + "]")) != a.end();)
    list.push_back(it->second);
  return list;
}

PressureCurve curve_of(const LawArguments& a) {
  if (const auto normal = a.find("normal"); normal != a.end()) return PressureCurve::linear(normal->second);
  if (a.contains("coefficient")) return PressureCurve::asperities(a.at("coefficient"), a.at("height"));
  return PressureCurve::through(numbered(a, "approach"), numbered(a, "pressure"));
}

std::string unit_of(const std::string& argument) {
  if (argument == "friction" || argument == "ratio") return "";
  if (argument == "coefficient") return "Pa/m^2.5";
  if (argument == "normal" || argument == "tangential") return "Pa/m";
  return argument.starts_with("pressure") ? "Pa" : "m";
}

class RoughContact final : public Law, public PenaltyForm {
 public:
  explicit RoughContact(const LawArguments& a)
      : arguments_(a),
        friction_(a.at("friction")),
        curve_(curve_of(a)),
        tangential_(a.contains("tangential") ? a.at("tangential") : 0.0),
        ratio_(a.contains("ratio") ? a.at("ratio") : 0.0) {}

  std::string word() const override { return "contact"; }
  std::vector<LawParameter> parameters() const override {
    std::vector<LawParameter> parameters;
    for (const auto& [name, value] : arguments_) parameters.push_back({name, unit_of(name), value});
    return parameters;
  }
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
  bool allows_massless_nodes() const override { return false; }

  bool acts_on(int direction, bool) const override { return direction == 0 || friction_ > 0.0; }
  std::vector<MemoryEntry> memory() const override {
    return {{"approach", "m"},
            {"largest approach", "m"},
            {"tangential slope", "Pa/m"},
            {"tangential elongation", "m", MemoryEntry::Kind::vector}};
  }
  void set_initial(LawState& state) const override {
    state.gap = arguments_.at("gap");
    state.status = PointState::open;
  }
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  void let_go(LawState& state) const override { state.memory.clear(); }
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState& start, const LawState& end, const Increment& increment, double area) const override;
  double opening(const LawState& state) const override { return std::max(state.gap, 0.0); }
  Tangent tangent(const LawState& state, bool ties_sliding) const override;

  ExplicitForm explicit_form() const override { return {this, nullptr, {}}; }
  Vec3 stiffness(double area, double cells, double penalty) const override;
  void begin(SpringPoint& point) const override;
  void move(SpringPoint& point, const Vec3& jump) const override;
  double penalty_energy(const SpringPoint& point) const override;
  double plastic_work(const LawState&, double) const override { return 0.0; }
  double stored_energy(const LawState& state, double area) const override {
    return area * (curve_.energy(state.memory.scalar(approach_now)) + tangential_energy(state.memory));
  }

 private:
  // What the tangents start an increment from: the slope (Pa/m) and the elongation (m) once the approach has changed,
  // and what of it the friction of the increment (Pa, at most) lets be.
  struct Tangential {
    double slope = 0.0;
    Vec2 changed = Vec2::Zero(), left = Vec2::Zero();
  };
  Tangential tangential_after(const LawMemory& start, double approach, double slope, double limit,
                              bool is_static) const;
  double approach_after(const Trial& trial, const Increment& increment, const LawState& start) const;
  double working_pressure(double from, double to, const Increment& increment) const;
  Vec2 tangential_force(const Trial& trial, const Increment& increment, const LawState& start, const Tangential& t,
                        double limit) const;
  double tangential_slope_at(double approach, double normal_slope) const {
    if (!(approach > 0.0) || friction_ == 0.0) return 0.0;
    return tangential_ > 0.0 ? tangential_ : ratio_ * normal_slope;
  }
  static double tangential_energy(const LawMemory& memory) {
    return 0.5 * memory.scalar(tangential_slope) * memory.vector(stretch).squaredNorm();
  }
  // Into the memory at the end, which forgets where the sides part.
  static void keep(double approach, double slope, const Vec2& stretched, LawMemory& memory);

  LawArguments arguments_;
  double friction_;
  PressureCurve curve_;
  double tangential_, ratio_;
};

std::vector<LawRemark> RoughContact::remarks() const {
  std::vector<LawRemark> remarks = {{"friction {}", friction_, ""}};
  const double gap = arguments_.at("gap");
  if (gap > 0.0) remarks.push_back({"gap {}", gap, "m"});
  if (gap < 0.0) remarks.push_back({"interference {}", -gap, "m"});
  if (arguments_.contains("normal"))
    remarks.push_back({"gives way by {}", arguments_.at("normal"), "Pa/m"});
  else
    remarks.push_back({"asperities carry {} at an approach of a micrometre", curve_.pressure(1e-6), "Pa"});
  if (tangential_ > 0.0) remarks.push_back({"along the tangents by {}", tangential_, "Pa/m"});
  if (ratio_ > 0.0) remarks.push_back({"along the tangents by {} of the normal", ratio_, ""});
  return remarks;
}

// Pa; in dynamics the mean over the way, on which it then works exactly what the asperities store. With numerical
// damping the way is longer than the increment's (eq. L13).
double RoughContact::working_pressure(double from, double to, const Increment& increment) const {
  if (increment.is_static) return curve_.pressure(to);
  return curve_.mean(from, from + 2.0 * increment.from_end(to - from));
}

// Of approach + (its change by the pressure) = that without pressure, which rises with the approach: Newton's method
// between bounds.
double RoughContact::approach_after(const Trial& trial, const Increment& increment, const LawState& start) const {
  constexpr int most = 100;
  constexpr double exact = 1e-15, rounding = 2e-16;
  const double from = -start.gap;
  const double free = from - increment.motion(start.rate[0], trial.s[0]);
  const double answer = increment.dt * increment.from_end(trial.y[0]) * trial.area;  // m/Pa
  if (answer <= 0.0) return free;
  // Farther back than the start only against less pressure than that has.
  const double back = increment.is_static ? std::min(free, 0.0) : std::min(from, free - answer * curve_.pressure(from));
  double high = free, low = std::min(free, back);
  double approach = from > low && from < high ? from : free;  // most increments change little
  for (int i = 0; i < most; ++i) {
    const double pressure = working_pressure(from, approach, increment);
    const double residual = approach - free + answer * pressure;
    if (std::abs(residual) <= rounding * (std::abs(free) + answer * pressure)) break;
    (residual > 0.0 ? high : low) = approach;
    const double way = 2.0 * increment.from_end(approach - from), size = std::max(std::abs(approach), std::abs(from));
    double slope = curve_.slope(approach);
    if (!increment.is_static)
      slope = increment.from_end(std::abs(way) > 1e-6 * size ? 2.0 * (curve_.pressure(from + way) - pressure) / way
                                                             : slope);
    const double before = approach, next = approach - residual / (1.0 + answer * slope);
    approach = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(approach - before) <= exact * size) break;
  }
  return approach;
}

// In a static increment the slope is that of the approach, below the largest one both ways; what first touches is not
// stretched, and adds nothing to the traction. In dynamics it grows alone, so that no cycle gains energy (eq. L14).
RoughContact::Tangential RoughContact::tangential_after(const LawMemory& start, double approach, double slope,
                                                        double limit, bool is_static) const {
  const double largest = start.scalar(approach_largest), before = start.scalar(tangential_slope);
  const double here = tangential_slope_at(approach, slope);
  const double full = is_static ? tangential_slope_at(largest, curve_.slope(largest)) : before;
  Tangential t;
  t.slope = is_static ? here : std::max(here, before);
  if (!(t.slope > 0.0)) return t;
  const bool grows = is_static ? approach > largest : here > before;
  t.changed = (grows ? full / t.slope : 1.0) * start.vector(stretch).tail<2>();
  const double traction = t.slope * t.changed.norm();
  t.left = traction > limit ? Vec2(limit / traction * t.changed) : t.changed;
  return t;
}

Vec2 RoughContact::tangential_force(const Trial& trial, const Increment& increment, const LawState& start,
                                    const Tangential& t, double limit) const {
  Vec2 force = Vec2::Zero();
  if (!(t.slope > 0.0) || !(limit > 0.0)) return force;
  const double k = trial.area * t.slope;
  const Vec2 answer = increment.dt * increment.from_end<Vec2>(trial.y.tail<2>());  // m/N
  std::array<bool, 2> acts{};
  Vec2 free = Vec2::Zero();  // elongation without a force
  for (const int d : {0, 1}) {
    acts[d] = trial.y[d + 1] > 0.0 || trial.is_given[d + 1];
    if (!acts[d]) continue;
    const double moved = increment.motion(start.rate[d + 1], trial.s[d + 1]);
    free[d] = t.left[d] + moved;
    force[d] = k * (t.left[d] + increment.from_end(moved)) / (1.0 + k * increment.from_end(answer[d]));
  }
  if (t.slope * (free - answer.cwiseProduct(force)).norm() <= limit) return force;
  // It slides: the traction at the end is the limit, along the elongation that there would be.
  const Vec2 before = k * increment.from_start(t.left);
  const double slides = trial.area * increment.from_end(limit);
  Vec2 s = free - answer.cwiseProduct(before);
  for (const int d : {0, 1})
    if (!acts[d]) s[d] = 0.0;
  const GivenRates given{{trial.is_given[1], trial.is_given[2]}, Vec2::Zero()};
  const Vec2 along = project_on_disc(s, slides * answer, 1.0, given).force;
  for (const int d : {0, 1})
    if (acts[d]) force[d] = before[d] + slides * along[d];
  return force;
}

Vec3 RoughContact::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  Vec3 force = Vec3::Zero();
  if (trial.y[0] <= 0.0 && !trial.is_given[0]) return force;
  const double approach = approach_after(trial, increment, start);
  const double pressure = working_pressure(-start.gap, approach, increment);
  if (!(pressure > 0.0)) return force;
  force[0] = -trial.area * pressure;
  if (friction_ <= 0.0) return force;
  const double limit = friction_ * pressure;
  const Tangential t = tangential_after(start.memory, approach, curve_.slope(approach), limit, increment.is_static);
  force.tail<2>() = tangential_force(trial, increment, start, t, limit);
  return force;
}

void RoughContact::keep(double approach, double slope, const Vec2& stretched, LawMemory& memory) {
  if (!(approach > 0.0)) return memory.clear();
  memory.scalar(approach_now) = approach;
  memory.scalar(approach_largest) = std::max(approach, memory.scalar(approach_largest));
  memory.scalar(tangential_slope) = slope;
  memory.vector(stretch) = Vec3(0.0, stretched[0], stretched[1]);
}

LawState RoughContact::advance(const Trial& trial, const Increment& increment, const LawState& start,
                               const Vec3& force) const {
  LawState end = start;
  end.rate = trial.s - trial.y.cwiseProduct(force);
  const Vec3 moved = motion_of(start, end, increment);
  end.gap = start.gap + moved[0];
  end.force = force;
  end.status = PointState::open;
  const double approach = -end.gap, limit = friction_ * -force[0] / trial.area;
  const Tangential t = tangential_after(start.memory, approach, curve_.slope(approach), limit, increment.is_static);
  Vec2 last = Vec2::Zero();
  follow_slip(moved.tail<2>(), force[0] < 0.0, end);
  if (force[0] < 0.0) {
    if (t.slope > 0.0) last = increment.end_of<Vec2>(force.tail<2>() / (trial.area * t.slope), t.left);
    const bool slides = t.slope * last.norm() >= (1.0 - 1e-9) * limit;
    end.status = slides ? PointState::slip : PointState::stick;
  }
  keep(approach, t.slope, last, end.memory);
  return end;
}

// With the traction that the force works with; what falls to zero or grows into more slope is lost, too. In a static
// increment what the mean of both ends leaves out of the bent path is work of whatever drives it.
Work RoughContact::work(const LawState& start, const LawState& end, const Increment& increment, double area) const {
  Work work{.stored = stored_energy(end, area) - stored_energy(start, area)};
  if (end.status == PointState::open && end.gap < 0.0) {  // released
    work.damping = -work.stored;
    return work;
  }
  const Vec3 motion = motion_of(start, end, increment);
  const double limit = friction_ * -end.force[0] / area;
  const Tangential t = tangential_after(start.memory, -end.gap, curve_.slope(-end.gap), limit, increment.is_static);
  if (end.force[0] < 0.0 && t.slope > 0.0) {
    const Vec2 traction = end.force.tail<2>() / area;
    const Vec2 last = increment.end_of<Vec2>(traction / t.slope, t.left);
    const Vec2 slid = motion.tail<2>() - (last - t.left);
    const double before =
        increment.is_static ? 0.5 * t.slope * t.changed.squaredNorm() : tangential_energy(start.memory);
    work.friction = area * (traction.dot(slid) + before - 0.5 * t.slope * t.left.squaredNorm());
    if (!(end.gap < 0.0)) work.friction += area * 0.5 * t.slope * last.squaredNorm();
  }
  if (increment.is_static) work.given = work.stored + work.friction - working_force(start, end, increment).dot(motion);
  return work;
}

Tangent RoughContact::tangent(const LawState& state, bool ties_sliding) const {
  const double approach = -state.gap;
  if (!(approach > 0.0)) return {};
  const bool sticks = state.status == PointState::stick || ties_sliding;
  const double normal = curve_.slope(approach),
               known = state.memory.size() > 0 ? state.memory.scalar(tangential_slope) : 0.0;
  const double k = !sticks ? 0.0 : known > 0.0 ? known : tangential_slope_at(approach, normal);
  return {{}, Vec3::Zero(), Vec3(normal, k, k)};
}

// Their own, but for asperities, which grow without bound: beyond the stiffness of the cells behind they are straight.
Vec3 RoughContact::stiffness(double area, double cells, double penalty) const {
  const double most = std::max(1.0, penalty) * cells;
  double normal = 0.0;
  if (arguments_.contains("coefficient"))
    normal = most;
  else if (arguments_.contains("normal"))
    normal = area * arguments_.at("normal");
  else
    for (const double x : numbered(arguments_, "approach"))
      normal = std::max(normal, area * curve_.slope(x * (1 - 1e-9)));
  const double tangential = tangential_ > 0.0 ? area * tangential_ : ratio_ * normal;
  return {normal, tangential, tangential};
}

void RoughContact::begin(SpringPoint& point) const {
  point.offset = curve_.approach_of_slope(point.stiffness[0] / point.area);
}

void RoughContact::move(SpringPoint& point, const Vec3& jump) const {
  LawState& now = point.now;
  const Vec2 moved = (jump - point.jump).tail<2>();
  now.gap = point.start.gap + jump[0];
  const double approach = -now.gap, straight = std::min(approach, point.offset);
  const double slope = curve_.slope(straight);
  const double pressure = curve_.pressure(straight) + slope * (approach - straight), limit = friction_ * pressure;
  const double before = tangential_energy(now.memory);
  const Tangential t = tangential_after(now.memory, approach, slope, limit, false);
  Vec2 last = Vec2::Zero();
  now.force = Vec3(-point.area * pressure, 0.0, 0.0);
  now.status = pressure > 0.0 ? PointState::stick : PointState::open;
  if (pressure > 0.0) {
    const Vec2 free = t.left + moved;
    const double traction = t.slope * free.norm();
    last = traction > limit ? Vec2(limit / traction * free) : free;
    if (traction >= limit) now.status = PointState::slip;
    point.friction_work += point.area * 0.5 * t.slope * (t.left + last).dot(free - last);
    now.force.tail<2>() = point.area * t.slope * last;
  }
  follow_slip(moved, pressure > 0.0, now);
  point.friction_work += point.area * (before - 0.5 * t.slope * t.left.squaredNorm());
  keep(approach, t.slope, last, now.memory);
}

// What the straight end of asperities lacks of what they would store.
double RoughContact::penalty_energy(const SpringPoint& point) const {
  const double approach = -point.now.gap, more = approach - point.offset;
  if (!(more > 0.0)) return 0.0;
  const double straight =
      curve_.energy(point.offset) + more * (curve_.pressure(point.offset) + 0.5 * more * curve_.slope(point.offset));
  return point.area * (straight - curve_.energy(approach));
}

}  // namespace

const std::vector<std::string>& compliance_arguments() {
  static const std::vector<std::string> names = {"normal?", "approach[]",  "pressure[]", "coefficient?",
                                                 "height?", "tangential?", "ratio?"};
  return names;
}

bool is_rough(const LawArguments& arguments) {
  return arguments.contains("normal") || arguments.contains("coefficient") || arguments.contains("approach[1]");
}

LawPtr make_rough_contact(const LawArguments& arguments) { return std::make_shared<RoughContact>(arguments); }

double coefficient_of_asperities(double radius, double density, double contact_modulus, double height) {
  return 8.0 / 15.0 * density * contact_modulus * std::sqrt(radius) / height;
}

}  // namespace dygita

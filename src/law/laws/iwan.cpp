// A lap joint that slips little by little: bonded along the normal, Iwan's sliders side by side along the tangents,
// with the distribution of limits of Segalman's four parameters (manual, eq. L9-L11).
#include <algorithm>
#include <cmath>

#include "law/tie.hpp"

namespace dygita {

namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

struct Slider {
  double stiffness, limit;  // Pa/m, Pa
};

// The force of a slider (Pa) that would have this one if it stuck.
Vec2 returned(const Slider& slider, const Vec2& trial) {
  const double size = trial.norm();
  return size > slider.limit ? Vec2(slider.limit / size * trial) : trial;
}

// Each slider stands for a band of limits, has its stiffness and its force when all of it slides: the joint's stiffness
// and its limit are exact, and so is the backbone at the ends of the bands. These are in a geometric row, four decades
// long unless that makes it too coarse.
std::vector<Slider> sliders_of(double slip, double stiffness, double chi, double beta, int n) {
  constexpr double shortest = 1e-4, coarsest = 0.5;
  const double shape = beta + (chi + 1.0) / (chi + 2.0);
  const double longest = slip * (1.0 + beta) / (stiffness * shape);  // m, where all slides
  const double density = slip * (chi + 1.0) / (std::pow(longest, chi + 2.0) * shape);
  const double ratio = n > 1 ? std::max(coarsest, std::pow(shortest, 1.0 / (n - 1))) : 1.0;
  std::vector<Slider> sliders;
  double first = 0.0;
  for (int i = 0; i < n; ++i) {
    const double end = longest * std::pow(ratio, n - 1 - i);
    const auto moment = [&](double power) { return density * (std::pow(end, power) - std::pow(first, power)) / power; };
    sliders.push_back({moment(chi + 1.0), moment(chi + 2.0)});
    first = end;
  }
  if (beta > 0.0) sliders.push_back({slip * beta / (longest * shape), slip * beta / shape});
  return sliders;
}

class Iwan final : public Law, public TieSprings {
 public:
  // slip: traction at which all slides (Pa); stiffness: of a small motion (Pa/m); chi, beta: of Segalman's
  // distribution.
  explicit Iwan(const LawArguments& a)
      : arguments_(a),
        slip_(a.at("slip")),
        stiffness_(a.at("stiffness")),
        sliders_(
            sliders_of(slip_, stiffness_, a.at("chi"), a.at("beta"), static_cast<int>(std::lround(a.at("sliders"))))) {}

  std::string word() const override { return "iwan"; }
  std::vector<LawParameter> parameters() const override {
    return {{"slip", "Pa", slip_},
            {"stiffness", "Pa/m", stiffness_},
            {"chi", "", arguments_.at("chi")},
            {"beta", "", arguments_.at("beta")},
            {"sliders", "", arguments_.at("sliders")}};
  }
  std::vector<LawRemark> remarks() const override {
    return {{"slips altogether at {}", slip_, "Pa"},
            {"{} before", stiffness_, "Pa/m"},
            {"chi {}", arguments_.at("chi"), ""},
            {"beta {}", arguments_.at("beta"), ""}};
  }
  Shown shown() const override { return {.slip = true, .states = true}; }

  bool is_tie() const override { return false; }
  bool joins_its_like() const override { return false; }
  bool can_be_tightened() const override { return false; }
  TensionLimit tension_limit() const override { return {}; }
  bool allows_massless_nodes() const override { return false; }

  bool acts_on(int, bool) const override { return true; }
  std::vector<MemoryEntry> memory() const override {
    return {{"traction of the sliders", "Pa", MemoryEntry::Kind::vector, static_cast<int>(sliders_.size())}};
  }
  void set_initial(LawState&) const override {}
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  void let_go(LawState& state) const override { state.memory.clear(); }
  void begin_to_part(LawState&, double) const override {}
  Work work(const LawState& start, const LawState& end, const Increment& increment, double area) const override;
  double opening(const LawState&) const override { return 0.0; }
  // What turns round sticks.
  Tangent tangent(const LawState& state, bool ties_sliding) const override {
    const double k = state.status == PointState::slip && !ties_sliding ? 0.0 : stiffness_;
    return {{true, false, false}, Vec3::Zero(), Vec3(0.0, k, k)};
  }

  ExplicitForm explicit_form() const override { return {this, nullptr, {}}; }
  Vec3 stiffness(double area, double cells, double penalty) const override {
    return {TieSprings::stiffness(area, cells, penalty)[0], area * stiffness_, area * stiffness_};
  }
  void move(SpringPoint& point, const Vec3& jump) const override;
  double penalty_energy(const SpringPoint& point) const override { return energy_of_springs(point, 0, 1); }
  double stored_energy(const LawState& state, double area) const override;

 private:
  // Of all sliders after a tangential motion (m): traction (Pa), and how it answers to more (Pa/m).
  struct Answer {
    Vec2 traction = Vec2::Zero();
    Mat2 slope = Mat2::Zero();
  };
  Answer after(const LawMemory& start, const Vec2& motion) const;
  // The same into the memory; is none left that sticks?
  bool slide(const LawMemory& start, const Vec2& motion, LawMemory& end) const;
  Vec2 traction_of(const LawMemory& memory) const;
  Vec2 force_of_sliders(const Trial& trial, const Increment& increment, const LawState& start) const;

  LawArguments arguments_;
  double slip_, stiffness_;
  std::vector<Slider> sliders_;
};

Vec2 Iwan::traction_of(const LawMemory& memory) const {
  Vec2 sum = Vec2::Zero();
  for (int i = 0; i < memory.n_vectors(); ++i) sum += memory.vector(i).tail<2>();
  return sum;
}

Iwan::Answer Iwan::after(const LawMemory& start, const Vec2& motion) const {
  Answer answer;
  for (int i = 0; i < start.n_vectors(); ++i) {
    const Slider& slider = sliders_[static_cast<size_t>(i)];
    const Vec2 trial = start.vector(i).tail<2>() + slider.stiffness * motion;
    const double size = trial.norm();
    if (size <= slider.limit) {
      answer.traction += trial;
      answer.slope.diagonal().array() += slider.stiffness;
      continue;
    }
    const Vec2 along = trial / size;
    answer.traction += slider.limit * along;
    answer.slope += slider.stiffness * slider.limit / size * (Mat2::Identity() - along * along.transpose());
  }
  return answer;
}

bool Iwan::slide(const LawMemory& start, const Vec2& motion, LawMemory& end) const {
  bool all_slide = true;
  for (int i = 0; i < start.n_vectors(); ++i) {
    const Slider& slider = sliders_[static_cast<size_t>(i)];
    const Vec2 trial = start.vector(i).tail<2>() + slider.stiffness * motion, last = returned(slider, trial);
    end.vector(i).tail<2>() = last;
    all_slide &= last != trial;
  }
  return all_slide;
}

// Newton's method on rate + Y F(rate) = s, the gradient of a convex potential, from no motion on: from there each
// slider answers less and less.
Vec2 Iwan::force_of_sliders(const Trial& trial, const Increment& increment, const LawState& start) const {
  constexpr int most = 100;
  constexpr double exact = 1e-14;
  const Vec2 before = start.rate.tail<2>(), y = trial.y.tail<2>(), traction = traction_of(start.memory);
  Vec2 s = trial.s.tail<2>(), rate = -increment.undoing(before), weight = Vec2::Zero(), force = Vec2::Zero();
  for (int d = 0; d < 2; ++d) {
    if (y[d] > 0.0)
      weight[d] = 1.0 / y[d];
    else if (trial.is_given[d + 1])
      rate[d] = s[d];
    else
      s[d] = rate[d];
  }
  Answer answer;
  const auto residual_at = [&](const Vec2& at) {
    answer = after(start.memory, increment.motion(before, at));
    force = trial.area * increment.mean(traction, answer.traction);
    return Vec2(at + y.cwiseProduct(force) - s);
  };
  const double rounding = 1e-2 * trial.area * slip_ * y.maxCoeff();
  Vec2 residual = residual_at(rate);
  for (int i = 0; i < most && residual.norm() > exact * (s.norm() + y.cwiseProduct(force).norm() + rounding); ++i) {
    const Mat2 slope = Mat2::Identity() + trial.area * increment.from_end(increment.from_end(increment.dt)) *
                                              Mat2(y.asDiagonal() * answer.slope);
    Vec2 step = -slope.inverse() * residual;
    // The slope of the potential along the step: where it rises, the step goes too far.
    const double falls = std::abs(residual.cwiseProduct(weight).dot(step));
    Vec2 next = residual_at(rate + step);
    for (int k = 0; k < most && next.cwiseProduct(weight).dot(step) > 1e-3 * falls; ++k) {
      step *= 0.5;
      next = residual_at(rate + step);
    }
    rate += step;
    residual = next;
  }
  return force;
}

Vec3 Iwan::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  const Vec2 of_sliders = force_of_sliders(trial, increment, start);
  Vec3 force = Vec3::Zero();
  if (trial.y[0] > 0.0) force[0] = force_for_rate(trial, closing_rate(trial, increment, 0.0))[0];
  for (const int d : {1, 2})
    if (trial.y[d] > 0.0 || trial.is_given[d]) force[d] = of_sliders[d - 1];
  return force;
}

LawState Iwan::advance(const Trial& trial, const Increment& increment, const LawState& start, const Vec3& force) const {
  LawState end = held_end(trial, start, force);
  const Vec2 motion = motion_of(start, end, increment).tail<2>();
  if (slide(start.memory, motion, end.memory)) end.status = PointState::slip;
  end.slip.tail<2>() += motion;
  return end;
}

double Iwan::stored_energy(const LawState& state, double area) const {
  double energy = 0.0;
  for (int i = 0; i < state.memory.n_vectors(); ++i)
    energy += 0.5 * state.memory.vector(i).squaredNorm() / sliders_[static_cast<size_t>(i)].stiffness;
  return area * energy;
}

// A slider rubs with the mean of the step, as the force works; in a static step with the force that it slides against,
// and what the mean of both ends leaves out of the bent path is work of whatever drives it.
Work Iwan::work(const LawState& start, const LawState& end, const Increment& increment, double area) const {
  Work work{.stored = stored_energy(end, area) - stored_energy(start, area)};
  if (end.status == PointState::open) {  // released
    work.damping = -work.stored;
    return work;
  }
  const Vec2 motion = motion_of(start, end, increment).tail<2>();
  for (int i = 0; i < start.memory.n_vectors(); ++i) {
    const Vec2 first = start.memory.vector(i).tail<2>(), last = end.memory.vector(i).tail<2>();
    const Vec2 slid = motion - (last - first) / sliders_[static_cast<size_t>(i)].stiffness;
    work.friction += area * increment.mean(first, last).dot(slid);
  }
  if (increment.is_static)
    work.given = work.stored + work.friction - working_force(start, end, increment).tail<2>().dot(motion);
  return work;
}

// The normal as a tie's, the sliders by radial return.
void Iwan::move(SpringPoint& point, const Vec3& jump) const {
  const Vec3 moved = jump - point.jump;
  const Vec2 motion = moved.tail<2>();
  LawState& now = point.now;
  now.force[0] += point.stiffness[0] * moved[0];
  Vec2 traction = Vec2::Zero();
  bool all_slide = true;
  for (int i = 0; i < now.memory.n_vectors(); ++i) {
    const Slider& slider = sliders_[static_cast<size_t>(i)];
    const Vec2 first = now.memory.vector(i).tail<2>(), trial = first + slider.stiffness * motion;
    const Vec2 last = returned(slider, trial);
    point.friction_work += point.area * 0.5 * (first + last).dot(trial - last) / slider.stiffness;
    now.memory.vector(i).tail<2>() = last;
    traction += last;
    all_slide &= last != trial;
  }
  now.force.tail<2>() = point.area * traction;
  now.slip.tail<2>() += motion;
  now.status = all_slide ? PointState::slip : PointState::stick;
}

}  // namespace

namespace laws {

LawEntry iwan() {
  return {"iwan", {"slip", "stiffness", "chi", "beta", "sliders"}, [](const LawArguments& a) -> LawPtr {
            return std::make_shared<Iwan>(a);
          }};
}

}  // namespace laws

}  // namespace dygita

// Does what a load's history holds happen in the step it acts in? Said with warn(), with the figures.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "checks/parts.hpp"
#include "model/load.hpp"
#include "model/load_content.hpp"
#include "signal/unit.hpp"

namespace dygita::check {

namespace {

constexpr double rounding = 1e-6;
constexpr double near_zero = 0.02;            // of the largest value
constexpr double most_acceleration = 980665;  // m/s^2

std::string time(double t) {
  const double size = std::abs(t);
  if (size >= 1.0) return fmt::format("{:.4g} s", t);
  return size >= 1e-3 || size == 0.0 ? fmt::format("{:.4g} ms", 1e3 * t) : fmt::format("{:.4g} us", 1e6 * t);
}

// A load's value along one axis, in one step.
class InStep {
 public:
  InStep(const Problem& problem, const Step& step, const Load& load, const History& history, const Chain& chain)
      : problem_(problem), step_(step), load_(load), history_(history), chain_(chain), profile_(history.profile()) {}

  void check() const {
    has_its_unit();
    if (history_.is_constant() || (profile_ && profile_->low == profile_->high)) return;
    if (!profile_)
      rises_no_more();
    else if (profile_->begin == profile_->end)
      jumps_in_the_step();
    else if (step_.is_static)
      lasts_in_a_static_step();
    else
      lasts_in_a_dynamic_step();
  }

 private:
  void has_its_unit() const {
    if (const std::optional<double> factor = history_.factor_without_unit()) return doubt_missing_unit(*factor);
    const std::string unit = history_.unit();
    if (unit.empty() || unit == load_.unit()) return;
    fail(problem_, load_.origin,
         fmt::format("{} takes {}, and the file of its history is in {}", who(), load_.unit(), unit),
         "scale the signal by a number, as in 7.2*signal for a mass of 7.2 kg, to change its unit");
  }

  // A file without a unit: g taken for m/s^2 is a tenth of the shock. A factor may be that of a unit, and may not.
  void doubt_missing_unit(double factor) const {
    const bool is_acceleration = load_.unit() == std::string("m/s^2");
    const std::string what = fmt::format("{} takes {}, and the file of its history gives no unit", who(), load_.unit());
    if (std::abs(std::abs(factor) - 1.0) < 1e-9) {
      if (is_acceleration)
        fail(problem_, load_.origin, what,
             "history.file{ ..., unit = g0 } where its values are in g, unit = 1 where they are in m/s^2; or titles in "
             "the file: time [s], acceleration [g]");
      doubt(problem_, load_.origin,
            what + fmt::format(": its values are taken as {}; history.file{{ ..., unit = 1 }} "
                               "says so, another value converts them",
                               load_.unit()));
    } else if (is_acceleration && std::abs(std::abs(factor) / standard_gravity - 1.0) > 0.01) {
      doubt(problem_, load_.origin,
            what + fmt::format(": times {:g} they are taken as m/s^2; history.file{{ ..., unit = g0 }} or unit = 1 "
                               "says what they are",
                               factor));
    }
  }

  // Zero, then a value, both for good.
  void jumps_in_the_step() const {
    if (profile_->begin <= end() * (1.0 + rounding)) return;
    say(fmt::format("jumps at {}, after the end of the step at {}", time(profile_->begin), time(end())));
  }

  void lasts_in_a_static_step() const {
    const double increment = 1.0 / step_.n_increments();
    if (profile_->end < 0.5 * increment)
      say(fmt::format("ends after {}, within the first increment: time runs from 0 to 1 s in a static step",
                      time(profile_->end)));
    else
      reaches_its_peak();
  }

  void lasts_in_a_dynamic_step() const {
    const double length = profile_->end - profile_->begin;
    if (is_pulse() && !chain_.before && length < step_.dt * (1.0 - rounding))
      say(fmt::format("lasts {}, shorter than 'dt' = {}: {}", time(length), time(step_.dt),
                      prescribes_a_motion() ? "a prescribed motion is sampled at the ends of time steps and may miss it"
                                            : "only its impulse is kept"));
    if (profile_->is_record) is_whole();
    if (!reaches_its_peak()) return;
    const double left = history_.value(end());
    if (is_pulse() && !chain_.after && profile_->end > end() * (1.0 + rounding) &&
        std::abs(left) > near_zero * profile_->largest())
      say(fmt::format("lasts until {} and is cut off at the end of the step, {}, where it is {:.3g} {}",
                      time(profile_->end), time(end()), left, load_.unit()));
  }

  bool prescribes_a_motion() const {
    const std::vector<Effect> effects = load_.effects();
    return std::any_of(effects.begin(), effects.end(),
                       [](const Effect& effect) { return std::holds_alternative<PrescribedMotion>(effect); });
  }

  bool reaches_its_peak() const {
    if (chain_.after || profile_->peak <= end() * (1.0 + rounding)) return true;
    // A plateau has as much before.
    if (std::abs(largest_in_step()) >= 0.999 * std::abs(history_.value(profile_->peak))) return true;
    say(fmt::format(
        "reaches its largest value, {:.4g} {}, at {}, after the end of the step at {}: within the step it is "
        "{:.4g} {} at most",
        history_.value(profile_->peak), load_.unit(), time(profile_->peak), time(end()), largest_in_step(),
        load_.unit()));
    return false;
  }

  // A record holds its first and last values beyond its ends.
  void is_whole() const {
    const double most = profile_->largest(), first = history_.value(profile_->begin),
                 last = history_.value(profile_->end);
    const auto percent = [&](double value) { return 100.0 * std::abs(value) / most; };
    const char* unit = load_.unit();
    if (!chain_.before && profile_->begin < -rounding * end())
      say(fmt::format("has a record that begins at {}: values before 0 are not applied; :shifted({:g}) includes them",
                      time(profile_->begin), -profile_->begin));
    else if (!chain_.before && std::abs(first) > near_zero * most)
      say(fmt::format("has a record that begins at {} with {:.4g} {}, {:.2g} % of its largest value, {}",
                      time(profile_->begin), first, unit, percent(first),
                      profile_->begin > rounding * end() ? "applied from 0 on" : "applied suddenly"));
    if (!chain_.after && profile_->end < end() * (1.0 - rounding) && std::abs(last) > near_zero * most)
      say(
          fmt::format("has a record that ends at {} with {:.4g} {}, {:.2g} % of its largest value, held until the end "
                      "of the step at {}",
                      time(profile_->end), last, unit, percent(last), time(end())));
  }

  // A function that is still on its way up, and was no straight line: a wave whose peak lies beyond the step?
  void rises_no_more() const {
    const int n = 512;
    double largest = 0.0, bend = 0.0;
    std::vector<double> v(n + 1);
    for (int i = 0; i <= n; ++i) largest = std::max(largest, std::abs(v[i] = history_.value(end() * i / n)));
    const bool is_part = chain_.before || chain_.after;
    if (largest == 0.0 && is_part) return;
    if (largest == 0.0) return say("is zero throughout the step");
    if (largest > most_acceleration && load_.unit() == std::string("m/s^2"))
      say(fmt::format("reaches {:.4g} m/s^2, beyond 100000 g; is it in m/s^2 already?", largest));
    if (is_part) return;
    for (int i = 0; i <= n; ++i) bend = std::max(bend, std::abs(v[i] - v[0] - (v[n] - v[0]) * i / n));
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    if (*low == *high && !step_.is_static)
      return say(fmt::format("is {:.4g} {} throughout the step: does it depend on t, and is t in seconds?", *low,
                             load_.unit()));
    const bool ends_highest = std::abs(v[n]) >= largest;
    for (int i = 0; i < n; ++i)
      if ((v[i + 1] - v[i]) * v[n] < 0.0) return;  // has turned before
    const double slope = n * std::abs(v[n] - v[n - 1]) / largest;
    if (!step_.is_static && ends_highest && slope > 0.05 && bend > 1e-6 * largest)
      say(fmt::format(
          "has no peak within the step: it still rises at its end, {}, where it is {:.4g} {}; is a frequency "
          "in kHz, or an angle in degrees?",
          time(end()), v[n], load_.unit()));
  }

  bool is_pulse() const {
    return !profile_->is_record && std::abs(history_.value(profile_->end)) <= 1e-9 * profile_->largest();
  }
  double largest_in_step() const {
    double largest = 0.0;
    for (int i = 0; i <= 256; ++i) {
      const double v = history_.value(end() * i / 256);
      if (std::abs(v) > std::abs(largest)) largest = v;
    }
    return largest;
  }
  double end() const { return step_.is_static ? 1.0 : step_.duration; }

  std::string who() const {
    return fmt::format("step '{}': {}{}", step_.name, load_.path,
                       load_.on.empty() ? "" : " on " + describe(load_.on.front()));
  }
  void say(const std::string& what) const { doubt(problem_, load_.origin, who() + " " + what); }

  const Problem& problem_;
  const Step& step_;
  const Load& load_;
  const History& history_;
  const Chain chain_;
  const std::optional<Profile> profile_;
};

}  // namespace

void histories(const Problem& problem) {
  for (size_t i = 0; i < problem.steps.size(); ++i)
    for (const LoadPtr& load : problem.steps[i]->loads)
      for (size_t k = 0; k < load->values.size(); ++k) {
        const std::optional<TimeValue>& value = load->values[k];
        if (!value || value->is_number) continue;
        InStep(problem, *problem.steps[i], *load, value->history, chain_of(problem, i, *load, k)).check();
      }
}

}  // namespace dygita::check

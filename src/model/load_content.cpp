#include "model/load_content.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "base/error.hpp"
#include "law/law.hpp"
#include "model/effects.hpp"
#include "model/places.hpp"
#include "signal/spectrum.hpp"

namespace dygita {

namespace {

constexpr double share = 0.95;  // of a load's energy

template <typename Kind>
bool has_effect(const Load& load) {
  for (const Effect& effect : load.effects())
    if (std::holds_alternative<Kind>(effect)) return true;
  return false;
}

// Does it give nodes a velocity?
bool is_of_velocity(const Load& load) {
  for (const Effect& effect : load.effects())
    if (const auto* motion = std::get_if<PrescribedMotion>(&effect); motion && motion->is_velocity) return true;
  return false;
}

// Where a force acts and how, and velocities that nodes are given, with their values at an instant of a step (s).
using Values = std::map<std::string, double>;
Values values_at(const Step& step, double t) {
  Values values;
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects()) {
      const auto add = [&](const std::string& name, const FaceOrRegion& on, const TimeValue& value) {
        values[name + " on " + std::visit([](const auto& place) { return place.label(); }, on)] +=
            value.history.value(t);
      };
      if (const auto* force = std::get_if<NodalForces>(&effect)) add(force->name, force->on, force->value);
      if (const auto* motion = std::get_if<PrescribedMotion>(&effect); motion && motion->is_velocity)
        for (size_t axis = 0; axis < 3; ++axis)
          if (motion->along[axis]) add(motion->name_along(static_cast<int>(axis)), motion->on, *motion->along[axis]);
    }
  return values;
}

// What continues where the step before has ended, or begins at zero, is no jump; a tenth of it is none either.
bool jumps_between(const Values& before, const Values& after) {
  constexpr double most = 0.1;
  const auto at = [](const Values& values, const std::string& name) {
    const auto it = values.find(name);
    return it == values.end() ? 0.0 : it->second;
  };
  const auto jumps = [&](const std::string& name) {
    const double a = at(before, name), b = at(after, name);
    return std::abs(b - a) > most * std::max(std::abs(a), std::abs(b));
  };
  return std::any_of(before.begin(), before.end(), [&](const auto& value) { return jumps(value.first); }) ||
         std::any_of(after.begin(), after.end(), [&](const auto& value) { return jumps(value.first); });
}

bool is_first_in_motion(const Step& step) {
  for (const Step* before = step.after.get(); before; before = before->after.get())
    if (!before->is_static) return false;
  return true;
}

// Some substructures move against others, or against the ground.
bool meet_at_speed(const Problem& problem) {
  const Vec3 ground = problem.supports.empty() ? problem.substructures.front()->velocity : Vec3(Vec3::Zero());
  return std::any_of(problem.substructures.begin(), problem.substructures.end(),
                     [&](const SubstructurePtr& part) { return part->velocity != ground; });
}

size_t number_of(const Problem& problem, const Substructure& part) {
  return static_cast<size_t>(index_of(problem.substructures, &part));
}

// Across a gap of its own; one of the geometry may be closed here and there.
bool is_open(const Interface& interface) {
  return !interface.has_gap_of_geometry && interface.law->initial().gap > 0.0;
}

// Which substructures are joined or touch: the first of each group.
std::vector<size_t> groups_in_touch(const Problem& problem) {
  std::vector<size_t> first(problem.substructures.size());
  std::iota(first.begin(), first.end(), size_t{0});
  for (const InterfacePtr& interface : problem.interfaces) {
    if (is_open(*interface)) continue;
    const size_t a = first[number_of(problem, *interface->side_1.part)],
                 b = first[number_of(problem, *interface->side_2.part)];
    std::replace(first.begin(), first.end(), std::max(a, b), std::min(a, b));
  }
  return first;
}

// Something that nothing holds has a wall, or something that it does not touch, across a gap before it, and may meet it
// at speed.
bool flies_towards_something(const Problem& problem, const Step& step) {
  if (step.loads.empty()) return false;
  const std::vector<size_t> group = groups_in_touch(problem);
  const auto group_of = [&](const Substructure& part) { return group[number_of(problem, part)]; };
  std::set<size_t> stays, has_gap;
  for (const SupportPtr& support : supports_of(problem, step))
    for (const FaceOrRegion& on : support->on) {
      const LawPtr law = support->kind->law();
      if (support->kind->sums() != Directions::none) continue;
      const bool is_away = law && law->initial().gap > 0.0;
      (is_away ? has_gap : stays).insert(group_of(*std::visit([](const auto& place) { return place.part; }, on)));
    }
  for (const InterfacePtr& interface : problem.interfaces) {
    const size_t a = group_of(*interface->side_1.part), b = group_of(*interface->side_2.part);
    if (a != b) has_gap.insert({a, b});
  }
  return std::any_of(has_gap.begin(), has_gap.end(), [&](size_t i) { return !stays.contains(i); });
}

bool begins_with_a_jump(const Problem& problem, const Step& step) {
  if (is_first_in_motion(step) && meet_at_speed(problem)) return true;
  const Step* before = step.after.get();
  if (before && step.supports != before->supports) return true;
  if (std::any_of(step.loads.begin(), step.loads.end(), [](const LoadPtr& load) { return has_effect<Release>(*load); }))
    return true;
  const double end = !before ? 0.0 : before->is_static ? 1.0 : before->duration;
  return jumps_between(before ? values_at(*before, end) : Values(), values_at(step, 0.0));
}

// Zero where the deck's function fails: the run reports it, and keeps what it has computed till then.
double known_value(const History& history, double t) {
  try {
    return history.value(t);
  } catch (const InputError&) {
    return 0.0;
  }
}

// As many as resolve the time steps, where they are not too many (and the most where dt is yet to be chosen); a power
// of two, as the transform likes them.
std::vector<double> samples_of(const History& history, const Step& step) {
  constexpr unsigned fewest = 256, most = 1u << 17;
  const unsigned wanted = step.dt > 0.0 ? 4u * static_cast<unsigned>(step.n_increments()) : most,
                 n = std::bit_ceil(std::clamp(wanted, fewest, most));
  std::vector<double> samples(n, 0.0);
  for (unsigned i = 0; i < n; ++i) {
    try {
      samples[i] = history.value(step.duration * i / (n - 1));
    } catch (const InputError&) {  // of the deck's function: the run reports it, and keeps its results
      samples[i] = i > 0 ? samples[i - 1] : 0.0;
    }
  }
  return samples;
}

// Of values less `from`.
double frequency_of(const History& history, const Step& step, double from) {
  if (history.is_constant()) return 0.0;
  std::vector<double> samples = samples_of(history, step);
  for (double& value : samples) value -= from;
  return band_limit(samples, step.duration / static_cast<double>(samples.size() - 1), share);
}

// By half of all that it moves, within a quarter of a time step.
bool jumps_on_the_way(const History& history, const Step& step) {
  if (history.is_constant()) return false;
  const std::vector<double> samples = samples_of(history, step);
  if (samples.size() < 4 * static_cast<size_t>(step.n_increments())) return false;
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  for (size_t i = 1; i < samples.size(); ++i)
    if (std::abs(samples[i] - samples[i - 1]) > 0.5 * (*high - *low)) return true;
  return false;
}

}  // namespace

const Load* same_load_in(const Step& step, const Load& load, size_t i_value) {
  if (step.is_static) return nullptr;
  for (const LoadPtr& other : step.loads) {
    bool is_same = other->path == load.path && other->on.size() == load.on.size();
    for (size_t i = 0; is_same && i < load.on.size(); ++i) is_same = describe(load.on[i]) == describe(other->on[i]);
    if (is_same && other->values[i_value]) return other.get();
  }
  return nullptr;
}

Chain chain_of(const Problem& problem, size_t i_step, const Load& load, size_t i_value) {
  constexpr double close = 0.02;  // of the largest value in the step
  const Step& step = *problem.steps[i_step];
  const History& here = load.values[i_value]->history;
  if (step.is_static) return {};
  double largest = 0.0;
  constexpr int n = 64;
  for (int i = 0; i <= n; ++i) largest = std::max(largest, std::abs(known_value(here, step.duration * i / n)));
  const auto meets = [&](const Step& beside, double t, double own) {
    const Load* other = same_load_in(beside, load, i_value);
    return other &&
           std::abs(known_value(other->values[i_value]->history, t) - known_value(here, own)) <= close * largest;
  };
  Chain chain;
  if (i_step > 0) chain.before = meets(*problem.steps[i_step - 1], problem.steps[i_step - 1]->duration, 0.0);
  if (i_step + 1 < problem.steps.size()) chain.after = meets(*problem.steps[i_step + 1], 0.0, step.duration);
  return chain;
}

namespace {

// A value of a load over the dynamic steps that go on with it.
struct Record {
  std::vector<double> samples;
  double dt = 0.0;            // s
  size_t begin = 0, end = 0;  // samples of the step itself
};

Record record_of(const Problem& problem, size_t i_step, const Load& load, size_t i_value) {
  size_t first = i_step, last = i_step;
  std::vector<const Load*> loads = {&load};
  while (chain_of(problem, first, *loads.front(), i_value).before)
    loads.insert(loads.begin(), same_load_in(*problem.steps[--first], load, i_value));
  while (chain_of(problem, last, *loads.back(), i_value).after)
    loads.push_back(same_load_in(*problem.steps[++last], load, i_value));
  double duration = 0.0, finest = problem.steps[i_step]->duration;
  for (size_t i = first; i <= last; ++i) {
    const Step& step = *problem.steps[i];
    duration += step.duration;
    finest = std::min(finest, step.duration / std::max(256, 4 * step.n_increments()));
  }
  constexpr double most = 1u << 17;
  const size_t n = std::bit_ceil(static_cast<size_t>(std::min(duration / finest, most)));
  Record record{{}, duration / static_cast<double>(n), 0, 0};
  for (size_t i = first; i <= last; ++i) {
    if (i == i_step) record.begin = record.samples.size();
    const History& history = loads[i - first]->values[i_value]->history;
    const auto n_own = static_cast<int>(std::lround(problem.steps[i]->duration / record.dt));
    for (int j = 0; j < n_own; ++j) record.samples.push_back(known_value(history, j * record.dt));
    if (i == i_step) record.end = record.samples.size();
  }
  record.samples.resize(n, record.samples.empty() ? 0.0 : record.samples.back());
  record.end = std::min(record.end, n);
  return record;
}

double largest_in(const std::vector<double>& samples, size_t begin, size_t end) {
  double largest = 0.0;
  for (size_t i = begin; i < end; ++i) largest = std::max(largest, std::abs(samples[i]));
  return largest;
}

}  // namespace

double load_frequency(const Problem& problem, size_t i_step, const Load& load) {
  constexpr double nothing = 1e-3;  // of the largest value
  constexpr size_t enough = 64;     // samples, that show what is in a step
  const Step& step = *problem.steps[i_step];
  double highest = 0.0;
  for (size_t k = 0; k < load.values.size(); ++k) {
    if (!load.values[k] || load.values[k]->history.is_constant()) continue;
    const Chain chain = chain_of(problem, i_step, load, k);
    const Record whole = chain.before || chain.after ? record_of(problem, i_step, load, k) : Record();
    if (whole.end - whole.begin < enough) {
      highest = std::max(highest, frequency_of(load.values[k]->history, step, 0.0));
      continue;
    }
    const double own = largest_in(whole.samples, whole.begin, whole.end),
                 all = largest_in(whole.samples, 0, whole.samples.size());
    if (own > nothing * all) highest = std::max(highest, band_limit(whole.samples, whole.dt, share));
  }
  return highest;
}

// What is there from the start is at rest.
double brought_frequency(const Problem& problem, const Step& step) {
  constexpr double without_bound = std::numeric_limits<double>::infinity();
  if (begins_with_a_jump(problem, step) || flies_towards_something(problem, step)) return without_bound;
  double highest = 0.0;
  for (const LoadPtr& load : step.loads) {
    const bool acts_at_once = has_effect<NodalForces>(*load) || is_of_velocity(*load);
    for (const auto& value : load->values) {
      if (!value) continue;
      if (acts_at_once && jumps_on_the_way(value->history, step)) return without_bound;
      highest = std::max(highest, frequency_of(value->history, step, value->history.value(0.0)));
    }
  }
  return highest;
}

}  // namespace dygita

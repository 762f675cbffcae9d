#include "step/preload.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "law/law.hpp"

namespace dygita {

std::vector<Preload> make_preloads(const StepModel& model, const std::vector<PointRecord>& records) {
  constexpr double nothing = 1e3;  // Pa, mean stress
  std::vector<Preload> preloads;
  if (!model.scheme.is_static) return preloads;
  for (size_t s = 0; s < model.surfaces->size(); ++s) {
    const Interface* interface = (*model.surfaces)[s].interface;
    const LoadValue* value = interface ? model.loads->preload(interface) : nullptr;
    if (!value) continue;
    Preload preload{interface, {}, *value};
    preload.force.from = 0.0;
    double area = 0.0;
    for (size_t i = 0; i < records.size(); ++i) {
      const Point& point = model.exchange.points[i];
      if (!point.law || point.members.front().surface != static_cast<int>(s)) continue;
      preload.points.push_back(static_cast<int>(i));
      preload.force.from += records[i].law.force[0];
      area += point.area;
    }
    // Nothing asked of a bolt that has nothing: any shortening that leaves it loose would do, the one it has does.
    const int n = model.step->increments;
    if (value->at_static(n - 1, n) == 0.0 && std::abs(preload.force.from) <= nothing * area) continue;
    preloads.push_back(std::move(preload));
  }
  return preloads;
}

double find_shortening(const std::function<double(double)>& force, double target, double start, double slope,
                       double scale, double precision, double furthest) {
  const double infinity = std::numeric_limits<double>::infinity();
  double low = -infinity, high = infinity;  // too little and too much
  double d = start, best = start, smallest = infinity, last_d = start, last_force = 0.0;
  if (!(slope > 0.0) || !(scale > 0.0)) return start;
  double reach = 100.0 * scale / slope;  // the furthest step, longer each time that nothing is felt: a gap closes first
  for (int i = 0; i < 200; ++i) {
    const double now = force(d), missing = target - now;
    if (std::abs(missing) < smallest) {
      smallest = std::abs(missing);
      best = d;
    }
    if (std::abs(missing) <= precision * scale) break;
    (missing > 0.0 ? low : high) = d;
    const double secant = i == 0 ? slope : (now - last_force) / (d - last_d);
    double step = missing > 0.0 ? reach : -reach;
    if (secant > 0.0 && std::abs(missing) < secant * reach)
      step = missing / secant;
    else
      reach *= 2.0;
    double next = d + step;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == d || std::abs(next - start) > furthest) break;
    last_d = d;
    last_force = now;
    d = next;
  }
  return best;
}

void shorten(const StepModel& model, const Preload& preload, double target, const Increment& increment,
             std::vector<PointRecord>& records) {
  double slope = 0.0, size = 0.0;
  for (const int i : preload.points)
    if (const double y = records[i].trial.y[0]; y > 0.0) slope += 1.0 / (increment.dt * y);
  const auto force = [&](double d) {
    double sum = 0.0;
    size = 0.0;
    for (const int i : preload.points) {
      PointRecord& record = records[i];
      record.trial.shortening = d;
      const double f = model.exchange.points[i].law->force(record.trial, increment, record.law)[0];
      sum += f;
      size += std::abs(f);
    }
    return sum;
  };
  const double start = records[preload.points.front()].trial.shortening;
  force(start);
  const double d = find_shortening(force, target, start, slope, std::abs(target) + size);
  for (const int i : preload.points) records[i].trial.shortening = d;
}

void check_reached(const Step& step, int increment, const std::vector<const Interface*>& interfaces, const Vec& force,
                   const Vec& target) {
  for (size_t i = 0; i < interfaces.size(); ++i) {
    if (target[i] <= 0.0 || force[i] >= 0.5 * target[i]) continue;
    throw NumericalError(fmt::format(
        "step '{}', increment {}: load.preload asks for {:.6g} N through interface.{} '{}', and no "
        "shortening gives more than {:.3g} N; likely "
        "cause: one of its sides has no reaction path (a part held by this interface alone, a joint that cannot close)",
        step.name, increment + 1, target[i], interfaces[i]->law->word(), interfaces[i]->name,
        force[i] > 1e-6 * target[i] ? force[i] : 0.0));
  }
}

}  // namespace dygita

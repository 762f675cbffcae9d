#include "drawing/time_axis.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/plot_scale.hpp"

namespace dygita {

namespace {

bool is_static_step(const Json& step) { return text(step, "kind") == "static"; }

int increments_of(const Json& step) {
  const double n = number(step, "increments");
  return std::isfinite(n) ? whole_number(step.at("increments")) : 0;
}

}  // namespace

TimeAxis::TimeAxis(const Json& steps) {
  for (const Json& step : steps)
    if (!is_static_step(step) && number(step, "dt") > 0.0 && increments_of(step) > 0) {
      dynamic_ += increments_of(step) * number(step, "dt");
      dt_ = dt_ > 0.0 ? std::min(dt_, number(step, "dt")) : number(step, "dt");
    }
  // Static steps ahead of the motion lie before zero, so that dynamic places are times.
  const double unit = dynamic_ > 0.0 ? 0.12 * dynamic_ : 0.0;
  const auto width = [&](const Json& step) { return unit > 0.0 ? unit : static_cast<double>(increments_of(step)); };
  double place = 0.0, time = 0.0;
  if (dynamic_ > 0.0)
    for (const Json& step : steps) {
      if (!is_static_step(step)) break;
      place -= width(step);
    }
  for (const Json& step : steps) {
    const bool is_static = is_static_step(step);
    const int n = increments_of(step);
    const double wide =
        is_static ? width(step) : n * std::max(0.0, std::isfinite(number(step, "dt")) ? number(step, "dt") : 0.0);
    ranges_.push_back({is_static, n, place, wide, time});
    if (is_static && n > 0) spans_.push_back({place, place + wide, text(step, "name") + " (static)"});
    place += wide;
    if (!is_static) time += wide;
  }
}

std::vector<double> TimeAxis::places(const Table& table) const {
  std::vector<double> places;
  std::vector<int> rows(ranges_.size(), 0), seen(ranges_.size(), 0);
  for (const int step : table.step) ++rows[step];
  for (size_t i = 0; i < table.step.size(); ++i) {
    const Range& range = ranges_[table.step[i]];
    if (!range.is_static) {
      places.push_back(range.start + table.columns[0][i] - range.time);
      continue;
    }
    // One row per increment, at its end; one more where the start has a row.
    const int row = ++seen[table.step[i]] + range.increments - rows[table.step[i]];
    places.push_back(range.start + range.width * row / std::max(1, range.increments));
  }
  return places;
}

void TimeAxis::note_missed(const Table& convergence) {
  if (!convergence.has_column("converged") || ranges_.empty()) return;
  const std::vector<double>& converged = convergence.column("converged");
  const double all = ranges_.back().start + ranges_.back().width - ranges_.front().start;
  std::vector<int> seen(ranges_.size(), 0);
  for (size_t i = 0; i < converged.size(); ++i) {
    const Range& range = ranges_[convergence.step[i]];
    const int k = seen[convergence.step[i]]++;
    if (converged[i] != 0.0) continue;
    const double unit = range.width / std::max(1, range.increments);
    const PlotSpan span{range.start + k * unit, range.start + (k + 1) * unit, ""};
    const bool is_next = !missed_.empty() && span.from < missed_.back().to + 1e-3 * all;  // what no reader tells apart
    if (is_next)
      missed_.back().to = span.to;
    else
      missed_.push_back(span);
  }
}

void TimeAxis::shade(Plot& plot) const {
  plot.spans = spans_;
  plot.missed = missed_;
}

PlotAxis TimeAxis::axis() const {
  if (dynamic_ == 0.0) return increments();
  PlotAxis axis{"time", "s"};
  axis.from = ranges_.front().start;
  axis.to = ranges_.back().start + ranges_.back().width;
  if (spans_.empty()) return axis;
  const PlotScale times({"time", "s"}, {0.0, dynamic_}, 7);
  axis.quantity = times.title();
  for (const PlotScale::Tick& tick : times.ticks())
    for (size_t i = 0; i < ranges_.size(); ++i) {
      const Range& range = ranges_[i];
      if (range.is_static || tick.value < range.time - 1e-9 * dynamic_ ||
          tick.value > range.time + (1 + 1e-9) * range.width)
        continue;
      axis.ticks.push_back({range.start + tick.value - range.time, tick.label});
      break;
    }
  return axis;
}

PlotAxis TimeAxis::increments() { return {"increment"}; }

std::vector<PlotSpan> static_increments(const Json& steps) {
  std::vector<PlotSpan> spans;
  int n = 0;
  for (const Json& step : steps) {
    if (is_static_step(step) && increments_of(step) > 0)
      spans.push_back({n + 0.5, n + increments_of(step) + 0.5, text(step, "name") + " (static)"});
    n += increments_of(step);
  }
  return spans;
}

}  // namespace dygita

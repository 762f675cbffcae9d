#include "recording/loop_recorder.hpp"

#include <algorithm>

#include "watch/surface_sums.hpp"

namespace dygita {

std::pair<int, int> LoopRequest::range(const Problem& problem) const {
  const std::vector<StepPtr>& all = problem.steps;
  const int n = static_cast<int>(all.size());
  if (!steps.empty()) {
    const int begin = index_of(all, steps.front().get());
    return {begin, begin + static_cast<int>(steps.size())};
  }
  const int begin = after ? index_of(all, after.get()) + 1 : 0;
  int end = begin;
  while (end < n && all[end]->is_static == all[begin]->is_static) ++end;
  return {begin, end};
}

LoopRecorder::LoopRecorder(const Columns& columns, const Problem& problem, const LoopRequest& request)
    : TableRecorder(columns), problem_(problem), request_(request) {
  for (const FaceOrRegion& place : request.between) between_.push_back(weighted_nodes(problem, place));
}

void LoopRecorder::begin_step(const Instant& instant) {
  before_ = displacement(instant);
  if (instant.i_step == 0) add(instant, instant.time(), {before_, 0.0});
}

// The force is a mean over a time step; so is the displacement then.
void LoopRecorder::accept(const Instant& instant) {
  const double now = displacement(instant),
               force = resultant(instant, problem_, request_.on).force.dot(request_.direction);
  add(instant, mean_time(instant),
      {instant.is_static() ? now : 0.5 * (before_ + now), request_.is_of_supports() ? -force : force});
  before_ = now;
}

void LoopRecorder::finish(Table& table, Findings& findings) {
  TableRecorder::finish(table, findings);
  findings.model = std::move(trace_);
}

void LoopRecorder::add(const Instant& instant, double time, const std::vector<double>& values) {
  add_row(instant, time, values);
  trace_.converged.push_back(instant.converged ? 1 : 0);
  trace_.balance.push_back(instant.state.energies.balance());
}

// Of side 2 against side 1; the ground is side 1 of a support.
double LoopRecorder::displacement(const Instant& instant) {
  const auto noted = [&](const Vec3& u) {
    trace_.moved = std::max(trace_.moved, u.norm());
    return u;
  };
  if (!between_.empty()) {
    const auto mean = [&](const WeightedNodes& on) {
      return noted(mean_over(on, instant.displacement(on.part, on.nodes)));
    };
    Vec3 moved = mean(between_.back());
    if (between_.size() > 1) moved -= mean(between_.front());
    return moved.dot(request_.direction);
  }
  double sum = 0.0, area = 0.0;
  for (const int s : surfaces_of(instant, request_.on)) {
    const Surface& surface = (*instant.model.surfaces)[s];
    const MovedSides& sides = sides_.try_emplace(s, surface).first->second;
    const Points u_1 = sides.first.displacement(instant), u_2 = sides.second.displacement(instant);
    for (int i = 0; i < surface.n_points(); ++i) {
      const Vec3 jump = u_2.col(i) - noted(u_1.col(i));
      sum += surface.facing.areas[i] * jump.dot(request_.direction);
      area += surface.facing.areas[i];
    }
  }
  // A wall is side 2 of its surface, and side 1 here.
  return (request_.is_of_supports() ? -sum : sum) / area;
}

}  // namespace dygita

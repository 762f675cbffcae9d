#include "watch/motion_watch.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "law/law.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

double extent(const Points& places, const Vec3& along) {
  const Eigen::RowVectorXd way = along.transpose() * places;
  return way.maxCoeff() - way.minCoeff();
}

// The longest that a facet around a point reaches along a direction.
double cell_along(const Facing& facing, int point, const Vec3& along) {
  double longest = 0.0;
  for (const Facet& facet : facing.facets) {
    const std::span<const int> points = facet.nodes();
    if (std::find(points.begin(), points.end(), point) == points.end()) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int other : points) {
      low = std::min(low, facing.places.col(other).dot(along));
      high = std::max(high, facing.places.col(other).dot(along));
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

}  // namespace

bool shows_motion(const Instant& instant) {
  constexpr int samples = 50;                                   // a step
  if (instant.is_static() && !instant.converged) return false;  // no equilibrium: no motion
  const long n = instant.model.step->n_increments(), i = instant.increment + 1, k = std::min<long>(n, samples);
  return (i * k) / n != ((i - 1) * k) / n;
}

std::string time_of(const Instant& instant) {
  const std::string& step = instant.model.step->name;
  if (instant.is_static()) return fmt::format("increment {} of static step '{}'", instant.increment + 1, step);
  return fmt::format("t = {:.4g} ms in step '{}'", 1e3 * instant.time(), step);
}

std::string in_mm(const Vec3& place) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * place[0], 1e3 * place[1], 1e3 * place[2]);
}

void MotionWatch::look_at_edges(const Surface& surface, Watched& watched) {
  std::vector<double> edges;
  watched.shortest.assign(static_cast<size_t>(surface.n_points()), std::numeric_limits<double>::infinity());
  for (const Facet& facet : surface.facing.facets) {
    const std::span<const int> rim = facet_shape(facet.type()).rim, nodes = facet.nodes();
    for (size_t k = 0; k < rim.size(); ++k) {
      const int a = nodes[rim[k]], b = nodes[rim[(k + 1) % rim.size()]];
      if (a == b) continue;  // points that have been merged
      edges.push_back((surface.facing.places.col(a) - surface.facing.places.col(b)).norm());
      for (const int point : {a, b}) watched.shortest[point] = std::min(watched.shortest[point], edges.back());
    }
  }
  if (edges.empty()) return;
  std::nth_element(edges.begin(), edges.begin() + edges.size() / 2, edges.end());
  watched.cell = edges[edges.size() / 2];
}

void MotionWatch::prepare(const Instant& instant) {
  is_ready_ = true;
  std::set<const Interface*> released;
  for (const StepPtr& step : instant.model.problem->steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (const auto* release = std::get_if<Release>(&effect)) released.insert(release->on.get());
  std::vector<const Surface*> moving;
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (!surface.declared_law().shown().gap && !released.contains(surface.interface)) continue;
    moving.push_back(&surface);
    surfaces_.push_back({.surface = static_cast<int>(s)});
    surfaces_.back().name = (surface.interface ? "interface '" : "wall '") + surface.name() + "'";
  }
  jumps_ = WatchedJumps(*instant.model.cut, moving);
  for (size_t i = 0; i < moving.size(); ++i)
    if (jumps_.watchers()[i] == ranks::me()) look_at_edges(*moving[i], surfaces_[i]);
}

void MotionWatch::begin_step(const Instant& start) {
  if (!is_ready_) prepare(start);
}

void MotionWatch::note(double share, Finding found, Finding& finding) const {
  if (!(share > finding.most)) return;
  found.most = share;
  found.at = static_cast<int>(moments_.size()) - 1;
  found.first = finding.first < 0 && share > 1.0 ? found.at : finding.first;
  finding = found;
}

void MotionWatch::accept(const Instant& instant) {
  if (!shows_motion(instant) || surfaces_.empty()) return;
  moments_.push_back(time_of(instant));
  const std::vector<Points> jumps = jumps_.take(instant);
  for (size_t i = 0; i < surfaces_.size(); ++i)
    if (jumps[i].cols() > 0 && surfaces_[i].cell > 0.0 && has_jump(instant, surfaces_[i]))
      watch_surface(instant, jumps[i], surfaces_[i]);
}

bool MotionWatch::has_jump(const Instant& instant, const Watched& watched) {
  const Surface& surface = (*instant.model.surfaces)[watched.surface];
  return surface.declared_law().shown().gap || instant.state.released[watched.surface];
}

void MotionWatch::watch_surface(const Instant& instant, const Points& jumps, Watched& watched) {
  const Surface& surface = (*instant.model.surfaces)[watched.surface];
  const bool is_contact = surface.declared_law().shown().gap, is_released = instant.state.released[watched.surface];
  const Facing& facing = surface.facing;
  double least = std::numeric_limits<double>::infinity(), deepest = 0.0;
  int slid = -1, at_least = 0, at_deepest = 0;
  double furthest = std::max(1.0, watched.slip.most);  // of half the shortest edge: nothing less is looked at closely
  Vec3 way = Vec3::Zero();
  for (int i = 0; i < surface.n_points(); ++i) {
    const Vec3 jump = jumps.col(i), normal = facing.normals.col(i);
    const double opened = jump.dot(normal);
    const Vec3 tangential = jump - opened * normal;
    if (opened < least) least = opened, at_least = i;
    if (-opened > deepest) deepest = -opened, at_deepest = i;
    const double share = tangential.norm() / (limit::slip_in_cells * watched.shortest[i]);
    if (is_contact && share > furthest) furthest = share, slid = i, way = tangential;
  }
  const auto place = [&](int i) { return Vec3(facing.places.col(i)); };
  if (slid >= 0) {
    const double length = way.norm(), cell = cell_along(facing, slid, way / length);
    note(length / (limit::slip_in_cells * cell),
         {.value = length, .length = extent(facing.places, way / length), .cell = cell, .place = place(slid)},
         watched.slip);
  }
  if (is_contact)
    note(least / watched.cell, {.value = least, .cell = watched.cell, .place = place(at_least)}, watched.opening);
  if (is_released && instant.state.shortening[watched.surface] == 0.0)
    note(deepest / (limit::passing_in_cells * watched.cell),
         {.value = deepest, .cell = watched.cell, .place = place(at_deepest)}, watched.passing);
}

void MotionWatch::settle() {
  if (ranks::is_alone() || surfaces_.empty()) return;
  constexpr int n_finding = 9;
  std::vector<double> all;
  std::vector<int> offset{0};
  for (const Watched& w : surfaces_) {
    for (const Finding* f : {&w.slip, &w.opening, &w.passing})
      all.insert(all.end(), {f->most, f->value, f->length, f->cell, f->place[0], f->place[1], f->place[2],
                             static_cast<double>(f->at), static_cast<double>(f->first)});
    offset.push_back(static_cast<int>(all.size()));
  }
  ranks::Segments(jumps_.watchers(), offset).complete(all.data());
  const double* of = all.data();
  for (Watched& w : surfaces_)
    for (Finding* f : {&w.slip, &w.opening, &w.passing}) {
      *f = {of[0], of[1], of[2], of[3], {of[4], of[5], of[6]}, static_cast<int>(of[7]), static_cast<int>(of[8])};
      of += n_finding;
    }
}

void MotionWatch::finish(RunResult& result) const {
  const auto moment = [&](int i) { return moments_[static_cast<size_t>(i)]; };
  const auto since = [&](const Finding& f) { return f.first == f.at ? "" : "; too large since " + moment(f.first); };
  double slip = 0.0;
  for (const Watched& w : surfaces_) {
    slip = std::max(slip, limit::slip_in_cells * w.slip.most);
    if (w.slip.most > 1.0)
      result.warnings.push_back(fmt::format(
          "{} slides by {:.4g} mm at {}, {}{}: {}; displacements are assumed small, so each node stays paired with its "
          "initial opposite node",
          w.name, 1e3 * w.slip.value, in_mm(w.slip.place), moment(w.slip.at), since(w.slip),
          w.slip.value > w.slip.length
              ? fmt::format("it is {:.4g} mm long there, so one side has slid off the other but is still supported",
                            1e3 * w.slip.length)
              : fmt::format("half a cell is {:.4g} mm there", 0.5e3 * w.slip.cell)));
    if (w.opening.most > 1.0)
      result.warnings.push_back(
          fmt::format("{} is open everywhere, by {:.4g} mm at least, {}{}: its sides have separated by more than a "
                      "cell ({:.4g} mm); if they close again, each node still meets its initial opposite node",
                      w.name, 1e3 * w.opening.value, moment(w.opening.at), since(w.opening), 1e3 * w.opening.cell));
    if (w.passing.most > 1.0)
      result.warnings.push_back(fmt::format(
          "{} is released, and its sides overlap by {:.4g} mm at {}, {}{}: after load.release nothing prevents this",
          w.name, 1e3 * w.passing.value, in_mm(w.passing.place), moment(w.passing.at), since(w.passing)));
  }
  if (slip > limit::slip_in_cells) result.figures.largest_slip = slip;
}

}  // namespace dygita

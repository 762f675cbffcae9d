#include "step/distant_points.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/error.hpp"

namespace dygita {

namespace {

// Numbers of a point, and with its own: all points of a surface have one law.
size_t n_point(const SurfaceState& surface) {
  constexpr size_t n_of_every_law = 17;
  return n_of_every_law + (surface.points.empty() ? 0 : surface.points.front().memory.size());
}
size_t width(const SurfaceState& surface) { return 1 + n_point(surface); }

void write(const SurfaceState& surface, int point, double* to) {
  const LawState& law = surface.points[static_cast<size_t>(point)];
  for (const double value : {law.gap, law.plastic_opening}) *to++ = value;
  for (const Vec3* v : {&law.slip, &law.rate, &law.force}) to = std::copy_n(v->data(), 3, to);
  *to++ = static_cast<double>(law.status);
  const Work& work = surface.works[static_cast<size_t>(point)];
  for (const double value : {work.friction, work.plastic, work.damping, work.stored}) *to++ = value;
  *to++ = surface.residual[static_cast<size_t>(point)];
  std::copy_n(law.memory.data(), law.memory.size(), to);
}

void read(const double* from, int point, SurfaceState& surface) {
  LawState& law = surface.points[static_cast<size_t>(point)];
  for (double* value : {&law.gap, &law.plastic_opening}) *value = *from++;
  for (Vec3* v : {&law.slip, &law.rate, &law.force}) *v = Eigen::Map<const Vec3>(from), from += 3;
  law.status = static_cast<PointState>(*from++);
  Work& work = surface.works[static_cast<size_t>(point)];
  for (double* value : {&work.friction, &work.plastic, &work.damping, &work.stored}) *value = *from++;
  surface.residual[static_cast<size_t>(point)] = *from++;
  std::copy_n(from, law.memory.size(), law.memory.data());
}

}  // namespace

int DistantPoints::booking(const StepModel& model, const Point& point) {
  return model.cut->piece(model.exchange.ports[static_cast<size_t>(point.first_port)].piece).rank;
}

DistantPoints::DistantPoints(const StepModel& model, State& state)
    : state_(&state),
      here_(state.surfaces.size()),
      own_(state.surfaces.size()),
      n_ranks_(state.surfaces.size(), 0),
      booking_(state.surfaces.size()),
      is_known_(state.surfaces.size(), 1) {
  for (const Point& point : model.exchange.points) {
    if (booking(model, point) != ranks::me()) continue;
    for (const Member& member : point.members) own_[static_cast<size_t>(member.surface)].push_back(member.point);
    for (int t = point.first_tie; t < point.end_tie; ++t) {
      const Tie& tie = model.exchange.ties[static_cast<size_t>(t)];
      own_[static_cast<size_t>(tie.surface)].push_back(tie.surface_point);
    }
  }
  std::vector<double> n_ranks;
  std::vector<std::vector<int>> to_each(static_cast<size_t>(ranks::count()));
  for (size_t s = 0; s < own_.size(); ++s) {
    std::sort(own_[s].begin(), own_[s].end());
    here_[s] = own_[s];
    if (!takes_part(*model.problem, *model.step, (*model.surfaces)[s])) {
      here_[s].resize(state.surfaces[s].points.size());
      std::iota(here_[s].begin(), here_[s].end(), 0);
    }
    n_ranks.push_back(own_[s].empty() ? 0.0 : 1.0);
    if (!own_[s].empty()) to_each[0].push_back(static_cast<int>(s));
  }
  n_ranks = ranks::sums(n_ranks);
  n_ranks_.assign(n_ranks.begin(), n_ranks.end());
  const std::vector<std::vector<int>> from_each = ranks::swapped(to_each);
  for (size_t rank = 1; rank < from_each.size(); ++rank)
    for (const int s : from_each[rank]) booking_[static_cast<size_t>(s)].push_back(static_cast<int>(rank));
}

void DistantPoints::forget() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (size_t s = 0; s < is_known_.size(); ++s) {
    // A surface that is here alone stays known.
    if (!is_known_[s] || !has_others(s)) continue;
    auto own = own_[s].begin();
    std::vector<LawState>& points = state_->surfaces[s].points;
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      if (own != own_[s].end() && *own == i) {
        ++own;
        continue;
      }
      points[static_cast<size_t>(i)].gap = nan;
      points[static_cast<size_t>(i)].force.setConstant(nan);
    }
    is_known_[s] = 0;
  }
}

// Of each point its number, then its fields.
std::vector<double> DistantPoints::answer(int surface) const {
  const std::vector<int>& own = own_[static_cast<size_t>(surface)];
  const SurfaceState& fields = state_->surfaces[static_cast<size_t>(surface)];
  std::vector<double> values(width(fields) * own.size());
  double* to = values.data();
  for (const int point : own) {
    *to = point;
    write(fields, point, to + 1);
    to += width(fields);
  }
  return values;
}

void DistantPoints::complete(int surface) const {
  const size_t s = static_cast<size_t>(surface);
  if (is_known_[s]) return;
  CHECK(ranks::is_first(), "fields of an interface are read on a rank that does not keep them");
  for (const int rank : booking_[s]) {
    const std::vector<double> values = ranks::ask(rank, {asked, surface}, {});
    for (size_t at = 0; at < values.size(); at += width(state_->surfaces[s]))
      read(values.data() + at + 1, static_cast<int>(values[at]), state_->surfaces[s]);
  }
  is_known_[s] = 1;
}

// Some surfaces at a time: what is under way stays small beside what is kept.
void DistantPoints::complete_all() {
  constexpr size_t enough = 1 << 16;  // numbers in one message
  for (size_t first = 0, end = 0; first < own_.size(); first = end) {
    size_t n = 0;
    for (end = first; end < own_.size() && n < enough; ++end)
      n += width(state_->surfaces[end]) * state_->surfaces[end].points.size();
    complete_some(first, end);
  }
  is_known_.assign(is_known_.size(), 1);
}

void DistantPoints::complete_some(size_t first, size_t end) {
  std::vector<double> own;
  for (size_t s = first; s < end; ++s) {
    if (own_[s].empty()) continue;
    own.push_back(static_cast<double>(s));
    own.push_back(static_cast<double>(own_[s].size()));
    const std::vector<double> values = answer(static_cast<int>(s));
    own.insert(own.end(), values.begin(), values.end());
  }
  const std::vector<std::vector<double>> of_all = ranks::of_all(own);
  for (size_t rank = 0; rank < of_all.size(); ++rank) {
    if (static_cast<int>(rank) == ranks::me()) continue;
    for (size_t at = 0; at < of_all[rank].size();) {
      SurfaceState& surface = state_->surfaces[static_cast<size_t>(of_all[rank][at])];
      const auto n = static_cast<size_t>(of_all[rank][at + 1]);
      at += 2;
      for (size_t i = 0; i < n; ++i, at += width(surface))
        read(of_all[rank].data() + at + 1, static_cast<int>(of_all[rank][at]), surface);
    }
  }
}

void share_first(State& state) {
  if (ranks::is_alone()) return;
  Energies& e = state.energies;
  const auto energies = {&e.kinetic, &e.strain, &e.loads, &e.friction, &e.plastic,
                         &e.damping, &e.scheme, &e.start, &e.stored};
  std::vector<double> values(state.shortening);
  for (const double* energy : energies) values.push_back(*energy);
  for (const SurfaceState& surface : state.surfaces)
    for (size_t i = 0; i < surface.points.size(); ++i) {
      values.resize(values.size() + n_point(surface));
      write(surface, static_cast<int>(i), values.data() + values.size() - n_point(surface));
    }
  values = ranks::shared(std::move(values));
  if (ranks::is_first()) return;
  const double* from = values.data();
  for (double& shortening : state.shortening) shortening = *from++;
  for (double* energy : energies) *energy = *from++;
  for (SurfaceState& surface : state.surfaces)
    for (size_t i = 0; i < surface.points.size(); ++i, from += n_point(surface))
      read(from, static_cast<int>(i), surface);
}

}  // namespace dygita

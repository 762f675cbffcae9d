#include "solution/distant_points.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"

namespace dygita {

namespace {

constexpr size_t n_point = 18;

void write(const SurfaceState& surface, int point, double* to) {
  const LawState& law = surface.points[static_cast<size_t>(point)];
  for (const double value : {law.gap, law.plastic_opening, law.hardening_opening, law.opening_rate}) *to++ = value;
  for (const Vec3* v : {&law.slip, &law.rate, &law.force}) to = std::copy_n(v->data(), 3, to);
  *to++ = static_cast<double>(law.status);
  const Work& work = surface.works[static_cast<size_t>(point)];
  for (const double value : {work.friction, work.plastic, work.damping}) *to++ = value;
  *to = surface.residual[static_cast<size_t>(point)];
}

void read(const double* from, int point, SurfaceState& surface) {
  LawState& law = surface.points[static_cast<size_t>(point)];
  for (double* value : {&law.gap, &law.plastic_opening, &law.hardening_opening, &law.opening_rate}) *value = *from++;
  for (Vec3* v : {&law.slip, &law.rate, &law.force}) *v = Eigen::Map<const Vec3>(from), from += 3;
  law.status = static_cast<PointState>(*from++);
  Work& work = surface.works[static_cast<size_t>(point)];
  for (double* value : {&work.friction, &work.plastic, &work.damping}) *value = *from++;
  surface.residual[static_cast<size_t>(point)] = *from;
}

}  // namespace

int DistantPoints::booking(const StepModel& model, const Point& point) {
  return model.cut->piece(model.exchange.ports[static_cast<size_t>(point.first_port)].piece).rank;
}

DistantPoints::DistantPoints(const StepModel& model, State& state)
    : state_(&state),
      here_(state.surfaces.size()),
      booked_(state.surfaces.size()),
      is_known_(state.surfaces.size(), 1) {
  std::vector<std::vector<int>> rank_of;
  for (const SurfaceState& surface : state.surfaces) rank_of.emplace_back(surface.points.size(), -1);
  for (const Point& point : model.exchange.points) {
    const int rank = booking(model, point);
    for (const Member& member : point.members)
      rank_of[static_cast<size_t>(member.surface)][static_cast<size_t>(member.point)] = rank;
    for (int t = point.first_tie; t < point.end_tie; ++t) {
      const Tie& tie = model.exchange.ties[static_cast<size_t>(t)];
      rank_of[static_cast<size_t>(tie.surface)][static_cast<size_t>(tie.surface_point)] = rank;
    }
  }
  for (size_t s = 0; s < rank_of.size(); ++s)
    for (int i = 0; i < static_cast<int>(rank_of[s].size()); ++i) {
      const int rank = rank_of[s][static_cast<size_t>(i)];
      if (rank < 0 || rank == ranks::me()) here_[s].push_back(i);
      if (rank >= 0) booked_[s][rank].push_back(i);
    }
}

void DistantPoints::forget() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (size_t s = 0; s < is_known_.size(); ++s) {
    if (!is_known_[s]) continue;
    for (const auto& [rank, points] : booked_[s])
      for (const int point : points) {
        if (rank == ranks::me()) continue;
        LawState& law = state_->surfaces[s].points[static_cast<size_t>(point)];
        law.gap = nan;
        law.force.setConstant(nan);
      }
    // A surface that is here alone stays known.
    is_known_[s] = booked_[s].empty() || (booked_[s].size() == 1 && booked_[s].contains(ranks::me()));
  }
}

std::vector<double> DistantPoints::answer(int surface) const {
  const auto& booked = booked_[static_cast<size_t>(surface)];
  const auto own = booked.find(ranks::me());
  if (own == booked.end()) return {};
  std::vector<double> values(n_point * own->second.size());
  double* to = values.data();
  for (const int point : own->second) {
    write(state_->surfaces[static_cast<size_t>(surface)], point, to);
    to += n_point;
  }
  return values;
}

void DistantPoints::complete(int surface) const {
  const size_t s = static_cast<size_t>(surface);
  if (is_known_[s]) return;
  CHECK(ranks::is_first(), "fields of an interface are read on a rank that does not keep them");
  for (const auto& [rank, points] : booked_[s]) {
    if (rank == ranks::me()) continue;
    const std::vector<double> values = ranks::ask(rank, {asked, surface}, {});
    const double* from = values.data();
    for (const int point : points) {
      read(from, point, state_->surfaces[s]);
      from += n_point;
    }
  }
  is_known_[s] = 1;
}

// Some surfaces at a time: what is under way stays small beside what is kept.
void DistantPoints::complete_all() {
  constexpr size_t enough = 1 << 16;  // numbers in one message
  for (size_t first = 0, end = 0; first < booked_.size(); first = end) {
    size_t n = 0;
    for (end = first; end < booked_.size() && n < enough; ++end)
      for (const auto& [rank, points] : booked_[end]) n += n_point * points.size();
    complete_some(first, end);
  }
  is_known_.assign(is_known_.size(), 1);
}

void DistantPoints::complete_some(size_t first, size_t end) {
  std::vector<int> owner, offset{0};
  for (size_t s = first; s < end; ++s)
    for (const auto& [rank, points] : booked_[s]) {
      owner.push_back(rank);
      offset.push_back(offset.back() + static_cast<int>(n_point * points.size()));
    }
  std::vector<double> values(static_cast<size_t>(offset.back()));
  const auto for_each_point = [&](auto&& visit) {
    double* at = values.data();
    for (size_t s = first; s < end; ++s)
      for (const auto& [rank, points] : booked_[s])
        for (const int point : points) {
          visit(rank, state_->surfaces[s], point, at);
          at += n_point;
        }
  };
  for_each_point([](int rank, SurfaceState& surface, int point, double* at) {
    if (rank == ranks::me()) write(surface, point, at);
  });
  ranks::Segments(owner, offset).complete(values.data());
  for_each_point([](int rank, SurfaceState& surface, int point, double* at) {
    if (rank != ranks::me()) read(at, point, surface);
  });
}

void share_first(State& state) {
  if (ranks::is_alone()) return;
  Energies& e = state.energies;
  const auto energies = {&e.kinetic, &e.strain, &e.loads, &e.friction, &e.plastic, &e.damping, &e.scheme, &e.start};
  std::vector<double> values(state.shortening);
  for (const double* energy : energies) values.push_back(*energy);
  for (const SurfaceState& surface : state.surfaces)
    for (size_t i = 0; i < surface.points.size(); ++i) {
      values.resize(values.size() + n_point);
      write(surface, static_cast<int>(i), values.data() + values.size() - n_point);
    }
  values = ranks::shared(std::move(values));
  if (ranks::is_first()) return;
  const double* from = values.data();
  for (double& shortening : state.shortening) shortening = *from++;
  for (double* energy : energies) *energy = *from++;
  for (SurfaceState& surface : state.surfaces)
    for (size_t i = 0; i < surface.points.size(); ++i, from += n_point) read(from, static_cast<int>(i), surface);
}

}  // namespace dygita

#include "latin/local_stage.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "law/law.hpp"

namespace dygita {

LocalStage::LocalStage(const StepModel& model, const State& start, const Vec& k) : model_(&model), k_(k), sums_(model) {
  const TimeScheme& scheme = model.scheme;
  increment_ = {scheme, model.problem->solver.push_out};
  const Exchange& exchange = model.exchange;
  // Up to the last one that is iterated here: none where all pieces are explicit.
  const int n_points = model.near.points().empty() ? 0 : model.near.points().back() + 1;
  points_.resize(static_cast<size_t>(n_points));
  if (n_points > 0) ports_.resize(static_cast<size_t>(exchange.points[n_points - 1].end_port));
  const std::vector<PortMotion> motions = port_motions(model, start);
  for (const int i : model.near.points()) {
    const Point& point = exchange.points[i];
    for (int p = point.first_port; p < point.end_port; ++p) {
      ports_[p].u = point.frame.transpose() * motions[p].displacement;
      if (!scheme.is_static) ports_[p].w = point.frame.transpose() * motions[p].velocity;
    }
    points_[i] = start_point(model, point, start, motions);
    // Forces of the step before, on whichever port carries the node.
    for (const Member& member : point.members) {
      const Surface& surface = (*model.surfaces)[member.surface];
      const Vec3 force = point.frame.transpose() * start.surfaces[member.surface].points[member.point].force;
      for (int p = point.first_port; p < point.end_port; ++p) {
        const Port& port = exchange.ports[p];
        const bool is_first = p < point.first_port_2;
        const int part = is_first ? surface.part_1 : surface.part_2;
        const int node = is_first   ? surface.facing.side_1.main_node(member.point)
                         : part < 0 ? -1
                                    : surface.facing.side_2.main_node(member.point);
        if (port.is_owner && port.part == part && port.node == node) ports_[p].f += is_first ? force : Vec3(-force);
      }
    }
  }
  preloads_ = make_preloads(model, points_);
  find_surfaces();
  for (const int i : model.near.points())
    for (int t = exchange.points[i].first_tie; t < exchange.points[i].end_tie; ++t) {
      const Tie& tie = exchange.ties[t];
      const Vec3 force =
          exchange.points[i].frame.transpose() * start.surfaces[tie.surface].points[tie.surface_point].force;
      ports_[tie.port_1].f += force;
      ports_[tie.port_2].f -= force;
    }
  found_ = found_forces(start);
  points_left_.assign(points_.size(), 0.0);
  work_left_.assign(model_->pieces.size(), 0.0);
}

Vec LocalStage::initial_q() const {
  Vec q = Vec::Zero(model_->near.n());
  for (size_t p = 0; p < ports_.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = model_->unknown(model_->exchange.ports[p], d); i >= 0)
        q[i] = ports_[p].f[d] + k_[i] * ports_[p].w[d];
  return q;
}

// Mean over a group; a held side of it decides.
Vec3 LocalStage::mean_displacement(int first, int end) const {
  Vec3 mean = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    double sum = 0.0;
    const PortState* held = nullptr;
    for (int p = first; p < end; ++p) {
      if (model_->exchange.ports[p].is_held[d]) held = &ports_[p];
      sum += ports_[p].u[d];
    }
    mean[d] = held ? held->u[d] : end > first ? sum / (end - first) : 0.0;
  }
  return mean;
}

namespace {

// f(i) for the points i, on so many threads at most (0: all), where there are enough of them.
template <class Function>
void for_points(const std::vector<int>& points, Function&& f, int most_threads = 0) {
  constexpr std::ptrdiff_t together = 128;
  parallel_for_ranges(
      static_cast<std::ptrdiff_t>(points.size()),
      [&](std::ptrdiff_t first, std::ptrdiff_t n) {
        for (std::ptrdiff_t i = first; i < first + n; ++i) f(points[static_cast<size_t>(i)]);
      },
      together, most_threads);
}

}  // namespace

void LocalStage::begin(int increment, const std::vector<double>& motions, bool starts_window) {
  const Exchange& exchange = model_->exchange;
  i_increment_ = increment;
  Vec displacement(starts_window ? model_->near.n() : 0);
  for (size_t i = 0; i < model_->here.size() && starts_window; ++i) {
    const Piece& piece = *model_->pieces[model_->here[i]];
    displacement.segment(model_->near.start(model_->here[i]), piece.n_rows()) = piece.row_displacements();
  }
  if (starts_window) model_->near.exchange({displacement.data()});
  const auto begin_at = [&](int i) {
    const Point& point = exchange.points[i];
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = exchange.ports[p];
      PortState& state = ports_[p];
      state.w_old = model_->scheme.is_static ? Vec3(Vec3::Zero()) : state.w;
      state.f_old = state.f;
      for (int d = 0; d < 3; ++d) {
        if (port.unknown[d] >= 0 && starts_window) state.u[d] = displacement[model_->unknown(port, d)];
        if (port.is_held[d]) state.w[d] = model_->held_velocity(port, point.frame.col(d), motions);
      }
    }
    const Vec3 mean_1 = mean_displacement(point.first_port, point.first_port_2);
    const Vec3 mean_2 = mean_displacement(point.first_port_2, point.end_port);
    for (int p = point.first_port; p < point.end_port; ++p)
      ports_[p].offset = (ports_[p].u - (p < point.first_port_2 ? mean_1 : mean_2)) / model_->scheme.dt;
    if (!point.law) return;
    begin_point(*model_, point, (point.is_wall ? Vec3(Vec3::Zero()) : mean_2) - mean_1, increment, points_[i]);
    give_rates(*model_, point, motions, mean_1.norm() + mean_2.norm(), points_[i]);
  };
  // A shortening in statics may be a function of the deck.
  for_points(model_->near.points(), begin_at, model_->scheme.is_static ? 1 : 0);
}

double LocalStage::displacement_size() {
  Vec u = Vec::Zero(model_->near.n());
  for (const int i : model_->near.points())
    for (int p = model_->exchange.points[i].first_port; p < model_->exchange.points[i].end_port; ++p)
      for (int d = 0; d < 3; ++d)
        if (const int at = model_->unknown(model_->exchange.ports[p], d); at >= 0) u[at] = ports_[p].u[d];
  return sums_.add(1, [&](Eigen::Index first, Eigen::Index n, double* to) {
    for (Eigen::Index i = first; i < first + n; ++i) *to += 0.5 * k_[i] * u[i] * u[i];
  })[0];
}

// r and 1/k of one side of a point: a group is one body with k = sum k, r = sum k r / sum k.
LocalStage::Side LocalStage::gather(int first, int end, const Vec& velocity, const Vec& q) const {
  Side side;
  for (int d = 0; d < 3; ++d) {
    double k_sum = 0.0, kr_sum = 0.0;
    bool is_held = false;
    for (int p = first; p < end && !is_held; ++p) {
      const Port& port = model_->exchange.ports[p];
      if (port.is_held[d]) {
        is_held = true;
        side.r[d] = ports_[p].w[d];
      } else if (const int i = model_->unknown(port, d); i >= 0) {
        const double r = 2.0 * velocity[i] - q[i] / k_[i] + ports_[p].offset[d];
        k_sum += k_[i];
        kr_sum += k_[i] * r;
      }
    }
    if (is_held || k_sum == 0.0) continue;
    side.r[d] = kr_sum / k_sum;
    side.inverse_k[d] = 1.0 / k_sum;
  }
  return side;
}

void LocalStage::scatter(int first, int end, const Side& side, const Vec3& force, const Vec& velocity, const Vec& q,
                         Vec& image) {
  for (int d = 0; d < 3; ++d) {
    const double w_side = side.r[d] + side.inverse_k[d] * force[d];
    double balance = force[d];  // what a held port of the group takes
    int held_port = -1;
    for (int p = first; p < end; ++p) {
      const Port& port = model_->exchange.ports[p];
      const int i = model_->unknown(port, d);
      if (port.is_held[d]) {
        ports_[p].f[d] = 0.0;  // one of several held copies takes it all
        held_port = p;
        continue;
      }
      if (i < 0) continue;
      const double f_linear = q[i] - k_[i] * velocity[i];
      const double r = velocity[i] - f_linear / k_[i];
      const double w_hat = w_side - ports_[p].offset[d];
      const double f_hat = k_[i] * (w_hat - r);
      ports_[p].w[d] = w_hat;
      ports_[p].f[d] = f_hat;
      balance -= f_hat;
      image[i] = f_hat + k_[i] * w_hat;
      ports_[p].residual[d] = f_linear - f_hat;
    }
    if (held_port >= 0) ports_[held_port].f[d] = balance;
  }
}

void LocalStage::set_trial(const Point& point, const Side& side_1, const Side& side_2, PointRecord& record) const {
  record.trial.s = record.given_rate;
  record.trial.y.setZero();
  for (int d = 0; d < 3; ++d) {
    if (!point.is_active[d] || !point.has_law[d] || record.trial.is_given[d]) continue;
    record.trial.s[d] = side_2.r[d] - side_1.r[d];
    record.trial.y[d] = side_1.inverse_k[d] + side_2.inverse_k[d];
  }
}

std::vector<double> LocalStage::normal_trials() const {
  std::vector<double> trials;
  for (const PointRecord& record : points_) trials.push_back(record.trial.s[0]);
  return trials;
}

bool LocalStage::links(int i_point, double least) const {
  return dygita::links(model_->exchange.points[static_cast<size_t>(i_point)], points_[static_cast<size_t>(i_point)],
                       least);
}

double LocalStage::gap(int i_point) const {
  const Point& point = model_->exchange.points[static_cast<size_t>(i_point)];
  const PointRecord& record = points_[static_cast<size_t>(i_point)];
  return gap_of(point, record, increment_at(point));
}

void LocalStage::run_point(size_t i_point, const Vec& velocity, const Vec& q, Vec& image) {
  const Point& point = model_->exchange.points[i_point];
  PointRecord& state = points_[i_point];
  const Side side_1 = gather(point.first_port, point.first_port_2, velocity, q);
  const Side side_2 = gather(point.first_port_2, point.end_port, velocity, q);
  state.force.setZero();
  if (point.law) {
    set_trial(point, side_1, side_2, state);
    if (!state.is_released)
      state.force = limited_force(*point.law, state.trial, increment_at(point), state.law, limit_at(i_point));
  }
  scatter(point.first_port, point.first_port_2, side_1, state.force, velocity, q, image);
  scatter(point.first_port_2, point.end_port, side_2, -state.force, velocity, q, image);
}

void LocalStage::run_points(const std::vector<int>& points, const Vec& velocity, const Vec& q, Vec& image) {
  for_points(points, [&](int i) { run_point(static_cast<size_t>(i), velocity, q, image); });
}

// Shortenings need all points of their interface.
void LocalStage::run_inner(const Vec& velocity, const Vec& q, Vec& image) {
  image.resize(q.size());
  if (preloads_.empty()) run_points(model_->near.inner_points(), velocity, q, image);
}

void LocalStage::run_outer(const Vec& velocity, const Vec& q, Vec& image) {
  for (size_t i = 0; i < preloads_.size(); ++i) shorten(static_cast<int>(i), velocity, q);
  if (!preloads_.empty()) run_points(model_->near.inner_points(), velocity, q, image);
  run_points(model_->near.outer_points(), velocity, q, image);
}

// Both answers are on one line through (F, V) of slope -k: q and image tell how far apart, F - F_hat = (q - image)/2.
InterfaceSums::ToCome LocalStage::distance_sums(const Vec& velocity, const Vec& q, const Vec& image) const {
  enum { distance, force, motion, n_sums };
  return {n_sums, [this, &velocity, &q, &image](Eigen::Index first, Eigen::Index n, double* to) {
            for (Eigen::Index i = first; i < first + n; ++i) {
              const double k = k_[i], inverse = 1.0 / k, change = 0.5 * (q[i] - image[i]);
              const double f = q[i] - k * velocity[i] - found_[i], f_hat = f - change;
              const double w_hat = velocity[i] - inverse * change;
              to[distance] += inverse * (change * change);
              to[force] += 0.5 * inverse * (f * f + f_hat * f_hat);
              to[motion] += 0.5 * k * (velocity[i] * velocity[i] + w_hat * w_hat);
            }
          }};
}

IndicatorSums LocalStage::measure(const Vec& velocity, const Vec& q, const Vec& image,
                                  const InterfaceSums::ToCome& also,
                                  const std::function<void(const double*)>& receive) {
  const InterfaceSums::ToCome own = distance_sums(velocity, q, image);
  const std::vector<double>& sums = sums_.add(own.n + also.n, [&](Eigen::Index first, Eigen::Index n, double* to) {
    own.share(first, n, to);
    if (also.n > 0) also.share(first, n, to + own.n);
  });
  if (also.n > 0) receive(sums.data() + own.n);
  return distance_of(sums.data());
}

}  // namespace dygita

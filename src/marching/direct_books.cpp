// What direct points keep and tell: the laws' memory, works, forces over the time step of the deck.
#include <algorithm>
#include <map>

#include "base/parallel.hpp"
#include "law/law.hpp"
#include "marching/direct_points.hpp"

namespace dygita {

namespace {

// That one thread has done before others are awake.
constexpr int few_shown = 64, few_booked = 1000;

}  // namespace

// On any rank.
void DirectPoints::find_released() {
  std::vector<double> is_direct(model_->surfaces->size(), 0.0);
  for (const Point& point : model_->exchange.points)
    for (const Member& member : point.members)
      if (point.is_direct) is_direct[static_cast<size_t>(member.surface)] = 1.0;
  if (!model_->near.is_all()) is_direct = ranks::sums(is_direct);
  for (size_t s = 0; s < is_direct.size(); ++s)
    if (is_direct[s] > 0.0 && (*model_->surfaces)[s].interface) released_.push_back(static_cast<int>(s));
}

void DirectPoints::begin_interval(int increment) {
  interval_ = 0.0;
  i_interval_ = increment;
}

void DirectPoints::begin_interval_of(OwnPoint& p) {
  p.impulse.setZero();
  p.work = {};
  p.on_pieces = 0.0;
  for (int i = p.side_1.first; i < p.side_2.end; ++i) ports_[i].impulse.setZero();
  if (!p.point->law) return;
  const Interface* interface = (*model_->surfaces)[p.point->members.front().surface].interface;
  if (interface && !p.record.is_released) p.record.is_released = model_->loads->is_released(interface, i_interval_);
}

void DirectPoints::add_held_force(const OwnPoint& p, const OwnPort& port) {
  if (!port.piece) return;
  for (int i = port.first_share; i < port.end_share; ++i)
    if (shares_[i].has_held) port.piece->add_held_force(shares_[i].node, shares_[i].block.transpose() * port.force);
  if (port.is_spread()) return;
  const Port& of = model_->exchange.ports[port.index];
  for (int d = 0; d < 3; ++d)
    if (of.is_held[d]) port.piece->add_held_force(port.node, port.force[d] * p.point->frame.col(d));
}

// The law moves on; works and impulses of the increment, with the velocities that the nodes end with.
void DirectPoints::end_point(OwnPoint& p) {
  for (int i = p.side_1.first; i < p.side_2.end; ++i) {
    OwnPort& port = ports_[i];
    const Vec3 v = velocity(p, port);
    p.on_pieces += 0.5 * increment_.dt * port.force.dot(port.v_old + v);
    port.v_old = v;
    if (port.is_moved) add_held_force(p, port);
    port.impulse += increment_.dt * port.force;
  }
  const LawState end = dygita::end_of_point(*p.point, p.record, increment_);
  if (p.point->law) p.work.add(p.point->law->work(p.record.law, end, increment_, p.point->area));
  p.record.law = end;
  p.impulse += increment_.dt * p.record.force;
}

// Works are booked by the rank that has the piece of the first port. What belongs to a surface is told by its last
// point.
void DirectPoints::find_books() {
  std::map<int, std::vector<int>> of_piece;
  std::map<int, int> last;
  for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
    const OwnPoint& p = points_[static_cast<size_t>(i)];
    if (p.is_booked_here) of_piece[model_->exchange.ports[p.point->first_port].piece].push_back(i);
    if (!p.point->law) continue;
    for (const Member& member : p.point->members) last[member.surface] = i;
  }
  for (auto& [piece, points] : of_piece) books_.push_back({piece, std::move(points)});
  for (const auto& [surface, i] : last) last_of_surfaces_.push_back(i);
  std::sort(last_of_surfaces_.begin(), last_of_surfaces_.end());
  last_of_surfaces_.erase(std::unique(last_of_surfaces_.begin(), last_of_surfaces_.end()), last_of_surfaces_.end());
}

// In the order of the points, whatever the number of threads.
void DirectPoints::book(Book& book, IncrementEnergy& energy) const {
  book.gap_difference = 0.0;
  for (const int i : book.points) {
    const OwnPoint& p = points_[static_cast<size_t>(i)];
    book.gap_difference = std::max(book.gap_difference, p.gap_difference);
    energy.loads += p.work.given;
    energy.friction += p.work.friction;
    energy.plastic += p.work.plastic;
    energy.damping += p.work.damping;
    energy.stored += p.work.stored;
    energy.scheme += p.work.given - p.on_pieces - p.work.dissipated() - p.work.stored;
  }
}

void DirectPoints::show(State& state, std::vector<IncrementEnergy>& energy, int most_threads) {
  for (const int s : released_)
    if (model_->loads->is_released((*model_->surfaces)[s].interface, i_interval_)) state.released[s] = 1;
  // What each point writes alone.
  const int n = static_cast<int>(points_.size());
  const auto show_point = [&](int i) {
    OwnPoint& p = points_[static_cast<size_t>(i)];
    p.gap_difference = p.is_booked_here && p.point->law ? difference_of_gaps(p) : 0.0;
    PointRecord shown = p.record;
    shown.law.force = p.impulse / interval_;
    if (p.point->law) {
      book_on_surfaces(*p.point, p.work, state);
      show_law(*p.point, shown.law, state);
    }
    for (const Member& member : p.point->members) state.surfaces[member.surface].residual[member.point] = 0.0;
    if (p.point->first_tie == p.point->end_tie) return;
    for (int t = p.point->first_tie; t < p.point->end_tie; ++t) {
      const Tie& tie = model_->exchange.ties[t];
      state.surfaces[tie.surface].residual[tie.surface_point] = 0.0;
    }
    thread_local std::vector<Vec3> port_force;
    port_force.clear();
    for (int k = p.side_1.first; k < p.side_2.end; ++k) port_force.push_back(ports_[k].impulse / interval_);
    show_ties(*model_, *p.point, shown, port_force, state);
  };
  shown_shares_.run(n, n > few_shown ? most_threads : 1, show_point);
  parallel_for(
      static_cast<int>(books_.size()), [&](int i) { book(books_[i], energy[books_[i].piece]); }, Schedule::evenly,
      n > few_booked ? most_threads : 1);
  for (const Book& book : books_) gap_difference_ = std::max(gap_difference_, book.gap_difference);
  for (const int i : last_of_surfaces_) show_record(*points_[i].point, points_[i].record, state);
}

Vec3 DirectPoints::end_displacement(const OwnPoint& p, const OwnPort& port) const {
  if (!port.is_spread()) return p.point->frame.transpose() * port.nodes->displacement_of(port.node);
  Vec3 u = Vec3::Zero();
  for (int i = port.first_share; i < port.end_share; ++i)
    u += shares_[i].block * port.nodes->displacement_of(shares_[i].node);
  return u;
}

double DirectPoints::difference_of_gaps(const OwnPoint& p) const {
  if (!p.keeps_gap) return 0.0;
  std::array<double, 2> mean{};
  for (const int which : {0, 1}) {
    const Side& side = which == 0 ? p.side_1 : p.side_2;
    for (int i = side.first; i < side.end; ++i)
      mean[which] += end_displacement(p, ports_[i])[0] / (side.end - side.first);
  }
  return std::abs(p.record.first_gap + mean[1] - mean[0] - p.record.law.gap);
}

double DirectPoints::bytes() const {
  return static_cast<double>(sizeof(OwnPort) * ports_.size() + sizeof(OwnPoint) * points_.size());
}

}  // namespace dygita

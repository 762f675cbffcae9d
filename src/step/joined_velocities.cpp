#include "step/joined_velocities.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

constexpr double same_motion = 1e-9;  // of the largest velocity: what sides that move alike differ by

// A velocity of one side against another: the sum of along . V over the nodes of the pieces.
struct JoinedRow {
  std::vector<std::pair<int, NodeAlong>> nodes;  // with the piece of each
  int point = -1, direction = -1;
  bool is_of_law = false;
};

class Joining {
 public:
  Joining(const StepModel& model, const Exchange& exchange, State& state)
      : model_(model), exchange_(exchange), state_(state) {
    for (size_t i = 0; i < exchange.points.size(); ++i) add_point(static_cast<int>(i));
  }

  std::string run();

 private:
  void add_point(int i);
  int add_side(int i, int d, int first, int end);
  void add_row(int i, int d, int from, int to, bool is_of_law);
  void add_port(const Port& port, const Vec3& direction, JoinedRow& row) const;
  bool holds(const Point& point, int d) const;
  Vec rates(const std::vector<Points>& velocity) const;
  std::vector<Points> answer(const Vec& impulse) const;
  template <class Of>
  double sum_by_piece(const JoinedRow& row, Of&& of) const;
  Vec compliance() const;
  Vec impulses(const Vec& rate) const;
  bool let_go(const Vec& impulse);
  std::string name_of(const JoinedRow& row) const;

  const StepModel& model_;
  const Exchange& exchange_;
  State& state_;
  std::vector<JoinedRow> rows_, gone_;
};

// Is it a law that holds its sides in this direction, whatever passes through it until it yields?
bool Joining::holds(const Point& point, int d) const {
  if (!point.law || point.is_wall || !point.has_law[d] || point.law->shown().gap) return false;
  const int s = point.members.front().surface;
  const Interface* interface = (*model_.surfaces)[s].interface;
  if (state_.released[s] || (interface && model_.loads->is_released(interface, 0))) return false;
  return point.law->tangent(point.law->initial(), false).holds[d];
}

void Joining::add_port(const Port& port, const Vec3& direction, JoinedRow& row) const {
  if (!port.trace) {
    row.nodes.push_back({port.piece, {port.piece_node, direction}});
    return;
  }
  port.for_each_node([&](int node, const Mat3& block) {
    row.nodes.push_back({port.piece, {model_.cut->owner(port.part, node).node, Vec3(block.transpose() * direction)}});
  });
}

void Joining::add_row(int i, int d, int from, int to, bool is_of_law) {
  const Vec3 direction = exchange_.points[i].frame.col(d);
  JoinedRow row{{}, i, d, is_of_law};
  add_port(exchange_.ports[from], -direction, row);
  add_port(exchange_.ports[to], direction, row);
  rows_.push_back(std::move(row));
}

// The ports of a side move with one of them, a held one if there is one; returns that one.
int Joining::add_side(int i, int d, int first, int end) {
  int leader = first;
  for (int p = first; p < end; ++p)
    if (exchange_.ports[p].is_held[d]) {
      leader = p;
      break;
    }
  for (int p = first; p < end; ++p)
    if (p != leader && !exchange_.ports[p].is_held[d]) add_row(i, d, leader, p, false);
  return leader;
}

void Joining::add_point(int i) {
  const Point& point = exchange_.points[i];
  for (int d = 0; d < 3; ++d) {
    const int one = add_side(i, d, point.first_port, point.first_port_2);
    if (point.first_port_2 == point.end_port) continue;
    const int other = add_side(i, d, point.first_port_2, point.end_port);
    if (holds(point, d) && !(exchange_.ports[one].is_held[d] && exchange_.ports[other].is_held[d]))
      add_row(i, d, one, other, true);
  }
}

// What each piece that is solved here has of a row, added piece by piece: on several ranks with the same bits.
template <class Of>
double Joining::sum_by_piece(const JoinedRow& row, Of&& of) const {
  double all = 0.0, of_piece = 0.0;
  for (size_t k = 0; k < row.nodes.size(); ++k) {
    const auto& [piece, on] = row.nodes[k];
    if (k > 0 && row.nodes[k - 1].first != piece) all += std::exchange(of_piece, 0.0);
    if (model_.solves(piece)) of_piece += of(piece, on);
  }
  return all + of_piece;
}

// Of the rows, m/s; velocity: of the pieces here.
Vec Joining::rates(const std::vector<Points>& velocity) const {
  std::vector<double> values(rows_.size(), 0.0);
  for (size_t i = 0; i < rows_.size(); ++i)
    values[i] = sum_by_piece(rows_[i], [&](int piece, const NodeAlong& on) {
      return velocity[piece].cols() > 0 ? on.along.dot(velocity[piece].col(on.node)) : 0.0;
    });
  if (!ranks::is_alone()) values = ranks::shared(ranks::sums(values));
  return Eigen::Map<const Vec>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Velocities that impulses on the rows bring, for the pieces here that have any.
std::vector<Points> Joining::answer(const Vec& impulse) const {
  std::vector<Points> on_pieces(model_.pieces.size(), Points(3, 0));
  for (size_t i = 0; i < rows_.size(); ++i)
    for (const auto& [piece, on] : rows_[i].nodes) {
      if (!model_.solves(piece)) continue;
      Points& of_piece = on_pieces[piece];
      if (of_piece.cols() == 0) of_piece = Points::Zero(3, state_.velocity[piece].cols());
      of_piece.col(on.node) += impulse[static_cast<Eigen::Index>(i)] * on.along;
    }
  for (const int i : model_.here)
    if (on_pieces[i].cols() > 0) on_pieces[i] = model_.pieces[i]->velocity_of_impulse(on_pieces[i]);
  return on_pieces;
}

// About, of each row by itself, m/(N s).
Vec Joining::compliance() const {
  std::vector<double> values(rows_.size(), 0.0);
  for (size_t i = 0; i < rows_.size(); ++i)
    values[i] = sum_by_piece(rows_[i], [&](int piece, const NodeAlong& on) {
      const Vec& masses = model_.pieces[piece]->node_masses();
      return on.node < masses.size() && masses[on.node] > 0.0 ? on.along.squaredNorm() / masses[on.node] : 0.0;
    });
  if (!ranks::is_alone()) values = ranks::shared(ranks::sums(values));
  Vec all = Eigen::Map<const Vec>(values.data(), static_cast<Eigen::Index>(values.size()));
  return (all.array() > 0.0).select(all, 1.0);
}

// N s on the rows, that take their rates away: by conjugate gradients. Where rows say the same in two ways any will do.
Vec Joining::impulses(const Vec& rate) const {
  constexpr double enough = 1e-26;  // of squares
  const Vec diagonal = compliance();
  Vec impulse = Vec::Zero(rate.size()), residual = -rate, z = residual.cwiseQuotient(diagonal), along = z;
  double size = residual.dot(z);
  const double goal = enough * size;
  const Eigen::Index most = 10 * rate.size() + 100;
  for (Eigen::Index n = 0; n < most && size > goal; ++n) {
    const Vec image = rates(answer(along));
    const double curvature = along.dot(image);
    if (!(curvature > 0.0)) break;
    impulse += size / curvature * along;
    residual -= size / curvature * image;
    z = residual.cwiseQuotient(diagonal);
    const double next = residual.dot(z);
    along = z + next / size * along;
    size = next;
  }
  return impulse;
}

// Takes out the rows of laws that yield to their impulse when it comes within one increment. Were there any?
bool Joining::let_go(const Vec& impulse) {
  const Increment increment{model_.scheme};
  const Vec y = model_.scheme.dt * compliance();
  std::vector<JoinedRow> kept;
  const size_t n_gone = gone_.size();
  for (size_t i = 0; i < rows_.size(); ++i) {
    JoinedRow& row = rows_[i];
    const Point& point = exchange_.points[row.point];
    bool yields = false;
    if (row.is_of_law) {
      LawState start;
      for (const Member& member : point.members)
        start.add(state_.surfaces[member.surface].points[member.point], member.share, point.frame);
      const auto at = static_cast<Eigen::Index>(i);
      const double asked = -impulse[at] / increment.dt;
      Trial trial;
      trial.s[row.direction] = y[at] * asked;
      trial.y[row.direction] = y[at];
      trial.shortening = state_.shortening[point.members.front().surface];
      trial.jump[0] = start.plastic_opening - trial.shortening;
      trial.area = point.area;
      yields = std::abs(point.law->force(trial, increment, start)[row.direction]) < (1.0 - 1e-6) * std::abs(asked);
    }
    (yields ? gone_ : kept).push_back(std::move(row));
  }
  rows_ = std::move(kept);
  return gone_.size() > n_gone;
}

std::string Joining::name_of(const JoinedRow& row) const {
  const Point& point = exchange_.points[row.point];
  if (row.is_of_law) return (*model_.surfaces)[point.members.front().surface].name();
  if (point.first_tie < point.end_tie) return (*model_.surfaces)[exchange_.ties[point.first_tie].surface].name();
  return point.members.empty() ? "" : (*model_.surfaces)[point.members.front().surface].name();
}

std::string Joining::run() {
  double largest = 0.0;
  for (const int i : model_.here)
    if (state_.velocity[i].size() > 0) largest = std::max(largest, state_.velocity[i].cwiseAbs().maxCoeff());
  if (!ranks::is_alone()) largest = ranks::largest(largest);
  Vec rate = rates(state_.velocity);
  Eigen::Index worst = 0;
  if (rows_.empty() || rate.cwiseAbs().maxCoeff(&worst) <= same_motion * largest) return "";
  const std::string name = name_of(rows_[static_cast<size_t>(worst)]);
  Vec impulse = impulses(rate);
  while (let_go(impulse)) {
    rate = rates(state_.velocity);
    impulse = rows_.empty() ? Vec() : impulses(rate);
  }
  const std::vector<Points> change = answer(impulse);
  for (const int i : model_.here)
    if (change[i].cols() > 0) state_.velocity[i] += change[i];
  std::swap(rows_, gone_);
  rate = rates(state_.velocity);
  for (size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].direction == 0)
      for (const Member& member : exchange_.points[rows_[i].point].members)
        exchange_.points[rows_[i].point].law->begin_to_part(state_.surfaces[member.surface].points[member.point],
                                                            rate[static_cast<Eigen::Index>(i)]);
  return name.empty() ? "a cut" : name;
}

}  // namespace

std::string join_velocities(const StepModel& model, State& state) {
  if (ranks::is_alone()) return Joining(model, model.exchange, state).run();
  const Exchange all = make_exchange(*model.problem, *model.step, *model.cut, *model.surfaces, model.conditions);
  return Joining(model, all, state).run();
}

}  // namespace dygita

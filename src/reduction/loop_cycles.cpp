#include "reduction/loop_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dygita {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest_turn = 1e-3;  // of the range of the displacement
constexpr double standstill = 1e-6;     // of that range: where a joint sticks, the force turns first
constexpr double widest_opening = 0.2;  // of a cycle, of its range: what a straight line closes

struct Path {
  std::vector<double> x, f;
};

struct Cycle {
  int start = 0, turn = 0, close = 0;  // rows
  double amplitude = 0.0, force_amplitude = 0.0, mean = 0.0, mean_force = 0.0;
  double on_reversal = 0.0, at_end = 0.0;  // N/m
  double loss = 0.0;                       // J
  bool has_loss(const LoopRows& rows) const { return loss > noise(rows); }
  bool gains(const LoopRows& rows) const { return loss < -noise(rows); }
  double noise(const LoopRows& rows) const { return rows.noise * amplitude * force_amplitude; }
  bool has_converged(const LoopRows& rows) const {
    const auto& all = rows.converged;
    return all.empty() || std::count(all.begin() + start, all.begin() + close + 1, 0) == 0;
  }
  double energy_error(const LoopRows& rows) const {
    return rows.balance.empty() ? not_known : std::abs(rows.balance[close] - rows.balance[start]);
  }
};

// Slope of the rows i and i + step, or further along where the displacement is constant.
double slope(const Path& path, int i, int step, int end) {
  for (int j = i + step; step > 0 ? j <= end : j >= end; j += step)
    if (path.x[j] != path.x[i]) return (path.f[j] - path.f[i]) / (path.x[j] - path.x[i]);
  return not_known;
}

// The cycle from one turning point over the next and back; nothing where the way back ends too early.
bool close_cycle(const Path& path, int start, int turn, int end, Cycle& cycle) {
  const double range = path.x[turn] - path.x[start];
  double area = 0.0, x_last = path.x[start], f_last = path.f[start];
  const auto go_to = [&](double x, double f) {
    area += 0.5 * (f + f_last) * (x - x_last);
    x_last = x;
    f_last = f;
  };
  for (int i = start + 1; i <= turn; ++i) go_to(path.x[i], path.f[i]);
  int i = turn + 1;
  const auto is_past = [&](int row) {
    return range > 0.0 ? path.x[row] <= path.x[start] : path.x[row] >= path.x[start];
  };
  for (; i <= end && !is_past(i); ++i) go_to(path.x[i], path.f[i]);
  if (i <= end) {  // where it crosses
    const double share = path.x[i] == x_last ? 0.0 : (path.x[start] - x_last) / (path.x[i] - x_last);
    go_to(path.x[start], f_last + share * (path.f[i] - f_last));
  }
  if (std::abs(path.x[start] - x_last) > widest_opening * std::abs(range)) return false;
  const double back = path.x[turn] - x_last, force_back = path.f[turn] - f_last;
  cycle.start = start;
  cycle.turn = turn;
  cycle.close = std::min(i, end);
  cycle.amplitude = 0.25 * std::abs(range + back);
  cycle.force_amplitude = 0.25 * std::abs(path.f[turn] - path.f[start] + force_back);
  cycle.mean = 0.25 * (2 * path.x[turn] + path.x[start] + x_last);
  cycle.mean_force = 0.25 * (2 * path.f[turn] + path.f[start] + f_last);
  go_to(path.x[start], path.f[start]);
  cycle.loss = area;
  cycle.on_reversal = 0.5 * (slope(path, start, 1, turn) + slope(path, turn, 1, end));
  cycle.at_end = slope(path, turn, -1, start);
  return true;
}

std::vector<Cycle> cycles_of(const Path& path, const std::vector<int>& turns) {
  std::vector<Cycle> cycles;
  for (size_t i = 1; i + 2 < turns.size();) {  // the first is the origin, no turn
    Cycle cycle;
    if (close_cycle(path, turns[i], turns[i + 1], turns[i + 2], cycle)) {
      cycles.push_back(cycle);
      i += 2;
    } else {
      ++i;
    }
  }
  return cycles;
}

// One side of first loading: displacement and force from the origin, both positive.
struct Side {
  std::vector<double> x{0.0}, f{0.0};

  // Work (J) up to a displacement and force there.
  std::pair<double, double> up_to(double a) const {
    double work = 0.0;
    for (size_t i = 1; i < x.size(); ++i) {
      const double share = std::min(1.0, (a - x[i - 1]) / (x[i] - x[i - 1])),
                   force = f[i - 1] + share * (f[i] - f[i - 1]);
      work += 0.5 * (f[i - 1] + force) * share * (x[i] - x[i - 1]);
      if (share < 1.0 || i + 1 == x.size()) return {work, force};
    }
    return {0.0, 0.0};
  }
};

// Rows that go further from the origin than any before, on either side.
std::array<Side, 2> first_loading(const Path& path, int first) {
  std::array<Side, 2> sides;
  double reached = 0.0, range = 0.0;
  for (size_t i = first; i < path.x.size(); ++i) range = std::max(range, std::abs(path.x[i] - path.x[first]));
  for (size_t i = first; i < path.x.size(); ++i) {
    const double x = path.x[i] - path.x[first], f = path.f[i] - path.f[first];
    if (std::abs(x) <= reached + 1e-9 * range) continue;
    reached = std::abs(x);
    Side& side = sides[x > 0.0 ? 0 : 1];
    side.x.push_back(std::abs(x));
    side.f.push_back(x > 0.0 ? f : -f);
  }
  return sides;
}

// Rows of a side: tangent, and the spring and the limit of the slider that gives way there (eq. C6).
void add_side(const Side& side, double sign, Table& table) {
  const size_t n = side.x.size() - 1;
  std::vector<double> tangent, length;
  for (size_t i = 1; i <= n; ++i) {
    length.push_back(side.x[i] - side.x[i - 1]);
    tangent.push_back((side.f[i] - side.f[i - 1]) / length.back());
  }
  const std::vector<double> concave = decreasing(tangent, length);
  std::vector<std::array<double, 5>> rows;
  for (size_t i = 0; i < n; ++i) {
    // What is left at the end slides there at the earliest: it is not known where.
    const double spring = i + 1 < n ? concave[i] - concave[i + 1] : concave[i];
    rows.push_back({sign * side.x[i + 1], sign * side.f[i + 1], tangent[i], spring, spring * side.x[i + 1]});
  }
  if (sign < 0.0) std::reverse(rows.begin(), rows.end());
  for (const auto& row : rows)
    for (size_t c = 0; c < row.size(); ++c) table.columns[c].push_back(row[c]);
}

Table backbone_table(const std::array<Side, 2>& sides) {
  Table table{{"displacement", "force", "stiffness", "slider_stiffness", "slider_force"},
              {"m", "N", "N/m", "N/m", "N"},
              {},
              {}};
  table.columns.resize(table.names.size());
  add_side(sides[1], -1.0, table);
  const double origin[] = {0.0, 0.0, not_known, 0.0, 0.0};
  for (int c = 0; c < 5; ++c) table.columns[c].push_back(origin[c]);
  add_side(sides[0], 1.0, table);
  return table;
}

Table cycle_table(const Table& loop, const std::vector<Cycle>& cycles, const Side& side, const LoopRows& rows) {
  Table table{{"time", "amplitude", "force_amplitude", "mean", "mean_force", "secant", "reversal", "end", "loss",
               "loss_factor", "exponent", "masing_loss", "energy_error", "converged"},
              {"s", "m", "N", "m", "N", "N/m", "N/m", "N/m", "J", "", "", "J", "J", ""},
              {},
              {}};
  table.columns.resize(table.names.size());
  const Cycle* before = nullptr;  // the last of another amplitude
  for (const Cycle& c : cycles) {
    const double secant = c.force_amplitude / c.amplitude;
    double local = not_known;
    if (before && before->has_loss(rows) && c.has_loss(rows))
      local = exponent_of({before->force_amplitude, c.force_amplitude}, {before->loss, c.loss});
    // Masing's rule: branches are the backbone doubled (eq. C7).
    const auto [work, force] = side.up_to(c.amplitude);
    const double masing = side.x.back() >= 0.999 * c.amplitude ? 8 * work - 4 * c.amplitude * force : not_known;
    const double row[] = {loop.columns[0][c.start],
                          c.amplitude,
                          c.force_amplitude,
                          c.mean,
                          c.mean_force,
                          secant,
                          c.on_reversal,
                          c.at_end,
                          c.loss,
                          c.loss / (std::numbers::pi * secant * c.amplitude * c.amplitude),
                          local,
                          masing,
                          c.energy_error(rows),
                          c.has_converged(rows) ? 1.0 : 0.0};
    for (size_t i = 0; i < table.columns.size(); ++i) table.columns[i].push_back(row[i]);
    table.step.push_back(loop.step[c.start]);
    before = &c;
  }
  return table;
}

}  // namespace

std::vector<int> turning_points(const std::vector<double>& x, const std::vector<double>& f, int first) {
  const int n = static_cast<int>(x.size());
  std::vector<int> turns;
  if (first >= n) return turns;
  const auto [low, high] = std::minmax_element(x.begin() + first, x.end());
  const double range = *high - *low, turn = smallest_turn * range;
  turns.push_back(first);
  int extreme = first;
  double sense = 0.0;  // of the travel: not known at first
  for (int i = first + 1; i < n; ++i) {
    const double away = x[i] - x[extreme];
    if (sense == 0.0) {
      if (std::abs(away) <= turn) continue;
      sense = away > 0.0 ? 1.0 : -1.0;
      extreme = i;
    } else if (sense * away > standstill * range ||
               (sense * away > -standstill * range && sense * (f[i] - f[extreme]) >= 0.0)) {
      extreme = i;
    } else if (-sense * away > turn) {
      turns.push_back(extreme);
      extreme = i;
      sense = -sense;
    }
  }
  if (extreme != turns.back()) turns.push_back(extreme);
  return turns;
}

LoopSummary summarise_loop(const Table& table, int first, const LoopRows& rows) {
  Path path{table.column("displacement"), table.column("force")};
  LoopSummary summary;
  const auto [low, high] = std::minmax_element(path.x.begin() + first, path.x.end());
  summary.range = *high - *low;
  if (summary.range <= rows.resolution) path.x.assign(path.x.size(), path.x[first]);  // it does not move
  const std::array<Side, 2> sides = first_loading(path, first);
  // That of more rows: to and fro, the second side shows only the ends that happen to reach a little further.
  const Side& side = sides[0].x.size() >= sides[1].x.size() ? sides[0] : sides[1];
  const std::vector<Cycle> cycles = cycles_of(path, turning_points(path.x, path.f, first));
  summary.cycles = cycle_table(table, cycles, side, rows);
  summary.backbone = backbone_table(sides);
  std::vector<double> amplitude, force, loss;
  for (const Cycle& c : cycles) {
    summary.n_gaining += c.gains(rows);
    if (!c.has_loss(rows)) continue;
    if (!rows.balance.empty())
      summary.energy_error = std::max({summary.energy_error, c.energy_error(rows) / c.loss, c.noise(rows) / c.loss});
    amplitude.push_back(c.amplitude);
    force.push_back(c.force_amplitude);
    loss.push_back(c.loss);
  }
  summary.exponent = exponent_of(force, loss);
  summary.displacement_exponent = exponent_of(amplitude, loss);
  const auto stiffness = [&](size_t row) {
    // Where the force turns against the displacement there is no stiffness: inertia, or a load between the two places.
    return row > 0 && row < side.x.size() && side.f[row] > 0.0 ? side.f[row] / side.x[row] : not_known;
  };
  size_t visible = 1;
  while (visible < side.x.size() && side.x[visible] <= rows.resolution) ++visible;
  summary.stiffness = stiffness(visible);
  summary.secant = stiffness(side.x.size() - 1);
  summary.largest_force = std::isfinite(summary.secant) ? side.f.back() : not_known;
  return summary;
}

}  // namespace dygita

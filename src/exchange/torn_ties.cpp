#include "exchange/torn_ties.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

using MotionShares = std::map<int, double>;  // of motions of the conditions

class TornTies {
 public:
  TornTies(const Problem& problem, const Step& step, const Conditions& conditions, const std::vector<Surface>& surfaces,
           const Exchange& exchange)
      : problem_(problem), step_(step), conditions_(conditions), surfaces_(surfaces), exchange_(exchange) {}

  void refuse() {
    for (const Point& point : exchange_.points) {
      constexpr std::array<bool, 3> all = {true, true, true};  // sides are groups of tied nodes
      refuse_apart(point, point.first_port, point.first_port_2, all);
      refuse_apart(point, point.first_port_2, point.end_port, all);
      refuse_apart(point, point.first_port, point.end_port, joined(point));
    }
  }

 private:
  // Directions in which the law lets nothing move; none where a load of the step tightens it, or it has let go.
  std::array<bool, 3> joined(const Point& point) const {
    if (!point.law || point.is_wall) return {};
    const Interface* interface = surfaces_[static_cast<size_t>(point.members.front().surface)].interface;
    if (!interface || is_tightened_or_gone(interface)) return {};
    std::array<bool, 3> joined = point.law->tangent(point.law->initial(), false).holds;
    for (size_t d = 0; d < 3; ++d) joined[d] = joined[d] && point.has_law[d];
    return joined;
  }

  bool is_tightened_or_gone(const Interface* interface) const {
    for (const StepPtr& step : problem_.steps) {
      const bool is_this = step.get() == &step_;
      for (const LoadPtr& load : step->loads)
        for (const Effect& effect : load->effects()) {
          const auto* release = std::get_if<Release>(&effect);
          if (release && release->on.get() == interface && (!is_this || release->at <= 0.0)) return true;
          const Tightening* bolt = tightening(effect);
          if (is_this && bolt && bolt->on.get() == interface) return true;
        }
      if (is_this) break;
    }
    return false;
  }

  void refuse_apart(const Point& point, int first, int end, const std::array<bool, 3>& directions) {
    for (size_t d = 0; d < 3; ++d) {
      const Vec3 axis = point.frame.col(static_cast<Eigen::Index>(d));
      const Port* held = nullptr;
      for (int p = first; p < end && directions[d]; ++p) {
        const Port& port = exchange_.ports[static_cast<size_t>(p)];
        if (!is_held(port, d, axis)) continue;
        if (held && moves_apart(*held, port, axis)) fail(point, *held, port, axis);
        held = &port;
      }
    }
  }

  // Rows of quadratic faces have small shares of nodes beside those that are held, which could follow only by moving
  // many times as far.
  bool is_held(const Port& port, size_t d, const Vec3& axis) const {
    constexpr double small_share = 0.1;
    if (port.is_held[d] || !port.trace) return port.is_held[d];
    double free = 0.0, all = 0.0;
    port.for_each_node([&](int node, const Mat3& block) {
      const Held* held = conditions_.at(port.part, node);
      const Vec3 along = block.transpose() * axis;
      all += along.squaredNorm();
      free += held ? (held->free_basis().transpose() * along).squaredNorm() : along.squaredNorm();
    });
    return free <= small_share * small_share * all;
  }

  // Of what is held of a port.
  MotionShares motion_of(const Port& port, const Vec3& axis) const {
    MotionShares shares;
    double whole = 0.0;
    port.for_each_node([&](int node, const Mat3& block) {
      const Held* held = conditions_.at(port.part, node);
      for (int j = 0; held && j < held->n; ++j) {
        const double share = held->directions.col(j).dot(block.transpose() * axis);
        whole += share * held->directions.col(j).dot(axis);
        for (const auto& [motion, factor] : held->motion[static_cast<size_t>(j)]) shares[motion] += factor * share;
      }
    });
    for (auto& [motion, share] : shares) share /= whole;
    return shares;
  }

  bool moves_apart(const Port& one, const Port& other, const Vec3& axis) {
    MotionShares difference = motion_of(one, axis);
    for (const auto& [motion, share] : motion_of(other, axis)) difference[motion] -= share;
    const auto [known, is_new] = is_apart_.try_emplace(difference, false);
    // Shares of a face are known to rounding.
    constexpr double alike = 1e-6;
    for (int i = 0; i < step_.n_increments() && is_new && !known->second; ++i) {
      double sum = 0.0, size = 0.0;
      for (const auto& [motion, share] : difference) {
        const double v = conditions_.motions[static_cast<size_t>(motion)].velocity(i, step_.dt);
        sum += share * v;
        size = std::max(size, std::abs(v));
      }
      known->second = std::abs(sum) > alike * size;
    }
    return known->second;
  }

  std::string holder_of(const Port& port, const Vec3& axis) const {
    std::string holder = "a prescribed motion";
    const Held* held = conditions_.at(port.part, port.node);
    for (int j = 0; held && j < held->n; ++j)
      if (const Support* support = held->support[static_cast<size_t>(j)];
          support && std::abs(held->directions.col(j).dot(axis)) > 1e-6)
        holder = "support '" + support->name + "'";
    return holder;
  }

  // The interface between two ports, or one that the group has.
  const Surface* surface_of(const Point& point) const {
    const std::array<bool, 3> of_law = joined(point);
    if (of_law[0] || of_law[1] || of_law[2]) return &surfaces_[static_cast<size_t>(point.members[0].surface)];
    if (point.first_tie == point.end_tie) return nullptr;
    return &surfaces_[static_cast<size_t>(exchange_.ties[static_cast<size_t>(point.first_tie)].surface)];
  }

  [[noreturn]] void fail(const Point& point, const Port& one, const Port& other, const Vec3& axis) const {
    const Surface* const surface = surface_of(point);
    const Substructure &part = *problem_.substructures[static_cast<size_t>(one.part)],
                       &other_part = *problem_.substructures[static_cast<size_t>(other.part)];
    const Vec3 at = 1e3 * (part.mesh->nodes.col(one.node) + part.place);
    const Vec3 along = axis + Vec3::Zero();  // no -0
    throw InputError(
        surface && surface->interface ? surface->interface->origin : problem_.origin,
        fmt::format("step '{}': '{}' joins its sides, but they are moved apart along ({:.3g}, {:.3g}, {:.3g}) at "
                    "({:.4g}, {:.4g}, {:.4g}) mm: '{}' by {}, '{}' by {}\n    leave these nodes out of one of them, or "
                    "drive one side alone: the interface carries the motion to the other",
                    step_.name, surface ? surface->name() : "a cut", along[0], along[1], along[2], at[0], at[1], at[2],
                    part.name, holder_of(one, axis), other_part.name, holder_of(other, axis)));
  }

  const Problem& problem_;
  const Step& step_;
  const Conditions& conditions_;
  const std::vector<Surface>& surfaces_;
  const Exchange& exchange_;
  std::map<MotionShares, bool> is_apart_;
};

}  // namespace

void refuse_torn_ties(const Problem& problem, const Step& step, const Conditions& conditions,
                      const std::vector<Surface>& surfaces, const Exchange& exchange) {
  TornTies(problem, step, conditions, surfaces, exchange).refuse();
}

}  // namespace dygita

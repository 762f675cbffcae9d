#include "model/joint_path.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "law/law.hpp"
#include "model/effects.hpp"
#include "model/load.hpp"
#include "model/places.hpp"

namespace dygita {

namespace {

// dB, as in handbooks of pyroshock: peaks of spectra in light structures.
constexpr double a_metre = 13.0, a_bolted_joint = 3.0, a_bond = 2.0, an_isolator = 20.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

std::set<const Interface*> tightened_in(const Problem& problem) {
  std::set<const Interface*> tightened;
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (const Tightening* bolt = tightening(effect)) tightened.insert(bolt->on.get());
  return tightened;
}

double loss_of(const Interface& interface, bool is_tightened) {
  if (is_tightened) return a_bolted_joint;
  if (interface.law->word() == "bonded") return a_bond;
  return is_isolator(interface) ? an_isolator : a_bolted_joint;
}

// dB between neighbours that something joins, by the best of their interfaces.
using Losses = std::map<std::pair<int, int>, double>;
Losses losses_between(const Problem& problem) {
  const std::set<const Interface*> tightened = tightened_in(problem);
  Losses losses;
  for (const InterfacePtr& interface : problem.interfaces) {
    const int a = index_of(problem.substructures, interface->side_1.part.get()),
              b = index_of(problem.substructures, interface->side_2.part.get());
    const double loss = loss_of(*interface, tightened.contains(interface.get()));
    for (const auto& pair : {std::pair{a, b}, std::pair{b, a}}) {
      const auto [at, is_new] = losses.emplace(pair, loss);
      if (!is_new) at->second = std::min(at->second, loss);
    }
  }
  return losses;
}

Vec3 centre_of(const FaceOrRegion& place) { return part_of(place).place + mean_of(place).centre; }

// The part before each on its best way from one of them; -1: none.
std::vector<int> parts_before(const Losses& losses, int n, int from) {
  std::vector<double> lost(static_cast<size_t>(n), infinite);
  std::vector<int> before(static_cast<size_t>(n), -1);
  std::set<std::pair<double, int>> open = {{0.0, from}};
  lost[static_cast<size_t>(from)] = 0.0;
  while (!open.empty()) {
    const auto [so_far, part] = *open.begin();
    open.erase(open.begin());
    if (so_far > lost[static_cast<size_t>(part)]) continue;
    for (auto it = losses.lower_bound({part, 0}); it != losses.end() && it->first.first == part; ++it) {
      const auto next = static_cast<size_t>(it->first.second);
      if (!(so_far + it->second < lost[next])) continue;
      lost[next] = so_far + it->second;
      before[next] = part;
      open.insert({lost[next], static_cast<int>(next)});
    }
  }
  return before;
}

}  // namespace

bool is_isolator(const Interface& interface) {
  const std::string word = interface.law->word();
  return word == "bushing" || word == "viscous";
}

double JointPath::rule() const {
  return -(a_metre * distance + a_bolted_joint * bolted + a_bond * bonded + an_isolator * isolators);
}

std::string JointPath::text() const {
  std::string text;
  for (const auto& [n, one, several] : {std::tuple{bolted, "bolted joint", "bolted joints"},
                                        {bonded, "bond", "bonds"},
                                        {isolators, "isolator", "isolators"}})
    if (n > 0) text += fmt::format("{} {}, ", n, n == 1 ? one : several);
  return text + fmt::format("{:.3g} m", distance);
}

JointPath joint_path(const Problem& problem, const FaceOrRegion& from, const FaceOrRegion& to) {
  JointPath path;
  path.distance = (centre_of(to) - centre_of(from)).norm();
  const int first = index_of(problem.substructures, &part_of(from)),
            last = index_of(problem.substructures, &part_of(to));
  const Losses losses = losses_between(problem);
  const std::vector<int> before = parts_before(losses, static_cast<int>(problem.substructures.size()), first);
  for (int part = last; part != first; part = before[static_cast<size_t>(part)]) {
    const int previous = before[static_cast<size_t>(part)];
    if (previous < 0) {
      path.is_connected = false;
      return path;
    }
    const double loss = losses.at({previous, part});
    ++(loss == a_bolted_joint ? path.bolted : loss == a_bond ? path.bonded : path.isolators);
  }
  return path;
}

}  // namespace dygita

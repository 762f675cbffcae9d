#include "run/earlier_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/log.hpp"
#include "run/keep_state.hpp"
#include "run/share_plan.hpp"

namespace dygita {

namespace fs = std::filesystem;

EarlierRun::EarlierRun(const fs::path& folder, const fs::path& own) : folder_(fs::absolute(folder).lexically_normal()) {
  std::error_code ignored;
  if (fs::equivalent(folder_, own, ignored))
    throw InputError(
        fmt::format("--from {}: the results of this run would replace those it starts from\n    --out gives them "
                    "another folder",
                    folder.string()));
  state_ = state_in(folder_);
}

void EarlierRun::check_meshes(const Problem& problem) const {
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("--from {}: {}\n    the parts, their order and their meshes must be those of that run",
                                 folder_.string(), what));
  };
  const auto& kept = state_.mesh_digests;
  for (size_t i = 0; i < std::max(kept.size(), problem.substructures.size()); ++i) {
    if (i >= kept.size()) fail(fmt::format("that run has no substructure '{}'", problem.substructures[i]->name));
    if (i >= problem.substructures.size()) fail(fmt::format("this problem has no substructure '{}'", kept[i].first));
    const Substructure& part = *problem.substructures[i];
    if (part.name != kept[i].first)
      fail(fmt::format("substructure {} is '{}' there and '{}' here", i + 1, kept[i].first, part.name));
    if (digest_alone(kept[i].second) != part.mesh->digest)
      fail(fmt::format("substructure '{}' has another mesh", part.name));
  }
}

size_t EarlierRun::n_common_steps(const Problem& problem) const {
  size_t n = 0;
  while (n < problem.steps.size() && n < state_.steps.size() && problem.steps[n]->is_static &&
         state_.steps[n].is_static && problem.steps[n]->name == state_.steps[n].name)
    ++n;
  if (n > 0) return n;
  const auto label = [](const std::string& name, bool is_static) {
    return fmt::format("the {} step '{}'", is_static ? "static" : "dynamic", name);
  };
  const Step& first = *problem.steps.front();
  throw InputError(
      fmt::format("--from {}: that run begins with {}, this problem with {}\n    static steps of the same name at the "
                  "beginning of both are started from it",
                  folder_.string(), label(state_.steps.front().name, state_.steps.front().is_static),
                  label(first.name, first.is_static)));
}

bool EarlierRun::has_same_loads(const Problem& problem, size_t n_steps) const {
  const std::vector<double> now =
      load_samples(problem, {state_.steps.begin(), state_.steps.begin() + static_cast<long>(n_steps)});
  if (now.size() > state_.loads.size()) return false;
  return std::equal(now.begin(), now.end(), state_.loads.begin(),
                    [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); });
}

StartFields EarlierRun::fields_for(const Problem& problem) const {
  if (problem.monolithic || problem.explicit_dynamics)
    throw InputError(fmt::format("--from {}: solver.{} has no interface fields to start from", folder_.string(),
                                 problem.monolithic ? "monolithic" : "explicit"));
  check_meshes(problem);
  const size_t n = n_common_steps(problem);
  std::string names;
  for (size_t i = 0; i < n; ++i) names += fmt::format("{}'{}'", i > 0 ? ", " : "", problem.steps[i]->name);
  say(fmt::format("  static step{} {} start{} from {}{}", n > 1 ? "s" : "", names, n > 1 ? "" : "s", folder_.string(),
                  has_same_loads(problem, n) ? "" : ", which has other loads"));
  return {state_.fields.get(), n};
}

std::vector<int> EarlierRun::pieces_for(const Problem& problem) const {
  const bool was_cut = std::any_of(state_.mesh_digests.begin(), state_.mesh_digests.end(),
                                   [](const auto& mesh) { return digest_alone(mesh.second) != mesh.second; });
  return was_cut ? kept_pieces(problem, state_) : std::vector<int>();
}

}  // namespace dygita

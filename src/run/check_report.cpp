// What a run would compute, without computing it.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/aside.hpp"
#include "base/memory.hpp"
#include "base/team.hpp"
#include "base/warnings.hpp"
#include "checks/check_problem.hpp"
#include "interfaces/unjoined.hpp"
#include "reduction/lumped_inertia.hpp"
#include "reference/explicit.hpp"
#include "run/machine_speed.hpp"
#include "run/part_lines.hpp"
#include "run/run_problem.hpp"
#include "step/step_needs.hpp"

namespace dygita {

std::string check_report(const Problem& problem) {
  check_problem(problem);
  const MayBeAbandoned may;
  const std::vector<Surface> surfaces = make_surfaces(problem);
  doubt_neighbours(problem, surfaces);
  doubt_lumped_inertia(problem);
  tell_warnings();
  State state = initial_state(problem, surfaces);
  long n_dofs = 0;
  std::string text = fmt::format("problem '{}'\n", problem.name);
  for (const SubstructurePtr& part : problem.substructures) {
    if (part->mesh->has_cells()) check_mesh(*part->mesh, part->name);
    n_dofs += 3L * part->mesh->n_nodes();
    text += part_line(*part);
  }
  text += mass_line(problem);
  for (const std::string& line : base_lines(problem)) text += line + "\n";
  for (const Surface& surface : surfaces) text += surface_line(surface);
  long increments = 0;
  double bytes = 0.0, at_most = 0.0;
  std::pair<double, double> all{};  // s
  const bool is_latin = !problem.monolithic && !problem.explicit_dynamics;
  const CutPtr cut = is_latin ? make_cut(problem, surfaces) : no_cut(problem);
  if (const std::string pieces = list_pieces(problem, cut->counts()); !pieces.empty())
    text += "  cut into pieces: " + pieces + "\n";
  const std::vector<Body> bodies = make_bodies(problem, surfaces, *cut);
  for (const StepPtr& step : problem.steps) {
    if (problem.explicit_dynamics && !step->is_static) {
      const ExplicitSize size = predict_explicit(problem, *step, surfaces, bodies, state);
      text += fmt::format(
          "  dynamic step '{}': {} increments of {:.4g} us in {} substeps each (critical time step {:.4g} us), {:.4g} "
          "MB\n",
          step->name, step->n_increments(), step->dt * 1e6, size.n_substeps, size.critical * 1e6, size.bytes / 1e6);
      increments += step->n_increments();
      bytes = std::max(bytes, size.bytes);
      at_most = std::max(at_most, resident_memory() + size.bytes);
      continue;
    }
    const auto [size, step_at_most, cost] = predict_needs(problem, *step, surfaces, bodies, state, cut);
    text += fmt::format("  {} step '{}': {} increments{}, {} interface unknowns, {:.4g} MB",
                        step->is_static ? "static" : "dynamic", step->name, step->n_increments(),
                        step->is_static ? "" : fmt::format(" of {:.4g} us", step->dt * 1e6), size.n_unknowns,
                        size.bytes / 1e6);
    if (is_latin) {
      const std::pair<double, double> seconds = time_of(cost, machine_speed(), thread_limit());
      text += ", " + in_words(seconds) + (cost.rounds.empty() ? "" : " (" + cost.rounds + ")");
      all.first += seconds.first, all.second += seconds.second;
    }
    text += "\n";
    if (const std::string how = describe(size.integration, problem, *step); !how.empty()) text += "    " + how + "\n";
    increments += step->n_increments();
    bytes = std::max(bytes, size.bytes);
    at_most = std::max(at_most, step_at_most);
  }
  double matrices = 0.0;
  std::set<const StoredMatrices*> known;
  for (const Body& body : bodies)
    if (known.insert(body.matrices.get()).second) matrices += body.matrices->bytes();
  if (all.second > 0.0)
    text += fmt::format("  {} on {} thread{}, by the speed of this machine when nothing else runs\n", in_words(all),
                        thread_limit(), thread_limit() == 1 ? "" : "s");
  if (at_most > 0.0)
    text += fmt::format("  about {:.3g} MB of memory on one thread, within a factor of two\n", at_most / 1e6);
  return text + fmt::format(
                    "  {} degrees of freedom, {} increments in all, {:.4g} MB for factors and interface operators, "
                    "{:.4g} MB for "
                    "matrices; nothing was solved\n",
                    n_dofs, increments, bytes / 1e6, matrices / 1e6);
}

}  // namespace dygita

// Can the time step and the mesh carry what the loads bring and the spectra ask for? Said with warn().
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/warnings.hpp"
#include "checks/check_problem.hpp"
#include "checks/parts.hpp"
#include "law/law.hpp"
#include "model/load_content.hpp"
#include "model/output.hpp"
#include "model/support.hpp"

namespace dygita::check {

namespace {

constexpr double steps_a_period = 10.0;   // a trapezoidal step then turns a wave by 3 % too little each period
constexpr double cells_a_wavelength = 5;  // a mesh turns it by 7 %; as many nodes of cells of order two, by less
constexpr double most_damping = 0.2;      // of critical

struct Content {
  double frequency = 0.0;  // Hz
  std::string who, of;     // "load.pressure on face 'rod.zmax'", and what it asks for
  Origin origin;
};

std::string label(const Load& load) {
  return load.on.empty() ? load.path : load.path + " on " + describe(load.on.front());
}

std::string in_unit(double frequency) {
  return frequency < 1e3   ? fmt::format("{:.3g} Hz", frequency)
         : frequency < 1e6 ? fmt::format("{:.3g} kHz", frequency / 1e3)
                           : fmt::format("{:.3g} MHz", frequency / 1e6);
}

// What the step must carry: the highest of its loads, and the spectra asked for.
std::vector<Content> contents(const Problem& problem, size_t i_step) {
  std::vector<Content> list;
  for (const LoadPtr& load : problem.steps[i_step]->loads)
    if (const double f = load_frequency(problem, i_step, *load); f > 0.0)
      list.push_back({f, label(*load), "95 % of the energy of " + label(*load) + " lies below", load->origin});
  for (const OutputPtr& output : problem.outputs)
    if (const std::optional<double> f = output->highest_frequency())
      list.push_back({*f, output->known_as(), output->known_as() + " asks for", output->origin});
  return list;
}

bool is_of_order_two(const Substructure& part) {
  return std::any_of(part.mesh->blocks.begin(), part.mesh->blocks.end(), [](const CellBlock& block) {
    return nodes_per_cell(block.type) > cell_shape(block.type).n_corners;
  });
}

// Mean over a part's cells of the least distance of two nodes, their shortest edge or half of it, m: the length along
// the waves where cells are drawn out across them.
double cell_size(const Substructure& part) {
  const Mesh& mesh = *part.mesh;
  double sum = 0.0;
  for (const CellBlock& block : mesh.blocks) {
    const int n = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      double shortest2 = std::numeric_limits<double>::infinity();
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < a; ++b)
          shortest2 =
              std::min(shortest2, (mesh.nodes.col(block.cell(i)[a]) - mesh.nodes.col(block.cell(i)[b])).squaredNorm());
      sum += std::sqrt(shortest2);
    }
  }
  return sum / mesh.n_cells();
}

void say(const Problem& problem, const Content& content, const std::string& what, const std::string& text) {
  doubt(problem, content.origin, fmt::format("{} {}; {}", content.of, in_unit(content.frequency), text),
        {what, content.frequency, content.who});
}

// Materials whose damping takes most of the motion that the step is to show. Where nothing says which frequencies
// matter, the lowest of the step counts: what is overdamped there is so everywhere.
void doubt_damping(const Problem& problem, const Step& step, double highest) {
  const double lowest = 1.0 / step.duration, f = std::max(highest, lowest);
  std::set<std::string> told;
  for (const SubstructurePtr& part : problem.substructures) {
    if (!told.insert(part->material.name).second) continue;
    const Damping& damping = part->material.damping;
    if (!part->mesh->has_cells()) continue;
    const double at = damping.ratio(f);
    if (at <= most_damping) continue;
    doubt(problem, part->origin,
          fmt::format("damping of material '{}' is {:.3g} % of critical at {}{}: such motion decays within a period; "
                      "'damping' is in seconds, 'damping_ratio' with "
                      "'damping_frequency' takes the ratio",
                      part->material.name, 100.0 * at, in_unit(f),
                      highest > 0.0 ? ", which step '" + step.name + "' is to show"
                                    : ", the lowest of step '" + step.name + "'"));
  }
}

void doubt_superelements(const Problem& problem, const Content& content) {
  for (const SubstructurePtr& part : problem.substructures) {
    const double valid_to = part->mesh->inside->valid_to;
    if (valid_to > 0.0 && content.frequency > valid_to)
      say(problem, content, "superelement " + part->name,
          fmt::format("superelement '{}' is valid up to {}: above that it does not represent the body", part->name,
                      in_unit(valid_to)));
  }
}

// Hz, the highest of shear waves that the coarsest part's cells carry; infinity: none has cells.
double carried_by_mesh(const Problem& problem) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const SubstructurePtr& part : problem.substructures)
    if (part->mesh->has_cells())
      lowest = std::min(lowest, part->material.s_wave_speed() / (cells_a_wavelength * cell_size(*part)));
  return lowest;
}

bool rubs(const Problem& problem, const Step& step) {
  const std::vector<SupportPtr> supports = supports_of(problem, step);
  return std::any_of(problem.interfaces.begin(), problem.interfaces.end(),
                     [](const InterfacePtr& interface) { return interface->law->shown().slip; }) ||
         std::any_of(supports.begin(), supports.end(), [](const SupportPtr& support) {
           const LawPtr law = support->kind->law();
           return law && law->shown().slip;
         });
}

// What dt of a step is chosen for.
struct Choice {
  bool slides = false;
  double steps = 0.0, frequency = 0.0;  // a period; Hz
  std::string of;
};

Choice choice_of(const Problem& problem, size_t i_step) {
  // The scheme's phase lag is then 0.8 %; friction turns round in between, and its loop is as wide as it is late.
  constexpr double usual = 20.0, of_friction = 40.0;
  Choice choice;
  choice.slides = rubs(problem, *problem.steps[i_step]);
  choice.steps = choice.slides ? of_friction : usual;
  for (const Content& content : contents(problem, i_step))
    if (content.frequency > choice.frequency) choice.frequency = content.frequency, choice.of = content.of;
  if (choice.frequency == 0.0 || !std::isfinite(choice.frequency))
    choice.frequency = carried_by_mesh(problem), choice.of = "the mesh carries";
  return choice;
}

}  // namespace

ChosenDt choose_dt(const Problem& problem, size_t i_step) {
  constexpr double most = 1e7;
  const Step& step = *problem.steps[i_step];
  const Choice choice = choice_of(problem, i_step);
  const double n = std::max(1.0, std::ceil(step.duration * choice.frequency * choice.steps * (1.0 - 1e-9)));
  if (!(n <= most))
    fail(problem, step.origin,
         fmt::format("step '{}' has no 'dt', and {}", step.name,
                     std::isfinite(n) ? fmt::format("{} {}: {:.3g} time steps exceed the limit of {:g}", choice.of,
                                                    in_unit(choice.frequency), n, most)
                                      : std::string("no load, output or mesh tells which frequencies matter")),
         "give 'dt'");
  return {
      step.duration / n,
      fmt::format("step '{}': dt = {:.4g} us, {:.0f} time steps a period{}; {} {}", step.name, 1e6 * step.duration / n,
                  choice.steps, choice.slides ? ", since friction slides" : "", choice.of, in_unit(choice.frequency))};
}

void resolution(const Problem& problem) {
  std::vector<double> size;
  for (size_t i_step = 0; i_step < problem.steps.size(); ++i_step) {
    const StepPtr& step = problem.steps[i_step];
    if (step->is_static) continue;
    const std::vector<Content> all = contents(problem, i_step);
    for (const Content& content : all) {
      const double steps = 1.0 / (content.frequency * step->dt);
      if (steps < steps_a_period)
        say(problem, content, "dt of " + step->name,
            fmt::format("step '{}' makes {:.2g} time steps per period there: {:.0f} are wanted, dt = {:.2g} us",
                        step->name, steps, steps_a_period, 1e6 / (steps_a_period * content.frequency)));
    }
    const auto highest = std::max_element(all.begin(), all.end(),
                                          [](const Content& a, const Content& b) { return a.frequency < b.frequency; });
    doubt_damping(problem, *step, highest == all.end() ? 0.0 : highest->frequency);
    if (highest == all.end()) continue;
    doubt_superelements(problem, *highest);
    if (size.empty())
      for (const SubstructurePtr& part : problem.substructures)
        size.push_back(part->mesh->has_cells() ? cell_size(*part) : 0.0);
    size_t worst = 0;
    const auto cells = [&](size_t i) {
      if (size[i] == 0.0) return std::numeric_limits<double>::infinity();
      return problem.substructures[i]->material.s_wave_speed() / highest->frequency / size[i];
    };
    for (size_t i = 1; i < size.size(); ++i)
      if (cells(i) < cells(worst)) worst = i;
    if (cells(worst) < cells_a_wavelength)
      say(problem, *highest, "mesh for " + step->name,
          fmt::format("the {} of substructure '{}', {:.3g} mm {}, are {:.2g} to the "
                      "wavelength of shear "
                      "waves there, {:.3g} mm: {:.0f} "
                      "are wanted",
                      is_of_order_two(*problem.substructures[worst]) ? "nodes" : "cells",
                      problem.substructures[worst]->name, 1e3 * size[worst],
                      is_of_order_two(*problem.substructures[worst]) ? "apart" : "along their shortest edge",
                      cells(worst), 1e3 * cells(worst) * size[worst], cells_a_wavelength));
  }
}

}  // namespace dygita::check

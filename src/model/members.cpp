#include "model/members.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <tuple>

#include "law/law.hpp"
#include "model/load.hpp"
#include "model/output.hpp"

namespace dygita {

namespace {

bool are_same(const Substructure& a, const Substructure& b, std::string& what) {
  what = a.mesh->digest != b.mesh->digest           ? "the mesh"
         : a.material.key() != b.material.key()     ? "the material"
         : a.material.damping != b.material.damping ? "the damping"
         : a.place != b.place                       ? "the place"
         : a.integration != b.integration           ? "'integration'"
                                                    : "";
  return what.empty();
}

bool are_same(const std::vector<Facet>& a, const std::vector<Facet>& b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (a[i].type() != b[i].type() || !std::ranges::equal(a[i].nodes(), b[i].nodes())) return false;
  return true;
}

// Substructures are the same ones by their names, which are unique.
bool are_same(const Face& a, const Face& b) {
  return a.part->name == b.part->name && (&a.facets() == &b.facets() || are_same(a.facets(), b.facets())) &&
         (!a.facets().empty() || a.group == b.group);
}

bool are_same(const Region& a, const Region& b) { return a.part->name == b.part->name && a.nodes == b.nodes; }
bool are_same(const InterfacePtr& a, const InterfacePtr& b) { return a->name == b->name; }
bool are_same(const SupportPtr& a, const SupportPtr& b) { return a->name == b->name; }

template <class... Places>
bool are_same(const std::vector<std::variant<Places...>>& a, const std::vector<std::variant<Places...>>& b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].index() != b[i].index()) return false;
    const bool is_same = std::visit(
        [&](const auto& place) { return are_same(place, std::get<std::decay_t<decltype(place)>>(b[i])); }, a[i]);
    if (!is_same) return false;
  }
  return true;
}

std::string difference(const Interface& a, const Interface& b) {
  if (a.law->word() != b.law->word()) return "the kind";
  if (!are_same(a.side_1, b.side_1) || !are_same(a.side_2, b.side_2)) return "'between'";
  if (a.points != b.points || a.within != b.within || a.means != b.means ||
      a.cyclic.has_value() != b.cyclic.has_value() || (a.cyclic && a.cyclic->turn != b.cyclic->turn))
    return "how its faces meet";
  return a.has_gap_of_geometry != b.has_gap_of_geometry ? "the kind of gap" : "";
}

std::string difference(const Support& a, const Support& b) {
  if (a.kind->word() != b.kind->word()) return "the kind";
  if (a.factors != b.factors) return "'factors'";
  return are_same(a.on, b.on) ? "" : "'on'";
}

std::string difference(const Substructure& a, const Substructure& b) {
  std::string what;
  are_same(a, b, what);
  return what;
}

std::string difference(const Output& a, const Output& b) { return a.word != b.word ? "the kind" : ""; }

std::string difference(const Step& a, const Step& b);

template <class T>
std::string difference_of_lists(const std::vector<std::shared_ptr<const T>>& a,
                                const std::vector<std::shared_ptr<const T>>& b, const std::string& what) {
  if (a.size() != b.size()) return fmt::format("the number of {}s", what);
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i]->name != b[i]->name) return fmt::format("{} '{}' ('{}')", what, a[i]->name, b[i]->name);
    if (a[i] == b[i]) continue;
    if (const std::string found = difference(*a[i], *b[i]); !found.empty())
      return fmt::format("{} of {} '{}'", found, what, a[i]->name);
  }
  return "";
}

std::string difference(const Step& a, const Step& b) {
  if (a.is_static != b.is_static) return "the kind";
  if (a.increments != b.increments) return "'increments'";
  if (a.dt != b.dt) return "'dt'";
  if (a.duration != b.duration) return "'duration'";
  if (a.inertia_relief != b.inertia_relief) return "'inertia_relief'";
  if ((a.after ? a.after->name : "") != (b.after ? b.after->name : "")) return "'after'";
  if (a.supports.has_value() != b.supports.has_value()) return "'supports'";
  if (a.supports && !difference_of_lists(*a.supports, *b.supports, "support").empty()) return "'supports'";
  if (a.loads.size() != b.loads.size()) return "the number of loads";
  for (size_t i = 0; i < a.loads.size(); ++i) {
    if (a.loads[i]->path != b.loads[i]->path) return fmt::format("{} ({})", a.loads[i]->path, b.loads[i]->path);
    if (!are_same(a.loads[i]->on, b.loads[i]->on)) return fmt::format("where {} acts", a.loads[i]->path);
  }
  return "";
}

bool are_same(const LatinSettings& a, const LatinSettings& b) {
  const auto all = [](const LatinSettings& s) {
    return std::make_tuple(s.tolerance, s.static_tolerance, s.window, s.relaxation, s.anderson, s.max_iterations,
                           s.numerical_damping, s.push_out, s.search_direction, s.mass.is_tuned,
                           s.mass.is_moved_from_contact, s.mass.is_chosen, s.integration, s.precision, s.pieces,
                           s.spectra, s.static_steps, s.plain);
  };
  return all(a) == all(b);
}

bool are_same_solvers(const Problem& a, const Problem& b) {
  if (std::string(a.solver_name()) != b.solver_name()) return false;
  if (a.monolithic) {
    const MonolithicSettings &x = *a.monolithic, &y = *b.monolithic;
    return std::tie(x.tolerance, x.max_iterations, x.numerical_damping, x.mass.is_tuned, x.plain) ==
           std::tie(y.tolerance, y.max_iterations, y.numerical_damping, y.mass.is_tuned, y.plain);
  }
  if (a.explicit_dynamics) {
    const ExplicitSettings &x = *a.explicit_dynamics, &y = *b.explicit_dynamics;
    return std::tie(x.safety, x.penalty, x.one_point, x.hourglass, x.bulk_viscosity) ==
           std::tie(y.safety, y.penalty, y.one_point, y.hourglass, y.bulk_viscosity);
  }
  return are_same(a.solver, b.solver);
}

}  // namespace

std::string difference_of_members(const Problem& first, const Problem& other) {
  if (first.name != other.name) return fmt::format("the problem's name ('{}', '{}')", first.name, other.name);
  for (const std::string& found : {difference_of_lists(first.substructures, other.substructures, "substructure"),
                                   difference_of_lists(first.interfaces, other.interfaces, "interface"),
                                   difference_of_lists(first.supports, other.supports, "support"),
                                   difference_of_lists(first.steps, other.steps, "step"),
                                   difference_of_lists(first.outputs, other.outputs, "output")})
    if (!found.empty()) return found;
  return are_same_solvers(first, other) ? "" : "the solver";
}

}  // namespace dygita

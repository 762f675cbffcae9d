#include "model/places.hpp"

#include <algorithm>
#include <set>

#include "law/law.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {

bool has_dynamic_step(const Problem& problem) {
  return std::any_of(problem.steps.begin(), problem.steps.end(), [](const StepPtr& step) { return !step->is_static; });
}

bool is_wall(const Target& target) {
  const SupportPtr* support = std::get_if<SupportPtr>(&target);
  return support && (*support)->kind->law() && (*support)->kind->sums() == Directions::none;
}

std::vector<SupportPtr> all_supports(const Problem& problem) {
  std::vector<SupportPtr> all = problem.supports;
  for (const StepPtr& step : problem.steps) {
    for (const SupportPtr& support : supports_of(problem, *step)) {
      if (index_of(all, support.get()) < 0) all.push_back(support);
    }
  }
  return all;
}

const Substructure& part_of(const FaceOrRegion& place) {
  return *std::visit([](const auto& p) { return p.part; }, place);
}

std::string label_of(const FaceOrRegion& place) {
  return std::visit([](const auto& p) { return p.label(); }, place);
}

std::vector<int> nodes_at(const FaceOrRegion& place) {
  if (const Face* face = std::get_if<Face>(&place)) return nodes_of(face->facets());
  std::vector<int> nodes = std::get<Region>(place).nodes;
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

MeanNodes mean_of(const FaceOrRegion& place) {
  const Points& x = part_of(place).mesh->nodes;
  if (const Face* face = std::get_if<Face>(&place)) return mean_nodes(face_nodes(*face->part->mesh, face->facets()), x);
  const std::vector<int> nodes = nodes_at(place);
  return mean_nodes(nodes, Vec::Ones(static_cast<Eigen::Index>(nodes.size())), x);
}

Target target_of(const FaceOrRegion& place) {
  return std::visit([](const auto& p) { return Target(p); }, place);
}

bool one_in_other(const FaceOrRegion& a, const FaceOrRegion& b) {
  if (&part_of(a) != &part_of(b)) return false;
  const std::vector<int> nodes_a = nodes_at(a), nodes_b = nodes_at(b);
  return std::includes(nodes_a.begin(), nodes_a.end(), nodes_b.begin(), nodes_b.end()) ||
         std::includes(nodes_b.begin(), nodes_b.end(), nodes_a.begin(), nodes_a.end());
}

bool overlap(const FaceOrRegion& a, const FaceOrRegion& b) {
  if (&part_of(a) != &part_of(b) || a.index() != b.index()) return false;
  const Face* face = std::get_if<Face>(&a);
  if (!face) {
    const std::vector<int> nodes_a = nodes_at(a), nodes_b = nodes_at(b);
    return std::find_first_of(nodes_a.begin(), nodes_a.end(), nodes_b.begin(), nodes_b.end()) != nodes_a.end();
  }
  std::set<FacetKey> keys;
  for (const Facet& facet : face->facets()) keys.insert(facet_key(facet));
  const std::vector<Facet>& others = std::get<Face>(b).facets();
  return std::any_of(others.begin(), others.end(),
                     [&](const Facet& facet) { return keys.count(facet_key(facet)) > 0; });
}

bool coincide(const FaceOrRegion& a, const FaceOrRegion& b) {
  return &part_of(a) == &part_of(b) && nodes_at(a) == nodes_at(b);
}

std::string describe(const Interface& interface) {
  return "interface." + (interface.cyclic ? "cyclic" : interface.law->word()) + " '" + interface.name + "'";
}

std::string describe(const Support& support) { return "support." + support.kind->word() + " '" + support.name + "'"; }

std::string describe(const Target& target) {
  if (const Face* face = std::get_if<Face>(&target)) return "face '" + face->label() + "'";
  if (const Region* region = std::get_if<Region>(&target)) return "a region of '" + region->part->name + "'";
  if (const InterfacePtr* interface = std::get_if<InterfacePtr>(&target)) return describe(**interface);
  return describe(*std::get<SupportPtr>(target));
}

std::optional<FaceOrRegion> place_of(const Target& target) {
  if (const Face* face = std::get_if<Face>(&target)) return *face;
  if (const Region* region = std::get_if<Region>(&target)) return *region;
  return std::nullopt;
}

}  // namespace dygita

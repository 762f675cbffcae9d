#include "drawing/named_facets.hpp"

#include <map>
#include <tuple>

#include "base/error.hpp"
#include "model/meeting.hpp"

namespace dygita {

namespace {

struct Names {
  std::string groups;
  int joint = -1;
};
using NamesOfPart = std::unordered_map<FacetKey, Names, FacetKeyHash>;

class Naming {
 public:
  explicit Naming(const Problem& problem)
      : problem_(problem), within_(default_within(problem)), names_(problem.substructures.size()) {
    for (size_t p = 0; p < names_.size(); ++p)
      for (const auto& [group, facets] : problem.substructures[p]->mesh->faces)
        for (const Facet& facet : facets) {
          std::string& groups = names_[p][facet_key(facet)].groups;
          groups += (groups.empty() ? "" : ", ") + group;
        }
    for (const InterfacePtr& interface : problem.interfaces) add(*interface);
    for (const SupportPtr& support : problem.supports) add(*support);
    for (const StepPtr& step : problem.steps)
      if (step->supports)
        for (const SupportPtr& support : *step->supports)
          if (index_of(problem.supports, support.get()) < 0) add(*support);
  }

  NamedFacets facets() {
    std::map<std::tuple<int, std::string, int>, int> known;
    result_.labels.emplace_back();
    for (size_t p = 0; p < names_.size(); ++p) {
      FacetLabels& of_part = result_.of_part.emplace_back();
      for (const auto& [key, names] : names_[p]) {
        const auto label = std::tuple(static_cast<int>(p), names.groups, names.joint);
        const auto [at, is_new] = known.try_emplace(label, static_cast<int>(result_.labels.size()));
        if (is_new) result_.labels.push_back({static_cast<int>(p), names.groups, names.joint});
        of_part[key] = at->second;
      }
    }
    return std::move(result_);
  }

 private:
  NamesOfPart& names_of(const Face& face) { return names_[index_of(problem_.substructures, face.part.get())]; }

  void mark(const Face& face, const std::vector<Facet>& facets) {
    for (const Facet& facet : facets)
      names_of(face)[facet_key(facet)].joint = static_cast<int>(result_.joints.size()) - 1;
  }

  void add(const Interface& interface) {
    const std::string name = "interface '" + interface.name + "'";
    if (interface.means) {
      result_.joints.push_back({name, true, true});
      mark(interface.side_1, interface.side_1.facets());
      mark(interface.side_2, interface.side_2.facets());
      return;
    }
    try {
      const Meeting meeting = meeting_of(interface, within_);
      result_.joints.push_back({name, true, true});
      mark(interface.side_1, meeting.facets_1());
      mark(interface.side_2, meeting.facets_2());
    } catch (const InputError&) {  // the check itself says what is wrong
      result_.joints.push_back({name + ": NOT FOUND", true, false});
      mark(interface.side_1, interface.side_1.facets());
      mark(interface.side_2, interface.side_2.facets());
    }
  }

  void add(const Support& support) {
    result_.joints.push_back({"support '" + support.name + "'", false, true});
    for (const FaceOrRegion& on : support.on)
      if (const auto* face = std::get_if<Face>(&on)) mark(*face, face->facets());
  }

  const Problem& problem_;
  double within_;  // m
  std::vector<NamesOfPart> names_;
  NamedFacets result_;
};

}  // namespace

NamedFacets named_facets(const Problem& problem) { return Naming(problem).facets(); }

}  // namespace dygita

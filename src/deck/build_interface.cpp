// Interfaces: their sides, the gap that is drawn between them or given, and their law.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.hpp"
#include "deck/build_model.hpp"
#include "deck/deck_state.hpp"
#include "law/law.hpp"
#include "law/rough_contact.hpp"
#include "mesh/face_nodes.hpp"
#include "model/cyclic.hpp"
#include "model/extent.hpp"
#include "model/found_faces.hpp"
#include "model/point_faces.hpp"

namespace dygita {

namespace {

constexpr double default_share_of_size = 1e-4;  // of the assembly: how far apart named faces may be that touch

InterfaceSide side_of(const Object& object) {
  if (object.kind == "substructure") return {object.as<SubstructurePtr>(), {}};
  const Face& face = object.as<Face>();
  return {face.part, face};
}

const char* cure_of_gap(bool knows_gaps) {
  return knows_gaps ? "gap = \"geometry\" keeps the actual gap, closed = true confirms contact"
                    : "move them together by 'place' or 'origin'";
}

// Does the deck say what is to be taken for the gap?
bool has_gap_of_its_own(const Declaration& d) {
  return (d.arguments.has("gap") && (!d.arguments.is_number("gap") || d.arguments.number("gap") != 0.0)) ||
         (d.arguments.has("closed") && d.arguments.boolean("closed"));
}

// A gap of round surfaces is taken from them where the deck says none; others are told.
void settle_gap(const Declaration& d, const std::string& who_1, const std::string& who_2, const GapDoubt& doubt,
                Interface& interface) {
  const bool knows_gaps = d.arguments.has("gap");
  if (doubt.is_empty() || has_gap_of_its_own(d)) return;
  const bool is_kept = knows_gaps && doubt.is_known;
  if (!is_kept && doubt.is_slight) return;
  interface.has_gap_of_geometry = interface.is_gap_drawn = is_kept;
  warn(fmt::format("{}{} '{}': '{}' and '{}' {}; {}", d.origin.prefix(), d.path, interface.name, who_1, who_2,
                   is_kept ? doubt.kept() : doubt.neglected(),
                   is_kept ? "closed = true starts the interface closed" : cure_of_gap(knows_gaps)),
       kind_of(doubt, is_kept, interface.side_1.part->name, interface.side_2.part->name));
}

// Faces that are named meet where they are near, within a distance that the assembly gives: not less than their own.
// Round ones that are apart meet all around, one on a plane beside the line.
void set_named_faces(const Declaration& d, const Face& one, const Face& other, Interface& interface) {
  const bool is_given = interface.within.has_value();
  interface.side_1 = with_facets(one, other, interface.within);
  interface.side_2 = with_facets(other, one, interface.within);
  const double size = std::max(extent_of(*one.part).size().norm(), extent_of(*other.part).size().norm());
  const double within = interface.within.value_or(default_share_of_size * size);
  if (!is_given && d.arguments.has("gap") && !has_gap_of_its_own(d))
    if (const double reach = reach_of_round(interface.side_1, interface.side_2); reach > within)
      interface.within = reach;
  const GapDoubt doubt = doubt_of_gap(interface.side_1, interface.side_2, interface.within.value_or(within));
  // Where 'within' is larger than what facets hide, the check of the whole problem tells it.
  if (!is_given || doubt.is_hidden || (doubt.is_known && d.arguments.has("gap")))
    settle_gap(d, one.label(), other.label(), doubt, interface);
}

// The faces, found where parts are given.
void set_sides(const Declaration& d, Interface& interface) {
  const std::vector<const Object*> sides = d.arguments.objects("between");
  const InterfaceSide one = side_of(*sides[0]), other = side_of(*sides[1]);
  if (d.arguments.has("motion") && d.arguments.text("motion") == "mean") {
    for (const InterfaceSide* side : {&one, &other})
      if (!side->face || is_of_points(*side->face))
        throw InputError(fmt::format("motion = \"mean\" joins two faces, and '{}' is none: name the face of the part",
                                     side->label()));
    interface.side_1 = *one.face;
    interface.side_2 = *other.face;
    interface.means = d.arguments.text("weights") == "nodes" ? MeanBy::nodes : MeanBy::area;
    return;
  }
  if (one.face && other.face) {
    set_named_faces(d, *one.face, *other.face, interface);
    return;
  }
  for (const InterfaceSide* side : {&one, &other})
    if (!side->face && !side->part->mesh->has_cells() && side->part->mesh->faces.empty())
      throw InputError(fmt::format("superelement '{}' has points but no facets: name its face and the opposite face",
                                   side->part->name));
  for (const auto& [own, opposite] : {std::pair(&one, &other), std::pair(&other, &one)})
    if (own->face && is_of_points(*own->face))
      throw InputError(fmt::format("'{}' is given by points alone: give the face of '{}' that lies on them",
                                   own->label(), opposite->label()));
  FoundFaces found = find_faces(one, other, interface.within);
  if (!interface.within && d.arguments.has("gap") && !has_gap_of_its_own(d))
    if (std::optional<FoundFaces> wide = beside_the_line(found)) found = std::move(*wide);
  interface.side_1 = found.side_1;
  interface.side_2 = found.side_2;
  interface.within = found.touching.within;
  say(fmt::format("{} '{}': '{}' and '{}' touch on {}", d.path, interface.name, one.label(), other.label(),
                  describe(found.touching)));
  settle_gap(d, one.label(), other.label(), doubt_of_gap(interface.side_1, interface.side_2, found.touching.within),
             interface);
}

// Elastic constants of two faces against each other: 1/E* of both, and the tangential slope over the normal one of
// their asperities (Mindlin). Throws InputError where a part has not two constants; cure: what to give instead.
std::array<double, 2> contact_constants(const Interface& interface, const std::string& what, const std::string& cure) {
  double normal = 0.0, tangential = 0.0;
  for (const Face* face : {&interface.side_1, &interface.side_2}) {
    const Elastic& material = face->part->material;
    if (!face->part->mesh->has_cells() || !material.is_isotropic())
      throw InputError(fmt::format("'{}' needs Young's modulus and Poisson's ratio of '{}', which has none\n    {}",
                                   what, face->part->name, cure));
    const double poisson = *material.constant("poisson");
    normal += (1.0 - poisson * poisson) / material.young();
    tangential += (2.0 - poisson) / material.shear_modulus();
  }
  return {1.0 / normal, 4.0 * normal / tangential};
}

// What the law is given of `compliance`.
void add_compliance(const Declaration& d, const Interface& interface, std::map<std::string, double>& of_law) {
  std::map<std::string, double> given = d.arguments.settings("compliance");
  if (given.contains("asperities.radius")) {
    const double height = given["asperities.height"];
    const double modulus = contact_constants(interface, "compliance.asperities", "give compliance.normal")[0];
    of_law["coefficient"] =
        coefficient_of_asperities(given["asperities.radius"], given["asperities.density"], modulus, height);
    of_law["height"] = height;
  }
  for (const auto& [name, value] : given)
    if (!name.starts_with("asperities.")) of_law[name] = value;
  if (const auto friction = of_law.find("friction"); friction == of_law.end() || friction->second == 0.0) {
    if (given.contains("tangential"))
      throw InputError("'compliance.tangential' acts within the limit of 'friction', which is 0");
  } else if (!given.contains("tangential")) {
    of_law["ratio"] = contact_constants(interface, "compliance", "give compliance.tangential")[1];
  }
}

// The gap (m) that a function of the deck adds at a place; NaN where a scan in it has no point: it need only have them
// where the faces meet (gaps_of_places.cpp).
double form_at(const Declaration& d, const Interface& interface, const Vec3& x) {
  constexpr double most = 0.01;
  DeckState& state = DeckState::of(d.lua);
  state.has_missed_scan = false;
  const double gap = d.arguments.number_at("gap", x, state.has_missed_scan);
  if (std::abs(gap) > most)
    throw InputError(d.origin, fmt::format("{} '{}': 'gap' is {:g} mm at ({:g}, {:g}, {:g}) m, and gaps are below {:g} "
                                           "mm\n    the function answers in m: was a unit forgotten?",
                                           d.path, interface.name, 1e3 * gap, x[0], x[1], x[2], 1e3 * most));
  return gap;
}

// The same at the nodes of both sides, and what it is like on the first that has it.
void set_form(const Declaration& d, Interface& interface) {
  bool is_told = false;
  for (const int side : {0, 1}) {
    const Face& face = side == 0 ? interface.side_1 : interface.side_2;
    const FaceNodes of_face = face_nodes(*face.part->mesh, face.facets());
    const auto place = [&](size_t i) -> Vec3 {
      return face.part->mesh->nodes.col(of_face.nodes[i]) + face.part->place;
    };
    double least = 1e300, largest = -1e300, sum = 0.0, area = 0.0;
    for (size_t i = 0; i < of_face.nodes.size(); ++i) {
      const double gap = interface.form[static_cast<size_t>(side)][of_face.nodes[i]] = form_at(d, interface, place(i));
      if (std::isnan(gap)) continue;
      const double own = of_face.areas[static_cast<Eigen::Index>(i)];
      least = std::min(least, gap);
      largest = std::max(largest, gap);
      sum += own * gap;
      area += own;
    }
    if (area > 0.0 && !std::exchange(is_told, true))
      say(fmt::format("{} '{}': 'gap' adds {:.4g} to {:.4g} um, {:.4g} um on average", d.path, interface.name,
                      1e6 * least, 1e6 * largest, 1e6 * sum / area));
    if (side == 1 && !is_told) d.arguments.number_at("gap", place(0), false);  // says where the scan has no point
  }
}

void refuse_one_face(const Declaration& d, const Interface& interface) {
  if (interface.side_1.part == interface.side_2.part && interface.side_1.group == interface.side_2.group)
    throw InputError(d.origin, fmt::format("{} '{}': 'between' has face '{}' twice", d.path, interface.name,
                                           interface.side_1.label()));
}

}  // namespace

// The law of a word, from all numbers and truth values of the declaration.
Content build_interface(const Declaration& d) {
  auto interface = new_named<Interface>(d);
  std::map<std::string, double> of_law = d.arguments.plain_numbers();
  if (of_law.erase("within") > 0) interface->within = d.arguments.number("within");
  try {
    set_sides(d, *interface);
  } catch (const InputError& error) {
    throw InputError(d.origin, fmt::format("{} '{}': {}", d.path, interface->name, error.what()));
  }
  refuse_one_face(d, *interface);
  if (d.arguments.has("points"))
    interface->points = d.arguments.text("points") == "first" ? Carrier::first : Carrier::second;
  if (d.arguments.has("gap") && !d.arguments.is_number("gap")) {
    interface->has_gap_of_geometry = true;
    of_law["gap"] = 0.0;
    if (d.arguments.is_function("gap")) set_form(d, *interface);
  }
  of_law.erase("closed");
  if (d.arguments.has("closed") && d.arguments.boolean("closed") &&
      (interface->has_gap_of_geometry || d.arguments.number("gap") != 0.0))
    throw InputError(d.origin,
                     fmt::format("{} '{}': 'closed' and 'gap' contradict each other", d.path, interface->name));
  if (d.arguments.has("compliance")) add_compliance(d, *interface, of_law);
  const auto entry = std::find_if(law_table().begin(), law_table().end(),
                                  [&](const LawEntry& law) { return law.word == d.arguments.word(); });
  const bool rubs = std::find(entry->arguments.begin(), entry->arguments.end(), "friction") != entry->arguments.end();
  if (rubs && of_law.try_emplace("friction", 0.0).second) DeckState::of(d.lua).without_friction.emplace_back(interface);
  interface->law = make_law(d.arguments.word(), of_law);
  return InterfacePtr(interface);
}

// The cut faces of a sector, tied with one of them turned.
Content build_cyclic(const Declaration& d) {
  auto interface = new_named<Interface>(d);
  if (d.arguments.has("within")) interface->within = d.arguments.number("within");
  const std::vector<const Object*> sides = d.arguments.objects("between");
  interface->side_1 = sides[0]->as<Face>();
  interface->side_2 = sides[1]->as<Face>();
  refuse_one_face(d, *interface);
  interface->law = make_law("bonded", {});
  const auto vector = [&](const char* key) -> Vec3 { return Vec3(d.arguments.numbers(key).data()); };
  try {
    interface->cyclic = cyclic_symmetry(interface->side_1, interface->side_2, vector("through"),
                                        vector("axis").normalized(), static_cast<int>(d.arguments.number("n")));
  } catch (const InputError& error) {
    throw InputError(d.origin, fmt::format("{} '{}': {}", d.path, interface->name, error.what()));
  }
  return InterfacePtr(interface);
}

}  // namespace dygita

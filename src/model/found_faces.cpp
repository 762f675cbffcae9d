#include "model/found_faces.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/task.hpp"
#include "meeting/neighbours.hpp"
#include "meeting/round_surfaces.hpp"
#include "meeting/true_gaps.hpp"
#include "model/meeting.hpp"

namespace dygita {

namespace {

std::string at(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]); }

Outside outside_of(const InterfaceSide& side) {
  if (side.face) return {*side.part->mesh, side.part->place, side.face->facets()};
  return {*side.part->mesh, side.part->place};
}

Face found_on(const SubstructurePtr& part, std::vector<Facet> facets, const std::vector<Facet>& beside,
              const std::string& other) {
  facets.insert(facets.end(), beside.begin(), beside.end());
  return {part, "(on " + other + ")", std::make_shared<const std::vector<Facet>>(std::move(facets))};
}

FoundFaces found_between(const InterfaceSide& one, const InterfaceSide& other, Touching touching) {
  FoundFaces found{found_on(one.part, touching.facets_1, touching.beside_1, other.part->name),
                   found_on(other.part, touching.facets_2, touching.beside_2, one.part->name),
                   {}};
  found.touching = std::move(touching);
  return found;
}

// Of a part, the smooth surfaces that have these facets.
Outside surfaces_with(const SubstructurePtr& part, const std::vector<Facet>& facets) {
  const Outside all = outside_of({part, {}});
  FacetKeys keys;
  for (const Facet& facet : facets) keys.insert(facet_key(facet));
  std::vector<char> is_of(all.facets.size(), 0);  // by the number of the surface
  for (size_t f = 0; f < all.facets.size(); ++f)
    if (keys.contains(facet_key(all.facets[f]))) is_of[static_cast<size_t>(all.patch[f])] = 1;
  std::vector<Facet> own;
  for (size_t f = 0; f < all.facets.size(); ++f)
    if (is_of[static_cast<size_t>(all.patch[f])]) own.push_back(all.facets[f]);
  return {*part->mesh, part->place, std::move(own)};
}

// Why two sides of an interface do not touch.
[[noreturn]] void refuse(const InterfaceSide& one, const InterfaceSide& other, const Outside& outside_1,
                         const Outside& outside_2, double within) {
  const std::string who = fmt::format("'{}' and '{}'", one.label(), other.label());
  const Neighbours neighbours =
      find_neighbours({one.part->mesh.get(), one.part->place}, {other.part->mesh.get(), other.part->place}, 0.0);
  if (const auto& intrusion = neighbours.intrusion)
    throw InputError(
        fmt::format("{} do not touch, they overlap: up to {:.3g} mm deep at {}\n    check 'place', 'origin' and "
                    "'unit'; model an interference by a negative 'gap' between faces that coincide",
                    who, 1e3 * intrusion->depth, at(intrusion->place), 1e9 * intrusion->volume));
  const Separation apart = separation(outside_1, outside_2);
  constexpr const char* at_edges =
      "{} have no area in common, although they come within {:.3g} mm of each other, as at {}\n"
      "    they meet at an edge or a point alone, or the facets of a round face are too coarse to tell: smaller cells "
      "('round', 'size') there, or a larger 'within'";
  if (apart.distance <= within) throw InputError(fmt::format(at_edges, who, 1e3 * within, at(apart.place_1)));
  throw InputError(fmt::format(
      "{} touch nowhere within {:.3g} mm: they are {:.4g} mm apart where they are nearest, from {} to {}\n    check "
      "'place', 'origin' and 'unit'; 'within' sets how far apart touching faces may be",
      who, 1e3 * within, 1e3 * apart.distance, at(apart.place_1), at(apart.place_2)));
}

Box box_of(const Substructure& part) { return PlacedBody{part.mesh.get(), part.place}.box(); }

FacetKeys keys_of(const std::vector<Facet>& facets) {
  FacetKeys keys;
  for (const Facet& facet : facets) keys.insert(facet_key(facet));
  return keys;
}

// Of two parts, facets that an interface of theirs leaves to no other.
struct Taken {
  FacetKeys of_1, of_2;
  void add(const Taken& more) {
    of_1.insert(more.of_1.begin(), more.of_1.end());
    of_2.insert(more.of_2.begin(), more.of_2.end());
  }
};

// What an interface covers in part of flat faces is free for others, but two facets that have met in one interface may
// not meet in another: of such pairs one side stays taken, the one that leaves more to be joined.
void take(const Interface& interface, bool is_swapped, const Outside& whole_1, const Outside& whole_2, Taken& taken) {
  const Face &face_1 = is_swapped ? interface.side_2 : interface.side_1,
             &face_2 = is_swapped ? interface.side_1 : interface.side_2;
  const Touching touching =
      find_touching(outside_of({face_1.part, face_1}), outside_of({face_2.part, face_2}), interface.within);
  if (touching.is_empty()) return taken.add({keys_of(face_1.facets()), keys_of(face_2.facets())});
  // Chords of round faces leave something of every facet.
  const bool is_flat = touching.bend <= 0.01 * touching.within;
  const std::vector<Facet> partly_1 = is_flat ? touching.partly_1 : std::vector<Facet>(),
                           partly_2 = is_flat ? touching.partly_2 : std::vector<Facet>();
  Touching both;
  if (!partly_1.empty() && !partly_2.empty())
    both = find_touching({*face_1.part->mesh, face_1.part->place, partly_1},
                         {*face_2.part->mesh, face_2.part->place, partly_2}, touching.within);
  Taken first{keys_of(touching.facets_1), keys_of(touching.facets_2)};
  for (const Facet& facet : partly_1) first.of_1.erase(facet_key(facet));
  for (const Facet& facet : partly_2) first.of_2.erase(facet_key(facet));
  Taken second = first;
  for (const Facet& facet : both.facets_1) first.of_1.insert(facet_key(facet));
  for (const Facet& facet : both.facets_2) second.of_2.insert(facet_key(facet));
  first.add(taken);
  second.add(taken);
  const auto left = [&](const Taken& of) {
    return find_touching(whole_1, whole_2, interface.within, of.of_1, of.of_2).area;
  };
  taken = both.is_empty() || left(first) >= left(second) ? std::move(first) : std::move(second);
}

}  // namespace

FoundFaces find_faces(const InterfaceSide& one, const InterfaceSide& other, std::optional<double> within) {
  if (one.part == other.part)
    throw InputError(fmt::format("'between' has part '{}' twice: an interface joins two parts", one.part->name));
  const Outside outside_1 = outside_of(one), outside_2 = outside_of(other);
  Touching touching = find_touching(outside_1, outside_2, within);
  if (touching.is_empty()) refuse(one, other, outside_1, outside_2, touching.within);
  return found_between(one, other, std::move(touching));
}

std::optional<FoundFaces> beside_the_line(const FoundFaces& found) {
  const Touching& touching = found.touching;
  if (touching.n_surfaces != 1 || touching.bend < 0.01 * touching.within) return {};
  const SubstructurePtr &part_1 = found.side_1.part, &part_2 = found.side_2.part;
  if (!part_1->mesh->has_cells() || !part_2->mesh->has_cells()) return {};
  const Outside one = surfaces_with(part_1, touching.facets_1), other = surfaces_with(part_2, touching.facets_2);
  const RoundFace round_1({one.mesh, one.facets, one.place, ""}), round_2({other.mesh, other.facets, other.place, ""});
  const double reach = round_1.reach_on_flat(round_2);
  if (reach <= touching.within) return {};
  Touching wide = find_touching(one, other, reach);
  if (wide.is_empty()) return {};
  return found_between({part_1, {}}, {part_2, {}}, std::move(wide));
}

std::vector<TouchingPair> all_touching(const std::vector<SubstructurePtr>& parts,
                                       const std::vector<InterfacePtr>& interfaces, std::optional<double> within) {
  const int n = static_cast<int>(parts.size());
  std::vector<Box> boxes;
  std::vector<std::optional<Outside>> outsides(parts.size());
  for (const SubstructurePtr& part : parts) boxes.push_back(box_of(*part));
  const auto outside = [&](int i) -> const Outside& {
    std::optional<Outside>& known = outsides[static_cast<size_t>(i)];
    if (!known) known = outside_of({parts[static_cast<size_t>(i)], {}});
    return *known;
  };
  std::vector<TouchingPair> pairs;
  Task task("parts that touch", n);
  for (int i = 0; i < n; task.done("'" + parts[static_cast<size_t>(i++)]->name + "'"))
    for (int j = i + 1; j < n; ++j) {
      heed_interrupt();
      const double smaller = std::min(boxes[i].size().norm(), boxes[j].size().norm());
      if (!boxes[i].grown(within.value_or(0.0) + 0.05 * smaller).meets(boxes[j])) continue;
      if (outside(i).facets.empty() || outside(j).facets.empty()) continue;  // superelements of points alone
      Taken taken;
      for (const InterfacePtr& interface : interfaces) {
        if (interface->side_1.part == parts[i] && interface->side_2.part == parts[j])
          take(*interface, false, outside(i), outside(j), taken);
        if (interface->side_1.part == parts[j] && interface->side_2.part == parts[i])
          take(*interface, true, outside(i), outside(j), taken);
      }
      Touching touching = find_touching(outside(i), outside(j), within, taken.of_1, taken.of_2);
      if (touching.is_empty()) continue;
      pairs.push_back({i, j, found_between({parts[i], {}}, {parts[j], {}}, std::move(touching))});
    }
  return pairs;
}

std::string nearest_apart(const std::vector<SubstructurePtr>& parts, const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::pair<double, std::array<int, 2>>> by_boxes;  // no two parts are nearer than their boxes
  for (const auto& [i, j] : pairs) {
    const Box a = box_of(*parts[static_cast<size_t>(i)]), b = box_of(*parts[static_cast<size_t>(j)]);
    by_boxes.push_back({(a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).norm(), {i, j}});
  }
  std::sort(by_boxes.begin(), by_boxes.end());
  std::optional<Separation> nearest;
  std::array<int, 2> who{};
  for (const auto& [distance, pair] : by_boxes) {
    if (nearest && nearest->distance <= distance) break;
    heed_interrupt();
    const Outside one = outside_of({parts[static_cast<size_t>(pair[0])], {}}),
                  other = outside_of({parts[static_cast<size_t>(pair[1])], {}});
    if (one.facets.empty() || other.facets.empty()) continue;
    const Separation apart = separation(one, other);
    if (nearest && nearest->distance <= apart.distance) continue;
    nearest = apart;
    who = pair;
  }
  if (!nearest) return "";
  return fmt::format("nearest are '{}' and '{}', {:.4g} mm apart, from {} to {}",
                     parts[static_cast<size_t>(who[0])]->name, parts[static_cast<size_t>(who[1])]->name,
                     1e3 * nearest->distance, at(nearest->place_1), at(nearest->place_2));
}

std::string describe(const Touching& touching) {
  const double largest = std::max(std::abs(touching.least_gap), std::abs(touching.most_gap));
  std::string text = fmt::format("{:.4g} mm^2 on {} surface{}, ", 1e6 * touching.area, touching.n_surfaces,
                                 touching.n_surfaces == 1 ? "" : "s");
  text += largest < 1e-3 * touching.within ? "no gap"
                                           : fmt::format("gaps from {:.2g} to {:.2g} mm between facets",
                                                         1e3 * touching.least_gap, 1e3 * touching.most_gap);
  text += fmt::format(" (within {:.2g} mm", 1e3 * touching.within);
  if (touching.bend > 0.01 * touching.within)
    text += fmt::format(" of round surfaces, off which facets are up to {:.2g} mm", 1e3 * touching.bend);
  return text + ")";
}

std::string GapDoubt::neglected() const {
  return is_empty() || is_slight ? "" : apart + ", which is neglected: the interface starts closed " + on_average;
}

std::string GapDoubt::kept() const {
  return apart + (overlaps ? ", which a static step presses apart" : ", which is kept") +
         ", as that of the round surfaces " + on_average;
}

double reach_of_round(const Face& side_1, const Face& side_2) {
  constexpr double most = 0.1;  // of a radius: faces further apart are not made to meet
  const RoundFace round_1(placed(side_1)), round_2(placed(side_2));
  if (const double reach = round_1.reach_on_flat(round_2); reach > 0.0) return reach;
  const double even = round_1.even_gap(round_2).value_or(0.0);
  return even < most * std::min(round_1.least_radius(), round_2.least_radius()) ? std::max(0.0, 2.0 * even) : 0.0;
}

GapDoubt doubt_of_gap(const Face& side_1, const Face& side_2, double within) {
  constexpr double most_interference = 0.01;  // of a radius: no fit is tighter
  TrueGaps gaps = true_gaps(placed(side_1), placed(side_2), within);
  if (gaps.area == 0.0) return {};
  const RoundFace round_1(placed(side_1)), round_2(placed(side_2));
  const std::optional<double> even = round_1.even_gap(round_2);
  const bool is_slight = !gaps.is_told();
  if (is_slight && !even) return {};
  if (even) gaps.mean = gaps.least = gaps.most = *even;
  const bool is_apart = gaps.most + gaps.least > 0.0;
  GapDoubt doubt;
  doubt.largest = is_apart ? gaps.most : -gaps.least;
  doubt.apart = fmt::format("{} {:.2g} mm", is_apart ? "are apart by up to" : "overlap by up to", 1e3 * doubt.largest);
  doubt.on_average = fmt::format("(a gap of {:.2g} mm on average over {:.4g} mm^2)", 1e3 * gaps.mean, 1e6 * gaps.area);
  doubt.is_hidden = doubt.largest <= 2.0 * gaps.bend;
  doubt.is_slight = is_slight;
  doubt.overlaps = !is_apart;
  const double reach = round_1.reach_on_flat(round_2);  // what is nearer would leave out what the load brings together
  doubt.is_known = (reach > 0.0 && within >= reach) ||
                   (even && *even > -most_interference * std::min(round_1.least_radius(), round_2.least_radius()));
  return doubt;
}

KindOfWarning kind_of(const GapDoubt& doubt, bool is_kept, const std::string& who_1, const std::string& who_2) {
  return {is_kept           ? "gap of round surfaces"
          : doubt.is_hidden ? "gap within facets"
                            : "gap",
          doubt.largest, fmt::format("'{}' and '{}' ({:.2g} mm)", who_1, who_2, 1e3 * doubt.largest), !doubt.is_hidden};
}

}  // namespace dygita

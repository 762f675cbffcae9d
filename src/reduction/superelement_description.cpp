// What substructure.superelement reads: places, facets and rows (intake/superelement_file.cpp has the reader).
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/fnv1a.hpp"
#include "base/names.hpp"
#include "reduction/superelement_files.hpp"

namespace dygita {

namespace {

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      quoted += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string json_of(const Vec3& x) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x[0], x[1], x[2]); }

template <class List, class Each>
std::string json_list(const List& list, const char* between, Each&& each) {
  std::string text = "[";
  bool is_first = true;
  for (const auto& entry : list) {
    text += (is_first ? "" : between) + each(entry);
    is_first = false;
  }
  return text + "]";
}

const Substructure& part_of(const Target& target) {
  const auto* face = std::get_if<Face>(&target);
  return face ? *face->part : *std::get<Region>(target).part;
}

std::vector<int> nodes_on(const Target& target) {
  const auto* face = std::get_if<Face>(&target);
  return face ? nodes_of(face->facets()) : std::get<Region>(target).nodes;
}

// Rows, from 1; 0: a support holds it, -1: rows before have it.
class RowNumbers {
 public:
  explicit RowNumbers(const Superelement& element) {
    for (const Superelement::Row& row : element.dependent) numbers_[key(element, row)] = -1;
    for (size_t i = 0; i < element.rows.size(); ++i)
      if (element.rows[i].on >= 0) numbers_[key(element, element.rows[i])] = static_cast<int>(i) + 1;
  }
  // node: of the part's mesh; -1: the motion of face `on` as a whole.
  int at(const Superelement& element, int on, int node, int direction) const {
    const auto found = numbers_.find(key(element, {on, node, direction}));
    return found == numbers_.end() ? 0 : found->second;
  }

 private:
  // A node of two faces has its rows once.
  using Key = std::tuple<const Substructure*, int, int, int>;
  static Key key(const Superelement& element, const Superelement::Row& row) {
    return {&part_of(element.on[static_cast<size_t>(row.on)]), row.node < 0 ? row.on : -1, row.node, row.direction};
  }
  std::map<Key, int> numbers_;
};

// vtk types are what facets are known by outside.
std::string facets_text(const Target& target, const std::map<int, int>& number_of) {
  const auto* face = std::get_if<Face>(&target);
  const std::vector<Facet> facets = face ? face->facets() : std::vector<Facet>();
  return json_list(facets, ",\n      ", [&](const Facet& facet) {
    return fmt::format("{{\"type\": {}, \"nodes\": {}}}", facet_shape(facet.type()).vtk_type,
                       json_list(facet.nodes(), ", ", [&](int node) { return std::to_string(number_of.at(node)); }));
  });
}

// All nodes of the faces, each once, and the number (from 1) of each part's.
std::string nodes_text(const Superelement& element, const RowNumbers& rows,
                       std::map<const Substructure*, std::map<int, int>>& numbers) {
  std::vector<std::string> nodes;
  for (size_t f = 0; f < element.on.size(); ++f) {
    const Substructure& part = part_of(element.on[f]);
    for (const int node : nodes_on(element.on[f])) {
      if (!numbers[&part].emplace(node, static_cast<int>(nodes.size()) + 1).second) continue;
      const auto row = [&](int d) { return rows.at(element, static_cast<int>(f), node, d); };
      nodes.push_back(fmt::format("{{\"place\": {}, \"rows\": [{}, {}, {}]}}",
                                  json_of(part.mesh->nodes.col(node) + part.place), row(0), row(1), row(2)));
    }
  }
  return json_list(nodes, ",\n    ", [](const std::string& text) { return text; });
}

// A face that moves as a whole: its rows, the point that it turns about, its nodes.
std::string whole_face_text(const Superelement& element, const RowNumbers& rows, int f, std::map<int, int>& number_of) {
  const Target& on = element.on[static_cast<size_t>(f)];
  const Substructure& part = part_of(on);
  Vec3 centre = Vec3::Zero();
  bool turns = false;
  for (const auto* list : {&element.rows, &element.dependent})
    for (const Superelement::Row& row : *list)
      if (row.on == f) {
        centre = row.place;
        turns |= row.direction >= 3;
      }
  const std::vector<int> nodes = nodes_on(on);
  for (size_t i = 0; i < nodes.size(); ++i) number_of[nodes[i]] = static_cast<int>(i) + 1;
  std::vector<int> own;
  for (int d = 0; d < (turns ? 6 : 3); ++d) own.push_back(rows.at(element, f, -1, d));
  return fmt::format(
      "\"centre\": {}, \"rows\": {},\n     \"nodes\": {}", json_of(centre),
      json_list(own, ", ", [](int row) { return std::to_string(row); }),
      json_list(nodes, ", ", [&](int node) { return json_of(part.mesh->nodes.col(node) + part.place); }));
}

}  // namespace

std::vector<std::string> face_names(const std::vector<Target>& on) {
  std::vector<std::string> names;
  for (const Target& target : on) {
    const auto* face = std::get_if<Face>(&target);
    const auto is_alike = [&](const Target& other) {
      const auto* other_face = std::get_if<Face>(&other);
      return face && other_face && face->group == other_face->group;
    };
    names.push_back(face && std::count_if(on.begin(), on.end(), is_alike) == 1 ? face->group : label(target));
  }
  for (size_t i = 0; i < names.size(); ++i)  // regions of as many nodes
    if (std::count(names.begin(), names.end(), names[i]) > 1) names[i] += fmt::format(" {}", i + 1);
  return names;
}

std::string superelement_description(const std::string& problem, const SuperelementRequest& request,
                                     const Superelement& element,
                                     const std::vector<std::pair<std::string, std::string>>& matrices) {
  const char* motions[] = {"mean", "rigid", "nodes"};
  std::string text = fmt::format(
      "{{\"what\": \"dygita superelement\", \"version\": 1,\n  \"name\": {}, \"problem\": {}, \"step\": {},\n"
      "  \"motion\": \"{}\", \"n_rows\": {}, \"valid_to\": {:.17g}, \"mass_of_parts\": {:.17g}, "
      "\"increments_not_converged\": {},\n",
      json_text(request.name), json_text(problem), json_text(element.step), motions[static_cast<int>(request.motion)],
      element.rows.size(), element.valid_to, element.mass_of_parts, element.missed);
  for (const auto& [suffix, matrix] : matrices) {
    Fnv1a digest;
    digest.add(matrix);
    const std::string what = suffix.substr(1, suffix.find('.') - 1);
    text += fmt::format("  \"{}\": {{\"file\": {}, \"digest\": \"{}\"}},\n", what,
                        json_text(file_name_of(request.name) + suffix), digest.hexadecimal());
  }
  const RowNumbers rows(element);
  std::map<const Substructure*, std::map<int, int>> numbers;
  if (request.motion == FaceMotion::nodes) text += "  \"nodes\": " + nodes_text(element, rows, numbers) + ",\n";
  const std::vector<std::string> names = face_names(element.on);
  std::vector<std::string> faces;
  for (size_t f = 0; f < element.on.size(); ++f) {
    const Target& on = element.on[f];
    std::map<int, int> of_face;
    std::string face = fmt::format("{{\"name\": {}, ", json_text(names[f]));
    if (request.motion != FaceMotion::nodes)
      face += whole_face_text(element, rows, static_cast<int>(f), of_face) + ",\n     ";
    else
      face +=
          "\"points\": " +
          json_list(nodes_on(on), ", ", [&](int node) { return std::to_string(numbers.at(&part_of(on)).at(node)); }) +
          ",\n     ";
    const std::map<int, int>& number_of = request.motion == FaceMotion::nodes ? numbers.at(&part_of(on)) : of_face;
    faces.push_back(face + "\"facets\": " + facets_text(on, number_of) + "}");
  }
  return text + "  \"faces\": " + json_list(faces, ",\n    ", [](const std::string& one) { return one; }) + "}\n";
}

}  // namespace dygita

#include "result/superelement_files.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/names.hpp"

namespace dygita {

namespace {

const char* direction_names[] = {"x", "y", "z", "rx", "ry", "rz"};

const char* motion_text(FaceMotion motion) {
  switch (motion) {
    case FaceMotion::mean:
      return "the mean motion of the face (weights: areas), which is free to deform; a force on it is spread evenly "
             "over the face";
    case FaceMotion::rigid:
      return "the motion of the face as a rigid body";
    case FaceMotion::nodes:
      return "the displacement of one node";
  }
  return "";
}

// m, without the round-off of a mean that is zero.
double coordinate(double x) { return std::abs(x) < 1e-12 ? 0.0 : x; }

std::string introduction(const std::string& problem, const std::string& name, const Superelement& element) {
  const size_t n_modes = static_cast<size_t>(element.fixed_frequencies.size());
  std::string text = fmt::format(
      "# Superelement `{}` of problem `{}`\n\n"
      "The linear assembly about its state at the end of step `{}`, reduced to {} rows: {} interface coordinates and "
      "{} modes "
      "(Craig and Bampton, 1968), {} of which stand for all that are left out, from {} unknowns.\n\n",
      name, problem, element.step, element.rows.size(), element.rows.size() - n_modes, n_modes, element.n_residual,
      element.n_unknowns);
  if (element.missed > 0) text += "**" + unconverged_text(element) + ".**\n\n";
  text += fmt::format(
      "**To be used up to {:.4g} Hz**, half of the frequency up to which modes with the interface held are kept.\n\n",
      element.valid_to);
  text += fmt::format(
      "Small motions about that state: of the contact points {} are tied, {} are tied along their normal only, {} are "
      "open and free. Bonded and "
      "plastic interfaces are tied, the step's supports hold, prescribed motions of that step do not. Mass of the "
      "parts: {:.9g} kg, lumped at the nodes: the rotary inertia of a slender part about "
      "its own axis is too large, by a half with two cells across it.\n\n",
      element.n_tied, element.n_normal, element.n_open, element.mass_of_parts);
  if (element.n_damped > 0)
    text += fmt::format(
        "{} points of interfaces damp relative motion: they are in the damping matrix, and hold nothing.\n\n",
        element.n_damped);
  return text;
}

std::string file_list(const std::string& name, const Superelement& element) {
  std::string text = "## Files\n\n| file | content |\n| --- | --- |\n";
  text += fmt::format(
      "| `{0}_mass.mtx`, `{0}_stiffness.mtx` | symmetric, Matrix Market; SI: kg, N/m; where a row is a rotation in "
      "rad: kg m, kg m^2, N, N m |\n",
      name);
  if (element.damping.size() > 0) text += fmt::format("| `{}_damping.mtx` | the same: N s/m |\n", name);
  text +=
      fmt::format("| `{}.csv` | natural frequencies of the superelement itself, and their damping ratios |\n\n", name);
  text += fmt::format(
      "```python\nimport numpy, scipy.io, scipy.linalg\nM = scipy.io.mmread(\"{0}_mass.mtx\")\nK = "
      "scipy.io.mmread(\"{0}_stiffness.mtx\")\n"
      "w2, modes = scipy.linalg.eigh(K, M)\nprint(numpy.sqrt(numpy.maximum(w2, 0)) / (2 * numpy.pi))       # Hz, as in "
      "{0}.csv\n"
      "f = numpy.zeros(len(M)); f[2] = 1                                    # a force of 1 N on the third row\n"
      "w = 2 * numpy.pi * 1000\na = -w**2 * numpy.linalg.solve(K - w**2 * M, f)                       # m/s^2 of every "
      "row at 1 kHz\n```\n\n",
      name);
  return text;
}

// --- the description that a deck reads (mesh/superelement_file.hpp has the reader)

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

// Names of the faces: those of their meshes where these tell them apart.
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

std::string description(const std::string& problem, const SuperelementRequest& request, const Superelement& element,
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

}  // namespace

std::string unconverged_text(const Superelement& element) {
  return fmt::format("NOT CONVERGED: {} increment{} up to the end of step '{}' missed the tolerance", element.missed,
                     element.missed == 1 ? "" : "s", element.step);
}

std::string matrix_market_text(const Mat& symmetric, const std::string& comment) {
  CHECK(symmetric.rows() == symmetric.cols(), "a square matrix");
  std::string text = "%%MatrixMarket matrix array real symmetric\n% " + comment + "\n";
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {}\n", symmetric.rows(), symmetric.cols());
  for (int j = 0; j < symmetric.cols(); ++j)
    for (int i = j; i < symmetric.rows(); ++i) fmt::format_to(out, "{:.17g}\n", symmetric(i, j) + 0.0);  // + 0: no "-0"
  return text;
}

std::vector<std::pair<std::string, std::string>> superelement_files(const std::string& problem,
                                                                    const SuperelementRequest& request,
                                                                    const Superelement& element) {
  std::string page = introduction(problem, request.name, element) + file_list(file_name_of(request.name), element);
  page += fmt::format(
      "## Rows\n\nA coordinate is {}. Rotations turn about the point given, the face's centroid. The force of an "
      "interface row works on "
      "that motion: N, or N m about the point. Rows of modes are amplitudes (sqrt(kg) m), without force as long as "
      "nothing acts inside.\n\n"
      "| row | what | node | direction | x (m) | y (m) | z (m) |\n| --- | --- | --- | --- | --- | --- | --- |\n",
      motion_text(request.motion));
  const int n = static_cast<int>(element.rows.size()),
            n_interface = n - static_cast<int>(element.fixed_frequencies.size());
  for (int i = 0; i < n_interface; ++i) {
    const Superelement::Row& row = element.rows[i];
    page +=
        fmt::format("| {} | {} | {} | {} | {:.9g} | {:.9g} | {:.9g} |\n", i + 1, label(element.on[row.on]),
                    row.node < 0 ? std::string("all") : std::to_string(row.node + 1), direction_names[row.direction],
                    coordinate(row.place[0]), coordinate(row.place[1]), coordinate(row.place[2]));
  }
  page +=
      "\nNodes are counted from 1 in the part's mesh, as in its file for ParaView plus 1; rows from 1, as in the "
      "files.\n\n";
  page += "| row | mode with the interface held (Hz) |\n| --- | --- |\n";
  for (int i = 0; i < element.fixed_frequencies.size(); ++i)
    page += fmt::format("| {} | {:.6g}{} |\n", n_interface + i + 1, element.fixed_frequencies[i],
                        i + element.n_residual >= element.fixed_frequencies.size() ? " (for those left out)" : "");
  page +=
      "\n## Natural frequencies\n\nOf the superelement with nothing attached (about zero: a rigid motion), those up to "
      "the frequency it is made for:\n\n"
      "| | Hz | damping ratio |\n| --- | --- | --- |\n";
  for (int i = 0; i < element.frequencies.size() && element.frequencies[i] <= element.valid_to; ++i)
    page += fmt::format("| {} | {:.6g} | {:.4g} |\n", i + 1, element.frequencies[i], element.damping_ratios[i]);

  std::vector<std::pair<std::string, std::string>> files;
  const auto add = [&](const char* what, const char* unit, const Mat& matrix) {
    files.emplace_back(
        std::string("_") + what + ".mtx",
        matrix_market_text(matrix, fmt::format("{} ({}) of superelement '{}' after step '{}': see {}.md{}", what, unit,
                                               request.name, element.step, file_name_of(request.name),
                                               element.missed > 0 ? "\n% " + unconverged_text(element) : "")));
  };
  add("mass", "kg", element.mass);
  add("stiffness", "N/m", element.stiffness);
  if (element.damping.size() > 0) add("damping", "N s/m", element.damping);
  const std::string described = description(problem, request, element, files);
  files.emplace_back(".json", described);
  files.emplace_back(".md", page);
  return files;
}

}  // namespace dygita

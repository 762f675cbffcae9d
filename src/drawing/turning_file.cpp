#include "drawing/turning_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/log.hpp"
#include "base/markup.hpp"
#include "base/parallel.hpp"
#include "drawing/part_color.hpp"
#include "drawing/picture.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

constexpr double most_bytes = 600e3;
constexpr int fewest_nodes = 2000, most_nodes = 8000;

template <class T>
std::string base64(const std::vector<T>& values) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  std::string text;
  text.reserve(4 * (bytes.size() + 2) / 3);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t n = std::min<size_t>(3, bytes.size() - i);
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < n ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= n ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Whole numbers up to 32767, and what one of them is worth.
double quantised(const std::vector<double>& values, std::vector<int16_t>& to) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  const double unit = largest > 0.0 ? largest / 32767.0 : 1.0;
  to.clear();
  for (const double v : values) to.push_back(static_cast<int16_t>(std::lround(v / unit)));
  return unit;
}

template <class Lists>
std::string numbers(const Lists& lists) {
  std::vector<uint16_t> flat;
  for (const auto& list : lists)
    for (const int i : list) flat.push_back(static_cast<uint16_t>(i));
  return base64(flat);
}

Json parts_of(const Problem& problem, const TurningMesh& mesh) {
  Json parts = Json::array();
  for (size_t p = 0; p < mesh.parts.size(); ++p)
    parts.push_back({{"name", problem.substructures[p]->name},
                     {"color", part_color(static_cast<int>(p))},
                     {"nodes", mesh.parts[p].n_nodes},
                     {"triangles", mesh.parts[p].n_triangles}});
  return parts;
}

Json still(const Problem& problem, const TurningMesh& mesh, const View& view) {
  const Vec3 low = mesh.nodes.rowwise().minCoeff(), high = mesh.nodes.rowwise().maxCoeff(), centre = 0.5 * (low + high),
             extent = 0.5 * (high - low);
  std::vector<double> x;
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    for (int d = 0; d < 3; ++d) x.push_back(mesh.nodes(d, i) - centre[d]);
  std::vector<int16_t> places;
  const double unit = quantised(x, places);
  Json axes = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int d = 0; d < 3; ++d) axes.push_back(view.axes(row, d));
  return {{"parts", parts_of(problem, mesh)},
          {"unit", unit},  // m
          {"x", base64(places)},
          {"triangles", numbers(mesh.triangles)},
          {"edges", numbers(mesh.edges)},
          {"axes", std::move(axes)},  // to the right, up, towards the reader
          {"extent", {extent[0], extent[1], extent[2]}}};
}

// A frame at the nodes that are left: places lead, stress is the largest of those merged.
Json frame_of(const SkinFrame& frame, const TurningMesh& mesh) {
  const auto n = static_cast<size_t>(mesh.nodes.cols());
  std::vector<double> u(3 * n, 0.0), stress(n, 0.0);
  std::vector<int> count(n, 0);
  size_t i = 0;
  for (const TurningMesh::Part& part : mesh.parts)
    for (size_t k = 0; k < part.to.size(); ++k, ++i) {
      const auto to = static_cast<size_t>(part.to[k]);
      if (std::isfinite(frame.von_mises[i])) stress[to] = std::max<double>(stress[to], frame.von_mises[i]);
      if (!part.leads[k]) continue;
      ++count[to];
      for (size_t d = 0; d < 3; ++d)
        if (const double v = frame.displacement[3 * i + d]; std::isfinite(v)) u[3 * to + d] += v;
    }
  for (size_t j = 0; j < n; ++j)
    for (size_t d = 0; d < 3; ++d) u[3 * j + d] /= std::max(1, count[j]);
  std::vector<int16_t> places;
  const double unit = quantised(u, places), top = *std::max_element(stress.begin(), stress.end());
  std::vector<uint8_t> levels;
  for (const double s : stress)
    levels.push_back(static_cast<uint8_t>(top > 0.0 ? std::lround(255.0 * std::cbrt(s / top)) : 0));
  return {{"step", frame.step}, {"static", frame.is_static}, {"time", frame.time}, {"missed", frame.missed},
          {"unit", unit},       {"u", base64(places)},       {"top", top},         {"s", base64(levels)}};
}

double largest_displacement(const SkinMotion& motion) {
  double largest = 0.0;
  for (const SkinFrame& frame : motion.frames)
    for (size_t i = 0; i + 2 < frame.displacement.size(); i += 3)
      if (const double u = std::hypot(frame.displacement[i], frame.displacement[i + 1], frame.displacement[i + 2]);
          std::isfinite(u))
        largest = std::max(largest, u);
  return largest;
}

// The frame of largest stress in the motion, where there is one.
int shown(const Json& frames) {
  int best = 0;
  std::pair<bool, double> highest{false, -1.0};
  for (size_t k = 0; k < frames.size(); ++k) {
    const std::pair<bool, double> score{!frames[k]["static"].get<bool>(), frames[k]["top"].get<double>()};
    if (!(highest < score)) continue;
    highest = score;
    best = static_cast<int>(k);
  }
  return best;
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string motion_text(const Problem& problem, const SkinMotion& motion) {
  if (motion.frames.empty()) return "";
  const double bytes_of_node = 7.0 * static_cast<double>(motion.frames.size());
  const TurningMesh mesh =
      make_turning_mesh(problem.substructures, {},
                        static_cast<int>(std::clamp<double>(most_bytes / bytes_of_node, fewest_nodes, most_nodes)));
  if (mesh.nodes.cols() == 0) return "";  // bodies of points alone
  const View view = view_of(problem.substructures);
  Json json = still(problem, mesh, view);
  json["hides"] = view.is_cut;  // some part is hidden
  json["stress_power"] = 3;     // of a byte: a peak leaves room for what is small
  Json::array_t frames(motion.frames.size());
  parallel_for(static_cast<int>(frames.size()),
               [&](int i) { frames[static_cast<size_t>(i)] = frame_of(motion.frames[static_cast<size_t>(i)], mesh); });
  json["frames"] = std::move(frames);
  Points u = Points::Zero(3, 1);
  u(0, 0) = largest_displacement(motion);
  json["warp"] = picture_scale(view, {u});
  json["shown"] = shown(json["frames"]);
  return dumped(json);
}

std::string shapes_text(const Problem& problem, const std::vector<Frame>& modes) {
  constexpr size_t most_modes = 20;
  constexpr double drawn_as = 0.08;  // of the view's width, the largest displacement
  const size_t n = std::min(modes.size(), most_modes);
  if (n == 0) return "";
  const TurningMesh mesh = make_turning_mesh(
      problem.substructures, {},
      static_cast<int>(std::clamp<double>(most_bytes / (7.0 * static_cast<double>(n)), fewest_nodes, most_nodes)));
  if (mesh.nodes.cols() == 0) return "";
  const View view = whole_view_of(problem.substructures);
  Json json = still(problem, mesh, view);
  Json::array_t frames(n);
  parallel_for(static_cast<int>(n), [&](int m) {
    const Frame& mode = modes[static_cast<size_t>(m)];
    SkinFrame frame;
    frame.step = fmt::format("mode {}, {:.5g} Hz", m + 1, mode.time);
    frame.is_static = true;
    frame.missed = mode.missed;
    for (size_t p = 0; p < mesh.parts.size(); ++p)
      for (const int node : mesh.parts[p].nodes)
        for (int d = 0; d < 3; ++d)
          frame.displacement.push_back(static_cast<float>(mode.parts[p].displacement(d, node)));
    frame.von_mises.resize(frame.displacement.size() / 3);
    frames[static_cast<size_t>(m)] = frame_of(frame, mesh);
  });
  json["frames"] = std::move(frames);
  json["warp"] = drawn_as * view.size;
  json["shown"] = std::count_if(modes.begin(), modes.begin() + static_cast<long>(n) - 1,
                                [](const Frame& mode) { return mode.time <= 0.0; });
  json["modes"] = true;
  return dumped(json);
}

std::string assembly_text(const Problem& problem, const std::vector<FacetLabels>& labels,
                          const std::vector<TurningLabel>& names, const std::string& coloring) {
  const TurningMesh mesh = make_turning_mesh(problem.substructures, labels, 3 * most_nodes);
  if (mesh.nodes.cols() == 0)
    throw InputError("nothing to draw: all its parts are superelements of points without facets");
  Json json = still(problem, mesh, whole_view_of(problem.substructures));
  json["frames"] = Json::array();
  std::vector<std::array<int, 1>> of_triangle;
  for (const int label : mesh.label) of_triangle.push_back({label});
  json["label"] = numbers(of_triangle);
  json["labels"] = Json::array();
  for (const TurningLabel& name : names) json["labels"].push_back({{"name", name.name}, {"color", name.color}});
  json["coloring"] = coloring;
  return dumped(json);
}

std::string turning_figure(const std::string& json, const std::string& title, const std::string& caption) {
  // "</script>" in a name would end the data.
  std::string data;
  data.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      data += "\\u003c";
    else
      data += c;
  return "<figure class=\"turn\" hidden data-title=\"" + escaped(title) + "\">\n<script type=\"application/json\">" +
         data + "</script>\n<figcaption>" + escaped(caption) + "</figcaption>\n</figure>\n";
}

}  // namespace dygita

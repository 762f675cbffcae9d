#include "drawing/labelled_panel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/log.hpp"
#include "drawing/item_buffer.hpp"
#include "drawing/plot_legend.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {

namespace {

constexpr double line_height = 17.0, title_height = 26.0, margin = 14.0, widest_column = 230.0;  // px

std::string shaded(const std::string& color, double light) {
  std::string result = "#";
  for (size_t c = 1; c < 7; c += 2)
    result += fmt::format("{:02x}", std::lround(std::stoi(color.substr(c, 2), nullptr, 16) * (0.66 + 0.34 * light)));
  return result;
}

struct Label {
  int item;
  double x, y;  // the place it is of, px
  bool is_hidden = false;
  double at = 0;  // its own height
};

class Drawing {
 public:
  Drawing(const TurningMesh& mesh, const PanelRequest& request)
      : mesh_(mesh), request_(request), p_(fitted()), buffer_(int(request.width) + 1, int(request.height) + 1) {
    CHECK(request.item.size() == mesh.triangles.size(), "each triangle has an item");
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      if (request.item[t] >= 0 && faces_reader(t)) draw(static_cast<int>(t));
  }

  Panel panel() const {
    const std::vector<Label> labels = placed_labels();
    Panel result;
    result.is_named.assign(request_.items.size(), 0);
    std::vector<Label> side[2];
    double column[2] = {margin, margin};
    for (const Label& label : labels) {
      const int right = label.x > 0.5 * request_.width;
      side[right].push_back(label);
      column[right] = std::max(column[right], std::min(widest_column, 24.0 + text_width(name_of(label))));
      result.is_named[label.item] = 1;
    }
    result.height = title_height + request_.height;
    for (std::vector<Label>& of_side : side)
      result.height =
          std::max(result.height, title_height + line_height * static_cast<double>(of_side.size()) + margin);
    result.width = column[0] + request_.width + column[1];
    result.svg = fmt::format("<text x=\"{}\" y=\"17\" font-weight=\"bold\">{}</text>\n", coordinate(margin),
                             escaped(request_.title));
    result.svg += fmt::format("<g transform=\"translate({} {})\" stroke-linejoin=\"round\">\n", coordinate(column[0]),
                              coordinate(title_height));
    result.svg += triangles() + edges();
    for (int right : {0, 1}) result.svg += names(side[right], right == 1, result.height - title_height);
    result.svg += "</g>\n";
    return result;
  }

 private:
  const std::string& name_of(const Label& label) const { return request_.items[label.item].name; }

  // Pixels to the right and down, and depth towards the reader, of what is drawn at all.
  Points fitted() const {
    Points p = request_.axes * mesh_.nodes;
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (request_.item[t] != -1)
        for (const int node : mesh_.triangles[t]) {
          low = low.cwiseMin(p.col(node));
          high = high.cwiseMax(p.col(node));
        }
    const double scale = std::min((request_.width - 2.0 * margin) / std::max(high[0] - low[0], 1e-9),
                                  (request_.height - 2.0 * margin) / std::max(high[1] - low[1], 1e-9));
    const Vec3 centre = 0.5 * (low + high);
    p = scale * (p.colwise() - centre);
    p.row(0).array() += 0.5 * request_.width;
    p.row(1) = (0.5 * request_.height - p.row(1).array()).matrix();
    return p;
  }

  double area(size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return (p_(0, b) - p_(0, a)) * (p_(1, c) - p_(1, a)) - (p_(0, c) - p_(0, a)) * (p_(1, b) - p_(1, a));
  }
  bool faces_reader(size_t t) const { return area(t) < 0.0; }  // y runs down

  void draw(int t) {
    const auto& n = mesh_.triangles[t];
    buffer_.draw(t, {p_(0, n[0]), p_(0, n[1]), p_(0, n[2])}, {p_(1, n[0]), p_(1, n[1]), p_(1, n[2])},
                 {p_(2, n[0]), p_(2, n[1]), p_(2, n[2])});
  }

  double light(size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3 u = p_.col(b) - p_.col(a), v = p_.col(c) - p_.col(a);
    const Vec3 up(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    // The pixels' y runs down: the normal is turned over.
    return std::clamp(Vec3(-0.35, -0.6, 0.72).dot(up.normalized()) * -1.0, 0.0, 1.0);
  }

  std::string triangles() const {
    const std::vector<char> seen = buffer_.seen(static_cast<int>(mesh_.triangles.size()));
    std::vector<int> order;
    for (size_t t = 0; t < seen.size(); ++t)
      if (seen[t]) order.push_back(static_cast<int>(t));
    const auto depth = [&](int t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      return p_(2, a) + p_(2, b) + p_(2, c);
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return depth(a) < depth(b); });
    std::string result, color, path;
    const auto flush = [&] {
      if (!path.empty())
        result += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.8\" d=\"{1}\"/>\n", color, path);
      path.clear();
    };
    for (const int t : order) {
      const std::string own =
          shaded(request_.items[request_.item[t]].color, 0.1 * std::lround(10.0 * light(static_cast<size_t>(t))));
      if (own != color) flush();
      color = own;
      const auto& [a, b, c] = mesh_.triangles[t];
      path += "M" + point(a) + "L" + point(b) + " " + point(c) + "z";
    }
    flush();
    return result;
  }

  std::string point(int node) const { return coordinate(p_(0, node)) + " " + coordinate(p_(1, node)); }

  // Of each node whether it is drawn, and whether only as an outline.
  std::string edges() const {
    std::vector<int> of_node(static_cast<size_t>(mesh_.nodes.cols()), -1);
    for (size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const int node : mesh_.triangles[t])
        if (request_.item[t] != -1)
          of_node[node] = std::max(of_node[node] == -1 ? -2 : of_node[node], request_.item[t]);
    std::string solid, outline;
    for (const auto& [a, b] : mesh_.edges) {
      if (of_node[a] == -1 || of_node[b] == -1) continue;
      const Vec3 middle = 0.5 * (p_.col(a) + p_.col(b));
      const bool is_solid = of_node[a] >= 0 && of_node[b] >= 0;
      if (is_solid && !buffer_.is_in_front(middle[0], middle[1], middle[2], 0.008 * request_.width)) continue;
      (is_solid ? solid : outline) += "M" + point(a) + "L" + point(b);
    }
    const auto drawn = [](const std::string& path, const char* color) {
      return path.empty()
                 ? ""
                 : fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"/>\n", path, color);
    };
    return drawn(outline, "#c4c4c4") + drawn(solid, "#444444");
  }

  // Each item at the pixel of its own that is nearest to the middle of what is seen of it.
  std::vector<Label> placed_labels() const {
    struct Sum {
      double x = 0.0, y = 0.0, n = 0.0, nearest = 1e300;
    };
    std::vector<Sum> sums(request_.items.size());
    std::vector<Label> labels;
    const auto each_pixel = [&](const auto& visit) {
      for (int y = 0; y < request_.height; ++y)
        for (int x = 0; x < request_.width; ++x)
          if (const int t = buffer_.item(x, y); t >= 0) visit(request_.item[t], x + 0.5, y + 0.5);
    };
    each_pixel([&](int item, double x, double y) {
      sums[item].x += x;
      sums[item].y += y;
      ++sums[item].n;
    });
    std::vector<int> label_of(request_.items.size(), -1);
    each_pixel([&](int item, double x, double y) {
      Sum& sum = sums[item];
      if (request_.items[item].name.empty()) return;
      const double far = std::hypot(x - sum.x / sum.n, y - sum.y / sum.n);
      if (far >= sum.nearest) return;
      sum.nearest = far;
      if (label_of[item] < 0) {
        label_of[item] = static_cast<int>(labels.size());
        labels.push_back({item, x, y});
      }
      labels[label_of[item]].x = x;
      labels[label_of[item]].y = y;
    });
    if (request_.names_hidden) add_hidden(label_of, labels);
    return labels;
  }

  // At the middle of their triangles.
  void add_hidden(const std::vector<int>& label_of, std::vector<Label>& labels) const {
    std::vector<Vec3> sum(request_.items.size(), Vec3::Zero());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (const int item = request_.item[t]; item >= 0)
        for (const int node : mesh_.triangles[t]) sum[item] += Vec3(p_(0, node), p_(1, node), 1.0);
    for (size_t i = 0; i < sum.size(); ++i)
      if (label_of[i] < 0 && sum[i][2] > 0.0 && !request_.items[i].name.empty())
        labels.push_back({static_cast<int>(i), sum[i][0] / sum[i][2], sum[i][1] / sum[i][2], true});
  }

  // One column: from top to bottom as their places are, none over another.
  std::string names(std::vector<Label> labels, bool is_right, double height) const {
    std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
    double free = 0.5 * line_height;
    for (Label& label : labels) {
      label.at = std::max(label.y, free);
      free = label.at + line_height;
    }
    double below = height - 0.5 * line_height;
    for (auto label = labels.rbegin(); label != labels.rend(); ++label) {
      label->at = std::min(label->at, below);
      below = label->at - line_height;
    }
    std::string result;
    for (const Label& label : labels) {
      const double x = is_right ? request_.width + 4.0 : -4.0;
      result += fmt::format(
          "<path d=\"M{0} {1}H{2}L{3} {4}\" fill=\"none\" stroke=\"#333333\" stroke-width=\"0.8\"{8}/><circle "
          "cx=\"{3}\" "
          "cy=\"{4}\" r=\"2\" fill=\"#333333\"/><text x=\"{0}\" y=\"{5}\" text-anchor=\"{6}\">{7}</text>\n",
          coordinate(x), coordinate(label.at), coordinate(is_right ? x - 10.0 : x + 10.0), coordinate(label.x),
          coordinate(label.y), coordinate(label.at + 4.0), is_right ? "start" : "end", escaped(name_of(label)),
          label.is_hidden ? " stroke-dasharray=\"4 3\"" : "");
    }
    return result;
  }

  const TurningMesh& mesh_;
  const PanelRequest& request_;
  Points p_;
  ItemBuffer buffer_;
};

}  // namespace

Panel labelled_panel(const TurningMesh& mesh, const PanelRequest& request) { return Drawing(mesh, request).panel(); }

}  // namespace dygita

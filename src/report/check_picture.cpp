#include "report/check_picture.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "drawing/labelled_panel.hpp"
#include "drawing/named_facets.hpp"
#include "drawing/part_color.hpp"
#include "drawing/picture.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/turning_file.hpp"
#include "report/html.hpp"

namespace dygita {

namespace {

constexpr int most_nodes = 6000;
constexpr const char *unnamed = "#e6e6e6", *support_color = "#8a8a8a", *missing_color = "#ff2020";

std::string joint_color(const NamedFacets& names, int joint) {
  const NamedFacets::Joint& j = names.joints[joint];
  return !j.is_found ? missing_color : j.is_interface ? part_color(joint) : support_color;
}

// "xmin, interface 'grip'"
std::string text_of(const NamedFacets& names, const NamedFacets::Label& label) {
  std::string text = label.groups;
  if (label.joint >= 0) text += (text.empty() ? "" : ", ") + names.joints[label.joint].name;
  return text;
}

class CheckDrawings {
 public:
  explicit CheckDrawings(const Problem& problem)
      : problem_(problem),
        names_(named_facets(problem)),
        mesh_(make_turning_mesh(problem.substructures, names_.of_part, most_nodes)),
        axes_(whole_view_of(problem.substructures).axes) {
    for (size_t p = 0; p < mesh_.parts.size(); ++p) part_.insert(part_.end(), mesh_.parts[p].n_triangles, int(p));
  }

  std::vector<Panel> panels() const {
    std::vector<Panel> all = {assembly(), joints()};
    for (size_t p = 0; p < problem_.substructures.size(); ++p)
      for (Panel& panel : of_part(static_cast<int>(p))) all.push_back(std::move(panel));
    return all;
  }

  // The assembly that turns, facets coloured by the interface they are in.
  std::string turning() const {
    std::vector<TurningLabel> labels;
    for (const NamedFacets::Label& label : names_.labels)
      labels.push_back({text_of(names_, label), label.joint >= 0 ? joint_color(names_, label.joint) : ""});
    return turning_figure(assembly_text(problem_, names_.of_part, labels, "interface or support"),
                          "The assembly with its interfaces",
                          "Drag to turn, with Shift to move, Ctrl and the wheel (or + and −) to zoom; point at a face "
                          "to read its part, groups and "
                          "interface. 'apart' pulls the parts from each other.");
  }

  // Names that no drawing shows: supports on regions of nodes, groups inside a hole. Known once panels are made.
  std::vector<std::string> remarks() const { return remarks_; }

 private:
  PanelRequest request(const std::string& title, double width, double height) const {
    PanelRequest request;
    request.title = title;
    request.axes = axes_;
    request.width = width;
    request.height = height;
    request.names_hidden = true;
    return request;
  }

  Panel assembly() const {
    PanelRequest all = request("Parts", 520.0, 420.0);
    for (size_t p = 0; p < problem_.substructures.size(); ++p)
      all.items.push_back({problem_.substructures[p]->name, part_color(static_cast<int>(p))});
    all.item = part_;
    Panel panel = labelled_panel(mesh_, all);
    tell_hidden("Parts that have no boundary: ", all.items, panel.is_named);
    return panel;
  }

  Panel joints() const {
    PanelRequest found = request("Interfaces and supports", 520.0, 420.0);
    for (size_t j = 0; j < names_.joints.size(); ++j)
      found.items.push_back({names_.joints[j].name, joint_color(names_, static_cast<int>(j))});
    for (const int label : mesh_.label) {
      const int joint = names_.labels[label].joint;
      found.item.push_back(joint >= 0 ? joint : PanelRequest::outline);
    }
    Panel panel = labelled_panel(mesh_, found);
    tell_hidden("Without a face that is drawn: ", found.items, panel.is_named);
    return panel;
  }

  // From the reader's side and from the one behind.
  std::vector<Panel> of_part(int p) const {
    const std::string& name = problem_.substructures[p]->name;
    PanelRequest front = request(name, 300.0, 240.0);
    front.names_hidden = false;  // the other side shows it
    front.items.push_back({"", unnamed});
    std::vector<int> item_of_label(names_.labels.size(), 0);
    for (size_t l = 0; l < names_.labels.size(); ++l) {
      if (names_.labels[l].part != p) continue;
      item_of_label[l] = static_cast<int>(front.items.size());
      front.items.push_back({text_of(names_, names_.labels[l]), part_color(static_cast<int>(front.items.size()))});
    }
    for (size_t t = 0; t < part_.size(); ++t) front.item.push_back(part_[t] == p ? item_of_label[mesh_.label[t]] : -1);
    PanelRequest back = front;
    back.title = name + ", from behind";
    back.axes.row(0) *= -1.0;
    back.axes.row(2) *= -1.0;
    std::vector<Panel> panels = {labelled_panel(mesh_, front), labelled_panel(mesh_, back)};
    std::vector<char> is_named = panels[0].is_named;
    for (size_t i = 0; i < is_named.size(); ++i) is_named[i] |= panels[1].is_named[i];
    tell_hidden("'" + name + "' has more groups, inside: ", front.items, is_named);
    return panels;
  }

  void tell_hidden(const std::string& what, const std::vector<PanelItem>& items,
                   const std::vector<char>& is_named) const {
    std::string hidden;
    for (size_t i = 0; i < items.size(); ++i)
      if (!is_named[i] && !items[i].name.empty()) hidden += (hidden.empty() ? "" : "; ") + items[i].name;
    if (!hidden.empty()) remarks_.push_back(what + hidden);
  }

  const Problem& problem_;
  NamedFacets names_;
  TurningMesh mesh_;
  Mat3 axes_;
  std::vector<int> part_;  // of each triangle
  mutable std::vector<std::string> remarks_;
};

}  // namespace

std::string check_picture_svg(const Problem& problem) {
  const CheckDrawings drawings(problem);
  const std::vector<Panel> panels = drawings.panels();
  constexpr double page = 1560.0, gap = 18.0;
  std::string body;
  double x = gap, y = 46.0, row = 0.0, widest = 0.0;
  for (size_t i = 0; i < panels.size(); ++i) {
    // A part's two sides stay together.
    const double width = panels[i].width + (i >= 2 && i % 2 == 0 ? gap + panels[i + 1].width : 0.0);
    if (x > gap && x + width > page && (i < 2 || i % 2 == 0)) {
      x = gap;
      y += row + gap;
      row = 0.0;
    }
    body +=
        fmt::format("<g transform=\"translate({} {})\">\n", coordinate(x), coordinate(y)) + panels[i].svg + "</g>\n";
    x += panels[i].width + gap;
    widest = std::max(widest, x);
    row = std::max(row, panels[i].height);
  }
  y += row + gap;
  for (const std::string& remark : drawings.remarks()) {
    body += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", coordinate(gap), coordinate(y), escaped(remark));
    y += 20.0;
  }
  const std::string title = "problem '" + problem.name + "'";
  return open_svg(widest, y + gap, title) +
         fmt::format(
             "<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n<text x=\"{}\" y=\"28\" font-size=\"18\" "
             "font-weight=\"bold\">{}</text>\n",
             coordinate(widest), coordinate(y + gap), coordinate(gap), escaped(title)) +
         body + "</svg>\n";
}

std::string check_picture_html(const Problem& problem) {
  const CheckDrawings drawings(problem);
  const std::vector<Panel> panels = drawings.panels();
  std::vector<std::string> figures;
  for (const Panel& panel : panels)
    figures.push_back(
        html::figure(open_svg(panel.width, panel.height, "problem '" + problem.name + "'") + panel.svg + "</svg>\n"));
  std::string parts, remarks;
  for (const std::string& remark : drawings.remarks()) remarks += html::paragraph(remark);
  for (size_t i = 2; i < figures.size(); ++i) parts += figures[i];
  return html::page(problem.name + ", as declared",
                    "<h1>" + escaped(problem.name) + ", as declared</h1>\n" +
                        html::section("The assembly", drawings.turning() + figures[0] + figures[1] + remarks) +
                        html::section("The parts and their groups", html::row({parts})));
}

}  // namespace dygita

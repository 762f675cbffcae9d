// A drawing of triangles with the names of what they belong to beside it, each with a line to its place.
#pragma once

#include <string>
#include <vector>

#include "drawing/turning_mesh.hpp"

namespace dygita {

struct PanelItem {
  std::string name, color;  // without name: drawn, not named
};

struct PanelRequest {
  std::string title;
  Mat3 axes = Mat3::Identity();  // rows: to the right, up, towards the reader
  std::vector<PanelItem> items;
  std::vector<int> item;  // of each triangle of the mesh; -1: left out, outline: only its edges are drawn
  double width = 340.0, height = 300.0;  // px, of the drawing without names
  bool names_hidden = false;             // what is behind others too, by a dashed line to its place
  static constexpr int outline = -2;
};

struct Panel {
  double width = 0.0, height = 0.0;  // px
  std::string svg;                   // without the <svg> around it
  std::vector<char> is_named;        // of each item: whether it is seen and named here
};

// What others hide is left out; of an outline nothing is hidden. CHECKs that each triangle has an item.
Panel labelled_panel(const TurningMesh& mesh, const PanelRequest& request);

}  // namespace dygita

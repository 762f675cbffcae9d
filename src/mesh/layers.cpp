#include "mesh/layers.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "mesh/shape_functions.hpp"

namespace dygita {

namespace {

constexpr double least_cosine = 0.985;    // 10 degrees
constexpr double thickness_share = 0.01;  // by which a cell may differ from its plies

void check_cell(const Through& found, double thickness, const Vec3& at) {
  const std::string where =
      fmt::format("the cell at ({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * at[0], 1e3 * at[1], 1e3 * at[2]);
  if (found.cosine < least_cosine)
    throw InputError(fmt::format(
        "axis 3, along which plies lie on one another, is {:.3g} degrees off the nearest direction of {}\n    "
        "'orientation' gives the axes; the third is normal to the first two",
        std::acos(found.cosine) * 180.0 / std::numbers::pi, where));
  if (std::abs(found.thickness - thickness) > thickness_share * thickness)
    throw InputError(
        fmt::format("the plies are {:.4g} mm thick, and {} is {:.4g} mm along axis 3\n    a layup lies in "
                    "one cell from face to face",
                    1e3 * thickness, where, 1e3 * found.thickness));
}

}  // namespace

Through through(const Mat3& jacobian) {
  Through found;
  for (int d = 0; d < 3; ++d) {
    const double length = jacobian.col(d).norm(), cosine = jacobian(2, d) / length;
    if (std::abs(cosine) > found.cosine) found = {d, cosine < 0.0 ? -1.0 : 1.0, std::abs(cosine), 2.0 * length};
  }
  return found;
}

void check_layers(const Mesh& mesh, double thickness) {
  for (const CellBlock& block : mesh.blocks) {
    const CellShape& shape = cell_shape(block.type);
    if (shape.n_corners != 8)
      throw InputError(
          fmt::format("plies lie in hexahedra alone, and the mesh has {}\n    mesh.box, or mesh.step with "
                      "cells = \"hexahedra\"",
                      shape.name));
    const auto slopes = shape_functions(block.type).slopes(Vec3::Zero());
    const int n = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      Points x(3, n);
      for (int a = 0; a < n; ++a) x.col(a) = mesh.nodes.col(block.cell(i)[a]);
      const Mat3 jacobian = block.axes[static_cast<size_t>(i)].transpose() * x * slopes;
      check_cell(through(jacobian), thickness, x.leftCols(8).rowwise().mean());
    }
  }
}

}  // namespace dygita

#include "mesher/estimate.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "mesher/gmsh_session.hpp"

namespace dygita {

namespace {

constexpr double most_cells = 2e8;            // gmsh takes about a kilobyte for each
constexpr double tetrahedra_of_cube = 8.5;    // with edges as long as those of the cube: 6 sqrt(2)
constexpr double emptiest_box = 100.0;        // of a thin ring or a frame, over its volume
constexpr double implausible_length = 100.0;  // m

struct Extent {
  double cells, across;  // at least so many; m
};

Extent extent_of(int volume, double size, double unit, const GmshEntities& solids) {
  double low[3], high[3];
  gmsh::model::getBoundingBox(3, volume, low[0], low[1], low[2], high[0], high[1], high[2]);
  double box = 1.0, across = 0.0;
  for (int d = 0; d < 3; ++d) {
    box *= high[d] - low[d];
    across = std::hypot(across, high[d] - low[d]);
  }
  double content = box / emptiest_box;  // gmsh knows the volume of OpenCASCADE's solids alone
  if (std::find(solids.begin(), solids.end(), std::pair<int, int>{3, volume}) != solids.end())
    gmsh::model::occ::getMass(3, volume, content);
  return {tetrahedra_of_cube * content / std::pow(size, 3), across * unit};
}

}  // namespace

void refuse_hopeless(const std::string& file, const std::function<double(int volume)>& size_of, double unit) {
  GmshEntities solids;
  gmsh::model::occ::getEntities(solids, 3);
  double cells = 0.0, worst = 0.0, size = 0.0, across = 0.0;
  for (const int volume : gmsh_tags(3)) {
    const double of_volume = size_of(volume);
    if (!(of_volume > 0.0)) continue;
    const Extent extent = extent_of(volume, of_volume, unit, solids);
    cells += extent.cells;
    if (extent.cells < worst) continue;
    worst = extent.cells;
    size = of_volume * unit;
    across = extent.across;
  }
  if (!(cells > most_cells)) return;
  const std::string likely =
      across > implausible_length
          ? "is the file in millimetres? then say unit = mm"
          : fmt::format("is a unit missing or repeated, as in size = 4*mm? {:g} mm would be about {:.1g} cells",
                        1e6 * size, cells * 1e-9);
  throw InputError(fmt::format(
      "{}: cells of {:.3g} mm in a part {:.4g} m across would be about {:.1g}: more than gmsh can generate\n    {}",
      file, 1e3 * size, across, cells, likely));
}

}  // namespace dygita

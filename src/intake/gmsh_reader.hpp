// Meshes of files, read by the mesher.
#pragma once

#include <optional>

#include "mesh/mesh.hpp"

namespace dygita {

struct GmshOptions {
  std::string file;                   // .geo .msh .step .brep, absolute or relative to the working directory
  std::map<std::string, double> set;  // overrides DefineConstant parameters of a .geo
  std::optional<double> size;         // target element size (m), for .step and .brep and .geo without sizes
  double unit = 1.0;                  // length of one unit of the file, in metres
  int order = 1;                      // of the cells that are generated; a .msh has its own
  bool is_complete = false;           // order two: hex27 and prism18 in place of hex20 and prism15
};

// All volumes of one file, read or generated once.
class GmshMeshes {
 public:
  // Cells of order two that tangle are straightened, with a warning. Throws InputError: file missing or unreadable
  // (gmsh's own message), unknown parameter in `set` (with the known ones), no volume group, unsupported cell type
  // (says which are known).
  explicit GmshMeshes(const GmshOptions& options);

  // The body of physical volume `name`; its faces are the surface groups "name.x" (as "x") and every other surface
  // group x lying on its boundary (as "x", unless "name.x" exists; another volume's "other.x" is left out). Without
  // volume groups there is one volume per CAD body, named volume1, volume2, ..., without surface groups one face per
  // CAD surface, surface1, surface2, ... Touching bodies of a .step or .brep are made to share their surfaces. Throws
  // InputError with the closest name for an unknown volume.
  MeshPtr volume(const std::string& name) const;

  std::vector<std::string> volume_names() const;
  const std::string& digest() const { return digest_; }

 private:
  std::map<std::string, MeshPtr> volumes_;
  std::string file_, digest_;
};

}  // namespace dygita

// gmsh's process-wide state from initialize to finalize. Included by sources that name gmsh.
#pragma once

#include <gmsh.h>

#include <functional>
#include <string>

#include "intake/tagged_model.hpp"

namespace dygita {

using GmshEntities = gmsh::vectorpair;  // (dimension, tag)

// One at a time.
class GmshSession {
 public:
  explicit GmshSession(std::string file);
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  // Does `work` and turns what gmsh throws or logs as an error into an InputError, its warnings into ours.
  void run(const std::function<void()>& work) const;

 private:
  std::string file_;
};

std::vector<int> gmsh_tags(int dimension);

// Node tags of the cells of a volume entity, by type, in the order of our nodes; `volume` for messages. Throws
// InputError where cells are of a type that is not in the table.
void read_gmsh_cells(int entity, const std::string& file, const std::string& volume,
                     std::map<CellType, std::vector<size_t>>& cells);

// Corner tags of the facets of a surface entity, appended.
void read_gmsh_facets(int entity, std::vector<TaggedFacet>& facets);

// Places (m) of all nodes, by tag; unit: length of one unit of the model.
void read_gmsh_nodes(double unit, std::unordered_map<size_t, Vec3>& nodes);

}  // namespace dygita

// What a solver asks of the cells: a mass for each node, where it cannot do with a matrix.
#include "checks/parts.hpp"

namespace dygita::check {

namespace {

// The first type of cells of consistent mass; null where all are lumped.
const CellShape* consistent_cells(const Substructure& part) {
  for (const CellBlock& block : part.mesh->blocks)
    if (cell_shape(block.type).inertia == Inertia::consistent) return &cell_shape(block.type);
  return nullptr;
}

// A non-reflecting support is made of the material behind it.
void materials(const Problem& problem) {
  for (const SupportPtr& support : all_supports(problem)) {
    if (!support->kind->absorbs()) continue;
    for (const FaceOrRegion& place : support->on)
      if (!part_of(place).mesh->has_cells())
        fail(problem, support->origin,
             describe(*support) + " is on superelement '" + part_of(place).name +
                 "', which has no material to give the wave impedance",
             "condense the body without that face, or give it a mesh");
  }
}

}  // namespace

void cells(const Problem& problem) {
  materials(problem);
  const char* what = problem.explicit_dynamics              ? "solver.explicit"
                     : problem.mass().is_tuned              ? "mass = \"tuned\""
                     : problem.mass().is_moved_from_contact ? "massless_contact = true"
                                                            : nullptr;
  if (!what || !has_dynamic_step(problem)) return;
  for (const SubstructurePtr& part : problem.substructures)
    if (!part->mesh->has_cells())
      fail(problem, part->origin,
           std::string(what) + " requires a mesh: substructure '" + part->name +
               "' is a superelement, with a mass matrix",
           problem.explicit_dynamics ? "an explicit step divides by the mass of each node: solver.latin and "
                                       "solver.monolithic take superelements"
                                     : "leave it out");
  for (const SubstructurePtr& part : problem.substructures)
    if (const CellShape* cell = consistent_cells(*part))
      fail(problem, part->origin,
           std::string(what) + " requires cells of order one: substructure '" + part->name + "' has " + cell->name +
               " cells, of consistent mass",
           problem.explicit_dynamics ? "an explicit step divides by the mass of each node: solver.latin or "
                                       "solver.monolithic take such cells, or mesh the part with order = 1"
                                     : "leave it out, or mesh the part with order = 1");
}

}  // namespace dygita::check

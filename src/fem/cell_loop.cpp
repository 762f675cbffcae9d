#include "fem/cell_loop.hpp"

#include <algorithm>

#include "base/team.hpp"

namespace dygita {

NodeOwners node_owners(const Mesh& mesh) {
  constexpr int fewest_cells = 500, most_owners = 64;  // of an owner; of a mesh
  const int n_threads = is_in_team() ? 1 : thread_limit();
  NodeOwners owners;
  owners.n_owners = std::clamp(std::min(n_threads, mesh.n_cells() / fewest_cells), 1, most_owners);
  owners.owner.assign(mesh.n_nodes(), 0);
  if (owners.n_owners == 1) return owners;

  int axis;
  (mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff()).maxCoeff(&axis);
  std::vector<double> places(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) places[a] = mesh.nodes(axis, a);
  for (int cut = 1; cut < owners.n_owners; ++cut) {
    const auto quantile = places.begin() + static_cast<std::ptrdiff_t>(places.size()) * cut / owners.n_owners;
    std::nth_element(places.begin(), quantile, places.end());
    for (int a = 0; a < mesh.n_nodes(); ++a) owners.owner[a] += mesh.nodes(axis, a) >= *quantile;
  }
  return owners;
}

}  // namespace dygita

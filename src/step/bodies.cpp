#include "step/bodies.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/name_list.hpp"
#include "base/overloaded.hpp"
#include "base/parallel_by_cost.hpp"
#include "fem/mass.hpp"
#include "fem/node_pattern.hpp"
#include "law/law.hpp"
#include "model/load.hpp"
#include "partition/all_pieces.hpp"
#include "step/integration.hpp"

namespace dygita {

namespace {

void take_off(const FaceOrRegion& place, const SubstructurePtr& part, std::vector<char>& marked) {
  if (const Face* face = std::get_if<Face>(&place); face && face->part == part)
    for (const Facet& facet : face->facets())
      for (const int node : facet.nodes()) marked[node] = 0;
  if (const Region* region = std::get_if<Region>(&place); region && region->part == part)
    for (const int node : region->nodes) marked[node] = 0;
}

void take_off(const std::vector<FaceOrRegion>& places, const SubstructurePtr& part, std::vector<char>& marked) {
  for (const FaceOrRegion& place : places) take_off(place, part, marked);
}

void tell_those_that_keep_mass(const Problem& problem) {
  std::vector<std::string> names;
  for (const SubstructurePtr& part : problem.substructures)
    if (part->material.damping.is_of_strain()) names.push_back(part->name);
  if (!names.empty())
    warn(
        fmt::format("problem '{}': 'massless_contact' requires mass at contact nodes of {} and of the parts they "
                    "touch, because of damping by strain (damping_ratio, damping.stiffness)",
                    problem.name, list_of_names(names)));
}

// Nodes of a substructure that can do without mass: in contact and in nothing else that counts on it.
std::vector<char> nodes_in_contact_alone(const Problem& problem, const std::vector<Surface>& surfaces, int i_part) {
  const SubstructurePtr& part = problem.substructures[i_part];
  std::vector<char> marked(part->mesh->n_nodes(), 0);
  if (part->material.damping.is_of_strain()) return marked;  // the force at the end of a step would not be symmetric
  std::vector<int> n_surfaces(marked.size(), 0);
  const auto mark = [&](const Surface& surface, char value) {
    for (const auto& [part_here, trace] :
         {std::pair{surface.part_1, &surface.facing.side_1}, {surface.part_2, &surface.facing.side_2}}) {
      if (part_here != i_part) continue;
      std::set<int> nodes;
      for (int i = 0; i < trace->n_points(); ++i)
        for (int k = 0; k < trace->n_shares(i); ++k) nodes.insert(trace->share(i, k).node);
      for (const int node : nodes) {
        marked[node] = value;
        ++n_surfaces[node];
      }
    }
  };
  for (const Surface& surface : surfaces)
    if (surface.declared_law().allows_massless_nodes()) mark(surface, 1);
  for (const Surface& surface : surfaces)
    if (!surface.declared_law().allows_massless_nodes()) mark(surface, 0);
  // In an edge or a corner: without its mass the cell there could turn about the few nodes that have some.
  for (size_t node = 0; node < marked.size(); ++node)
    if (n_surfaces[node] > 1) marked[node] = 0;
  for (const StepPtr& step : problem.steps) {
    for (const SupportPtr& support : supports_of(problem, *step))
      if (support->kind->absorbs()) take_off(support->on, part, marked);
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        std::visit(overloaded{[&](const PrescribedMotion& motion) { take_off(motion.on, part, marked); },
                              [&](const BaseMotion& base) { take_off(base.on->on, part, marked); },
                              Ignored<NodalForces, BodyForce, Shortening, PreloadForce, Release>()},
                   effect);
  }
  return marked;
}

// All nodes of both sides of a point of contact, or none.
void agree(const std::vector<Surface>& surfaces, std::vector<std::vector<char>>& marked) {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const Surface& surface : surfaces) {
      if (surface.part_1 < 0 || surface.part_2 < 0 || !surface.declared_law().allows_massless_nodes()) continue;
      for (int i = 0; i < surface.n_points(); ++i) {
        std::vector<char*> all;
        const auto collect = [&](const SideTrace& side, std::vector<char>& of_part) {
          for (int k = 0; k < side.n_shares(i); ++k) all.push_back(&of_part[side.share(i, k).node]);
        };
        collect(surface.facing.side_1, marked[surface.part_1]);
        collect(surface.facing.side_2, marked[surface.part_2]);
        if (std::all_of(all.begin(), all.end(), [&](const char* one) { return *one == *all.front(); })) continue;
        for (char* one : all) *one = 0;
        has_changed = true;
      }
    }
  }
}

// Neighbours of a node that stay, the nearest of them (several where they are as near).
std::vector<int> nearest_inside(const Mesh& mesh, const NodePattern& pattern, const std::vector<char>& marked,
                                int node) {
  std::vector<std::pair<double, int>> inside;
  for (int e = pattern.starts[node]; e < pattern.starts[node + 1]; ++e)
    if (const int other = pattern.neighbours[e]; !marked[other])
      inside.emplace_back((mesh.nodes.col(other) - mesh.nodes.col(node)).norm(), other);
  std::vector<int> nearest;
  if (inside.empty()) return nearest;
  const double distance = std::min_element(inside.begin(), inside.end())->first;
  for (const auto& [d, other] : inside)
    if (d <= (1 + 1e-6) * distance) nearest.push_back(other);
  return nearest;
}

// A node with no neighbour to leave its mass to keeps it.
void keep_where_there_is_no_inside(const Problem& problem, const std::vector<Surface>& surfaces,
                                   std::vector<std::vector<char>>& marked) {
  for (size_t i = 0; i < marked.size(); ++i) {
    const std::vector<char> before = marked[i];
    const Mesh& mesh = *problem.substructures[i]->mesh;
    const NodePattern pattern = node_pattern(mesh);
    for (size_t node = 0; node < before.size(); ++node)
      if (before[node] && nearest_inside(mesh, pattern, before, static_cast<int>(node)).empty()) marked[i][node] = 0;
  }
  agree(surfaces, marked);
}

void move_inside(const Mesh& mesh, const std::vector<char>& marked, Mass& mass) {
  const NodePattern pattern = node_pattern(mesh);
  const Vec lumped = mass.lumped;
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    if (!marked[node]) continue;
    const std::vector<int> inside = nearest_inside(mesh, pattern, marked, node);
    const double share = lumped[node] / static_cast<double>(inside.size());
    for (const int other : inside) {
      mass.lumped[other] += share;
      if (mass.matrix.size() > 0) mass.matrix.coeffRef(other, other) += share;
    }
    mass.lumped[node] = 0.0;
    if (mass.matrix.size() > 0)
      mass.matrix.coeffRef(node, node) = 0.0;  // its cells are lumped: nothing else in its row
  }
}

// Loads on all of a substructure are laid on every rank.
bool has_body_forces(const Problem& problem) {
  for (const StepPtr& step : problem.steps) {
    if (step->inertia_relief) return true;
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (std::holds_alternative<BodyForce>(effect)) return true;
  }
  return false;
}

using BodyKey = std::pair<std::string, MaterialKey>;

// A mass has no directions: turned copies have the same. A mass matrix of its own has some.
BodyKey mass_key(const Substructure& part) {
  return {part.mesh->has_cells() ? part.mesh->shape_digest() : part.mesh->digest, part.material.key()};
}

// Of which pieces the masses are known on all ranks: all where loads are laid on them; else those that give theirs to
// equal ones of other ranks, in one process the first of them. moves_mass: of each piece, are there nodes whose mass
// moves inside?
std::vector<char> with_known_masses(const Cut& cut, bool are_all, const std::vector<char>& moves_mass) {
  std::vector<char> known(static_cast<size_t>(cut.n_pieces()), are_all);
  std::map<BodyKey, int> first;
  for (int i = 0; i < cut.n_pieces(); ++i) {
    if (moves_mass[static_cast<size_t>(i)]) continue;
    const int giving = first.try_emplace(mass_key(*cut.piece(i).body), i).first->second;
    if (cut.piece(giving).rank != cut.piece(i).rank) known[static_cast<size_t>(giving)] = 1;
  }
  return known;
}

// As assembled; of other pieces elsewhere nothing.
std::vector<Vec> lumped_masses(const std::vector<Body>& bodies, const Cut& cut, bool are_all_asked_for,
                               const std::vector<char>& moves_mass) {
  std::vector<Vec> masses;
  for (const Body& body : bodies) masses.push_back(body.matrices ? body.matrices->mass() : Vec());
  if (ranks::is_alone()) return masses;
  const std::vector<char> is_known = with_known_masses(cut, are_all_asked_for, moves_mass);
  std::vector<int> sizes;
  for (int i = 0; i < cut.n_pieces(); ++i) sizes.push_back(is_known[i] ? cut.piece(i).body->mesh->n_nodes() : 0);
  Vec all(std::accumulate(sizes.begin(), sizes.end(), Eigen::Index{0}));
  Eigen::Index at = 0;
  for (int i = 0; i < cut.n_pieces(); at += sizes[i++])
    if (is_known[i] && cut.is_here(i)) all.segment(at, sizes[i]) = masses[i];
  segments_of(cut, sizes).complete(all.data());
  at = 0;
  for (size_t i = 0; i < masses.size(); at += sizes[i++])
    if (is_known[i]) masses[i] = all.segment(at, sizes[i]);
  return masses;
}

// marked: nodes whose mass moves inside, empty: none. dt (s): of the shortest dynamic step, 0: there is none, negative:
// nobody asks for a matrix of it.
Mass mass_of(const Problem& problem, const Body& body, const Vec& lumped, const std::vector<char>& marked, double dt) {
  const Mesh& mesh = *body.part->mesh;
  const Elastic& m = body.part->material;
  const bool has_massless = std::find(marked.begin(), marked.end(), 1) != marked.end();
  Mass mass{lumped, {}, {}};
  if (const CondensedBody* own = mesh.inside->matrices()) {
    CHECK(!has_massless && !problem.mass().is_tuned, "refused by check_problem");
    if (dt >= 0.0) mass.full = own->mass_matrix;
    mass.is_consistent = true;
    if (lumped.size() > 0) mass.all = mass.lumped.sum();
    return mass;
  }
  if (problem.mass().is_tuned && dt > 0.0)
    mass.matrix = tuned_mass(mesh, m, {m.p_wave_speed(), dt}, has_massless ? marked : std::vector<char>());
  if (has_consistent_mass(mesh)) {
    CHECK(!has_massless && !problem.mass().is_tuned, "refused by check_problem");
    if (dt >= 0.0) mass.matrix = consistent_mass(mesh, m);
    mass.is_consistent = true;
  }
  if (has_massless) {
    if (lumped.size() > 0) move_inside(mesh, marked, mass);
    mass.is_massless = marked;
  }
  if (lumped.size() > 0) {
    mass.all = mass.lumped.sum();
    mass.least = mass.lumped.minCoeff();
  }
  return mass;
}

// Does nothing but explicit increments have to do with the body, as far as that can be said before they are chosen?
bool may_do_without_matrix(const Problem& problem, const Substructure& part) {
  return part.mesh->has_cells() && !problem.monolithic && !problem.explicit_dynamics &&
         problem.numerical_damping() == 0.0 && !problem.mass().is_moved_from_contact &&
         asked_of(problem, part) != IntegrationChoice::implicitly &&
         std::none_of(problem.steps.begin(), problem.steps.end(), [](const StepPtr& step) { return step->is_static; });
}

// Equal bodies share theirs; keeps: whose matrix stays.
void add_matrices(const std::vector<char>& to, const std::vector<char>& keeps, std::vector<Body>& bodies) {
  std::map<BodyKey, std::shared_ptr<const StoredMatrices>> known;
  const auto key = [](const Body& body) { return BodyKey{body.part->mesh->digest, body.part->material.key()}; };
  for (const Body& body : bodies)
    if (body.matrices) known[key(body)] = body.matrices;
  std::vector<std::pair<size_t, std::shared_ptr<const StoredMatrices>*>> wanted;
  std::vector<double> cost;
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (!to[i]) continue;
    const auto [at, is_new] = known.try_emplace(key(bodies[i]));
    if (!is_new) continue;
    wanted.emplace_back(i, &at->second);
    cost.push_back(bodies[i].part->mesh->n_cells());
  }
  SpareMatrices spares;
  parallel_by_cost(cost, [&](int i) {
    const auto& [first, matrices] = wanted[static_cast<size_t>(i)];
    const Substructure& part = *bodies[first].part;
    *matrices = std::make_shared<const StoredMatrices>(part.mesh, part.material, keeps[first], &spares);
  });
  for (size_t i = 0; i < bodies.size(); ++i)
    if (to[i]) bodies[i].matrices = known.at(key(bodies[i]));
}

}  // namespace

std::vector<Body> with_all_matrices(std::vector<Body> bodies) {
  const std::vector<char> all(bodies.size(), 1);
  add_matrices(all, all, bodies);
  for (Body& body : bodies) {
    if (body.mass->lumped.size() > 0) continue;
    Mass mass = *body.mass;
    mass.lumped = body.matrices->mass();
    body.mass = std::make_shared<const Mass>(std::move(mass));
  }
  return bodies;
}

void give_up_matrices(const std::vector<Body>& bodies) {
  for (const Body& body : bodies)
    if (body.matrices) body.matrices->give_up();
}

std::vector<Body> make_bodies(const Problem& problem, const std::vector<Surface>& surfaces) {
  std::vector<Body> bodies = make_bodies(problem, surfaces, *no_cut(problem));
  return bodies;
}

std::vector<Body> make_bodies(const Problem& problem, const std::vector<Surface>& surfaces, const Cut& cut) {
  double dt = 0.0;
  for (const StepPtr& step : problem.steps)
    if (!step->is_static) dt = dt == 0.0 ? step->dt : std::min(dt, step->dt);
  std::map<BodyKey, std::shared_ptr<const Mass>> known_mass;
  // Matrices of others serve loads alone.
  std::set<BodyKey> with_matrix;
  const bool lays_loads = has_body_forces(problem);
  for (int i = 0; i < cut.n_pieces(); ++i)
    if (lays_loads || cut.is_here(i)) with_matrix.insert(mass_key(*cut.piece(i).body));
  const bool moves_mass = problem.mass().is_moved_from_contact && dt > 0.0;
  std::vector<Body> bodies;
  std::vector<char> is_here, keeps;
  for (const CutPiece& piece : cut.pieces()) {
    bodies.push_back({piece.body.get(), nullptr, nullptr});
    is_here.push_back(piece.rank == ranks::me());
    keeps.push_back(!may_do_without_matrix(problem, *problem.substructures[piece.part]));
  }
  add_matrices(is_here, keeps, bodies);
  std::vector<std::vector<char>> marked(bodies.size());
  if (moves_mass) {
    tell_those_that_keep_mass(problem);
    CHECK(bodies.size() == problem.substructures.size(), "mass does not move across a cut");
    for (size_t i = 0; i < bodies.size(); ++i)
      marked[i] = nodes_in_contact_alone(problem, surfaces, static_cast<int>(i));
    agree(surfaces, marked);
    keep_where_there_is_no_inside(problem, surfaces, marked);
  }
  std::vector<char> has_massless;
  for (const std::vector<char>& own : marked) has_massless.push_back(std::find(own.begin(), own.end(), 1) != own.end());
  const std::vector<Vec> lumped = lumped_masses(bodies, cut, lays_loads, has_massless);
  std::vector<double> known;  // of the pieces, all and least
  const auto add_mass = [&](size_t i) {
    const BodyKey key = mass_key(*bodies[i].part);
    std::shared_ptr<const Mass>& equal = known_mass[key];
    if (has_massless[i] || !equal) {
      Mass mass = mass_of(problem, bodies[i], lumped[i], marked[i], with_matrix.contains(key) ? dt : -1.0);
      if (lumped[i].size() == 0) {
        mass.all = known[2 * i];
        mass.least = known[2 * i + 1];
      }
      bodies[i].mass = std::make_shared<const Mass>(std::move(mass));
    } else {
      bodies[i].mass = equal;
    }
    if (!has_massless[i]) equal = bodies[i].mass;
  };
  for (size_t i = 0; i < bodies.size(); ++i)
    if (lumped[i].size() > 0) add_mass(i);
  known = of_all_pieces(cut, 2, [&](int i, double* to) {
    const Mass& mass = *bodies[static_cast<size_t>(i)].mass;
    to[0] = mass.all;
    to[1] = mass.least;
  });
  for (size_t i = 0; i < bodies.size(); ++i)
    if (lumped[i].size() == 0) add_mass(i);
  return bodies;
}

}  // namespace dygita

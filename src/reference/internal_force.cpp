#include "reference/internal_force.hpp"

#include <algorithm>

namespace dygita {

namespace {

// As usual in explicit codes.
constexpr BulkViscosity usual_viscosity{0.06, 1.2};

// The body with only these cells.
Mesh only(const Mesh& mesh, std::vector<CellBlock> blocks) {
  Mesh some;
  some.nodes = mesh.nodes;
  some.blocks = std::move(blocks);
  return some;
}

}  // namespace

InternalForce::InternalForce(const std::vector<Body>& bodies, const ExplicitSettings& settings)
    : has_viscosity_(settings.bulk_viscosity) {
  first_.push_back(0);
  for (const Body& body : bodies) {
    const Mesh& mesh = *body.part->mesh;
    const Elastic& material = body.part->material;
    first_.push_back(first_.back() + 3 * mesh.n_nodes());
    Part part;
    part.beta = material.damping.stiffness;
    has_stiffness_damping_ |= part.beta > 0.0;
    std::vector<CellBlock> multiplied;  // by their stiffness
    const BulkViscosity none, viscosity = settings.bulk_viscosity ? usual_viscosity : none;
    for (const CellBlock& block : mesh.blocks) {
      // One point and its hourglass stiffness know lambda and mu alone.
      const bool is_uniform =
          settings.one_point && cell_shape(block.type).one_point != OnePoint::none && material.is_isotropic();
      // Viscosity sees the strain alone, not what stiffness damping adds to it: at its rate that is a third derivative.
      const bool is_apart = !is_uniform || part.beta > 0.0;
      if (is_uniform)
        part.cells.emplace_back(mesh, block, material,
                                UniformStrainSettings{true, settings.hourglass, is_apart ? none : viscosity});
      if (is_apart && settings.bulk_viscosity)
        part.viscous.emplace_back(mesh, block, material, UniformStrainSettings{false, 0.0, viscosity});
      if (settings.one_point && !is_uniform) multiplied.push_back(block);
    }
    if (!multiplied.empty())
      part.stiffness = std::make_unique<SymmetricBlocks>(assemble(only(mesh, multiplied), material).stiffness);
    if (!settings.one_point) part.stiffness = std::make_unique<SymmetricBlocks>(*body.matrices->stiffness());
    parts_.push_back(std::move(part));
  }
}

CellEnergy InternalForce::multiply(const Part& part, const double* displacement, double* force, bool has_energy) {
  if (!part.stiffness) return {};
  if (!has_energy) {
    part.stiffness->add_product(displacement, force);
    return {};
  }
  const int n = part.stiffness->n_dofs();
  product_.setZero(n);
  part.stiffness->add_product(displacement, product_.data());
  Eigen::Map<Vec>(force, n) += product_;
  return {0.5 * product_.dot(Eigen::Map<const Vec>(displacement, n)), 0.0, 0.0};
}

CellEnergy InternalForce::elastic(const Vec& displacement, Vec& force) {
  force.setZero(n_dofs());
  CellEnergy energy;
  for (int i = 0; i < n_parts(); ++i) {
    const double* u = displacement.data() + first_[i];
    for (const UniformStrainCells& cells : parts_[i].cells)
      energy += cells.add_elastic_force(u, force.data() + first_[i]);
    energy += multiply(parts_[i], u, force.data() + first_[i], true);
  }
  return energy;
}

CellEnergy InternalForce::damped(const Vec& displacement, const Vec& velocity, double dt, bool has_energy, Vec& force) {
  force.setZero(n_dofs());
  CellEnergy energy;
  for (int i = 0; i < n_parts(); ++i) {
    Part& part = parts_[i];
    const double* u = displacement.data() + first_[i];
    if (part.beta > 0.0) {
      const int n = first_[i + 1] - first_[i];
      damped_ = displacement.segment(first_[i], n) + part.beta * velocity.segment(first_[i], n);
      u = damped_.data();
    }
    for (UniformStrainCells& cells : part.cells) energy += cells.add_force(u, dt, has_energy, force.data() + first_[i]);
    for (UniformStrainCells& cells : part.viscous)
      energy += cells.add_force(displacement.data() + first_[i], dt, false, force.data() + first_[i]);
    energy += multiply(part, u, force.data() + first_[i], has_energy);
  }
  return energy;
}

void InternalForce::start_from(const Vec& displacement) {
  for (int i = 0; i < n_parts(); ++i) {
    for (UniformStrainCells& cells : parts_[i].cells) cells.start_from(displacement.data() + first_[i]);
    for (UniformStrainCells& cells : parts_[i].viscous) cells.start_from(displacement.data() + first_[i]);
  }
}

double InternalForce::largest_stiffness_damping() const {
  double largest = 0.0;
  for (const Part& part : parts_) largest = std::max(largest, part.beta);
  return largest;
}

double InternalForce::bytes() const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    for (const UniformStrainCells& cells : part.cells) sum += cells.bytes();
    for (const UniformStrainCells& cells : part.viscous) sum += cells.bytes();
    if (part.stiffness) sum += part.stiffness->bytes();
  }
  return sum;
}

}  // namespace dygita

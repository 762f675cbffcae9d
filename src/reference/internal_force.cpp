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
    part.damping = material.damping;
    has_damping_of_strain_ |= part.damping.is_of_strain();
    elongation_.resize(std::max(elongation_.size(), part.damping.branches.size()));
    std::vector<CellBlock> multiplied;  // by their stiffness
    const BulkViscosity none, viscosity = settings.bulk_viscosity ? usual_viscosity : none;
    for (const CellBlock& block : mesh.blocks) {
      // One point and its hourglass stiffness know lambda and mu alone.
      const bool is_uniform =
          settings.one_point && cell_shape(block.type).one_point != OnePoint::none && material.is_isotropic();
      // Viscosity sees the strain alone, not what stiffness damping adds to it: at its rate that is a third derivative.
      const bool is_apart = !is_uniform || part.damping.is_of_strain();
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
  for (Vec& e : elongation_) e.setZero(n_dofs());
}

void InternalForce::set_elongation(int part, int branch, const Points& e) {
  elongation_[static_cast<size_t>(branch)].segment(first_[part], e.size()) = e.reshaped();
}

void InternalForce::advance_branches(const Vec& velocity, double dt) {
  for (int i = 0; i < n_parts(); ++i) {
    const std::vector<Branch>& branches = parts_[i].damping.branches;
    const int n = first_[i + 1] - first_[i];
    for (size_t b = 0; b < branches.size(); ++b) {
      const Relaxation over(branches[b].rate, dt);
      auto e = elongation_[b].segment(first_[i], n);
      e = over.left * e + over.gain * velocity.segment(first_[i], n);
    }
  }
}

std::vector<Points> InternalForce::elongations(int part) const {
  std::vector<Points> all;
  for (const Vec& e : elongation_)
    all.push_back(e.segment(first_[part], first_[part + 1] - first_[part]).reshaped(3, Eigen::AutoSize));
  return all;
}

double InternalForce::energy_in_branches() {
  double sum = 0.0;
  for (int i = 0; i < n_parts(); ++i) {
    const std::vector<Branch>& branches = parts_[i].damping.branches;
    for (size_t b = 0; b < branches.size(); ++b) {
      Vec force = Vec::Zero(first_[i + 1] - first_[i]);
      const CellEnergy energy = elastic_of(parts_[i], elongation_[b].data() + first_[i], force.data());
      sum += branches[b].strength * (energy.strain + energy.hourglass);
    }
  }
  return sum;
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

CellEnergy InternalForce::elastic_of(const Part& part, const double* displacement, double* force) {
  CellEnergy energy;
  for (const UniformStrainCells& cells : part.cells) energy += cells.add_elastic_force(displacement, force);
  energy += multiply(part, displacement, force, true);
  return energy;
}

CellEnergy InternalForce::elastic(const Vec& displacement, Vec& force) {
  force.setZero(n_dofs());
  CellEnergy energy;
  for (int i = 0; i < n_parts(); ++i)
    energy += elastic_of(parts_[i], displacement.data() + first_[i], force.data() + first_[i]);
  return energy;
}

CellEnergy InternalForce::damped(const Vec& displacement, const Vec& velocity, double dt, bool has_energy, Vec& force) {
  force.setZero(n_dofs());
  CellEnergy energy;
  for (int i = 0; i < n_parts(); ++i) {
    Part& part = parts_[i];
    const double* u = displacement.data() + first_[i];
    if (part.damping.is_of_strain()) {
      const int n = first_[i + 1] - first_[i];
      damped_ = displacement.segment(first_[i], n) + part.damping.stiffness * velocity.segment(first_[i], n);
      for (size_t b = 0; b < part.damping.branches.size(); ++b)
        damped_ += part.damping.branches[b].strength * elongation_[b].segment(first_[i], n);
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
  for (const Part& part : parts_) largest = std::max(largest, part.damping.stiffness);
  return largest;
}

double InternalForce::largest_of_sudden_motion() const {
  double largest = 1.0;
  for (const Part& part : parts_) largest = std::max(largest, part.damping.of_sudden_motion());
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

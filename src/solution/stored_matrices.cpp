#include "solution/stored_matrices.hpp"

#include <utility>

namespace dygita {

namespace {

// Eigen's matrices are copied where they are moved.
StiffnessPtr taken(SparseMatrix&& matrix) {
  auto own = std::make_shared<SparseMatrix>();
  own->swap(matrix);
  return own;
}

}  // namespace

StoredMatrices::StoredMatrices(BodyMatrices matrices)
    : mass_(std::move(matrices.mass)),
      n_pairs_(0.5 * (static_cast<double>(matrices.stiffness.nonZeros()) / 9.0 - static_cast<double>(mass_.size()))),
      held_(taken(std::move(matrices.stiffness))) {}

StoredMatrices::StoredMatrices(MeshPtr mesh, const Elastic& material, bool keeps)
    : StoredMatrices(assemble(*mesh, material)) {
  mesh_ = std::move(mesh);
  material_ = material;
  last_ = held_;
  if (keeps) return;
  held_edges_ = std::make_shared<const EdgeBlocks>(*held_);
  last_edges_ = held_edges_;
  held_.reset();
}

double StoredMatrices::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return held_ ? 12.0 * static_cast<double>(held_->nonZeros()) : 0.0;
}

StiffnessPtr StoredMatrices::stiffness() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (held_) return held_;
  StiffnessPtr stiffness = last_.lock();
  if (!stiffness) stiffness = taken(assemble(*mesh_, material_).stiffness);
  last_ = stiffness;
  return stiffness;
}

std::shared_ptr<const EdgeBlocks> StoredMatrices::edges() const {
  if (const std::lock_guard<std::mutex> lock(mutex_); const auto edges = last_edges_.lock()) return edges;
  const StiffnessPtr stiffness = this->stiffness();
  const std::lock_guard<std::mutex> lock(mutex_);
  std::shared_ptr<const EdgeBlocks> edges = last_edges_.lock();
  if (!edges) edges = std::make_shared<const EdgeBlocks>(*stiffness);
  last_edges_ = edges;
  held_edges_ = edges;
  return edges;
}

void StoredMatrices::give_up() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (mesh_) held_.reset();
  held_edges_.reset();
}

}  // namespace dygita

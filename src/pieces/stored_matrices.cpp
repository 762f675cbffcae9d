#include "pieces/stored_matrices.hpp"

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

std::unique_ptr<SparseMatrix> SpareMatrices::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (spare_.empty()) return std::make_unique<SparseMatrix>();
  std::unique_ptr<SparseMatrix> matrix = std::move(spare_.back());
  spare_.pop_back();
  return matrix;
}

void SpareMatrices::give(std::unique_ptr<SparseMatrix> matrix) {
  const std::lock_guard<std::mutex> lock(mutex_);
  spare_.push_back(std::move(matrix));
}

void StoredMatrices::take_sizes(BodyMatrices& matrices) {
  mass_ = std::move(matrices.mass);
  n_pairs_ = 0.5 * (static_cast<double>(matrices.stiffness.nonZeros()) / 9.0 - static_cast<double>(mass_.size()));
}

StoredMatrices::StoredMatrices(BodyMatrices matrices) {
  take_sizes(matrices);
  held_ = taken(std::move(matrices.stiffness));
}

StoredMatrices::StoredMatrices(MeshPtr mesh, const Elastic& material, bool keeps, SpareMatrices* spares)
    : mesh_(std::move(mesh)), material_(material) {
  std::unique_ptr<SparseMatrix> memory = keeps || !spares ? nullptr : spares->take();
  BodyMatrices matrices = assemble(*mesh_, material, memory.get());
  take_sizes(matrices);
  if (keeps) {
    last_ = held_ = taken(std::move(matrices.stiffness));
    return;
  }
  last_edges_ = held_edges_ = std::make_shared<const EdgeBlocks>(matrices.stiffness, mesh_->nodes);
  if (!memory) return;
  memory->swap(matrices.stiffness);
  spares->give(std::move(memory));
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
  if (!edges) edges = std::make_shared<const EdgeBlocks>(*stiffness, mesh_->nodes);
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

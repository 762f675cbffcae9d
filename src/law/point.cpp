#include "law/point.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace dygita {

LawMemory::LawMemory(const std::vector<MemoryEntry>& entries) {
  int n_vectors = 0;
  for (const MemoryEntry& entry : entries)
    (entry.kind == MemoryEntry::Kind::scalar ? n_scalars_ : n_vectors) += entry.count;
  values_.assign(static_cast<size_t>(n_scalars_ + 3 * n_vectors), 0.0);
}

size_t LawMemory::checked(int i, int n) {
  CHECK(i >= 0 && i < n, "a law asks for more memory than it has declared, or of a state that is not its own");
  return static_cast<size_t>(i);
}

void LawMemory::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

void LawMemory::add(const LawMemory& member, double share, const Mat3& frame) {
  if (values_.empty()) {
    n_scalars_ = member.n_scalars_;
    values_.assign(member.values_.size(), 0.0);
  }
  for (int i = 0; i < n_scalars_; ++i) scalar(i) += share * member.scalar(i);
  for (int i = 0; i < n_vectors(); ++i) vector(i) += share * (frame.transpose() * member.vector(i));
}

LawMemory LawMemory::turned(const Mat3& frame) const {
  LawMemory turned = *this;
  for (int i = 0; i < n_vectors(); ++i) turned.vector(i) = frame * vector(i);
  return turned;
}

void LawState::add(const LawState& member, double share, const Mat3& frame) {
  gap += share * member.gap;
  plastic_opening += share * member.plastic_opening;
  slip += share * (frame.transpose() * member.slip);
  force += frame.transpose() * member.force;
  status = member.status;
  memory.add(member.memory, share, frame);
}

LawState LawState::member(double share, const Mat3& frame) const {
  return {.gap = gap,
          .plastic_opening = plastic_opening,
          .slip = frame * slip,
          .rate = frame * rate,
          .force = share * (frame * force),
          .status = status,
          .memory = memory.turned(frame)};
}

}  // namespace dygita

// What a law keeps of its own at a point from increment to increment, beside what all users of laws read.
#pragma once

#include <string>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// Numbers or vectors of one name and unit (SI), per area or lengths: where surface points are one point, it has their
// mean by area.
struct MemoryEntry {
  enum class Kind { scalar, vector };
  std::string name, unit;
  Kind kind = Kind::scalar;
  int count = 1;
};

// The block that a law declares: its scalars, and its vectors, each counted in the order of the entries. Vectors have
// the axes of whoever holds them: those of the point, or the global ones. Laws without entries have no storage.
class LawMemory {
 public:
  LawMemory() = default;
  explicit LawMemory(const std::vector<MemoryEntry>& entries);

  int n_scalars() const { return n_scalars_; }
  int n_vectors() const { return (static_cast<int>(values_.size()) - n_scalars_) / 3; }
  double& scalar(int i) { return values_[checked(i, n_scalars())]; }
  double scalar(int i) const { return values_[checked(i, n_scalars())]; }
  Eigen::Map<Vec3> vector(int i) { return Eigen::Map<Vec3>(values_.data() + place(i)); }
  Eigen::Map<const Vec3> vector(int i) const { return Eigen::Map<const Vec3>(values_.data() + place(i)); }
  void clear();  // to zero

  // Adds that of a surface point (global axes) that a point of this frame stands for, by its share of the area.
  void add(const LawMemory& member, double share, const Mat3& frame);
  // The same in global axes.
  LawMemory turned(const Mat3& frame) const;
  // All numbers, to be sent or received.
  size_t size() const { return values_.size(); }
  double* data() { return values_.data(); }
  const double* data() const { return values_.data(); }

 private:
  static size_t checked(int i, int n);  // CHECKs that i is one of n
  size_t place(int i) const { return static_cast<size_t>(n_scalars_) + 3 * checked(i, n_vectors()); }

  int n_scalars_ = 0;
  std::vector<double> values_;
};

}  // namespace dygita

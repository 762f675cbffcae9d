// Bodies that are joined in a ring around a line: which of the ties would close it (manual, eq. J5).
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "mesh/polygons.hpp"
#include "model/meeting.hpp"

namespace dygita {

class Rings {
 public:
  Rings(const Problem& problem, const std::vector<std::optional<Meeting>>& meetings);

  // At x, are both sides of an interface joined by ties that hold in all steps and come before it? Contact, which may
  // open, leaves a point to ties, never a tie to it. Empty: nowhere.
  std::function<bool(const Vec3&)> closed_by(int i) const;

 private:
  struct Entry {
    int interface;
    std::vector<Polygon> polygons;
    double tolerance;  // m
    Vec3 low, high;
  };

  void add(int i, const Face& face, const std::vector<Facet>& facets);
  bool are_joined_around(int i, const CyclicSymmetry& cyclic, const Vec3& x) const;
  bool are_joined(int i, const std::vector<const Entry*>& by, const Vec3& x) const;
  // What holds in all steps before what does not; of two that do the larger, of those as large the first by the names
  // of what it joins: in whatever order they are declared, and wherever the assembly stands.
  bool comes_before(int i, int j) const;
  static bool has(const Entry& entry, const Vec3& x);

  const Problem& problem_;
  std::vector<Entry> entries_;  // side after side of the interfaces, in their order
  std::set<int> holding_;       // ties in all steps
  std::set<int> matching_;      // node for node
  std::vector<double> areas_;   // m^2, of each interface: of the larger of both sides
};

}  // namespace dygita

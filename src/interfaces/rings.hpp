// Bodies that are joined in a ring around a line: which of the ties would close it (manual, eq. J5).
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "mesh/polygons.hpp"
#include "model/meeting.hpp"

namespace dygita {

// Do both answer alike, whatever is asked?
bool is_alike(const Law& a, const Law& b);
// The same of pressure: where both have friction, it may be another.
bool press_alike(const Law& a, const Law& b);

// Does some load act on it? It is then a law of its own, never part of a group nor one with its neighbours.
bool has_load(const Problem& problem, const Interface* interface);

class Rings {
 public:
  Rings(const Problem& problem, const std::vector<std::optional<Meeting>>& meetings);

  // At x, are both sides of an interface joined by ties that hold in all steps and come before it? Contact, which may
  // open, leaves a point to ties, never a tie to it; and to ties with one contact that presses as it does, of stiffer
  // bodies or larger, which opens as it would. Empty: nowhere.
  std::function<bool(const Vec3&)> closed_by(int i) const;

 private:
  struct Entry {
    int interface;
    std::vector<Polygon> polygons;  // what the sides have in common
    PolygonGrid grid;               // of these
    double tolerance;               // m, a share of the shortest edge
    Vec3 low, high;
  };

  // A side of an interface; null: the other one covers all of it.
  // reach: how far apart both may be, m.
  void add(int i, const PlacedFace& own, const PlacedFace* covering, double reach);
  bool are_joined_around(int i, const CyclicSymmetry& cyclic, const Vec3& x) const;
  bool are_joined(int i, const std::vector<const Entry*>& by, const Vec3& x) const;
  bool is_asked(int i, int j) const;  // may what i joins take a point off j?
  // What holds in all steps before what does not; of two that do those of cuts last, then those whose nodes meet, which
  // give up no point, then the one whose softer body is the stiffer by decades, then the larger, then the first by the
  // names of what it joins: in whatever order they are declared, and wherever the assembly stands.
  bool comes_before(int i, int j) const;
  bool is_stronger(int i, int j) const;
  bool are_contacts_of_one_kind(int i, int j) const;
  double decade(int i) const;                         // of its modulus
  double tolerance(const Entry& entry, int i) const;  // m, for points of i
  static bool has(const Entry& entry, const Vec3& x, double tolerance);

  const Problem& problem_;
  std::vector<Entry> entries_;  // side after side of the interfaces, in their order
  std::set<int> holding_;       // ties in all steps
  std::set<int> matching_;      // node for node
  std::vector<double> areas_;   // m^2, of each interface: of the larger of both sides
  std::vector<double> moduli_;  // Pa, of each interface: shear modulus of the softer side
  std::vector<double> near_;    // m, of each interface: the smaller tolerance of its sides
};

}  // namespace dygita

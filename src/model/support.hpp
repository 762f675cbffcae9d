// A kind of support: every duty that checks, solvers and records have of one.
//
// Each kind is one file in supports/, which ends with its entry in the table of supports; nothing else names it. Every
// duty is pure virtual: a kind that forgets one does not compile.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "law/law_fwd.hpp"

namespace dygita {

// Along the normals of the faces, or along axes x, y and z.
struct Directions {
  bool along_normals = false;
  std::array<bool, 3> axes{};

  static const Directions none, normal, all;
  bool operator==(const Directions&) const = default;
};
inline constexpr Directions Directions::none{};
inline constexpr Directions Directions::normal{.along_normals = true};
inline constexpr Directions Directions::all{.axes = {true, true, true}};

struct SpringAlong {
  double stiffness = 0.0, damping = 0.0;  // N/m, N s/m; about an axis N m, N m s
};

class SupportKind {
 public:
  virtual ~SupportKind() = default;

  // The word of the deck: support.<word>.
  virtual std::string word() const = 0;
  // Can it be on a region, which has neither normal nor area?
  virtual bool takes_regions() const = 0;
  // Directions that it holds rigidly in steps of this kind: they leave the unknowns.
  virtual Directions holds(bool is_static) const = 0;
  // Directions in which no load may prescribe the motion of what it is on.
  virtual Directions claims() const = 0;
  // Does it let waves out in dynamic steps, and keep the reactions that it had in static ones?
  virtual bool absorbs() const = 0;
  // What acts between it, as side 2, and the faces that it is on; null: nothing of the kind.
  virtual LawPtr law() const = 0;
  // Axes along which a weighted sum of the motions of its places is held; none: each place is held by itself.
  virtual Directions sums() const = 0;
  // What holds a sum along an axis (0, 1, 2), or a rotation about it (3, 4, 5); nothing: the sum is zero.
  virtual std::optional<SpringAlong> spring(int axis) const = 0;

  // Can it be shaken? Then it holds something where there is time.
  bool can_be_shaken() const { return holds(false) != Directions::none; }
};
using SupportKindPtr = std::shared_ptr<const SupportKind>;

// The law along the normal of a point of this area (m^2).
LawPtr law_of_spring(const SpringAlong& spring, double area);

// A kind of the table: its word, the numbers that it takes, all of them, and how it is made of them.
struct SupportEntry {
  std::string word;
  std::vector<std::string> arguments;
  SupportKindPtr (*make)(const LawArguments& arguments);
};

template <class T>
SupportKindPtr new_support(const LawArguments&) {
  return std::make_shared<const T>();
}

// Every kind there is: one entry for each file of supports/, in the order of their names. CMake writes this function.
const std::vector<SupportEntry>& support_table();

// A kind of an entry with every argument 1, to ask what holds for all of them.
SupportKindPtr example_of(const SupportEntry& entry);

// The kind of a word; CHECKs that there is one, and that the arguments are those it takes.
SupportKindPtr make_support(const std::string& word, const LawArguments& arguments = {});

}  // namespace dygita

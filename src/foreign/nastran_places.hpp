// Where the nodes of a Nastran file are, through the coordinate systems in which it gives them.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "foreign/bulk_cards.hpp"
#include "numerics/types.hpp"

namespace dygita {

struct NastranSystem {
  char kind = 'R';  // R, C, S
  Vec3 origin = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // columns

  Vec3 place(const Vec3& coordinates) const;  // angles in degrees
  // Its directions at a place: of C around the axis 3, of S also down from it.
  Mat3 axes_at(const Vec3& x) const;
};

struct NastranGrid {
  const BulkCard* card;
  long number, place_system, motion_system;  // CP, CD
  std::string held;                          // PS
  Vec3 x = Vec3::Zero();                     // in the units of the file
  enum class State { new_, busy, placed } state = State::new_;
};

class NastranPlaces {
 public:
  // Throws InputError: a number given twice, a system that is missing, flat, or defined by itself.
  explicit NastranPlaces(const BulkFile& file);

  const std::vector<NastranGrid>& grids() const { return grids_; }
  // Index among them; -1 where there is none.
  int index_of(long number) const;
  // System 0 is the file's own.
  const NastranSystem& system(long number, const BulkCard& asked);

 private:
  struct Given {
    const BulkCard* card = nullptr;
    int first = 1;  // field of its number
    bool is_made = false, is_busy = false;
    NastranSystem system = {};
  };
  void note_systems();
  void note_grids();
  void make(long number, Given& given);
  const Vec3& place(size_t grid, const BulkCard& asked);
  Vec3 point_of_node(long number, const BulkCard& asked);

  const BulkFile& file_;
  std::vector<NastranGrid> grids_;
  std::unordered_map<long, int> index_;
  std::unordered_map<long, Given> systems_;
  NastranSystem own_;
  int depth_ = 0;
};

}  // namespace dygita

#include "latin/piece_loops.hpp"

#include <algorithm>

#include "ranks/ranks.hpp"

namespace dygita {

PieceLoops::PieceLoops(const StepModel& model)
    : model_(model), largest_first_(model.here), seconds_(ranks::is_alone() ? 0 : model.pieces.size()) {
  std::stable_sort(largest_first_.begin(), largest_first_.end(), [&](int a, int b) {
    return model.pieces[a]->node_masses().size() > model.pieces[b]->node_masses().size();
  });
}

PieceLoops::InTurn PieceLoops::in_turn(const std::vector<int>& border) const {
  InTurn turns;
  for (const int i : largest_first_)
    (std::find(border.begin(), border.end(), i) != border.end() ? turns.border : turns.interior).push_back(i);
  return turns;
}

}  // namespace dygita

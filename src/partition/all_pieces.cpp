#include "partition/all_pieces.hpp"

namespace dygita {

ranks::Segments segments_of(const Cut& cut, const std::vector<int>& n_of) {
  std::vector<int> owner, offset{0};
  for (int i = 0; i < cut.n_pieces(); ++i) {
    owner.push_back(cut.piece(i).rank);
    offset.push_back(offset.back() + n_of[static_cast<size_t>(i)]);
  }
  return {owner, offset};
}

}  // namespace dygita

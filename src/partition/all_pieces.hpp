// What each rank computes of its own pieces, known on all of them.
#pragma once

#include "partition/cut.hpp"

namespace dygita {

// n_of: numbers of each piece, one after the other; whose `complete` fills in those of the pieces elsewhere.
ranks::Segments segments_of(const Cut& cut, const std::vector<int>& n_of);

// fill(i, at): writes the n numbers of piece i, where it is here. Returns those of all pieces.
template <class Fill>
std::vector<double> of_all_pieces(const Cut& cut, int n, Fill&& fill) {
  std::vector<double> values(static_cast<size_t>(n) * static_cast<size_t>(cut.n_pieces()), 0.0);
  for (int i = 0; i < cut.n_pieces(); ++i)
    if (cut.is_here(i)) fill(i, values.data() + static_cast<size_t>(n) * static_cast<size_t>(i));
  if (!ranks::is_alone())
    segments_of(cut, std::vector<int>(static_cast<size_t>(cut.n_pieces()), n)).complete(values.data());
  return values;
}

// f(i): a field (3 x n_nodes) of a piece that is here. Returns those of all pieces.
template <class Field>
std::vector<Points> fields_of_all_pieces(const Cut& cut, Field&& f) {
  std::vector<Points> fields;
  std::vector<int> sizes;
  Eigen::Index n = 0;
  for (int i = 0; i < cut.n_pieces(); ++i) {
    fields.push_back(cut.is_here(i) ? Points(f(i)) : Points(3, cut.piece(i).body->mesh->n_nodes()));
    sizes.push_back(static_cast<int>(fields.back().size()));
    n += fields.back().size();
  }
  if (ranks::is_alone()) return fields;
  Vec all(n);
  n = 0;
  for (const Points& field : fields) all.segment(n, field.size()) = field.reshaped(), n += field.size();
  segments_of(cut, sizes).complete(all.data());
  n = 0;
  for (Points& field : fields) field.reshaped() = all.segment(n, field.size()), n += field.size();
  return fields;
}

}  // namespace dygita

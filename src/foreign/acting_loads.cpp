#include "foreign/acting_loads.hpp"

#include <algorithm>
#include <iterator>

namespace dygita {

std::vector<const ActingLoad*> ActingLoads::met_by(const FileAction& action, const std::set<int>& points,
                                                   FileAction::Kind kind) const {
  std::map<size_t, size_t> n_common;
  for (const size_t i : everywhere_) n_common[i] = 0;
  for (const int point : points)
    if (const auto there = at_.find(point); there != at_.end())
      for (const size_t i : there->second) ++n_common[i];
  std::vector<const ActingLoad*> met;
  for (const auto& [i, n] : n_common) {
    const FileAction& one = all_[i].action;
    bool has_common = one.is_on_faces();
    for (size_t d = 0; d < 3; ++d) has_common = has_common || (one.along[d] && action.along[d]);
    if (one.kind == kind && (one.is_everywhere() || (has_common && n > (one.is_on_faces() ? 2u : 0u))))
      met.push_back(&all_[i]);
  }
  return met;
}

void ActingLoads::add(std::vector<ActingLoad> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all_));
  note_points();
}

std::set<std::string> ActingLoads::drop(const std::function<bool(const ActingLoad&)>& which) {
  std::set<std::string> names;
  for (const ActingLoad& one : all_)
    if (which(one)) names.insert(one.name);
  std::erase_if(all_, which);
  note_points();
  return names;
}

void ActingLoads::note_points() {
  at_.clear(), everywhere_.clear();
  for (size_t i = 0; i < all_.size(); ++i) {
    for (const int point : all_[i].points) at_[point].push_back(i);
    if (all_[i].action.is_everywhere()) everywhere_.push_back(i);
  }
}

}  // namespace dygita

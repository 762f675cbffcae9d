// What acts in a file from step to step, until a step says something else of the same place.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "foreign/file_actions.hpp"

namespace dygita {

struct ActingLoad {
  FileAction action;
  std::string name;      // in the deck
  std::set<int> points;  // nodes, or corners of facets; none where it is everywhere
};

class ActingLoads {
 public:
  const std::vector<ActingLoad>& all() const { return all_; }
  // Of this kind, those that an action on these points meets: along a common axis, or on faces in more than an edge.
  std::vector<const ActingLoad*> met_by(const FileAction& action, const std::set<int>& points,
                                        FileAction::Kind kind) const;
  void add(std::vector<ActingLoad> more);
  // Their names.
  std::set<std::string> drop(const std::function<bool(const ActingLoad&)>& which);

 private:
  void note_points();

  std::vector<ActingLoad> all_;
  std::map<int, std::vector<size_t>> at_;  // of each point what acts there
  std::vector<size_t> everywhere_;
};

}  // namespace dygita

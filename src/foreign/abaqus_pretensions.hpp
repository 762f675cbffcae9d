// *PRE-TENSION SECTION: surfaces inside parts, across which a force or a shortening of a node of the card acts.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "foreign/abaqus_model.hpp"
#include "foreign/file_actions.hpp"

namespace dygita {

class AbaqusPretensions {
 public:
  // Of all cards of the model; what cannot be read is told by finish.
  explicit AbaqusPretensions(AbaqusModel& model);

  // A line of *CLOAD or *BOUNDARY on directions from ... to of these nodes: false where none of them is of a card. The
  // action has its place and its value then; none where nothing is moved. Throws InputError with the line.
  bool read(const PlacedCard& placed, const DataLine& line, const std::vector<int>& nodes,
            std::pair<long, long> directions, double by, std::optional<FileAction>& action) const;
  // Surfaces by which parts are cut, and what is told.
  void finish(std::vector<std::string>& surfaces, std::vector<std::string>& untranslated);

 private:
  struct Section {
    std::string surface;
    double sign;  // of a force that pulls
  };
  void add(const PlacedCard& placed);
  double sign_of(const FileCard& card, const ForeignFace& surface, const Vec3& normal) const;

  AbaqusModel& model_;
  const CardFile& file_;
  std::map<int, Section> of_node_;
  std::vector<std::string> untranslated_;
};

}  // namespace dygita

// SPC, SPC1, SPCADD and the permanent supports of GRID: by the directions in which nodes are held.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "foreign/file_actions.hpp"
#include "foreign/nastran_spiders.hpp"

namespace dygita {

class NastranSupports {
 public:
  NastranSupports(NastranModel& model, std::vector<NastranSpider>& spiders);

  void add_permanent();
  // With what the set holds and moves; one action for nodes of the same directions. `untranslated`: what no deck says.
  std::vector<FileAction> of_set(long set, std::vector<std::string>& untranslated);

 private:
  struct Held {
    std::array<bool, 6> along = {};
    Vec3 by = Vec3::Zero();  // in the axes of the node
    const BulkCard* card = nullptr;
    std::array<const BulkCard*, 6> cards = {};  // that said so of each direction
  };
  void add_card(const BulkCard& card);
  void hold(int node, const std::string& components, double by, const BulkCard& card, const BulkFields& fields);
  void pass_on_to_feet(std::vector<std::string>& untranslated);
  // In the file's axes. Throws InputError where its own point elsewhere.
  FileAction action_of(int node, const Held& held);

  NastranModel& model_;
  std::vector<NastranSpider>& spiders_;
  std::set<int> of_cells_;
  std::map<int, Held> held_;
};

// Nodes of cells.
std::set<int> nodes_of_cells(const ForeignModel& model);

// "spc1 45": the set of nodes of that name is added to the model.
std::string add_place(ForeignModel& model, const BulkCard& card, std::vector<int> nodes);

}  // namespace dygita

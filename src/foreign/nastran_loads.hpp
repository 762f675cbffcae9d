// FORCE, FORCE1, PLOAD4, GRAV and their sums by LOAD.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "foreign/file_actions.hpp"
#include "foreign/nastran_spiders.hpp"

namespace dygita {

class NastranLoads {
 public:
  NastranLoads(NastranModel& model, std::vector<NastranSpider>& spiders);

  // `untranslated`: what no deck says.
  std::vector<FileAction> of_set(long set, std::vector<std::string>& untranslated);

 private:
  struct Loaded {
    Vec3 force = Vec3::Zero();
    const BulkCard* card = nullptr;
  };
  std::map<long, double> factors_of(long set) const;
  void add_card(const BulkCard& card, double factor);
  void add_force(const BulkCard& card, double factor);
  void add_pressure(const BulkCard& card, double factor);
  void add_gravity(const BulkCard& card, double factor);
  void pass_on_to_feet(std::vector<std::string>& untranslated);
  std::vector<FileAction> actions();

  NastranModel& model_;
  std::vector<NastranSpider>& spiders_;
  std::set<int> of_cells_;
  std::map<int, Loaded> forces_;
  using Says = std::array<double, 4>;  // a traction, and a pressure
  struct Pressed {
    ForeignFacet facet;
    Says says;
    const BulkCard* card;  // the first
  };
  struct PressedAlike {
    std::vector<ForeignFacet> facets;
    const BulkCard* card = nullptr;
  };
  std::map<Says, PressedAlike> pressed_alike() const;
  std::map<std::pair<int, std::array<int, 4>>, Pressed> pressures_;  // by the facet: cell and corners, sorted
  Vec3 gravity_ = Vec3::Zero();
  const BulkCard* of_gravity_ = nullptr;
};

}  // namespace dygita

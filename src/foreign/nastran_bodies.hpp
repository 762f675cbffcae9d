// CONM2 behind the nodes of an RBE2 or RBE3, and CBUSH and CELAS1, CELAS2 as springs.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "foreign/file_actions.hpp"
#include "foreign/nastran_spiders.hpp"

namespace dygita {

class NastranBodies {
 public:
  // said: cards that have become a body or a spring.
  NastranBodies(NastranModel& model, std::vector<NastranSpider>& spiders, std::set<const BulkCard*>& said);

  // Of a spider that nothing else has said; nothing where no mass is on its centre. Throws InputError with the card.
  void add_body(NastranSpider& spider);
  // Of a card CBUSH, CELAS1 or CELAS2. Throws InputError with it.
  void add_spring(const BulkCard& card);

  std::vector<FileBody> bodies;
  std::vector<FileSpring> springs;
  std::vector<std::string> remarks;

 private:
  struct End {
    std::string place;
    Vec3 x;
    bool turns;  // it is the mean of several nodes
  };
  Vec3 place_of(int node) const { return model_.places().grids()[static_cast<size_t>(node)].x; }
  Vec3 middle_of(const std::vector<int>& nodes) const;
  double size_of(const std::vector<int>& nodes) const;
  Mat3 inertia_of(const BulkFields& fields) const;
  End end_at(int node, const BulkCard& card, const BulkFields& fields);
  Mat3 axes_of_bushing(const BulkCard& card, const BulkFields& fields, const FileSpring& spring) const;
  void add_bushing(const BulkCard& card, const BulkFields& fields);
  void add_scalar(const BulkCard& card, const BulkFields& fields);
  const BulkCard& property(const char* name, long number, const BulkFields& fields) const;

  NastranModel& model_;
  std::vector<NastranSpider>& spiders_;
  std::set<const BulkCard*>& said_;
  std::set<int> of_cells_;
};

}  // namespace dygita

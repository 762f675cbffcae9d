// A Nastran file with its numbers and names: what the reader of meshes and the translator of decks have in common.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "foreign/bulk_cards.hpp"
#include "foreign/foreign_model.hpp"
#include "foreign/nastran_names.hpp"
#include "foreign/nastran_places.hpp"

namespace dygita {

struct NastranOptions {
  std::string file;
  double unit = 1.0;              // m
  std::vector<std::string> skip;  // types of elements that are left out
};

// A line of the case control, without comments, its continuations joined.
struct ControlLine {
  std::string text;  // capitals
  std::string where;
};

class NastranModel {
 public:
  // Reads nodes, cells, sets, properties and materials. Throws InputError with file, line and card.
  explicit NastranModel(const NastranOptions& options);

  const BulkFile& file() const { return file_; }
  const std::vector<ControlLine>& control() const { return control_; }
  ForeignModel& model() { return model_; }
  const ForeignModel& model() const { return model_; }
  NastranPlaces& places() { return places_; }
  // By which the file multiplies its masses: PARAM, WTMASS.
  double mass_factor() const { return mass_factor_; }
  // Is it a type of elements that is left out as the user asked?
  bool is_skipped(std::string_view type) const;

  // Index in the model. Throws InputError where there is none.
  int node(long number, const BulkFields& asked) const;
  // -1: an element that is no cell.
  int cell(long number, const BulkFields& asked) const;
  // Nodes of ranges of numbers; of a range those that there are.
  std::vector<int> nodes(const std::vector<std::array<long, 3>>& ranges, const BulkFields& asked) const;
  // The facet of a cell with the corner g1 and, opposite on a quadrilateral or left out by a tetrahedron's, g34 (0:
  // none).
  ForeignFacet facet(int cell, long g1, long g34, const BulkFields& asked) const;

 private:
  void read_control();
  void read_parameters();
  void read_properties();
  void read_cells();
  void add_cell(const BulkCard& card);
  void leave_out(const BulkCard& card);
  void tell_left_out();
  int group_of(long property);
  void read_sets();
  void add_range(const std::array<long, 3>& range, std::vector<int>& nodes) const;
  void read_control_set(const ControlLine& line);
  void add_set(long number, const std::vector<std::array<long, 3>>& ranges, const BulkFields& asked);
  void list_unused();

  NastranOptions options_;
  BulkFile file_;
  NastranNames names_;
  NastranPlaces places_;
  std::vector<ControlLine> control_;
  ForeignModel model_;
  std::unordered_map<long, int> cells_;
  std::unordered_map<long, int> groups_;  // by the number of the property
  std::map<std::string, int> n_left_out_;
  std::map<long, std::string> material_names_;
  double mass_factor_ = 1.0;
};

struct NastranMaterial {
  long number;
  ForeignMaterial material;
};
// MAT1, MAT9 and MAT11, their densities times `mass_factor`; `told`: what of them is not used.
std::vector<NastranMaterial> nastran_materials(const BulkFile& file, const NastranNames& names, double mass_factor,
                                               std::vector<std::string>& told);

// "flange", or "flange (PSOLID 4)" where there is a flange already; "PSOLID 4" of a number without a name.
std::string unique_name(const std::map<long, std::string>& names, long number, const std::string& card,
                        std::vector<std::string>& taken);

}  // namespace dygita

// An .inp with its numbers and names: what the reader of meshes and the translator of decks have in common.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "foreign/cards.hpp"
#include "foreign/foreign_model.hpp"

namespace dygita {

struct AbaqusCell;

struct AbaqusSet {
  std::string name;        // as the file writes it first
  std::vector<int> items;  // nodes, or cells, of the model; each once
};

// Numbers and names of an instance, or of the file itself.
struct AbaqusScope {
  std::string instance;                                   // empty: the file
  std::unordered_map<long, int> nodes, cells;             // a cell of -1: an element that is no cell
  std::map<std::string, AbaqusSet> node_sets, cell_sets;  // by their names in capitals
};

struct PlacedCard {
  const FileCard* card;
  AbaqusScope* scope;
};

struct AbaqusOptions {
  std::string file;
  double unit = 1.0;              // m
  std::vector<std::string> skip;  // types of elements that are left out
};

class AbaqusModel {
 public:
  // Reads nodes, cells, sets, surfaces, sections and materials. Throws InputError with file and line.
  explicit AbaqusModel(const AbaqusOptions& options);

  const CardFile& file() const { return file_; }
  const std::vector<PlacedCard>& cards() const { return placed_; }
  ForeignModel& model() { return model_; }
  double unit() const { return options_.unit; }  // m

  // Nodes, or cells, of a field: a number, the name of a set, "instance.name". Throws InputError where it is none;
  // numbers of elements that are no cells answer nothing.
  std::vector<int> nodes_of(const AbaqusScope& scope, const LineFields& fields, std::string_view field) const;
  std::vector<int> cells_of(const AbaqusScope& scope, const LineFields& fields, std::string_view field) const;
  // Facets of cells by a label, "S3" or "P3"; without one those on the outside of all of them.
  std::vector<ForeignFacet> facets_of(const std::vector<int>& cells, std::string_view label,
                                      const DataLine& line) const;
  // The scope that a card's INSTANCE names, else its own.
  AbaqusScope& scope_of(const PlacedCard& placed);

 private:
  using Place = std::function<Vec3(const Vec3&)>;  // of a node, in the file's unit
  using Kind = std::map<std::string, AbaqusSet> AbaqusScope::*;

  void place_cards();
  void place_instance(const std::vector<FileCard>& cards, size_t& i,
                      const std::map<std::string, std::vector<const FileCard*>>& parts);
  void read_meshes();
  void read_nodes(const PlacedCard& placed, const Place& system);
  void read_elements(const PlacedCard& placed);
  bool is_left_out(const PlacedCard& placed, const std::string& type);
  void add_cell(const PlacedCard& placed, const AbaqusCell& cell, const std::vector<long>& numbers,
                const DataLine& first);
  void read_set(const PlacedCard& placed, Kind kind, const char* option);
  void read_range(const PlacedCard& placed, const DataLine& line, Kind kind, std::vector<int>& items);
  void read_surface(const PlacedCard& placed);
  void read_section(const PlacedCard& placed);
  void finish_sets();
  void group_the_rest();
  void name_groups();
  void list_unused();
  std::vector<int> found(const AbaqusScope& scope, const LineFields& fields, std::string_view field,
                         bool is_node) const;

  AbaqusOptions options_;
  CardFile file_;
  ForeignModel model_;
  std::map<std::string, AbaqusScope> scopes_;  // by the instance in capitals
  std::map<std::string, Place> places_;        // of instances
  std::vector<PlacedCard> placed_;
  std::map<std::string, int> n_by_type_, n_left_out_;
  std::vector<std::pair<AbaqusScope*, std::string>> element_sets_;  // of each cell, where it is declared
  std::vector<int> element_set_of_cell_;
};

// The materials of the cards, and the keywords that they have used (in capitals).
std::vector<ForeignMaterial> abaqus_materials(const CardFile& file);

}  // namespace dygita

// A deck that says what a file of another program says, whichever it is: parts with their materials and welds, supports
// and loads, problems; with a comment by line for what no deck says.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <map>
#include <string>
#include <vector>

#include "foreign/file_actions.hpp"
#include "foreign/file_units.hpp"
#include "foreign/foreign_model.hpp"
#include "foreign/lua_text.hpp"

namespace dygita {

struct ImportOptions {
  std::string file;               // .inp, .bdf, .nas, .dat
  std::string units = "mm t s";   // of the file
  std::vector<std::string> skip;  // types of elements that are left out
};

// Lua, of the program that the end of the file's name tells. What no deck says stands as comments, and as an error(...)
// that stops the deck until its reader deletes it. Throws InputError where the file cannot be read.
std::string imported_deck(const ImportOptions& options);

class ImportedDeck {
 public:
  virtual ~ImportedDeck() = default;

 protected:
  // word: "mesh.abaqus".
  ImportedDeck(const ImportOptions& options, ForeignModel& model, const char* word);

  // ", orientation = ..." of a group that has one.
  virtual std::string orientation_of(const ForeignGroup& group) = 0;
  virtual std::string value_of(double value, const char* unit, const FileAction& action);

  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    body_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }
  void leave(const std::string& what);
  // Parts that these surfaces divide become two, joined by a bond that is tightened.
  void cut_parts(const std::vector<std::string>& surfaces);
  void write_parts(bool needs_density);
  // Parts that share the nodes of facets in the file are one body there.
  void write_welds();
  // A mass on a face.
  void put_body(const FileBody& body);
  // Its name in the deck; empty where no deck says it.
  std::string put_spring(const FileSpring& spring, size_t number);
  void add(const std::vector<FileAction>& actions, std::vector<std::string>& supports, std::vector<std::string>& loads);
  void write_problem(const std::string& name, const std::vector<std::string>& supports,
                     const std::vector<std::string>& steps, const std::string& output);
  // Frames of modes are called by their output, and none as those of the problem itself.
  static std::string modes_of(const std::string& problem, const std::string& asked);
  std::string head() const;

  // "part_a:face "TOP"" of each part that has it; of "I1.TOP" those of the instance I1.
  std::vector<std::string> places(const std::string& given, bool is_face) const;
  // The part that has all nodes of a set, `preferred` if it is one; -1: none.
  int part_with(const std::string& place, int preferred = -1) const;
  std::string known_face(const std::string& name) const;
  std::vector<int> nodes_in(const std::string& place) const;  // of a set

  const ImportOptions& options_;
  ForeignModel& model_;
  std::vector<ForeignPart> parts_;
  std::vector<std::string> remarks_, untranslated_;
  LuaNames names_;
  std::vector<std::string> part_names_, interfaces_;
  std::string body_;

 private:
  std::string material_of(const ForeignGroup& group, bool needs_density);
  std::string mesh_of(const ForeignPart& part);
  void note_tightened(const ForeignPart& part, int n_facets, const std::string& weld);
  void put_tightening(const FileAction& action, std::vector<std::string>& loads);
  std::pair<size_t, int> shared(const ForeignPart& one, const ForeignPart& other) const;
  // A place has one support: directions in which several lines hold it come together, with those held before.
  std::vector<FileAction> merged(const std::vector<FileAction>& actions, std::vector<std::string>& supports);
  bool is_whole_face(const FileBody& body) const;
  int n_nodes_of(const std::string& place) const;
  static std::string spin_of(const FileAction& action);
  std::string text_of(const FileAction& action, const std::string& on, const std::string& name);

  FileUnits units_;
  const char* word_;
  std::map<std::string, size_t> numbers_of_sets_;  // of nodes, by name
  std::map<std::string, std::string> materials_;
  std::map<std::string, bool> is_directed_;
  std::vector<std::string> surfaces_to_tighten_;
  std::string halves_;                            // the list of those written last
  std::map<std::string, std::string> tightened_;  // interfaces by the surface that has cut a part
  std::map<std::string, std::pair<std::vector<int>, std::array<bool, 3>>> held_;  // by the names of supports
};

}  // namespace dygita

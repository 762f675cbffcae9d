// What a Nastran file asks for beside its meshes: cases with their supports and loads, in the units of the file; and
// what it asks for that no deck says.
#pragma once

#include <string>
#include <vector>

#include "foreign/file_actions.hpp"
#include "foreign/nastran_model.hpp"

namespace dygita {

struct NastranCase {
  std::string where, name;  // "joint.bdf:7", "subcase 2"; a file without cases has one
  long supports = 0, loads = 0, method = 0;
  std::vector<FileAction> held, acting;
  std::string modes;  // "n = 10"
};

struct NastranAnalysis {
  enum class Kind { statics, modes, other };
  Kind kind = Kind::statics;
  std::vector<NastranCase> cases;
  std::vector<FileBody> bodies;           // of each case
  std::vector<FileSpring> springs;        // the same
  std::vector<std::string> remarks;       // what is said otherwise
  std::vector<std::string> untranslated;  // "joint.bdf:45: CELAS2: ..."
};

// Nodes and facets that cards list become sets of the model, called by the card and the line of the first of them:
// "spc1 45". What cannot be read is untranslated, and no error.
NastranAnalysis analysis_of(NastranModel& model);

// SOL, SUBCASE, SPC, LOAD, METHOD: the cases without what they choose.
void read_case_control(const NastranModel& model, NastranAnalysis& analysis);

}  // namespace dygita

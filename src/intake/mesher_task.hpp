// What the mesher, a program of its own, is asked, and what it answers: bytes through pipes.
//
// Files from strangers make gmsh run programs, write files, hang and crash. It therefore runs apart, without the right
// to do either, and nothing it answers is believed before it is checked.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "intake/gmsh_reader.hpp"
#include "intake/step_assembly.hpp"
#include "intake/tagged_model.hpp"

namespace dygita {

struct MesherTask {
  std::variant<GmshOptions, StepOptions> options;
  std::string path;                     // what gmsh opens: the file, or a script that includes it
  double memory_limit = 0.0;            // bytes; 0: none
  bool is_trusted = false;              // by the user: may do whatever the user may
  std::vector<std::string> readable{};  // folders and files that may be read besides the system's own
};

// A solid that is another one, turned and moved: x = turn x0 + shift, m.
struct SolidCopy {
  int of = -1;  // index of the other, which is before it and no copy
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
};

// Before each line on the mesher's standard error that says what it does.
inline constexpr char told_mark = '\x1e';

struct MesherAnswer {
  std::string error;                  // not empty: there is nothing else
  std::vector<std::string> warnings;  // said to the user
  TaggedModel model;
  std::vector<SolidNames> solids;                    // of an assembly, one for each volume of the model
  std::vector<std::optional<SolidCopy>> copies;      // of each of them; a copy has neither cells nor facets
  std::vector<std::vector<TaggedSurface>> surfaces;  // of each of them, called after it: "bolt1.head"
  std::vector<std::string> libraries;                // files that it was made with
};

std::string to_bytes(const MesherTask& task);
std::string to_bytes(const MesherAnswer& answer);

// Throws std::exception where the bytes are no task.
MesherTask task_of(const std::string& bytes);
// Throws InputError where the bytes are no answer, or its mesh no mesh: a cell of a type that is not in the table,
// nodes that are not there or not finite. `file` for messages.
MesherAnswer answer_of(const std::string& bytes, const std::string& file);

}  // namespace dygita

// What a deck holds of the model and of results: one kind of Lua userdata that refers to immutable C++ objects.
#pragma once

#include <lua.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "foreign/foreign_meshes.hpp"
#include "intake/gmsh_reader.hpp"
#include "material/material.hpp"
#include "model/model.hpp"
#include "result/result.hpp"
#include "result/series.hpp"
#include "signal/scan.hpp"

namespace dygita {

// A run of a problem as the deck sees it. Where nothing was solved (dygita check) every value is nan.
struct DeckResult {
  std::shared_ptr<const Problem> problem;
  std::shared_ptr<const RunResult> run;
  bool is_hollow = false;
  std::string case_name = {};
};
using DeckResultPtr = std::shared_ptr<const DeckResult>;

// What members of an ensemble come to (ensembles.hpp).
struct EnsembleResult;
using EnsembleResultPtr = std::shared_ptr<const EnsembleResult>;

// result[output].
struct OutputData {
  DeckResultPtr result;
  OutputPtr output;
  const Table* table = nullptr;    // in *result->run
  EnsembleResultPtr members = {};  // of an ensemble, whose statistics the result has; null: a run's own
  std::string column = {};         // then: the one that the table is of; empty: the first, or none
};

// One number a member.
struct Sample {
  std::string name;  // "bolt.normal.last", for messages
  std::vector<double> values;
};

// ensemble.drives.
struct Drives {
  EnsembleResultPtr of;
};

// result[part].
struct PartData {
  DeckResultPtr result;
  int part = -1;  // index in the problem's substructures
};

using Content =
    std::variant<std::monostate, MeshPtr, std::shared_ptr<const GmshMeshes>, std::shared_ptr<const StepAssembly>,
                 std::shared_ptr<const ForeignMeshes>, std::shared_ptr<const Material>, SubstructurePtr, Face, Region,
                 InterfacePtr, SupportPtr, LoadPtr, std::shared_ptr<const History>, StepPtr,
                 std::shared_ptr<const LatinSettings>, std::shared_ptr<const MonolithicSettings>,
                 std::shared_ptr<const ExplicitSettings>, OutputPtr, std::shared_ptr<const Problem>, DeckResultPtr,
                 OutputData, PartData, std::shared_ptr<const Series>, EnsembleResultPtr, Sample, Drives,
                 std::shared_ptr<const Scan>>;

struct Object {
  std::string kind;  // "substructure", "face", "series"; the schema's `makes`
  std::string path;  // the constructor: "interface.contact"
  std::string name;  // may be empty
  int id = -1;       // in the declaration register; -1: not declared by itself
  Content content;

  template <class T>
  const T& as() const {
    CHECK(std::holds_alternative<T>(content), "the deck object '" + path + "' holds something else");
    return std::get<T>(content);
  }
  // "interface 'shank'", "history.half_sine".
  std::string label() const { return name.empty() ? path : kind + " '" + name + "'"; }
};

// Pushes a new userdata; the table of arguments at index `arguments` (0: none) stays readable from the deck.
void push_object(lua_State* L, Object object, int arguments = 0);

// The object at `index`, or null if it is something else.
Object* object_at(lua_State* L, int index);

// The object at `index`; CHECKs that it is one (the Lua side has checked it).
Object& the_object_at(lua_State* L, int index);

// Registers the metatable; `read` and `write` are the stack indices of Lua functions (object, key), `operators` that of
// a table of metamethods; `length` is one of (object).
void set_object_metatable(lua_State* L, int read, int write, int operators, lua_CFunction length);

}  // namespace dygita

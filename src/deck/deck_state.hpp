// The Lua state of a deck with all that its callbacks need.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/log.hpp"
#include "deck/deck.hpp"
#include "deck/lua_state.hpp"
#include "deck/register.hpp"
#include "foreign/foreign_meshes.hpp"
#include "run/study.hpp"

namespace dygita {

struct DeckState : LuaState {
  DeckState(const DeckOptions& deck_options, const Engine& deck_engine, bool solves);

  static DeckState& of(LuaState& state) { return static_cast<DeckState&>(state); }

  const DeckOptions& options;
  const Engine& engine;
  const bool is_solving;         // false: dygita check
  std::filesystem::path folder;  // the deck's
  std::string deck_digest, deck_text;
  Register declared;
  std::vector<std::pair<std::string, double>> parameters;
  std::set<std::pair<std::string, std::string>> cases;  // problem and case names that ran
  DeckOutcome outcome;
  Study study;
  std::optional<SayAlikeOnce> say_alike_once;  // while members of an ensemble run
  int n_members = 0;                           // of the ensemble at hand that have run, or were checked
  std::shared_ptr<OperatorsOfMembers> shared;  // among them
  std::set<std::string> parameters_read, signals_told;
  std::map<std::shared_ptr<const NamedParts>, std::set<std::string>> parts_taken;  // by the deck, names
  std::vector<std::shared_ptr<const ForeignMeshes>> model_files;
  std::map<MeshPtr, std::map<std::string, std::vector<int>>>
      regions_of_halves;                                         // of meshes of model files that are cut
  std::vector<std::weak_ptr<const Interface>> without_friction;  // contacts for which the deck gives none
  std::vector<std::weak_ptr<Step>> without_dt;                   // dynamic: they get that of their problem
  std::set<std::string> steps_told;
  Origin parameters_origin;
  bool has_parameters = false;   // param{} was called
  bool has_missed_scan = false;  // a place was asked of a scan that has no point there
  bool has_read_hollow = false;  // the deck has read a value that was not computed
};

// Pushes the table of functions that the Lua side calls `native`.
void push_native(DeckState& state);

// problem:run{}: arguments on the stack as in native.call.
int run_from_deck(DeckState& state, lua_State* L);

// run_together(problems, cases, first, line): members of an ensemble after the first, which has run, side by side;
// their results, without fields. Nothing where they cannot: each then runs by itself.
int run_members_together(LuaState& lua, lua_State* L);

}  // namespace dygita

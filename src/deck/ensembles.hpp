// Ensembles as a deck has them: members drawn, compared and, once they have run, what they come to.
#pragma once

#include "deck/lua_state.hpp"
#include "deck/object.hpp"
#include "estimates/ensemble.hpp"

namespace dygita {

// A deck reads statistics of an ensemble of which no member has converged: it ends there, which is no fault of its own.
class NoStatistics : public InputError {
 public:
  using InputError::InputError;
};

struct EnsembleResult {
  Ensemble ensemble;
  std::vector<OutputScatter> scatter;
  std::vector<DeckResultPtr> members;
  DeckResultPtr statistics;  // of the first member's problem: of each output the tables of its columns
};

// What lua/ensembles.lua calls.
//   check_distribution(kind, numbers, line)
int check_distribution(LuaState& state, lua_State* L);
//   draw(method, n, seed, distributions): a list of values a member; the order in which neighbours follow each other
int draw_members(LuaState& state, lua_State* L);
//   call_member(of, values, who): of(values); the message of what it throws ends with who.text, where there is one
int call_member(LuaState& state, lua_State* L);
//   difference_of_members(problem, other): what may not differ, or nothing
int compare_members(LuaState& state, lua_State* L);
//   check_folder(problem, case): refuses a folder that leads elsewhere
int check_folder_of_ensemble(LuaState& state, lua_State* L);
//   let_go(result): of fields and pictures, which only the case that starts from it needs
int let_go_of_fields(LuaState& state, lua_State* L);
//   conclude(ensemble, { case, method, seed, names, rows, members, problems, keeps_members },
//   line): its result, written
int conclude_ensemble(LuaState& state, lua_State* L);

// Is the object an ensemble's result, what drives it, or a sample?
bool is_of_ensemble(const Object& object);
// Pushes what the key at stack index 2 answers for it; its length.
int read_ensemble(lua_State* L, const Object& object, const Origin& origin);
lua_Integer length_in_ensemble(const Object& object, const Origin& origin);
// One number a member, where `key` is last, first, max or min of a column.
bool push_sample(lua_State* L, const OutputData& data, const std::string& key, const Origin& origin);
// sample:quantile(share).
int quantile_of_sample(lua_State* L);

}  // namespace dygita

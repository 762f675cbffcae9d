// One Lua state that runs one deck: limits of time and memory, lines of the deck, and errors that cross between Lua and
// C++ without loss. Link Lua's C++ build only, so that its errors unwind C++ frames as exceptions do.
#pragma once

#include <atomic>
#include <ctime>
#include <exception>
#include <functional>
#include <lua.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/watchdog.hpp"

namespace dygita {

struct LuaLimits {
  double seconds = 60.0;       // in the deck's own code, of the processor or of the clock on the wall
  size_t bytes = 1024u << 20;  // of Lua's memory
};

// A Lua error of the deck itself (syntax, arithmetic on nil, error(), assert()), with file:line.
class DeckScriptError : public InputError {
 public:
  using InputError::InputError;
};

// Thrown through Lua when the user wants to stop (SIGINT): not an error.
class DeckStopped : public std::exception {};

class LuaState {
 public:
  // `deck_name` names the deck in messages ("crush.lua").
  LuaState(std::string deck_name, const LuaLimits& limits);
  ~LuaState();
  LuaState(const LuaState&) = delete;
  LuaState& operator=(const LuaState&) = delete;

  static LuaState& of(lua_State* L) { return **static_cast<LuaState**>(lua_getextraspace(L)); }
  lua_State* raw() const { return L_; }

  // lua_pcall of the function and arguments on the stack. What a callback threw comes out as it was; a Lua error as
  // DeckScriptError; lack of memory or time as InputError that names the limit.
  void call(int n_arguments, int n_results);

  // Compiles `text` and leaves the function on the stack; text only, no precompiled code.
  void load(const std::string& text, const std::string& chunk_name);

  // The deck's line that is being executed, also in a tail call, where Lua itself would name the caller's.
  int line(lua_State* L) const;
  Origin origin(int line) const { return {deck_name_, line}; }
  const std::string& deck_name() const { return deck_name_; }

  // While it lives the deck's clock is stopped and nothing can be declared: the engine or the mesher works.
  class Pause {
   public:
    explicit Pause(LuaState& state);
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    LuaState& state_;
  };
  bool is_paused() const { return is_paused_; }

  // Throws InputError if the deck cannot hold `bytes` more outside Lua's own memory; afterwards they count for as long
  // as `holder` lives.
  void reserve(const std::string& what, size_t bytes);
  void hold_reserved(std::weak_ptr<const void> holder, size_t bytes) {
    outside_.emplace_back(std::move(holder), bytes);
  }

  // Value of the Lua function kept under `reference` at t, called by the engine during a Pause from whichever thread.
  // Throws InputError (with file:line) on a Lua error or a value that is not a finite number.
  double value_of_function(int reference, int declared_at, double t);

  // Throws InputError where the deck has used up its time: after a call that can be long by itself.
  void check_time() const;

  // Keeps the exception while Lua unwinds to `call`.
  void hold(std::exception_ptr exception) { held_ = std::move(exception); }

  // False once the state is being closed: references into it are then void.
  std::shared_ptr<const bool> alive() const { return alive_; }

 private:
  // s of the processor, and elapsed: a busy machine gives a deck little of the first.
  struct Times {
    double processor = 0.0, elapsed = 0.0;
    Times operator+(const Times& o) const { return {processor + o.processor, elapsed + o.elapsed}; }
    Times operator-(const Times& o) const { return {processor - o.processor, elapsed - o.elapsed}; }
  };
  static Times now();
  struct FunctionClock;
  size_t outside_bytes();
  static void* allocate(void* self, void* block, size_t old_size, size_t new_size);
  static void hook(lua_State* L, lua_Debug* event);
  void watch();
  [[noreturn]] void raise(int status);
  InputError out_of_time() const;
  bool is_out_of_time() const;
  Times time_in_deck() const;
  void begin_section();
  bool is_deck(const lua_Debug& frame) const;

  std::string deck_name_, source_;
  LuaLimits limits_;
  lua_State* L_ = nullptr;
  size_t used_bytes_ = 0;
  Times spent_, section_start_;
  std::atomic<int> last_line_ = 0;
  int function_depth_ = 0;
  bool is_paused_ = false;
  std::vector<std::pair<std::weak_ptr<const void>, size_t>> outside_;
  std::exception_ptr held_;
  std::recursive_mutex function_mutex_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  Watchdog watchdog_;  // of what the hook does not stop: one call of C that takes as long as it likes
};

// Wraps a C++ function as a Lua one: what it throws unwinds Lua and comes out of LuaState::call.
template <int (*function)(LuaState&, lua_State*)>
int guarded(lua_State* L) {
  LuaState& state = LuaState::of(L);
  try {
    return function(state, L);
  } catch (const std::exception&) {
    state.hold(interrupt_requested() ? std::make_exception_ptr(DeckStopped()) : std::current_exception());
  }
  lua_pushliteral(L, "C++ exception");
  return lua_error(L);
}

// What Lua's tostring answers for the value at `index`.
std::string to_text(lua_State* L, int index);

}  // namespace dygita

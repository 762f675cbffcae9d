#include "deck/lua_state.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/progress.hpp"
#include "base/thread_time.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

constexpr int hook_period = 1000;                // instructions
constexpr double grace = 2.0;                    // s, that the hook has to end the deck itself
constexpr int exit_code = 2;                     // main's for an InputError
constexpr size_t large_block = size_t{1} << 20;  // bytes

// Gives messages without a place (assert, error with level 0) the deck's line.
int add_place(lua_State* L) {
  const LuaState& state = LuaState::of(L);
  const std::string text = to_text(L, 1);
  if (text.find(state.deck_name() + ":") == 0) return 1;
  lua_pushstring(L, (state.origin(state.line(L)).prefix() + text).c_str());
  return 1;
}

int open_libraries(lua_State* L) {
  luaL_requiref(L, LUA_GNAME, luaopen_base, 1);
  luaL_requiref(L, LUA_TABLIBNAME, luaopen_table, 1);
  luaL_requiref(L, LUA_STRLIBNAME, luaopen_string, 1);
  luaL_requiref(L, LUA_MATHLIBNAME, luaopen_math, 1);
  return 0;
}

}  // namespace

std::string to_text(lua_State* L, int index) {
  size_t length = 0;
  const char* text = luaL_tolstring(L, index, &length);
  std::string copy(text, length);
  lua_pop(L, 1);
  return copy;
}

LuaState::Times LuaState::now() {
  return {thread_seconds(), std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()};
}

LuaState::LuaState(std::string deck_name, const LuaLimits& limits)
    : deck_name_(std::move(deck_name)),
      source_("@" + deck_name_),
      limits_(limits),
      watchdog_([this] { return ranks::is_first() ? std::string(out_of_time().what()) : ""; }, exit_code) {
  L_ = lua_newstate(allocate, this);
  if (!L_) throw InputError("not enough memory for Lua itself (--memory-limit)");
  *static_cast<LuaState**>(lua_getextraspace(L_)) = this;
  begin_section();
  lua_pushcfunction(L_, open_libraries);
  call(0, 0);
  watch();
}

void LuaState::watch() { lua_sethook(L_, hook, LUA_MASKLINE | LUA_MASKRET | LUA_MASKCOUNT, hook_period); }

LuaState::~LuaState() {
  watchdog_.rest();
  *alive_ = false;
  lua_sethook(L_, nullptr, 0, 0);
  lua_close(L_);
}

void* LuaState::allocate(void* self, void* block, size_t old_size, size_t new_size) {
  auto& state = *static_cast<LuaState*>(self);
  if (!block) old_size = 0;  // Lua passes the kind of the new object there
  if (new_size == 0) {
    std::free(block);
    state.used_bytes_ -= old_size;
    return nullptr;
  }
  if (new_size > old_size) {
    if (state.used_bytes_ + (new_size - old_size) > state.limits_.bytes) return nullptr;
    // One call of string.rep can take as long as many instructions: the hook alone would come too late.
    if (new_size > large_block && !state.is_paused_ && state.is_out_of_time()) return nullptr;
  }
  void* grown = std::realloc(block, new_size);
  if (grown) state.used_bytes_ += new_size - old_size;
  return grown;
}

void LuaState::hook(lua_State* L, lua_Debug* event) {
  LuaState& state = of(L);
  if (event->event == LUA_HOOKLINE) {
    lua_getinfo(L, "S", event);
    if (state.is_deck(*event)) state.last_line_ = event->currentline;
  } else if (event->event == LUA_HOOKRET) {
    lua_Debug caller;
    if (!lua_getstack(L, 1, &caller)) return;
    lua_getinfo(L, "Sl", &caller);
    if (state.is_deck(caller) && caller.currentline > 0) state.last_line_ = caller.currentline;
  } else if (event->event == LUA_HOOKCOUNT) {
    // A load asked for while the engine computes answers: the engine stops by itself, and writes what it has.
    if (interrupt_requested() && !state.is_paused_) {
      state.hold(std::make_exception_ptr(DeckStopped()));
    } else if (state.is_out_of_time()) {
      state.hold(std::make_exception_ptr(state.out_of_time()));
    } else {
      return;
    }
    lua_pushliteral(L, "stopped");
    lua_error(L);
  }
}

bool LuaState::is_deck(const lua_Debug& frame) const { return std::strcmp(frame.source, source_.c_str()) == 0; }

int LuaState::line(lua_State* L) const {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "Slt", &frame);
    if (is_deck(frame) && frame.currentline > 0) return frame.currentline;
    if (frame.istailcall) return last_line_;
  }
  return last_line_;
}

// The deck's clock continues. Of several ranks the first has the word before another ends all of them.
void LuaState::begin_section() {
  section_start_ = now();
  watchdog_.expect_end_by(section_start_.elapsed + limits_.seconds - spent_.elapsed +
                          (ranks::is_first() ? 1.0 : 1.5) * grace);
}

LuaState::Times LuaState::time_in_deck() const { return spent_ + (now() - section_start_); }

bool LuaState::is_out_of_time() const {
  const Times times = time_in_deck();
  return std::max(times.processor, times.elapsed) > limits_.seconds;
}

void LuaState::check_time() const {
  if (is_out_of_time()) throw out_of_time();
}

InputError LuaState::out_of_time() const {
  return {origin(last_line_),
          fmt::format("deck code has run for {:g} s and was stopped\n    infinite loop? --time-limit raises the limit",
                      limits_.seconds)};
}

void LuaState::call(int n_arguments, int n_results) {
  const int handler = lua_gettop(L_) - n_arguments;
  lua_pushcfunction(L_, add_place);
  lua_insert(L_, handler);
  const int status = lua_pcall(L_, n_arguments, n_results, handler);
  lua_remove(L_, handler);
  if (status != LUA_OK) raise(status);
}

void LuaState::load(const std::string& text, const std::string& chunk_name) {
  const int status = luaL_loadbufferx(L_, text.data(), text.size(), chunk_name.c_str(), "t");
  if (status != LUA_OK) raise(status);
}

void LuaState::raise(int status) {
  const bool is_text = lua_type(L_, -1) == LUA_TSTRING;
  const std::string message = is_text ? lua_tostring(L_, -1) : fmt::format("error with a {}", luaL_typename(L_, -1));
  lua_pop(L_, 1);
  if (held_) std::rethrow_exception(std::exchange(held_, nullptr));
  if (status == LUA_ERRMEM) {
    if (is_out_of_time()) throw out_of_time();
    throw InputError(origin(last_line_),
                     fmt::format("deck data require more than {:g} MB of memory\n    --memory-limit "
                                 "raises the limit",
                                 static_cast<double>(limits_.bytes) / (1 << 20)));
  }
  throw DeckScriptError(message);
}

size_t LuaState::outside_bytes() {
  std::erase_if(outside_, [](const auto& held) { return held.first.expired(); });
  size_t bytes = 0;
  for (const auto& held : outside_) bytes += held.second;
  return bytes;
}

void LuaState::reserve(const std::string& what, size_t bytes) {
  if (used_bytes_ + outside_bytes() + bytes <= limits_.bytes) return;
  lua_gc(L_, LUA_GCCOLLECT);
  if (used_bytes_ + outside_bytes() + bytes <= limits_.bytes) return;
  constexpr double megabyte = 1 << 20;
  throw InputError(origin(line(L_)), fmt::format("{} take about {:.3g} MB; the limit is {:g} MB\n    --memory-limit "
                                                 "raises the limit",
                                                 what, static_cast<double>(bytes) / megabyte,
                                                 static_cast<double>(limits_.bytes) / megabyte));
}

LuaState::Pause::Pause(LuaState& state) : state_(state) {
  state_.watchdog_.rest();
  state_.spent_ = state_.time_in_deck();
  state_.is_paused_ = true;
  lua_sethook(state_.L_, hook, LUA_MASKCOUNT, hook_period);
}

LuaState::Pause::~Pause() {
  state_.begin_section();
  state_.is_paused_ = false;
  state_.watch();
}

// The deck's clock while the engine asks one of its functions; a function may ask a history, and so another one.
struct LuaState::FunctionClock {
  explicit FunctionClock(LuaState& state) : state_(state) {
    if (state_.function_depth_++ == 0 && state_.is_paused_) state_.begin_section();
  }
  ~FunctionClock() {
    if (--state_.function_depth_ != 0 || !state_.is_paused_) return;
    state_.watchdog_.rest();
    state_.spent_ = state_.time_in_deck();
  }
  FunctionClock(const FunctionClock&) = delete;
  FunctionClock& operator=(const FunctionClock&) = delete;
  LuaState& state_;
};

double LuaState::value_of_function(int reference, int declared_at, double t) {
  // The engine may ask from several threads; the deck's clock runs while its code does.
  const std::scoped_lock lock(function_mutex_);
  const FunctionClock clock(*this);
  lua_rawgeti(L_, LUA_REGISTRYINDEX, reference);
  lua_pushnumber(L_, t);
  call(1, 1);
  const bool is_number = lua_type(L_, -1) == LUA_TNUMBER;
  const double value = is_number ? lua_tonumber(L_, -1) : 0.0;
  const std::string answer = is_number ? fmt::format("{:g}", value) : luaL_typename(L_, -1);
  lua_pop(L_, 1);
  if (is_number && std::isfinite(value)) return value;
  throw InputError(origin(declared_at), fmt::format("the function of time declared here returns {} at t = {:g} s\n"
                                                    "    it must return a finite number at every time",
                                                    answer, t));
}

}  // namespace dygita

// The deck's surroundings: strict, closed, limited.
#include <gtest/gtest.h>

#include <chrono>

#include "deck/fake_engine.hpp"
#include "model/load.hpp"

namespace dygita::test::environment_tests {

namespace {

std::string message_with_limits(const std::string& text, double seconds, double megabytes) {
  const Folder folder;
  FakeEngine fake;
  DeckOptions options;
  options.path = folder.write("deck.lua", text);
  options.time_limit = seconds;
  options.memory_limit = megabytes;
  try {
    run_deck(options, fake.engine());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Environment, has_what_a_deck_needs) {
  EXPECT_EQ(message_of(R"(
    local total = 0
    for i, x in ipairs { 1, 2, 3 } do total = total + x * i end
    for name, x in pairs { a = 1 } do total = total + x end
    assert(total == 15 and select("#", 1, 2) == 2 and next({}) == nil)
    assert(tostring(3) == "3" and tonumber("4") == 4 and type({}) == "table")
    assert(("%.1f"):format(math.sqrt(2)) == "1.4" and ("bolt_12"):match("^(%a+)_(%d+)$") == "bolt")
    assert(table.concat({ "a", "b" }, "-") == "a-b" and ("x"):rep(3) == "xxx")
  )"),
            "");
}

// MPI ranks read the deck side by side: what it declares in this order they number alike.
TEST(Environment, goes_through_tables_in_one_order) {
  EXPECT_EQ(message_of(R"(
    local order, t = {}, { "x", "y", zinc = 1, 20.5, [100] = 2, [-1] = 0, copper = 3, [true] = 4, [false] = 5, ["10"] = 6 }
    for key in pairs(t) do order[#order + 1] = tostring(key) end
    assert(table.concat(order, " ") == "-1 1 2 3 100 10 copper zinc false true", table.concat(order, " "))
    local sum = 0
    for key, value in pairs(t) do
      t.zinc = nil
      if key == "zinc" then sum = sum + 1000 end
      if type(value) == "number" then sum = sum + value end
    end
    assert(sum == 20.5 + 2 + 0 + 3 + 4 + 5 + 6, tostring(sum))
    local f, state, first = pairs({ a = 7 })
    local key, value = f(state, first)
    assert(key == "a" and value == 7 and f(state, key) == nil)
  )"),
            "");
}

TEST(Environment, has_nothing_that_reaches_out) {
  for (const std::string name :
       {"os", "io", "package", "debug", "loadstring", "dofile", "loadfile", "require", "collectgarbage", "setmetatable",
        "getmetatable", "rawget", "rawset", "pcall", "xpcall", "coroutine", "_G"}) {
    EXPECT_TRUE(contains(message_of("local x = " + name), "deck.lua:1: '" + name + "'")) << name;
  }
}

TEST(Environment, cannot_be_changed) {
  EXPECT_TRUE(contains(message_of("print = 3"), "deck.lua:1: 'print' is a word of the deck"));
  EXPECT_TRUE(contains(message_of("_ENV.x = 3"), "deck.lua:1: 'x' is assigned and not declared"));
  EXPECT_TRUE(contains(message_of("string.format = nil"), "deck.lua:1: string.format cannot be changed"));
  EXPECT_TRUE(contains(message_of("math.pi = 3"), "deck.lua:1: math.pi cannot be changed"));
  EXPECT_EQ(message_of("for f in pairs(string) do end\nlocal f, t = pairs(math)\nt.pi = 3\nassert(math.pi > 3.1)"), "");
}

TEST(Environment, does_not_take_a_text_for_a_number) {
  EXPECT_TRUE(contains(message_of("local x = \"10\" * mm"), "deck.lua:1: attempt to perform arithmetic on a string"));
}

TEST(Environment, takes_no_precompiled_code) {
  EXPECT_TRUE(contains(message_of("\x1bLua"), "attempt to load a binary chunk"));
}

TEST(Environment, gives_the_same_random_numbers_in_every_run) {
  FakeEngine first, second;
  const std::string text =
      std::string("local p = param{ x = math.random() }") + two_blocks +
      "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, "
      "steps = { hold } }:run{}";
  run_text(text, first);
  run_text(text, second);
  EXPECT_EQ(first.requests.at(0).identity.parameters, second.requests.at(0).identity.parameters);
}

TEST(TimeLimit, stops_an_infinite_loop) {
  const std::string message = message_with_limits("local n = 0\nwhile true do\n  n = n + 1\nend", 0.2, 100);
  EXPECT_TRUE(contains(message, "deck code has run for 0.2 s and was stopped")) << message;
  EXPECT_TRUE(contains(message, "--time-limit")) << message;
  EXPECT_TRUE(contains(message, "deck.lua:3:") || contains(message, "deck.lua:2:")) << message;
}

TEST(TimeLimit, stops_a_loop_that_is_short_of_lines_and_long_of_work) {
  const std::string message = message_with_limits("while true do local s = ('x'):rep(50000000) end", 0.2, 200);
  EXPECT_TRUE(contains(message, "deck code has run for 0.2 s")) << message;
}

TEST(TimeLimit, does_not_count_what_the_engine_takes) {
  const Folder folder;
  FakeEngine fake;
  fake.during = [](const Problem&) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(600);
    while (std::chrono::steady_clock::now() < end) continue;
  };
  DeckOptions options;
  options.path =
      folder.write("deck.lua", std::string(two_blocks) +
                                   "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, "
                                   "supports = { base }, steps = { hold } }:run{}\n"
                                   "local n = 0\nfor i = 1, 100000 do n = n + i end");
  options.time_limit = 0.4;
  EXPECT_EQ(run_deck(options, fake.engine()).n_runs, 1);
}

TEST(TimeLimit, counts_functions_of_time_that_the_engine_asks) {
  FakeEngine fake;
  fake.during = [](const Problem& problem) { problem.steps[0]->loads[0]->values[2]->history.value(0.5); };
  const Folder folder;
  DeckOptions options;
  options.path = folder.write("deck.lua", std::string(two_blocks) + R"(
local slow = load.traction{ on = high:face "zmax", z = function(t) while t > 0 do end return 0 end }
local s = step.static{ name = "s", loads = { slow } }
problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { s } }:run{})");
  options.time_limit = 0.3;
  EXPECT_THROW(run_deck(options, fake.engine()), InputError);
}

TEST(MemoryLimit, stops_a_deck_that_fills_the_memory) {
  const std::string by_tables = "local list = {}\nfor i = 1, 1e9 do\n  list[i] = { i }\nend";
  for (const std::string& text : {std::string("local s = ('x'):rep(1e9)"), by_tables}) {
    const std::string message = message_with_limits(text, 20, 16);
    EXPECT_TRUE(contains(message, "deck data require more than 16 MB of memory")) << message;
    EXPECT_TRUE(contains(message, "--memory-limit")) << message;
  }
}

TEST(MemoryLimit, counts_meshes_for_as_long_as_they_live) {
  const std::string box = "mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 40, 40, 40 } }";  // about 6 MB
  EXPECT_EQ(message_with_limits("for i = 1, 20 do local m = " + box + " end", 20, 32), "");
  const std::string message =
      message_with_limits("local kept = {}\nfor i = 1, 20 do kept[i] = " + box + " end", 20, 32);
  EXPECT_TRUE(contains(message, "deck.lua:2: mesh.box: 40 x 40 x 40 cells take about 6.1 MB; the limit is 32 MB"))
      << message;
}

TEST(MemoryLimit, can_be_raised) {
  EXPECT_NE(message_with_limits("local s = ('x'):rep(3e7)", 20, 16), "");
  EXPECT_EQ(message_with_limits("local s = ('x'):rep(3e7)", 20, 200), "");
}

TEST(Searches, that_would_never_end_are_refused) {
  const std::string hang = "local s = ('a'):rep(40)\nlocal found = s:find(('a?'):rep(40) .. ('a'):rep(40))";
  EXPECT_TRUE(contains(message_of(hang), "deck.lua:2: the pattern has too many repetitions"));
  EXPECT_TRUE(contains(message_of("local s = (''):rep(1e18)"), "")) << "returns at once";
  EXPECT_TRUE(contains(message_of("table.move({}, 1, 1e15, 2)"), "table has no 'move'"));
}

TEST(Recursion, that_is_infinite_is_an_error_of_the_deck) {
  EXPECT_TRUE(contains(message_of("local function f(x) return 1 + f(x) end\nlocal y = f(1)"), "stack overflow"));
}

}  // namespace

}  // namespace dygita::test::environment_tests

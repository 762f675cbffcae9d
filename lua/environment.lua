-- The deck's surroundings besides its words: a closed choice of Lua's own functions, none of which reaches a file, the
-- system, another program or this program's inside, or runs long in one call, where no limit could stop it.
local native = ...

local largest_effort = 1e9  -- elementary comparisons in one search

local raw = {}
for name, f in pairs(string) do raw[name] = f end

-- Bounds the effort of a search: each repetition in a pattern may try every place of the text. Lua takes numbers for
-- texts here. What many searches cost together is watched after each that is not short.
local watched_effort = 1e5

local function check_effort(text, pattern)
  if type(text) == "number" then text = tostring(text) end
  if type(pattern) == "number" then pattern = tostring(pattern) end
  if type(text) ~= "string" or type(pattern) ~= "string" then return end
  local repeats = 1
  for _ in raw.gmatch((raw.gsub(pattern, "%%[^bf%d]", "")), "[*+%-?%%]") do repeats = repeats + 1 end
  if (#text + 1) ^ repeats > largest_effort and repeats > 1 or #text * #pattern > largest_effort then
    error("the pattern has too many repetitions for a text of " .. #text .. " characters", 3)
  end
  if (#text + 1) ^ repeats > watched_effort or #text * #pattern > watched_effort then native.check_time() end
end

local safe_string = {}
for _, name in ipairs { "byte", "char", "format", "len", "lower", "reverse", "sub", "upper" } do
  safe_string[name] = raw[name]
end
for _, name in ipairs { "find", "match", "gmatch", "gsub" } do
  local search = raw[name]
  safe_string[name] = function(text, pattern, ...)
    check_effort(text, pattern)
    return search(text, pattern, ...)
  end
end
function safe_string.rep(text, n, separator)
  if (text == "" or text == nil) and (separator == "" or separator == nil) then return "" end
  return raw.rep(text, n, separator)
end
local of_texts = getmetatable("")
for event in pairs(of_texts) do of_texts[event] = nil end  -- "10" * mm is an error, not a number
of_texts.__index = safe_string

-- In a deck that is checked, a value that was not computed is nan: it must stop nothing that a computed one would not.
function safe_string.format(...)
  if not native.has_no_values() then return raw.format(...) end
  local arguments = table.pack(...)
  for i = 1, arguments.n do
    if arguments[i] ~= arguments[i] then arguments[i] = 0 end
  end
  return raw.format(table.unpack(arguments, 1, arguments.n))
end

local function assert_value(...)
  local n, value, message = select("#", ...), ...
  if n == 0 then assert() end
  if value or native.has_no_values() then return ... end
  error(n > 1 and message or "assertion failed!", 2)
end

local function raise(message, level)
  if native.has_no_values() then return end
  level = level or 1
  error(message, level > 0 and level + 1 or 0)
end

local safe_math = {}
for name, member in pairs(math) do safe_math[name] = member end
safe_math.randomseed = nil
math.randomseed(1)  -- the same deck computes the same

local safe_table = { concat = table.concat, insert = table.insert, pack = table.pack, remove = table.remove,
                     sort = table.sort, unpack = table.unpack }

-- Keys in one order, numbers before texts, each by size: Lua's own order of texts is another in each process, and MPI
-- ranks, which read the deck side by side, would number what it declares differently. Other keys come last, as they come.
local rank_of_key = { number = 1, string = 2, boolean = 3 }

local function precedes(a, b)
  local rank_a, rank_b = rank_of_key[type(a)] or 4, rank_of_key[type(b)] or 4
  if rank_a ~= rank_b then return rank_a < rank_b end
  if rank_a <= 2 then return a < b end
  return rank_a == 3 and b and not a
end

local function in_order(t)
  local keys, i = {}, 0
  for key in next, t do keys[#keys + 1] = key end
  table.sort(keys, precedes)
  return function()
    local value
    repeat
      i = i + 1
      value = t[keys[i]]
    until keys[i] == nil or value ~= nil
    return keys[i], value
  end, t
end

local function ordered_pairs(t)
  if type(t) ~= "table" or getmetatable(t) ~= nil then return pairs(t) end
  return in_order(t)
end

-- Of lists beyond whose end reading is an error, too, which their metatable says: for decks and for this program's own
-- loops over what decks give.
local plain_ipairs = ipairs
function ipairs(t)
  if type(t) ~= "table" or getmetatable(t) ~= "list" then return plain_ipairs(t) end
  return function(list, i)
    local value = rawget(list, i + 1)
    if value ~= nil then return i + 1, value end
  end, t, 0
end

-- A table that can be read and not written; `what` opens the message. call: what it does when it is called itself; nil:
-- nothing.
local function read_only(members, what, call)
  return setmetatable({}, {
    __index = function(_, key)
      local member = members[key]
      if member ~= nil then return member end
      local known = {}
      for name in pairs(members) do known[#known + 1] = name end
      native.fail(native.line(), ("%s has no '%s'\n    %s"):format(what, tostring(key),
        native.did_you_mean(tostring(key), known)))
    end,
    __newindex = function(_, key) native.fail(native.line(), ("%s.%s cannot be changed"):format(what, tostring(key))) end,
    __call = call and function(_, ...) return (call(...)) end or function()
      local known = {}
      for name in pairs(members) do known[#known + 1] = name end
      table.sort(known)
      native.fail(native.line(), ("%s cannot be called; call one of its members: %s.%s"):format(what, what,
        table.concat(known, (", %s."):format(what))))
    end,
    __pairs = function()
      local copy = {}
      for name, member in pairs(members) do copy[name] = member end
      return in_order(copy)
    end,
    __metatable = false,
  })
end

-- Whether two coordinates (m) are the same but for round-off, 1e-8 m and a millionth of the larger, or within `by`.
local function near(a, b, by)
  if by ~= nil then
    if type(a) ~= "number" or type(b) ~= "number" or type(by) ~= "number" or not (by >= 0) then
      native.fail(native.line(), "near(a, b, by) takes three numbers, the last a distance that is not below zero")
    end
    return math.abs(a - b) <= by
  end
  if type(a) ~= "number" or type(b) ~= "number" then
    native.fail(native.line(), "near(a, b) compares two numbers, got a " .. type(a) .. " and a " .. type(b))
  end
  return math.abs(a - b) <= 1e-8 + 1e-6 * math.max(math.abs(a), math.abs(b))
end

return {
  read_only = read_only,
  functions = {
    math = read_only(safe_math, "math"), string = read_only(safe_string, "string"), table = read_only(safe_table, "table"),
    ipairs = ipairs, pairs = ordered_pairs, next = next, select = select, type = type, tonumber = tonumber, tostring = tostring,
    error = raise, assert = assert_value, print = native.print, near = near,
  },
  refused = {
    os = true, io = true, package = true, debug = true, loadstring = true, dofile = true, loadfile = true,
    require = true, collectgarbage = true, setmetatable = true, getmetatable = true, rawget = true, rawset = true,
    rawequal = true, rawlen = true, pcall = true, xpcall = true, coroutine = true, utf8 = true,
  },
}

-- Interfaces of a deck: one between two faces or parts, or one for each two parts that touch.
local native = ...
local interfaces = {}

local all = "all touching"
local of_all = { "of", "except" }
local parts, declared = {}, {}  -- in the order of the deck

local function fail(entry, line, text, hint) native.fail(line, entry.path .. ": " .. text .. (hint and "\n    " .. hint or "")) end

function interfaces.note_part(part) parts[#parts + 1] = part end
function interfaces.note(interface) declared[#declared + 1] = interface end

local function forget(list, object)
  for i, known in ipairs(list) do
    if known == object then return table.remove(list, i) end
  end
end

-- What others stand for.
function interfaces.forget_part(part) forget(parts, part) end
function interfaces.forget(interface) forget(declared, interface) end

-- Those that were found for a problem are its own: the next case of a study finds them anew. Those that a deck declares
-- one by one hold for all that follow.
local found = setmetatable({}, { __mode = "k" })
function interfaces.note_problem(of)
  for _, interface in ipairs(of or {}) do
    if found[interface] then forget(declared, interface) end
  end
end

local function name_of(object) return (select(3, native.kind(object))) end

-- The answer to "all touching": a list whose interfaces are found by name, too.
local named = {}
function named.__index(list, key)
  if type(key) ~= "string" then return nil end
  local names = {}
  for i, interface in ipairs(list) do
    names[i] = name_of(interface)
    if names[i] == key or names[i]:match "[^/ ]+/.*" == key then return interface end
  end
  native.fail(native.line(), ("no interface '%s' was found\n    %s"):format(key, native.did_you_mean(key, names)))
end
named.__metatable = false

-- Parts and pairs of parts that `except` leaves alone, and the pairs that it was used for.
local function exceptions(given, among)
  local skipped = { parts = {}, pairs = {} }
  for _, item in ipairs(given.except or {}) do
    local kind = native.kind(item)
    if kind == "substructure" then
      skipped.parts[item] = true
    elseif kind == "interface" then
      local one, other = native.sides(item, among)
      skipped.pairs[#skipped.pairs + 1] = { one, other }
    else
      skipped.pairs[#skipped.pairs + 1] = item
    end
  end
  return function(one, other)
    if skipped.parts[one] or skipped.parts[other] then return true end
    for _, pair in ipairs(skipped.pairs) do
      if pair[1] == one and pair[2] == other or pair[1] == other and pair[2] == one then return true end
    end
    return false
  end
end

local function declare_all(entry, given, line)
  local among = given.of or parts
  if #among < 2 then fail(entry, line, ("\"%s\" finds interfaces among parts, and %d are declared before"):format(all, #among)) end
  local is_left, left = exceptions(given, among), {}
  local list, lines, joined = setmetatable({}, named), {}, {}
  for _, pair in ipairs(native.touching(among, declared, given.within or 0, line)) do
    local one, other = among[pair[1]], among[pair[2]]
    joined[one], joined[other] = true, true
    local name = name_of(one) .. "/" .. name_of(other)
    if is_left(one, other) then
      left[#left + 1] = name
    else
      local copy = {}
      for key, value in pairs(given) do copy[key] = value end
      copy.name = (given.name and given.name .. " " or "") .. name
      copy.between, copy.within = { pair.face_1, pair.face_2 }, pair.within
      copy.of, copy.except = nil, nil
      list[#list + 1] = native.make(entry.path, "interface", copy, line)
      lines[#lines + 1] = ("  '%s': %s"):format(copy.name, pair.text)
      if pair.doubt ~= "" and not given.closed and (given.gap or 0) == 0 then
        native.warn(line, ("%s: '%s' and '%s' %s; %s"):format(entry.path, name_of(one), name_of(other), pair.doubt,
          entry.path == "interface.contact" and "gap = \"geometry\" keeps the actual gap, closed = true confirms contact"
          or "move them together by 'place' or 'origin'"), "gap", pair.largest,
          ("'%s' and '%s' (%.2g mm)"):format(name_of(one), name_of(other), 1e3 * pair.largest))
      end
    end
  end
  if #list == 0 then
    fail(entry, line, ("no two of %d parts touch where they have no interface yet"):format(#among),
      "'within' sets how far apart touching faces may be; overlapping parts do not touch: dygita check reports them")
  end
  if not given.of then
    for _, interface in ipairs(declared) do
      for _, part in ipairs{ native.sides(interface, among) } do joined[part] = true end
    end
    for _, part in ipairs(among) do
      if not joined[part] and not is_left(part, part) then
        native.warn(line, ("%s \"%s\": '%s' touches no other part, and no interface holds it"):format(entry.path, all, name_of(part)))
      end
    end
  end
  native.say(("%s \"%s\": %d pairs of parts touch%s"):format(entry.path, all, #list,
    #left > 0 and "; left alone: " .. table.concat(left, ", ") or ""))
  for _, text in ipairs(lines) do native.say(text) end
  for _, interface in ipairs(list) do
    found[interface] = true
    interfaces.note(interface)
  end
  return list
end

function interfaces.declare(entry, given, line)
  if given.between == all then
    local list = declare_all(entry, given, line)
    return list
  end
  for _, key in ipairs(of_all) do
    if given[key] then fail(entry, line, ("'%s' goes with between = \"%s\""):format(key, all)) end
  end
  local interface = native.make(entry.path, "interface", given, line)
  interfaces.note(interface)
  return interface
end

return interfaces

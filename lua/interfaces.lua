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

-- Those of "all touching" are their problem's own: the next case of a study finds them anew. Those that a deck declares
-- one by one or by names hold for all that follow, until the same line declares them again.
local found = setmetatable({}, { __mode = "k" })
local by_names = {}  -- by the line
function interfaces.note_problem(of)
  for _, interface in ipairs(of or {}) do
    if found[interface] then forget(declared, interface) end
  end
end

local function name_of(object) return (select(3, native.kind(object))) end

-- The parts declared so far whose names fit; * stands for any text.
function interfaces.named(pattern)
  local fits, list = "^" .. pattern:gsub("[%^%$%(%)%%%.%[%]%+%-%?]", "%%%0"):gsub("%*", ".*") .. "$", {}
  for _, part in ipairs(parts) do
    if name_of(part):find(fits) then list[#list + 1] = part end
  end
  return list
end

function interfaces.names()
  local names = {}
  for i, part in ipairs(parts) do names[i] = name_of(part) end
  return names
end

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

-- Of the sides { one, other }, lists of parts: all of them in the order of the deck, and which pairs are asked for, with
-- the part of the first side first.
local function side_by_side(sides)
  local is_on, among = { {}, {} }, {}
  for i = 1, 2 do
    for _, part in ipairs(sides[i]) do is_on[i][part] = true end
  end
  for _, part in ipairs(parts) do
    if is_on[1][part] or is_on[2][part] then among[#among + 1] = part end
  end
  return among, function(one, other)
    if is_on[1][one] and is_on[2][other] then return true, false end
    return is_on[1][other] and is_on[2][one], true
  end
end

-- Of the pairs that were asked for and have no interface, how far the nearest are apart.
local function nearest_of(among, asked, is_left)
  local number, has_interface, pairs_asked = {}, {}, {}
  for i, part in ipairs(among) do number[part], has_interface[i] = i, {} end
  for _, interface in ipairs(declared) do
    local one, other = native.sides(interface, among)
    if one and other then
      local i, j = number[one], number[other]
      has_interface[i][j], has_interface[j][i] = true, true
    end
  end
  for i, one in ipairs(among) do
    for j = i + 1, #among do
      if asked(one, among[j]) and not is_left(one, among[j]) and not has_interface[i][j] then
        pairs_asked[#pairs_asked + 1], pairs_asked[#pairs_asked + 2] = i, j
      end
    end
  end
  local text = native.nearest_apart(among, pairs_asked)
  return text
end

local function declare_all(entry, given, line)
  for _, interface in ipairs(by_names[line] or {}) do forget(declared, interface) end
  local among, asked = given.of or parts, function() return true, false end
  local what = ("\"%s\""):format(all)
  if given.between ~= all then
    among, asked = side_by_side(given.between)
    what = ("between %d and %d parts"):format(#given.between[1], #given.between[2])
  end
  if #among < 2 then fail(entry, line, ("\"%s\" needs two parts or more declared before it, got %d"):format(all, #among)) end
  local is_left, left = exceptions(given, among), {}
  local list, lines, joined = setmetatable({}, named), {}, {}
  for _, pair in ipairs(native.touching(among, declared, given.within or 0, line)) do
    local one, other = among[pair[1]], among[pair[2]]
    local is_asked, is_other_way = asked(one, other)
    -- A contact whose gap the deck leaves to the geometry takes a round face on a plane as far as a load may close it.
    local is_contact, has_no_gap = entry.path == "interface.contact", not given.closed and (given.gap or 0) == 0
    local is_wide = is_contact and has_no_gap and pair.beside_the_line ~= nil
    local faces = is_wide and pair.beside_the_line or pair
    local face_1, face_2 = faces.face_1, faces.face_2
    if is_other_way then one, other, face_1, face_2 = other, one, face_2, face_1 end
    joined[one], joined[other] = true, true
    local name = name_of(one) .. "/" .. name_of(other)
    if not is_asked then
      -- of one side both
    elseif is_left(one, other) then
      left[#left + 1] = name
    else
      local copy = {}
      for key, value in pairs(given) do copy[key] = value end
      copy.name = (given.name and given.name .. " " or "") .. name
      copy.between, copy.within = { face_1, face_2 }, faces.within
      copy.of, copy.except = nil, nil
      list[#list + 1] = native.make(entry.path, "interface", copy, line)
      lines[#lines + 1] = ("  '%s': %s"):format(copy.name, faces.text)
      local is_told_there = is_wide or pair.is_known and is_contact
      if pair.doubt ~= "" and not is_told_there and has_no_gap then
        native.warn(line, ("%s: '%s' and '%s' %s; %s"):format(entry.path, name_of(one), name_of(other), pair.doubt,
          is_contact and "gap = \"geometry\" keeps the actual gap, closed = true confirms contact"
          or "move them together by 'place' or 'origin'"), "gap", pair.largest,
          ("'%s' and '%s' (%.2g mm)"):format(name_of(one), name_of(other), 1e3 * pair.largest))
      end
    end
  end
  if #list == 0 then
    local nearest = nearest_of(among, asked, is_left)
    fail(entry, line, ("no two of %d parts touch without an interface already"):format(#among) .. (given.between ~= all and ", one of each side" or ""),
      (nearest ~= "" and nearest .. "\n    " or "") .. "'within' sets how far apart touching faces may be; overlapping parts do not touch: dygita check reports them")
  end
  if not given.of and given.between == all then
    for _, interface in ipairs(declared) do
      for _, part in ipairs{ native.sides(interface, among) } do joined[part] = true end
    end
    for _, part in ipairs(among) do
      if not joined[part] and not is_left(part, part) then
        native.warn(line, ("%s \"%s\": '%s' touches no other part, and no interface holds it"):format(entry.path, all, name_of(part)))
      end
    end
  end
  native.say(("%s %s: %d pairs of parts touch%s"):format(entry.path, what, #list,
    #left > 0 and "; left alone: " .. table.concat(left, ", ") or ""))
  for _, text in ipairs(lines) do native.say(text) end
  for _, interface in ipairs(list) do
    found[interface] = given.between == all or nil
    interfaces.note(interface)
  end
  if given.between ~= all then by_names[line] = list end
  return list
end

function interfaces.declare(entry, given, line)
  for _, key in ipairs(of_all) do
    if given[key] and given.between ~= all and not (key == "except" and given.between.are_lists) then
      fail(entry, line, ("'%s' goes with between = \"%s\""):format(key, all))
    end
  end
  if given.between == all or given.between.are_lists then
    local list = declare_all(entry, given, line)
    return list
  end
  local interface = native.make(entry.path, "interface", given, line)
  interfaces.note(interface)
  return interface
end

return interfaces

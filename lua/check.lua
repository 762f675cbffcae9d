-- Checks one call of the deck against its entry in the schema: nothing is ignored, nothing silently defaulted.
-- Every message is one line that says what and where, then what is allowed.
local native = ...
local placement = native.module "placement"
local bolts = native.module "bolts"
local frames = native.module "frames"
local interfaces = native.module "interfaces"
local ensembles = native.module "ensembles"
local check = {}

local hints = {
  face = 'a face is part:face "group"',
  face_of_region = "the facets at such nodes are part:face{ where = function(x, y, z) return boolean end }",
  region = "a region is part:where(function(x, y, z) return boolean end)",
  bolt = "a bolt is made of parts and interfaces: bolt.parts, bolt.interfaces, bolt.shank",
  mesh = 'a mesh is mesh.box{ ... } or file:volume "name"',
  frame = "a frame is frame{ origin = ..., axis = ..., x = ... }",
}

local function message(call, text, hint) return call.path .. ": " .. text .. (hint and "\n    " .. hint or "") end
local function fail(call, text, hint) native.fail(call.line, message(call, text, hint)) end

local function article(noun) return (noun:match "^[aeiou]" and "an " or "a ") .. noun end

local function describe(value)
  local kind, path, name = native.kind(value)
  if kind then
    local is_own_kind = path:sub(1, #kind + 1) == kind .. "."  -- "interface.contact" says more than "interface"
    return article(is_own_kind and path or kind) .. (name ~= "" and " '" .. name .. "'" or "")
  end
  if bolts.is_bolt(value) then return ("a bolt '%s'"):format(value.name) end
  if frames.is_frame(value) then return "a frame" end
  if ensembles.is_distribution(value) then return "a distribution" end
  if type(value) == "number" then return ("the number %g"):format(value) end
  if type(value) == "string" then return ('the text "%s"'):format(value) end
  if type(value) == "boolean" then return tostring(value) end
  return value == nil and "nothing" or article(type(value))
end

check.describe = describe

local function wrong_type(call, label, wanted, value, hint)
  fail(call, ("'%s' must be %s, got %s"):format(label, wanted, describe(value)), hint)
end

local function with_unit(text, unit) return unit and text .. " " .. unit or text end
local function of_unit(text, unit) return unit and text .. " (" .. unit .. ")" or text end

local function check_number(call, argument, value, label)
  if value ~= value or value == math.huge or value == -math.huge then
    local text = value ~= value and "nan" or ("%g"):format(value)
    native.fail_on_value(call.line, message(call, ("'%s' is not a finite number (%s)"):format(label, text),
      "was something divided by zero?"))
  end
  local range, unit = argument.range, argument.unit
  if range and (value < range[1] or value > range[2]) then
    fail(call, ("'%s' = %s is outside the plausible range %s"):format(label, with_unit(("%g"):format(value), unit),
      with_unit(("[%g, %g]"):format(range[1], range[2]), unit)),
      argument.in_radians and ("an angle is in radians: %g degrees are %g*deg"):format(value, value)
        or unit and "a bare number is SI; was a unit forgotten, or the wrong one used?")
  end
  local usual = argument.usual
  if usual and (value < usual[1] or value > usual[2]) then
    native.warn(call.line, message(call, ("'%s' = %s is unusual: %s"):format(label, with_unit(("%g"):format(value), unit), usual[3])))
  end
  return value
end

-- A table of named members, not a list.
local function is_named(value) return type(value) == "table" and type(next(value)) == "string" end
local function is_list(value) return type(value) == "table" and not native.kind(value) and not bolts.is_bolt(value) and not frames.is_frame(value) end

-- A list without holes of at most `limit` items.
local function check_list(call, value, label, wanted)
  if type(value) ~= "table" then wrong_type(call, label, wanted, value) end
  local n = 0
  for key in pairs(value) do
    if math.type(key) ~= "integer" or key < 1 then
      fail(call, ("'%s' must be %s, got a table with '%s'"):format(label, wanted, tostring(key)))
    end
    n = n + 1
  end
  for i = 1, n do
    if value[i] == nil then fail(call, ("'%s' has no value at place %d"):format(label, i), "is a name misspelt?") end
  end
  return n
end

local function fits(value, kinds)
  local kind, path = native.kind(value)
  for _, wanted in ipairs(kinds) do
    if wanted == kind or wanted == path then return true end
  end
  return false
end

local function one_of(kinds, prefix)
  local texts = {}
  for i, kind in ipairs(kinds) do texts[i] = prefix and article(kind) or kind end
  return table.concat(texts, " or ")
end

local function hint_for(kinds, value)
  if bolts.is_bolt(value) then return hints.bolt end
  if kinds[1] == "face" and native.kind(value) == "region" then return hints.face_of_region end
  if native.kind(value) == "model file" then return 'take one of its parts: file:part "name"' end
  if native.kind(value) == "mesh file" then return 'take one of its volumes: file:volume "name"' end
  return hints[kinds[1]]
end

local function check_object(call, argument, value, label)
  if argument.or_bolt and bolts.is_bolt(value) then return value end
  if not fits(value, argument.kinds) then
    wrong_type(call, label, one_of(argument.kinds, true), value, hint_for(argument.kinds, value))
  end
  return value
end

local function check_name(call, _, value, label)
  if type(value) ~= "string" then wrong_type(call, label, "text", value) end
  if value == "" then fail(call, ("'%s' is empty"):format(label)) end
  if #value > 100 then fail(call, ("'%s' is longer than 100 characters"):format(label)) end
  if value:find '[%c/\\:*?"<>|]' or value:find "^[%. ]" or value:find "[%. ]$" then
    fail(call, ("'%s' = \"%s\" cannot name a file"):format(label, value),
      'no / \\ : * ? " < > | or control character in it, no dot or space at its ends')
  end
  return value
end

local types = { name = check_name, object = check_object }

function types.frame(call, _, value, label)
  if not frames.is_frame(value) then wrong_type(call, label, "a frame", value, hints.frame) end
  return value
end

-- Directions by name: some of the axes, as "xyz", or named vectors. Answers a list of { name, vector }.
function types.directions(call, _, value, label)
  local list = {}
  if type(value) == "string" then
    local axes = { x = { 1, 0, 0 }, y = { 0, 1, 0 }, z = { 0, 0, 1 } }
    for letter in value:gmatch "." do
      if not axes[letter] then
        fail(call, ("'%s' = \"%s\" is unknown"):format(label, value), 'it is some of the axes, as "xyz" or "xz", or named directions, { axial = { 0, 0, 1 } }')
      end
      list[#list + 1], axes[letter] = { letter, axes[letter] }, nil
    end
    return list
  end
  if not is_named(value) then wrong_type(call, label, 'axes as "xyz", or named directions { axial = { 0, 0, 1 } }', value) end
  local names = {}
  for name in pairs(value) do names[#names + 1] = check_name(call, nil, name, label) end
  table.sort(names)
  for i, name in ipairs(names) do list[i] = { name, types.vector(call, {}, value[name], label .. "." .. name) } end
  return list
end

-- By the names of directions, what an argument may also say for all.
local function by_name(call, argument, value, label)
  local checked = {}
  for name, one in pairs(value) do checked[name] = types[argument.type](call, argument, one, label .. "." .. tostring(name)) end
  return { by_name = checked }
end

function types.number(call, argument, value, label)
  if argument.or_table and type(value) == "table" then
    return check.arguments(call, argument.or_table, value, label .. ".")
  end
  if argument.or_word and value == argument.or_word or argument.or_function and type(value) == "function" then return value end
  local wanted = of_unit("a number", argument.unit) .. (argument.or_function and ", a function of x, y, z" or "")
    .. (argument.or_word and ' or "' .. argument.or_word .. '"' or "")
  if type(value) ~= "number" then wrong_type(call, label, wanted, value) end
  return check_number(call, argument, value, label)
end

function types.integer(call, argument, value, label)
  if argument.or_word and value == argument.or_word then return value end
  local wanted = "a whole number" .. (argument.or_word and ' or "' .. argument.or_word .. '"' or "")
  if type(value) ~= "number" then wrong_type(call, label, wanted, value) end
  check_number(call, argument, value, label)
  local whole = math.tointeger(value)
  if not whole then wrong_type(call, label, wanted, value) end
  if argument.later_above and whole > argument.later_above then
    fail(call, ("'%s' = %d is not built yet in dygita %s"):format(label, whole, native.version))
  end
  return whole
end

function types.boolean(call, _, value, label)
  if type(value) ~= "boolean" then wrong_type(call, label, "true or false", value) end
  return value
end

function types.choice(call, argument, value, label)
  if type(value) ~= "string" then wrong_type(call, label, "text", value, native.did_you_mean("", argument.choices)) end
  for _, choice in ipairs(argument.choices) do
    if value == choice then return value end
  end
  fail(call, ("'%s' = \"%s\" is unknown"):format(label, value), native.did_you_mean(value, argument.choices))
end

function types.choices(call, argument, value, label)
  for i = 1, check_list(call, value, label, "a list of names") do
    types.choice(call, argument, value[i], ("%s[%d]"):format(label, i))
  end
  return value
end

function types.texts(call, argument, value, label)
  if argument.or_single and type(value) == "string" then value = { value } end
  for i = 1, check_list(call, value, label, "a list of names") do types.text(call, nil, value[i], ("%s[%d]"):format(label, i)) end
  return value
end

function types.text(call, _, value, label)
  if type(value) ~= "string" then wrong_type(call, label, "text", value) end
  if value == "" then fail(call, ("'%s' is empty"):format(label)) end
  return value
end
types.file = types.text

function types.vector(call, argument, value, label)
  local wanted = of_unit("three numbers { x, y, z }", argument.unit)
  if check_list(call, value, label, wanted) ~= 3 then
    fail(call, ("'%s' must be %s, got %d of them"):format(label, wanted, #value))
  end
  for i = 1, 3 do
    if type(value[i]) ~= "number" then wrong_type(call, ("%s[%d]"):format(label, i), "a number", value[i]) end
    check_number(call, argument, value[i], ("%s[%d]"):format(label, i))
  end
  return { value[1], value[2], value[3] }
end

-- A translation { x, y, z }, or { translate = ..., rotate = { axis, angle, about } }: turned about its place first, then
-- moved. Answers three numbers, or the twelve of a placement.
function types.placement(call, argument, value, label)
  if type(value) ~= "table" or native.kind(value) or #value > 0 or next(value) == nil then
    return types.vector(call, argument, value, label)
  end
  local given = check.arguments(call, argument.fields, value, label .. ".")
  local moved = placement.translation(given.translate)
  if not given.rotate then return given.translate end
  local turned = placement.rotation(given.rotate.axis, given.rotate.angle, given.rotate.about)
  if not turned then fail(call, ("'%s.rotate.axis' is zero"):format(label), "as in axis = { 0, 0, 1 }") end
  return placement.shortest(placement.after(moved, turned))
end

-- Two axes, a function of a place, or a cylinder's axis with an angle. Answers the function, or a flat list: six numbers of
-- two axes, seven of an axis, a point of it and the angle.
function types.orientation(call, argument, value, label)
  if type(value) == "function" then return value end
  local wanted = "two axes { {x, y, z}, {x, y, z} }, a function or a table { axis = ... }"
  if type(value) ~= "table" or native.kind(value) or next(value) == nil then wrong_type(call, label, wanted, value) end
  local flat = {}
  local function add(vector)
    for i = 1, 3 do flat[#flat + 1] = vector[i] end
  end
  if #value == 0 then
    local given = check.arguments(call, argument.fields, value, label .. ".")
    add(given.axis)
    add(given.about)
    flat[7] = given.angle
    return flat
  end
  if check_list(call, value, label, wanted) ~= 2 then fail(call, ("'%s' must be %s, got a list of %d"):format(label, wanted, #value)) end
  for i = 1, 2 do add(types.vector(call, {}, value[i], ("%s[%d]"):format(label, i))) end
  return flat
end

function types.counts(call, argument, value, label)
  local whole = {}
  if check_list(call, value, label, "three whole numbers") ~= 3 then
    fail(call, ("'%s' must be three whole numbers, got %d of them"):format(label, #value))
  end
  for i = 1, 3 do whole[i] = types.integer(call, argument, value[i], ("%s[%d]"):format(label, i)) end
  return whole
end

function types.numbers(call, argument, value, label)
  if argument.or_single and type(value) == "number" then return { types.number(call, argument, value, label) } end
  local numbers, n = {}, check_list(call, value, label, argument.or_single and "a number, or a list of numbers" or "a list of numbers")
  if n < argument.at_least then fail(call, ("'%s' must have at least %d numbers"):format(label, argument.at_least)) end
  if n > (argument.at_most or n) then fail(call, ("'%s' must have %d numbers at most, got %d"):format(label, argument.at_most, n)) end
  for i = 1, n do numbers[i] = types.number(call, argument, value[i], ("%s[%d]"):format(label, i)) end
  return numbers
end

-- A file, or pairs of frequency and level: left as one flat list.
function types.specification(call, _, value, label)
  if type(value) == "string" then return types.text(call, nil, value, label) end
  local pair_of = "{ frequency (Hz), level (m/s^2) }"
  local flat, n = {}, check_list(call, value, label, "a file or a list of " .. pair_of)
  if n < 2 then fail(call, ("'%s' must have at least two points %s, got %d"):format(label, pair_of, n)) end
  for i = 1, n do
    local point = ("%s[%d]"):format(label, i)
    if type(value[i]) ~= "table" then wrong_type(call, point, pair_of, value[i], "as in { {100, 20*g0}, {1000, 500*g0} }") end
    if check_list(call, value[i], point, pair_of) ~= 2 then fail(call, ("'%s' must be %s, got %d of them"):format(point, pair_of, #value[i])) end
    for j = 1, 2 do flat[#flat + 1] = types.number(call, {}, value[i][j], ("%s[%d]"):format(point, j)) end
  end
  return flat
end

-- Pairs that rise in both numbers, left as one flat list.
function types.pairs(call, argument, value, label)
  local pair_of, flat = "{ " .. argument.of[1] .. ", " .. argument.of[2] .. " }", {}
  local n = check_list(call, value, label, "a list of " .. pair_of)
  if n == 0 then fail(call, ("'%s' is empty"):format(label), "a list of " .. pair_of) end
  for i = 1, n do
    local point = ("%s[%d]"):format(label, i)
    if type(value[i]) ~= "table" then wrong_type(call, point, pair_of, value[i]) end
    if check_list(call, value[i], point, pair_of) ~= 2 then fail(call, ("'%s' must be %s, got %d numbers"):format(point, pair_of, #value[i])) end
    for j = 1, 2 do
      local number = types.number(call, {}, value[i][j], ("%s[%d]"):format(point, j))
      local before = i == 1 and 0 or value[i - 1][j]
      if not (j == 1 and number > before or j == 2 and number >= before) then
        fail(call, ("'%s[%d]' = %g is not more than %g"):format(point, j, number, before), "both rise from (0, 0), which is no point of the list")
      end
      flat[#flat + 1] = number
    end
  end
  return flat
end

-- How rough faces give way: one of three laws along the normal. Answers a flat table of numbers by the names of the law.
function types.compliance(call, argument, value, label)
  local given, flat, n = types.table(call, argument, value, label), {}, 0
  for _, key in ipairs { "normal", "curve", "asperities" } do
    if given[key] then n = n + 1 end
  end
  if n ~= 1 then fail(call, ("'%s' has %s of 'normal', 'curve' and 'asperities'"):format(label, n == 0 and "none" or "more than one"), "give one of them") end
  flat.normal, flat.tangential = given.normal, given.tangential
  for i = 1, #(given.curve or {}), 2 do
    flat[("approach[%d]"):format((i + 1) // 2)], flat[("pressure[%d]"):format((i + 1) // 2)] = given.curve[i], given.curve[i + 1]
  end
  for key, number in pairs(given.asperities or {}) do flat["asperities." .. key] = number end
  return flat
end

function types.settings(call, argument, value, label)
  if type(value) ~= "table" then wrong_type(call, label, "a table of numbers by name, as { size = 2*mm }", value) end
  local settings = {}
  for key, number in pairs(value) do
    if type(key) ~= "string" then fail(call, ("'%s' takes numbers by name, as { size = 2*mm }"):format(label)) end
    settings[key] = types.number(call, argument, number, label .. "." .. key)
  end
  return settings
end

-- Distributions by the names of parameters.
function types.distributions(call, _, value, label)
  if type(value) ~= "table" or native.kind(value) then
    wrong_type(call, label, "a table of distributions by name, as { mu = uniform(0.1, 0.3) }", value)
  end
  local vary = ensembles.check_vary(function(text) fail(call, text) end, value, label)
  return vary
end

types["function"] = function(call, _, value, label)
  if type(value) ~= "function" then wrong_type(call, label, "a function", value) end
  return value
end

function types.value(call, argument, value, label)
  if type(value) == "number" then return check_number(call, argument, value, label) end
  if type(value) == "function" then
    local n = native.n_parameters(value)
    if n > 1 then
      fail(call, ("'%s' is a function of %d arguments; a history is one of time alone"):format(label, n),
        "as in function(t) return 100*t end: it is the same at all its places")
    end
    return value
  end
  if native.kind(value) ~= "history" then
    wrong_type(call, label, of_unit("a number", argument.unit) .. ", a history or a function of time", value)
  end
  -- The values of a named history are in the unit of what it drives: only here are they plausible or not.
  local arguments = native.arguments(value)
  local checked = {}
  local function check_once(number, name)
    if not number or checked[number] then return end
    checked[number] = number == number  -- nan is no key
    check_number(call, argument, number, label .. name)
  end
  for _, key in ipairs { "value", "from", "to", "peak" } do check_once(arguments[key], "." .. key) end
  local low, high = native.extremes(value)
  check_once(low, " (smallest value)")
  check_once(high, " (largest value)")
  return value
end

function types.table(call, argument, value, label)
  if type(value) ~= "table" or native.kind(value) then
    local names = {}
    for _, field in ipairs(argument.fields) do
      if field.required then names[#names + 1] = field[1] end
    end
    wrong_type(call, label, ("a table { %s = ... }"):format(table.concat(names, " = ..., ")), value)
  end
  return check.arguments(call, argument.fields, value, label .. ".")
end

-- A list of tables of the same fields.
function types.tables(call, argument, value, label)
  local checked = {}
  if check_list(call, value, label, "a list of tables") == 0 then fail(call, ("'%s' is empty"):format(label), argument.doc) end
  for i = 1, #value do checked[i] = types.table(call, argument, value[i], ("%s[%d]"):format(label, i)) end
  return checked
end

-- A side of several interfaces: parts by name, or a list.
local function parts_of(call, value, label)
  local list = types.objects(call, { kinds = { "substructure" }, at_least = 1, or_single = true, or_names = true }, value, label)
  return list
end

-- Does `between` say more than two faces or parts: a word for all, names, lists?
local function is_of_many(value)
  if not is_list(value) then return type(value) == "string" end
  return type(value[1]) == "string" or type(value[2]) == "string" or is_list(value[1]) or is_list(value[2])
end

-- Two sides of an interface; two lists of parts, side by side; or a word for all.
function types.between(call, argument, value, label)
  if argument.or_word and value == argument.or_word then return value end
  local wanted = "two faces or parts { one, other }" .. (argument.or_word and (' or "%s"'):format(argument.or_word) or "")
  if type(value) == "string" and argument.or_word then
    fail(call, ("'%s' = \"%s\" is unknown"):format(label, value), ('it is { one, other }, or "%s"'):format(argument.or_word))
  end
  if type(value) ~= "table" then wrong_type(call, label, wanted, value, hints.face) end
  local n = check_list(call, value, label, wanted)
  if n ~= 2 then fail(call, ("'%s' must be %s, got %d of them"):format(label, wanted, n), hints.face) end
  local has_face = native.kind(value[1]) == "face" or native.kind(value[2]) == "face"
  if argument.or_word and is_of_many(value) and not has_face then
    return { parts_of(call, value[1], label .. "[1]"), parts_of(call, value[2], label .. "[2]"), are_lists = true }
  end
  for i = 1, 2 do check_object(call, argument, value[i], ("%s[%d]"):format(label, i)) end
  if value[1] == value[2] then
    fail(call, ("'%s' has %s twice: an interface joins two parts"):format(label, describe(value[1])))
  end
  return { value[1], value[2] }
end

-- Parts, pairs of parts and interfaces.
function types.except(call, _, value, label)
  local items, n = {}, check_list(call, value, label, "a list of parts, pairs of parts and interfaces")
  for i = 1, n do
    local item, place = value[i], ("%s[%d]"):format(label, i)
    if type(item) == "string" then
      table.move(parts_of(call, item, place), 1, #parts_of(call, item, place), #items + 1, items)
    elseif type(item) ~= "table" and not native.kind(item) then
      wrong_type(call, place, "a substructure, a pair of them { one, other }, or an interface", item)
    elseif native.kind(item) then
      items[#items + 1] = check_object(call, { kinds = { "substructure", "interface" } }, item, place)
    elseif #item == 2 and is_of_many(item) then
      for _, one in ipairs(parts_of(call, item[1], place .. "[1]")) do
        for _, other in ipairs(parts_of(call, item[2], place .. "[2]")) do items[#items + 1] = { one, other } end
      end
    else
      items[#items + 1] = types.objects(call, { kinds = { "substructure" }, exactly = 2 }, item, place)
    end
  end
  return items
end

-- A list of `n` items with what is in lists of it in their places.
local function flattened(call, value, n, label, what)
  local flat = {}
  for i = 1, n do
    local item = value[i]
    if type(item) == "table" and not native.kind(item) and (item[1] ~= nil or next(item) == nil) then
      local place = ("%s[%d]"):format(label, i)
      for _, inner in ipairs(flattened(call, item, check_list(call, item, place, what), place, what)) do flat[#flat + 1] = inner end
    else
      flat[#flat + 1] = item
    end
  end
  return flat
end

-- With the parts in the place of names and patterns, each once.
local function with_named(call, value, label)
  local list, is_there = {}, {}
  for _, item in ipairs(value) do is_there[item] = true end
  for i, item in ipairs(value) do
    if type(item) ~= "string" then list[#list + 1] = item end
    for _, part in ipairs(type(item) == "string" and interfaces.named(item) or {}) do
      if not is_there[part] then list[#list + 1], is_there[part] = part, true end
    end
    if type(item) == "string" and #interfaces.named(item) == 0 then
      local known = interfaces.names()
      fail(call, ("'%s': no part declared before is called \"%s\""):format(#value > 1 and ("%s[%d]"):format(label, i) or label, item),
        #known > 0 and native.did_you_mean(item, known) .. "; * stands for any text" or "parts are declared before they are named")
    end
  end
  return list
end

function types.objects(call, argument, value, label)
  local what = one_of(argument.kinds)
  if argument.or_names and type(value) == "string" then value = { value } end
  if bolts.is_bolt(value) then wrong_type(call, label, one_of(argument.kinds, true), value, hints.bolt) end
  if native.kind(value) and argument.or_single then return { check_object(call, argument, value, label) } end
  if type(value) ~= "table" and argument.or_single then
    wrong_type(call, label, one_of(argument.kinds, true) .. ", or a list", value, hint_for(argument.kinds, value))
  end
  local of_what = ("a list { ... } of %ss"):format(what)
  value = flattened(call, value, check_list(call, value, label, of_what), label, of_what)
  if argument.or_names then value = with_named(call, value, label) end
  local n = #value
  if argument.exactly and n ~= argument.exactly then
    fail(call, ("'%s' must be %d %ss, got %d"):format(label, argument.exactly, what, n), hints[argument.kinds[1]])
  end
  if argument.at_least and n < argument.at_least then fail(call, ("'%s' is empty"):format(label)) end
  local objects, places = {}, {}
  for i = 1, n do
    local object = check_object(call, argument, value[i], ("%s[%d]"):format(label, i))
    if places[object] then
      fail(call, ("'%s' has %s twice, at places %d and %d"):format(label, describe(object), places[object], i))
    end
    objects[i], places[object] = object, i
  end
  return objects
end

local function contains(list, item)
  for _, other in ipairs(list or {}) do
    if other == item then return true end
  end
  return false
end

-- Refuses the first (in alphabetical order) key that `arguments` does not have.
local function check_known(call, arguments, given, prefix)
  local known, is_known, unknown = {}, {}, {}
  for i, argument in ipairs(arguments) do
    known[i], is_known[argument[1]] = argument[1], true
  end
  for key in pairs(given) do
    if type(key) ~= "string" then
      fail(call, ("arguments need names: %s at place %s has none"):format(describe(given[key]), tostring(key)),
        native.did_you_mean("", known) .. (type(given[key]) == "number" and "; decimals take a point" or ""))
    end
    if not is_known[key] then unknown[#unknown + 1] = key end
  end
  table.sort(unknown)
  if #unknown == 0 then return end
  if contains(call.later, unknown[1]) then
    fail(call, ("'%s' is not built yet in dygita %s"):format(unknown[1], native.version))
  end
  fail(call, ("unknown argument '%s%s'"):format(prefix, unknown[1]), native.did_you_mean(unknown[1], known))
end

-- Is what is required elsewhere left out, given what another argument says?
local function is_excused(argument, given)
  local unless = argument.required_unless
  return unless and is_of_many(given[unless[1]])
end

-- The checked copy of `given`, defaults filled in.
function check.arguments(call, arguments, given, prefix)
  check_known(call, arguments, given, prefix)
  local checked = {}
  for _, argument in ipairs(arguments) do
    local key = argument[1]
    local value = given[key]
    if value ~= nil then
      if argument.with and given[argument.with] == nil then
        fail(call, ("'%s%s' needs '%s'"):format(prefix, key, argument.with), argument.doc)
      end
      local one = argument.by_direction and is_named(value) and by_name or types[argument.type]
      checked[key] = one(call, argument, value, prefix .. key)
    elseif argument.required and not is_excused(argument, given) then
      fail(call, ("'%s%s' is missing"):format(prefix, key), of_unit(key, argument.unit) .. ": " .. argument.doc)
    else
      checked[key] = argument.default
    end
  end
  return checked
end

-- A call with one table of named arguments; `...` is what the deck passed.
function check.call(entry, line, ...)
  local call = { path = entry.path, line = line, later = entry.later }
  local given = ...
  if select("#", ...) ~= 1 or type(given) ~= "table" then
    fail(call, "takes one table of named arguments, written " .. entry.path .. "{ ... }")
  end
  local checked = check.arguments(call, entry.arguments, given, "")
  if entry.one_of then
    local is_given = false
    for _, key in ipairs(entry.one_of) do is_given = is_given or checked[key] ~= nil end
    if not is_given then fail(call, "give at least one of " .. table.concat(entry.one_of, ", ")) end
  end
  if checked.frame and entry.makes ~= "frame" then frames.apply(entry, checked, line) end
  return checked
end

-- A method with one plain argument.
function check.plain(entry, line, ...)
  local call = { path = entry.path, line = line }
  if select("#", ...) ~= 1 then fail(call, "is written " .. entry.write) end
  return types[entry.argument.type](call, entry.argument, (...), entry.argument[1])
end

-- param{ name = number }: the checked numbers.
function check.parameters(line, ...)
  local call = { path = "param", line = line }
  local given = ...
  if select("#", ...) ~= 1 or type(given) ~= "table" then fail(call, "is written param{ mu = 0.2, n = 4 }") end
  for key, value in pairs(given) do
    if type(key) ~= "string" then fail(call, "parameters are named, as in param{ mu = 0.2, n = 4 }") end
    types.number(call, {}, value, key)
  end
  return given
end

return check

-- The words of a deck, made from the schema: constructors and methods that check their arguments and hand them to the
-- native side, which builds the model. Answers the deck's environment and the reader of objects.
local native = ...
local schema = native.module "schema"
local units = native.module "units"
local check = native.module "check"
local environment = native.module "environment"
local command_line = native.module "command_line"
local arithmetic = native.module "arithmetic"
local placement = native.module "placement"
local interfaces = native.module "interfaces"
local bolts = native.module "bolts"
local frames = native.module "frames"
local spectra = native.module "spectra"
local ensembles = native.module "ensembles"
local masses = native.module "masses"

local function fail(line, text, hint) native.fail(line, text .. (hint and "\n    " .. hint or "")) end

local function keys_of(...)
  local keys = {}
  for _, members in ipairs { ... } do
    for key in pairs(members) do keys[#keys + 1] = key end
  end
  return keys
end

local of_motion = {}  -- outputs that need a dynamic step, by their paths
for _, word in ipairs(schema.words) do
  for _, entry in ipairs(word) do of_motion[word.name .. "." .. entry[1]] = entry.of_motion end
end

-- Not a tail call anywhere below: native.line looks for the deck's line through these frames.
local function constructor(entry)
  return function(...)
    local line = native.line()
    local arguments = check.call(entry, line, ...)
    if entry.makes == "interface" then
      local made = interfaces.declare(entry, arguments, line)
      return made
    end
    if entry.makes == "frame" or entry.path == "output.srs" then
      local made
      if entry.makes == "frame" then made = frames.make(entry, arguments, line) else made = spectra.declare(entry, arguments, line) end
      return made
    end
    if entry.is_mass then
      return masses.declare(entry, arguments, line)
    end
    if entry.path == "problem" then
      spectra.leave_out(arguments, of_motion, line)
      masses.join(arguments)
    end
    local other = entry.path == "problem" and command_line.solver(line)
    if other then  -- the deck's own is kept as used
      arguments.solver_of_deck, arguments.solver = arguments.solver, other
    end
    local object = native.make(entry.path, entry.makes, arguments, line)
    if entry.makes == "substructure" then interfaces.note_part(object) end
    if entry.path == "problem" then interfaces.note_problem(arguments.interfaces) end
    return object
  end
end

-- A copy of a substructure under another name, in another place.
local function copied(of, arguments, name, place, line)
  local copy = {}
  for key, value in pairs(arguments) do copy[key] = value end
  copy.name, copy.place = name, placement.shortest(place)
  copy.of = of  -- which is used so
  local part = native.make(select(2, native.kind(of)), "substructure", copy, line)
  interfaces.note_part(part)
  return part
end

-- The substructures, or bolts, of a pattern: the given one, renamed, and copies of it in their places.
local function expanded(entry)
  return function(...)
    local line = native.line()
    local given = check.call(entry, line, ...)
    local is_bolt = bolts.is_bolt(given.of)
    local of = is_bolt and bolts.given(given.of) or native.arguments(given.of)
    if not of.place then
      fail(line, ("%s: '%s' has no place: it is on the faces of other parts"):format(entry.path, of.name), "declare one for each place")
    end
    local turn
    if given.axis then
      turn = placement.rotation(given.axis, given.angle or 2 * math.pi / given.n, given.about)
      if not turn then fail(line, entry.path .. ": 'axis' is zero", "as in axis = { 0, 0, 1 }") end
    else
      turn = placement.translation(given.step)
    end
    if is_bolt then bolts.forget(given.of) else interfaces.forget_part(given.of) end  -- the copies stand for it
    local place, copies = placement.of(of.place), {}
    for i = 1, given.n do
      local name = ("%s[%d]"):format(of.name, i)
      copies[i] = is_bolt and bolts.copy(given.of, name, place, line) or copied(given.of, of, name, place, line)
      place = placement.after(turn, place)
    end
    if is_bolt then copies = bolts.list(copies, of.name) end
    return copies
  end
end

-- A measured face: a function of a place that answers its height (m).
local function scanned(entry)
  return function(...)
    local line = native.line()
    local given = check.call(entry, line, ...)
    local scan, frame = native.scan(given, line), given.frame
    local first, second = given.plane:byte(1) - 119, given.plane:byte(2) - 119  -- 1, 2, 3 of x, y, z
    return function(x, y, z)
      local p = { x, y, z }
      if frame then
        local o = frame.origin
        local d = { x - o[1], y - o[2], z - o[3] }
        for i, axis in ipairs { frame.x, frame.y, frame.z } do p[i] = d[1] * axis[1] + d[2] * axis[2] + d[3] * axis[3] end
      end
      local height = native.height_of(scan, p[first], p[second])
      if not height then
        fail(line, ("%s: '%s' has no point near %s = %g mm, %s = %g mm"):format(entry.path, given.file, given.plane:sub(1, 1), 1e3 * p[first],
          given.plane:sub(2, 2), 1e3 * p[second]), "a place is seen within `smooth` of a point: is `unit`, `plane` or `frame` another?")
      end
      return height
    end
  end
end

local function not_built(path)
  return function() fail(native.line(), ("%s is not built yet in dygita %s"):format(path, native.version)) end
end

local words = {}
for _, word in ipairs(schema.words) do
  local name = word.name
  if word.call then word.call.path = name end
  if word.call and #word == 0 then
    words[name] = constructor(word.call)
  else
    local members = {}
    for _, entry in ipairs(word) do
      entry.path = name .. "." .. entry[1]
      members[entry[1]] = entry.expands and expanded(entry) or entry.is_scan and scanned(entry) or entry.is_bolt and bolts.constructor(entry, check.call) or constructor(entry)
    end
    for _, later in ipairs(word.later or {}) do members[later] = not_built(name .. "." .. later) end
    words[name] = environment.read_only(members, name, word.call and constructor(word.call))
  end
end

local methods = {}
for _, entry in ipairs(schema.methods) do
  entry.path = entry.kind .. ":" .. entry[1]
  methods[entry.kind] = methods[entry.kind] or {}
  methods[entry.kind][entry[1]] = function(self, ...)
    local line = native.line()
    if entry.kind == "history" and type(self) == "function" then self = native.combine("scaled", self, 1, line) end
    if native.kind(self) ~= entry.kind then fail(line, ("%s is called with a colon: %s"):format(entry[1], entry.write)) end
    local checked
    local by_table = entry.arguments and (not entry.argument or type((...)) == "table")
    if by_table then
      checked = check.call(entry, line, ...)
      if entry.unwraps and not checked.seen_from then checked = checked[entry.unwraps] end
    elseif not entry.argument then
      if select("#", ...) > 0 then fail(line, ("%s is written %s"):format(entry[1], entry.write)) end
    else checked = check.plain(entry, line, ...) end
    if entry.path == "ensemble:run" then
      local result = ensembles.run(self, checked, line)
      return result
    end
    local answer = native.call(entry.path, self, checked, line)
    return answer
  end
end

-- f:shifted(t) of a function of time.
arithmetic.of_functions.__index = function(_, key)
  local method = methods.history[key]
  if method then return method end
  fail(native.line(), ("a function has no '%s'"):format(tostring(key)), "is it to be called? a method is written with a colon and its arguments")
end

local function at(self, ...)
  local kind = native.kind(self)
  if kind ~= "series" and kind ~= "data" then
    fail(native.line(), "at is called with a colon: series:at(t) or series:at(step)")
  end
  local value = native.at(self, ...)
  return value
end
methods.series, methods.data = { at = at }, { at = at }

local of_results = { iterations = true, mean_iterations = true, converged = true }

-- What the deck reads from an object: a method, the data of a result, or an argument it was declared with.
local function read(object, key)
  local kind, path, name = native.kind(object)
  local own = methods[kind] or {}
  if own[key] then return own[key] end
  if native.is_data(object) then
    local value = native.read(object, key)
    return value
  end
  local arguments = native.arguments(object)
  local value = arguments[key]
  if value == nil and key == "name" and kind == "mesh" and name ~= "" then return name end
  if value ~= nil and path == "param" then native.note_parameter(key) end
  if type(value) == "table" then return table.move(value, 1, #value, 1, {}) end
  if value ~= nil then return value end
  if kind == "problem" and (native.kind(key) == "output" or of_results[key]) then
    fail(native.line(), ("problem '%s' has no results: it is declared here, and not run"):format(name),
      "its result is what run answers: local result = problem{ ... }:run{}")
  end
  fail(native.line(), ("%s has no '%s'"):format(name ~= "" and ("%s '%s'"):format(kind, name) or path, tostring(key)),
    native.did_you_mean(tostring(key), keys_of(own, arguments)))
end

local function write(object, key)
  local kind, path, name = native.kind(object)
  fail(native.line(), ("%s does not change once declared ('%s' was assigned)"):format(
    name ~= "" and ("%s '%s'"):format(kind, name) or path, tostring(key)), "declare another one")
end

local parameters_line

local function param(...)
  local line = native.line()
  if parameters_line then
    fail(line, ("param is called once in a deck, and was at line %d"):format(parameters_line), "put all parameters there")
  end
  parameters_line = line
  local values = {}
  for key, value in pairs(check.parameters(line, ...)) do values[key] = value end
  for _, setting in ipairs(native.settings) do
    if values[setting.name] == nil then
      fail(line, ("--set %s: the deck has no such parameter"):format(setting.name),
        native.did_you_mean(setting.name, keys_of(values)))
    end
    values[setting.name] = command_line.parameter(setting.name, setting.text)
  end
  local parameters = native.make("param", "parameters", values, line)
  return parameters
end
words.param = param
for _, entry in ipairs(schema.distributions) do words[entry[1]] = ensembles.constructor(entry) end

local globals = {}
for _, members in ipairs { environment.functions, units, words } do
  for name, member in pairs(members) do globals[name] = member end
end

-- What other languages and habits would write.
local habits = {
  True = "write true", False = "write false", None = "write nil", null = "write nil", NULL = "write nil",
  pi = "write math.pi", sin = "write math.sin", cos = "write math.cos", exp = "write math.exp", sqrt = "write math.sqrt",
  abs = "write math.abs", max = "write math.max", floor = "write math.floor",
  g = "write g0 for the standard acceleration of gravity, 9.80665 m/s^2", G = "write g0 for the standard acceleration of gravity",
  cm = "write 10*mm", inch = "write 25.4*mm", bar = "write 0.1*MPa", psi = "write 6895, in Pa", ksi = "write 6.895*MPa",
  degrees = "write deg", rad = "angles are in radians: write the number alone", min = "write math.min",
}
for _, name in ipairs { "m", "s", "N", "Pa", "kg", "J" } do
  habits[name] = ("numbers are in SI units: write 5 for 5 %s"):format(name)
end

local function undefined(name)
  local line = native.line()
  if environment.refused[name] then
    fail(line, ("'%s' is not there in a deck"):format(name),
      "a deck reaches no file, system or program; files are read through mesh.gmsh, mesh.step, mesh.abaqus, mesh.nastran and history.file")
  end
  if habits[name] then fail(line, ("'%s' is not defined"):format(name), habits[name]) end
  local near_by = native.locals()  -- first: of two names as near, the deck's own
  table.move(keys_of(globals), 1, #keys_of(globals), #near_by + 1, near_by)
  local best = native.closest_name(name, near_by)
  if best ~= "" then fail(line, ("'%s' is not defined"):format(name), ("did you mean '%s'?"):format(best)) end
  fail(line, ("'%s' is not defined"):format(name), native.did_you_mean("", keys_of(words, units)))
end

return {
  read = read,
  write = write,
  operators = arithmetic.of_objects,
  operators_of_functions = arithmetic.of_functions,
  environment = setmetatable({}, {
    __index = function(_, name)
      local member = globals[name]
      if member ~= nil then return member end
      undefined(tostring(name))
    end,
    __newindex = function(_, name)
      name = tostring(name)
      if globals[name] ~= nil then
        fail(native.line(), ("'%s' is a word of the deck and cannot be assigned"):format(name),
          ("write local %s = ... to use the name for something else"):format(name))
      end
      fail(native.line(), ("'%s' is assigned and not declared"):format(name), ("write local %s = ..."):format(name))
    end,
    __metatable = false,
  }),
}

-- Frames: an origin and three axes at right angles, in which a deck writes places and directions.
local native = ...
local placement = native.module "placement"
local environment = native.module "environment"
local frames = {}

local made = setmetatable({}, { __mode = "k" })  -- twelve numbers, as of a placement, by the frame
function frames.is_frame(value) return made[value] ~= nil end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
local function cross(a, b) return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] } end
local function sum(a, p, b, q) return { p * a[1] + q * b[1], p * a[2] + q * b[2], p * a[3] + q * b[3] } end
local function axis_of(p, j) return { p[j], p[3 + j], p[6 + j] } end
local function origin_of(p) return { p[10], p[11], p[12] } end
local function unit(a)
  local length = math.sqrt(dot(a, a))
  return length > 0 and sum(a, 1 / length, a, 0) or nil
end

-- A vector of a frame as a deck reads it: another one would be printed and not used.
local function fixed(vector, name)
  return setmetatable({}, {
    __index = vector,
    __len = function() return 3 end,
    __pairs = function() return next, vector, nil end,
    __newindex = function() native.fail(native.line(), ("%s of a frame cannot be changed\n    make another frame: frame{ origin = ..., axis = ... }"):format(name)) end,
    __metatable = false,
  })
end

function frames.make(entry, given, line)
  local function refuse(text, hint) native.fail(line, entry.path .. ": " .. text .. "\n    " .. hint) end
  local z, x = unit(given.axis), given.x and unit(given.x)
  if not z then refuse("'axis' is zero", "as in axis = { 0, 0, 1 }") end
  if given.x and not x then refuse("'x' is zero", "as in x = { 1, 0, 0 }") end
  x = x or (math.abs(z[1]) < 0.999999 and { 1, 0, 0 } or { 0, 1, 0 })
  local across = sum(x, 1, z, -dot(x, z))
  if dot(across, across) < 1e-12 then refuse("'x' is along 'axis'", "it is a direction across the axis, or aslant of it") end
  across = unit(across)
  local c, s = math.cos(given.angle), math.sin(given.angle)
  if given.angle ~= 0 then across = unit(sum(across, c, cross(z, across), s)) end
  local y, o = cross(z, across), given.origin
  local p = { across[1], y[1], z[1], across[2], y[2], z[2], across[3], y[3], z[3], o[1], o[2], o[3] }
  if given.frame then p = placement.after(made[given.frame], p) end
  local frame = environment.read_only({
    x = fixed(axis_of(p, 1), "x"), y = fixed(axis_of(p, 2), "y"), z = fixed(axis_of(p, 3), "z"), origin = fixed(origin_of(p), "origin"),
  }, "a frame")
  made[frame] = p
  return frame
end

local function turned(p, v) return sum(sum(axis_of(p, 1), v[1], axis_of(p, 2), v[2]), 1, axis_of(p, 3), v[3]) end
local function coordinates(p, x, y, z)
  local from = { x - p[10], y - p[11], z - p[12] }
  return dot(axis_of(p, 1), from), dot(axis_of(p, 2), from), dot(axis_of(p, 3), from)
end

-- An argument in the axes of the deck, by what the schema says that it is.
local turns = {
  direction = turned,
  point = function(p, x) return sum(turned(p, x), 1, origin_of(p), 1) end,
  place = function(p, place) return placement.shortest(placement.after(p, placement.of(place))) end,
  -- Along a normal that is turned already.
  height = function(p, at, given) return given.normal and unit(given.normal) and at + dot(origin_of(p), unit(given.normal)) or at end,
  directions = function(p, list)
    local answer = {}
    for i, item in ipairs(list) do answer[i] = { item[1], turned(p, item[2]) } end
    return answer
  end,
  ["function"] = function(p, f)
    return function(x, y, z)
      local answer = f(coordinates(p, x, y, z))
      return answer
    end
  end,
  -- Moments xx, yy, zz, and xy, xz, yz where they are given.
  inertia = function(p, of)
    if #of ~= 3 and #of ~= 6 then return of end
    local xy, xz, yz = of[4] or 0, of[5] or 0, of[6] or 0
    local rows = { { of[1], xy, xz }, { xy, of[2], yz }, { xz, yz, of[3] } }
    local function entry(i, j)
      local total = 0
      for a = 1, 3 do
        for b = 1, 3 do total = total + p[3 * i - 3 + a] * rows[a][b] * p[3 * j - 3 + b] end
      end
      return total
    end
    return { entry(1, 1), entry(2, 2), entry(3, 3), entry(1, 2), entry(1, 3), entry(2, 3) }
  end,
  corner = function(_, x) return x end,
  component = function(_, value) return value end,
  motion = function(_, value) return value end,
  held = function(_, value) return value end,
  own_axes = function(_, value) return value end,
}

-- A box in the frame is none along the axes of the deck.
local function turn_box(p, given)
  local low, high, where = given.low, given.high, given.where
  local by = 1e-8
  for i = 1, 3 do by = math.max(by, 1e-6 * math.abs(low[i]), 1e-6 * math.abs(high[i])) end
  given.low, given.high, given.box = nil, nil, { low[1], low[2], low[3], high[1], high[2], high[3] }
  given.where = function(x, y, z)
    local at = { coordinates(p, x, y, z) }
    for i = 1, 3 do
      if at[i] < low[i] - by or at[i] > high[i] + by then return false end
    end
    local answer = where == nil or where(x, y, z)
    return answer
  end
end

local function added(a, b, line)
  if type(a) == "number" and type(b) == "number" then return a + b end
  if type(a) == "number" then a, b = b, a end
  local total = native.combine("sum", a, b, line)
  return total
end

local function turn_components(p, given, line)
  local values = { given.x, given.y, given.z }
  for i, key in ipairs { "x", "y", "z" } do
    local total
    for j = 1, 3 do
      local share, term = p[3 * i - 3 + j], values[j]
      if term ~= nil and math.abs(share) > 1e-15 then
        if type(term) == "number" then term = share * term else term = native.combine("scaled", term, share, line) end
        total = total == nil and term or added(total, term, line)
      end
    end
    given[key] = total
  end
end

-- Axes of the deck along which nodes are held or driven that are so along some axes of the frame. Where the deck's axes
-- span more than these, nodes would be free aslant of them.
local function axes_of_deck(entry, p, is_given, line)
  local is_on, n_given, n_on = {}, 0, 0
  for i = 1, 3 do
    for j = 1, 3 do is_on[i] = is_on[i] or is_given[j] and math.abs(p[3 * i - 3 + j]) > 1e-12 end
    n_given, n_on = n_given + (is_given[i] and 1 or 0), n_on + (is_on[i] and 1 or 0)
  end
  if n_on > n_given then
    native.fail(line, ("%s: along these axes of the frame alone nodes would stay free aslant of the deck's axes"):format(entry.path)
      .. "\n    give x, y and z that lie in one plane of the deck, or all of them; one direction aslant is held on a plane face by support.symmetry")
  end
  return is_on
end

local function turn_motion(entry, p, given, line)
  local is_on = axes_of_deck(entry, p, { given.x ~= nil, given.y ~= nil, given.z ~= nil }, line)
  turn_components(p, given, line)
  for i, key in ipairs { "x", "y", "z" } do
    if not is_on[i] then given[key] = nil end
  end
end

-- What a call means that gives no directions.
function frames.axes() return { { "x", { 1, 0, 0 } }, { "y", { 0, 1, 0 } }, { "z", { 0, 0, 1 } } } end

-- Turns what a call says in its `frame` into the axes of the deck, in place.
function frames.apply(entry, given, line)
  local p, names, kinds = made[given.frame], {}, {}
  if entry.tells_frame then given.seen_from = p end  -- messages then say where things are in it
  if not entry.keeps_frame then given.frame = nil end
  for _, argument in ipairs(entry.arguments) do
    local key, kind = argument[1], argument.in_frame
    if kind then names[#names + 1] = "'" .. key .. "'" end
    if kind == "directions" and given[argument.with] ~= nil and given[key] == nil then given[key] = frames.axes() end
    if kind and given[key] ~= nil then
      given[key] = turns[kind](p, given[key], given)
      kinds[kind] = true
    end
  end
  if not next(kinds) and not entry.keeps_frame then
    native.fail(line, ("%s: 'frame' has no effect without %s"):format(entry.path, table.concat(names, ", ")))
  end
  if kinds.corner and given.low and given.high then turn_box(p, given) end
  if kinds.component then turn_components(p, given, line) end
  if kinds.motion then turn_motion(entry, p, given, line) end
  if kinds.own_axes then given.axes = { table.unpack(p, 1, 9) } end
  if kinds.held then
    local is_on = axes_of_deck(entry, p, { given.x, given.y, given.z }, line)
    given.x, given.y, given.z = is_on[1] or false, is_on[2] or false, is_on[3] or false
  end
end

return frames

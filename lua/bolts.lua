-- Standard hexagon bolts: their dimensions, and the parts, faces and interfaces that a deck gets of one.
local native = ...
local placement = native.module "placement"
local interfaces = native.module "interfaces"
local holes = native.module "holes"
local bolts = {}

-- In mm: pitch (ISO 261), height of the head and width across flats (ISO 4014, 4017), height of the nut (ISO 4032,
-- largest), inner and outer diameter and thickness of the washer (ISO 7089).
local sizes = {
  M3 = { 3, pitch = 0.5, head = 2, flats = 5.5, nut = 2.4, washer = { 3.2, 7, 0.5 } },
  M4 = { 4, pitch = 0.7, head = 2.8, flats = 7, nut = 3.2, washer = { 4.3, 9, 0.8 } },
  M5 = { 5, pitch = 0.8, head = 3.5, flats = 8, nut = 4.7, washer = { 5.3, 10, 1 } },
  M6 = { 6, pitch = 1, head = 4, flats = 10, nut = 5.2, washer = { 6.4, 12, 1.6 } },
  M8 = { 8, pitch = 1.25, head = 5.3, flats = 13, nut = 6.8, washer = { 8.4, 16, 1.6 } },
  M10 = { 10, pitch = 1.5, head = 6.4, flats = 16, nut = 8.4, washer = { 10.5, 20, 2 } },
  M12 = { 12, pitch = 1.75, head = 7.5, flats = 18, nut = 10.8, washer = { 13, 24, 2.5 } },
  M14 = { 14, pitch = 2, head = 8.8, flats = 21, nut = 12.8, washer = { 15, 28, 2.5 } },
  M16 = { 16, pitch = 2, head = 10, flats = 24, nut = 14.8, washer = { 17, 30, 3 } },
  M20 = { 20, pitch = 2.5, head = 12.5, flats = 30, nut = 18, washer = { 21, 37, 3 } },
  M24 = { 24, pitch = 3, head = 15, flats = 36, nut = 21.5, washer = { 25, 44, 4 } },
}
bolts.sizes = { "M3", "M4", "M5", "M6", "M8", "M10", "M12", "M14", "M16", "M20", "M24" }

-- The diameter of the tensile stress area of ISO 898-1: between the pitch diameter and that of the core.
local function stress_diameter(size) return size[1] - 0.9382 * size.pitch end

local made = setmetatable({}, { __mode = "k" })  -- what a bolt was declared with, by the bolt
function bolts.is_bolt(value) return made[value] ~= nil end

local function answering(fields, what)
  return { __metatable = false, __index = function(_, key)
    if math.type(key) == "integer" then return nil end
    if fields[key] ~= nil then return fields[key] end
    local known = {}
    for name in pairs(fields) do known[#known + 1] = name end
    native.fail(native.line(), ("%s has no '%s'\n    %s"):format(what, tostring(key), native.did_you_mean(tostring(key), known)))
  end, __newindex = function(_, key)
    native.fail(native.line(), ("%s does not change once declared ('%s' was assigned)"):format(what, tostring(key)))
  end }
end

-- Meshes of the parts of a bolt around z; z = 0 is the upper face of what it clamps.
local function meshes_of(given, line)
  local mm, size = 1e-3, sizes[given.size]
  local diameter = (given.shank == "nominal" and size[1] or stress_diameter(size)) * mm
  local washer = given.washer and size.washer[3] * mm or 0
  local half = 0.5 * given.grip + washer
  local function mesh(arguments)
    arguments.around, arguments.order = given.around, given.order
    local made_mesh = native.make("bolt.mesh", "mesh", arguments, line)
    return made_mesh
  end
  local function of_end(height, bearing, above)
    return mesh{ diameter = diameter, flats = size.flats * mm, height = height * mm, shank = half, bearing = bearing, above = above }
  end
  local function of_washer(low)
    return mesh{ inner = size.washer[1] * mm, outer = size.washer[2] * mm, low = low, thickness = washer }
  end
  local meshes = { head = of_end(size.head, washer, true), nut = of_end(size.nut, -given.grip - washer, false), diameter = diameter }
  if given.washer then meshes.upper, meshes.lower = of_washer(0), of_washer(-given.grip - washer) end
  return meshes
end

-- `like`: the bolt whose copy this is.
local function declare(given, meshes, line, like)
  local name, list, joined = given.name, {}, {}
  local twin = like and made[like]
  local function part(role, mesh)
    local object = native.make("substructure", "substructure", { name = name .. " " .. role, mesh = mesh, material = given.material,
      place = given.place, velocity = { 0, 0, 0 }, integration = given.integration, of = twin and twin.roles[role] }, line)
    interfaces.note_part(object)
    list[#list + 1] = object
    return object
  end
  local function face(of, group)
    local object = native.call("substructure:face", of, group, line)
    return object
  end
  local function join(word, as, one, other, law)
    law.name, law.between, law.of = as, { one, other }, twin and twin.interfaces[#joined + 1]
    local object = native.make("interface." .. word, "interface", law, line)
    interfaces.note(object)
    joined[#joined + 1] = object
    return object
  end
  local roles = {}
  for _, role in ipairs { "head", "nut", "upper", "lower" } do
    local called = role == "upper" and "washer 1" or role == "lower" and "washer 2" or role
    if meshes[role] then roles[role] = part(called, meshes[role]); roles[called] = roles[role] end
  end
  local head, nut, upper, lower = roles.head, roles.nut, roles.upper, roles.lower
  local law = given.yield and { yield = given.yield, hardening = given.hardening, compression = false } or {}
  local shank = join(given.yield and "plastic" or "bonded", name, face(nut, "cut"), face(head, "cut"), law)
  if upper then
    join("contact", name .. " head/washer", face(upper, "upper"), face(head, "bearing"), { friction = given.friction, gap = 0, closed = false })
    join("contact", name .. " nut/washer", face(nut, "bearing"), face(lower, "lower"), { friction = given.friction, gap = 0, closed = false })
  end
  local fields = {
    name = name, parts = list, interfaces = joined, shank = shank, head = head, nut = nut, washers = { upper, lower },
    upper = upper and face(upper, "lower") or face(head, "bearing"), lower = lower and face(lower, "upper") or face(nut, "bearing"),
    grip = given.grip, top = face(head, "end"), tip = face(nut, "end"), diameter = meshes.diameter, area = math.pi / 4 * meshes.diameter ^ 2,
  }
  local bolt = setmetatable({}, answering(fields, ("bolt '%s'"):format(name)))
  made[bolt] = { given = given, meshes = meshes, roles = roles, parts = list, interfaces = joined }
  return bolt
end

local function check_given(entry, given, line)
  if given.hardening ~= 0 and not given.yield then
    native.fail(line, entry.path .. ": 'hardening' goes with 'yield', which is missing")
  end
  if given.around % 12 ~= 0 then
    native.fail(line, ("%s: 'around' = %d is not a multiple of 12"):format(entry.path, given.around)
      .. "\n    hexagon and square grid have their corners at nodes: 12, 24, 36, ...")
  end
end

-- The bolt's z along `towards`, its z = 0 at `head`; its corners turn with the axes of `frame`, nil: the deck's.
local function place_at(head, towards, frame)
  local from = placement.translation(head)
  if frame then
    local x, y, z = frame.x, frame.y, frame.z
    from = { x[1], y[1], z[1], x[2], y[2], z[2], x[3], y[3], z[3], head[1], head[2], head[3] }
    towards = holes.along_axes(frame, towards)
  end
  local turn
  if towards[3] < -0.9999999 then
    turn = placement.rotation({ 1, 0, 0 }, math.pi, { 0, 0, 0 })
  else
    turn = placement.rotation({ -towards[2], towards[1], 0 }, math.acos(math.min(1, towards[3])), { 0, 0, 0 })
  end
  return placement.shortest(turn and placement.after(from, turn) or from)
end

-- One bolt for each hole through the parts; those of one grip are copies of the first.
local function through(entry, given, line)
  local list, first = {}, {}
  local texts, count = {}, {}
  for i, hole in ipairs(holes.through(given, sizes[given.size][1] * 1e-3, entry.path, line)) do
    local own = {}
    for key, value in pairs(given) do own[key] = value end
    own.name, own.place = ("%s[%d]"):format(given.name, i), place_at(hole.head, hole.towards, given.frame)
    own.grip = math.floor(hole.grip * 1e7 + 0.5) / 1e7  -- round-off of the file makes no other bolt
    local like = first[own.grip]
    list[i] = declare(own, like and made[like].meshes or meshes_of(own, line), line, like)
    first[own.grip] = like or list[i]
    local text = ("grip %.4g mm through %s"):format(own.grip * 1e3, holes.parts_of(hole, given.parts))
    if not count[text] then texts[#texts + 1] = text end
    count[text] = (count[text] or 0) + 1
  end
  native.say(("%s '%s': %d %s bolt%s"):format(entry.path, given.name, #list, given.size, #list > 1 and "s" or ""))
  for i, text in ipairs(texts) do
    if i > 12 then
      native.say(("  and %d more"):format(#texts - 12))
      break
    end
    native.say(("  %d with %s"):format(count[text], text))
  end
  return bolts.list(list, given.name)
end

function bolts.constructor(entry, call)
  return function(...)
    local line = native.line()
    local given = call(entry, line, ...)
    check_given(entry, given, line)
    local bolt
    if entry.is_through then bolt = through(entry, given, line) else bolt = declare(given, meshes_of(given, line), line) end
    return bolt
  end
end

-- The i-th bolt of a pattern.
function bolts.copy(bolt, name, place, line)
  local given = {}
  for key, value in pairs(made[bolt].given) do given[key] = value end
  given.name, given.place = name, placement.shortest(place)
  local copy = declare(given, made[bolt].meshes, line, bolt)
  return copy
end

function bolts.given(bolt) return made[bolt].given end

-- The first bolt stands for its copies: what it declared is theirs.
function bolts.forget(bolt)
  for _, part in ipairs(made[bolt].parts) do interfaces.forget_part(part) end
  for _, interface in ipairs(made[bolt].interfaces) do interfaces.forget(interface) end
end

-- A list of bolts that answers what all of them have, too.
function bolts.list(copies, name)
  local fields = { parts = {}, interfaces = {}, shanks = {} }
  for _, bolt in ipairs(copies) do
    for _, key in ipairs { "parts", "interfaces" } do
      for _, object in ipairs(bolt[key]) do table.insert(fields[key], object) end
    end
    table.insert(fields.shanks, bolt.shank)
  end
  return setmetatable(copies, answering(fields, ("the list of bolts '%s'"):format(name)))
end

return bolts

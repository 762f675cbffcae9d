-- ring_sector.lua -- one sector of a ring of eight against the whole ring: interface.cyclic.
--
--        .   rib    .          each sector (cut at the dots): a base of alloy (r 30-50 mm, 10 mm high) of two wedges, in a skin
--        .  _____   . |        of steel (r 50-53 mm), with a rib on it, off its middle, that is pressed on; the bore is blown up
--        . |_____|  . | skin
--        .   base   . |
--
-- Run        dygita run decks/verification/ring_sector.lua        --set whole=1 (the ring prints the same figures)
--            --set fine=3 (cells of the base across, on its left half alone: meshes of the cut faces differ)
--            --set joint=1 (a bonded rib) --set order=2 --set free=1 (held along z alone) --set shock=0 (static alone)
-- See        out/ring_sector/base/ring_sector.pvd
--            --set swap=1 (the cut faces of the base in the other order: the same figures)
--            --set modes=6 (those in which all sectors move alike)
-- Expect     displacements, spectra and modes of the ring, to the tolerance of the iteration
-- Read next  manual/howto/interfaces.md
-- Mesh       meshes/wedge.geo

local p = param{ whole = 0, n = 8, across = 2, fine = 0, joint = 0, order = 1, free = 0, shock = 1, modes = 0, swap = 0 }
local n, sector = math.tointeger(p.n), 360 / p.n
local axis = { 0, 0, 1 }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping_ratio = 0.01, damping_frequency = 10*kHz }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.33, density = 2700, damping_ratio = 0.01, damping_frequency = 10*kHz }

local parts, joints, base, skin, rib, cut, cut_of_skin = {}, {}, {}, {}, {}, {}, {}
local meshes = {}
local function wedge(name, i, material, from, to, inner, outer, low, high, across, around, up)
  meshes[name] = meshes[name] or mesh.gmsh{ file = "../../meshes/wedge.geo", order = p.order,
    set = { inner = inner, outer = outer, low = low, high = high, from = from * sector, to = to * sector, n_radial = across, n_around = around, n_high = up } }:volume "wedge"
  local part = substructure{ name = name .. " " .. i, material = material, mesh = meshes[name], place = { rotate = { axis = axis, angle = (i - 1) * sector * deg } } }
  table.insert(parts, part)
  return part
end
local function join(kind, name, a, b, rest)
  local all = { name = name, between = { a, b } }
  for key, value in pairs(rest or {}) do all[key] = value end
  table.insert(joints, interface[kind](all))
  return joints[#joints]
end

-- The base of one sector is two wedges, which may differ in their meshes.
local last = p.whole == 1 and n or 1
for i = 1, last do
  local right = wedge("base right", i, alloy, 0, 0.5, 30*mm, 50*mm, 0, 10*mm, p.across, 4, 2)
  local left = wedge("base left", i, alloy, 0.5, 1, 30*mm, 50*mm, 0, 10*mm, p.fine > 0 and p.fine or p.across, 4, 2)
  skin[i] = wedge("skin", i, steel, 0, 1, 50*mm, 53*mm, 0, 10*mm, 1, 8, 2)
  rib[i] = wedge("rib", i, steel, 0.25, 0.5, 35*mm, 45*mm, 10*mm, 25*mm, 2, 2, 3)
  base[i] = { right = right, left = left }
  join("bonded", "middle " .. i, right:face "left", left:face "right")
  join("bonded", "rim right " .. i, right:face "outer", skin[i], { within = 0.1*mm })
  join("bonded", "rim left " .. i, left:face "outer", skin[i], { within = 0.1*mm })
  if p.joint == 1 then join("bonded", "foot " .. i, right:face "top", rib[i]:face "bottom")
  else join("contact", "foot " .. i, right:face "top", rib[i]:face "bottom", { friction = 0.2 }) end
end
if p.whole == 1 then
  for i = 1, n do
    cut[i] = join("bonded", "cut " .. i, base[i].left:face "left", base[i % n + 1].right:face "right")
    cut_of_skin[i] = join("bonded", "cut of skin " .. i, skin[i]:face "left", skin[i % n + 1]:face "right")
  end
else
  local left, right = base[1].left:face "left", base[1].right:face "right"
  if p.swap == 1 then left, right = right, left end
  cut[1] = join("cyclic", "cut 1", left, right, { axis = axis, n = n })
  cut_of_skin[1] = join("cyclic", "cut of skin 1", skin[1]:face "left", skin[1]:face "right", { axis = axis, n = n })
end

local function all(of, face) local list = {} for i = 1, last do list[i] = of(i):face(face) end return list end
local pressed = load.pressure{ on = all(function(i) return rib[i] end, "top"), history = 20*MPa }
local blown = load.pressure{ on = all(function(i) return base[i].right end, "inner"), history = 5*MPa }
local bottom = all(function(i) return skin[i] end, "bottom")
local table_ = p.free == 1 and support.held{ name = "table", on = bottom, z = true } or support.fixed{ name = "table", on = bottom }
local press = step.static{ name = "press", increments = 2, loads = { pressed, blown } }
local shock = p.shock == 1 and step.dynamic{ name = "shock", after = press, duration = 0.2*ms, dt = 2*us, loads = { pressed, blown,
  load.base_acceleration{ on = table_, direction = axis, history = history.half_sine{ peak = 20000, duration = 0.1*ms } } } }

local tip = rib[1]:where(function(x, y, z) return near(z, 25*mm) and near(math.sqrt(x^2 + y^2), 45*mm) and near(math.atan(y, x), 0.25 * sector * deg) end)
local wall = base[1].left:where(function(x, y, z) return near(z, 0) and near(math.sqrt(x^2 + y^2), 30*mm) and near(math.atan(y, x), sector * deg) end)
local function at(name, on, quantity) return output.history{ name = name, on = on, quantity = quantity } end
local outputs = { at("tip", tip, "displacement"), at("wall", wall, "displacement"), output.resultant{ name = "cut", on = { cut[1], cut_of_skin[1] } },
  output.vtk{ frames = 1 } }
if p.shock == 1 then table.insert(outputs, output.srs{ name = "spectrum", on = tip, from = 500, to = 50*kHz }) end
if p.modes > 0 then table.insert(outputs, output.modes{ name = "modes", n = p.modes }) end
local result = problem{ name = "ring_sector", substructures = parts, interfaces = joints, supports = { table_ }, outputs = outputs,
  steps = p.shock == 1 and { press, shock } or { press } }:run{}
for i, name in ipairs{ "tip", "wall" } do
  local u = result[outputs[i]]
  print(("%s at the end (um): %.6f %.6f %.6f"):format(name, u.x[#u.x] / um, u.y[#u.y] / um, u.z[#u.z] / um))
end

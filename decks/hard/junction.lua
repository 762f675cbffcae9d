-- junction.lua -- four blocks meet along an edge and a fifth stands on all of them: contact, friction, bonds in one node.
--
--        +---------+   -> shove
--        |   lid   |
--     +--+--+   +--+--+
--     | a b |   contact: lid on each, a|b and c|d; bonded: a-c and b-d
--     | c d |   wall, friction below
--     +-----+
--
-- Run        dygita run decks/hard/junction.lua                --set friction=1     --set bonded=0 (contact everywhere)
-- See        out/junction/base/junction.pvd
-- Expect     converged or said not to; forces of the lid's contacts and weights balance; no energy created.
--            Measured: converged, 22 iterations (33 with contact everywhere), force to 1e-9, none created
-- Read next  one_element.lua

local p = param{ friction = 0.3, n = 2, bonded = 1, speed = 2 }

local s = 6*mm
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, x, y, z, size, cells, velocity)
  return substructure{
    name = name, material = alloy, velocity = velocity,
    mesh = mesh.box{ origin = { x, y, z }, size = size, cells = cells },
  }
end
local n, still = p.n, { 0, 0, 0 }
local a = block("a", 0, s, 0, { s, s, s }, { n, n, n }, still)
local b = block("b", s, s, 0, { s, s, s }, { n, n, n }, still)
local c = block("c", 0, 0, 0, { s, s, s }, { n, n, n }, still)
local d = block("d", s, 0, 0, { s, s, s }, { n, n, n }, still)
local lid = block("lid", 0, 0, s, { 2*s, 2*s, s }, { 2*n, 2*n, n }, { p.speed, 0.3 * p.speed, -p.speed })
local function touch(name, face_1, face_2)
  return interface.contact{ name = name, between = { face_1, face_2 }, friction = p.friction }
end
local function tie(name, face_1, face_2)
  if p.bonded == 0 then return touch(name, face_1, face_2) end
  return interface.bonded{ name = name, between = { face_1, face_2 } }
end
local seats = {}
for i, part in ipairs{ a, b, c, d } do seats[i] = touch("seat_" .. part.name, part:face "zmax", lid:face "zmin") end
local others = {
  touch("ab", a:face "xmax", b:face "xmin"), touch("cd", c:face "xmax", d:face "xmin"),
  tie("ca", c:face "ymax", a:face "ymin"), tie("db", d:face "ymax", b:face "ymin"),
}
local all = { table.unpack(seats) }
for _, other in ipairs(others) do all[#all + 1] = other end
local floor = support.wall{
  name = "floor", on = { a:face "zmin", b:face "zmin", c:face "zmin", d:face "zmin" }, friction = p.friction,
}
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = lid:face "zmax", history = 20*MPa } } }
local hit = step.dynamic{
  name = "hit", after = press, duration = 60*us, dt = 0.5*us, loads = { load.pressure{ on = lid:face "zmax", history = 20*MPa } },
}
local lids, energy = output.resultant{ name = "lids", on = seats }, output.energy{}
local result = problem{
  name = "junction", substructures = { a, b, c, d, lid }, interfaces = all, supports = { floor },
  steps = { press, hit }, outputs = { lids, energy, output.vtk{ frames = 30 } },
  solver = solver.latin{ mass = "lumped" },  -- of all five: by itself the program tunes that of the lid alone
}:run{}
local created, largest = 0, 0
for i = 1, #result[energy].scheme do
  created = math.max(created, -result[energy].scheme[i])
  largest = math.max(largest, result[energy].kinetic[i] + result[energy].strain[i] + math.abs(result[energy].loads[i]))
end
local F = 20*MPa * (2*s)^2
print(("lid on its four seats after the static step, error: %.3e"):format(result[lids].normal:at(press) / -F - 1))
print(("energy created: %.2e %% of the largest; %.1f iterations: %s"):format(
  100 * created / largest, result.mean_iterations, result.converged and "converged" or "NOT converged"))

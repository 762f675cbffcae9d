-- grazing.lua -- a block is shaken on its wall so that it parts and lands a hundred times, sliding a little each time.
--
--         ^ v  p(t), harmonic, both ways
--      +-------+
--      | block |  --> steady sideways pull
--      +-------+
--     ///////////  friction
--
-- Run        dygita run decks/hard/grazing.lua                 --set cycles=1000
-- See        out/grazing/base/sole.csv                         normal, open_area
-- Expect     at least as many spells of contact as cycles; energy balance closed, none created (0.1 % at most).
--            Measured: 159 spells in 100 cycles, none created, 45 % lost at impacts (coarse mesh)
-- Read next  never_closes.lua

local p = param{ cycles = 100, friction = 0.3, n = 3, mean = 5*MPa }

local side, period = 10*mm, 40*us
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local block = substructure{ name = "block", material = alloy, mesh = mesh.box{ size = { side, side, side }, cells = { p.n, p.n, p.n } } }
local wall = support.wall{ name = "wall", on = block:face "zmin", friction = p.friction }
local function wave(t) return p.mean * (1 + 1.5 * math.sin(2 * math.pi * t / period)) end
local shake = step.dynamic{
  name = "shake", duration = p.cycles * period, dt = period / 40,
  loads = { load.pressure{ on = block:face "zmax", history = wave }, load.traction{ on = block:face "xmax", x = 0.05*MPa } },
}
local sole, energy = output.joint{ name = "sole", on = wall }, output.energy{}
local way = output.history{ name = "way", on = block:face "zmax", quantity = "displacement" }
local outputs, corners = { sole, energy, way }, {}
for i, at in ipairs{ { 0, 0 }, { side, 0 }, { 0, side }, { side, side } } do
  local corner = block:where(function(x, y, z) return near(x, at[1]) and near(y, at[2]) and near(z, 0) end)
  corners[i] = output.history{ name = "corner_" .. i, on = corner, quantity = "velocity", direction = { 0, 0, 1 } }
  outputs[#outputs + 1] = corners[i]
end
local result = problem{
  name = "grazing", substructures = { block }, supports = { wall }, steps = { shake }, outputs = outputs,
}:run{}

local spells, touching, created, largest = 0, false, 0, 0
local normal = result[sole].normal
for i = 1, #normal do
  local now = normal[i] < 0
  if now and not touching then spells = spells + 1 end
  touching = now
end
local scheme, kinetic, strain, work = result[energy].scheme, result[energy].kinetic, result[energy].strain, result[energy].loads
for i = 1, #scheme do
  created = math.max(created, -scheme[i])
  largest = math.max(largest, kinetic[i] + strain[i] + math.abs(work[i]))
end
local fastest = 0
for _, corner in ipairs(corners) do fastest = math.max(fastest, -result[corner].min) end
print(("fastest landing of a corner, m/s: %.3f"):format(fastest))
print(("spells of contact: %d in %d cycles"):format(spells, p.cycles))
print(("energy created: %.2e %% of the largest, slid %.1f um, highest %.2f mm, %.1f iterations: %s"):format(
  100 * created / largest, result[sole].slip.max / um, result[way].z.max / mm, result.mean_iterations,
  result.converged and "converged" or "NOT converged"))

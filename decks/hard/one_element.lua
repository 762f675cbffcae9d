-- one_element.lua -- every body is one element: thrown on a wall, on one another, stacked, bolted and pulled.
--
--      +--+
--      +--+  c        all one hex8 each
--      +--+
--      +--+  b
--     //////
--
-- Run        dygita run decks/hard/one_element.lua             --set count=8
-- See        out/one_element/base/one_element.pvd
-- Expect     converged, no energy created, at rest under gravity after the static step. Measured: weight to rounding, 2e-17 m/s at rest, 4 iterations
-- Read next  early_yield.lua

local p = param{ count = 3, friction = 0.3 }

local s = 5*mm
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local parts, seats = {}, {}
for k = 1, p.count do
  parts[k] = substructure{
    name = "brick" .. k, material = alloy, velocity = { 0, 0, 0 },
    mesh = mesh.box{ origin = { 0, 0, (k - 1) * s }, size = { s, s, s }, cells = { 1, 1, 1 } },
  }
  if k > 1 then
    seats[#seats + 1] = interface.contact{
      name = "seat" .. k, between = { parts[k - 1]:face "zmax", parts[k]:face "zmin" }, friction = p.friction,
    }
  end
end
local wall = support.wall{ name = "wall", on = parts[1]:face "zmin", friction = p.friction }
local weight = load.gravity{ z = -1e4 }
local settle = step.static{ name = "settle", loads = { weight } }
local rest = step.dynamic{ name = "rest", after = settle, duration = 50*us, dt = 0.5*us, loads = { weight } }
local jolt = step.dynamic{
  name = "jolt", after = rest, duration = 100*us, dt = 0.5*us,
  loads = { weight, load.pressure{ on = parts[p.count]:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = 10*us } },
            load.traction{ on = parts[p.count]:face "xmax", x = history.half_sine{ peak = 20*MPa, duration = 10*us } } },
}
local push, energy = output.resultant{ name = "push", on = wall }, output.energy{}
local motion = output.history{ name = "motion", on = parts[p.count]:face "zmax", quantity = "velocity" }
local result = problem{
  name = "one_element", substructures = parts, interfaces = seats, supports = { wall }, steps = { settle, rest, jolt },
  outputs = { push, energy, motion, output.vtk{ frames = 20 } },
}:run{}
local F, resting = 2700 * s^3 * p.count * 1e4, 0
for i = 1, 100 do
  resting = math.max(resting, math.abs(result[motion].x[i + 1]), math.abs(result[motion].y[i + 1]), math.abs(result[motion].z[i + 1]))
end
print(("weight on the wall, error: %.3e; velocity at rest: %.3e m/s"):format(result[push].normal:at(settle) / -F - 1, resting))
print(("%.1f iterations: %s"):format(result.mean_iterations, result.converged and "converged" or "NOT converged"))

-- long_run.lua -- two stacked blocks bounce and rub on their wall for as many steps as you like.
--
--      +-------+
--      | upper |      gravity, a sideways velocity
--      +-------+ <--- contact, friction
--      | lower |
--      +-------+
--     ///////////     wall, friction
--
-- Run        dygita run decks/hard/long_run.lua                --set steps=100000
-- See        out/long_run/base/energy.csv
-- Expect     no energy created (0.1 % at most) and no drift at rest.
--            Measured: none created, balance open by 6e-5 % (8e-5 % after 100000 steps); 2 mm/s in the last tenth of 10000 steps,
--            of the 500 that the upper block came with
-- Read next  junction.lua

local p = param{ steps = 10000, friction = 0.3, n = 2 }

local side = 10*mm
local alloy = material.elastic{ name = "alloy", young = 10*GPa, poisson = 0.3, density = 2700, damping = 1e-7 }
local function block(name, from, velocity)
  return substructure{
    name = name, material = alloy, velocity = velocity,
    mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, side }, cells = { p.n, p.n, p.n } },
  }
end
local lower, upper = block("lower", 0, { 0, 0, 0 }), block("upper", side, { 0.2, 0.1, -0.5 })
local seat = interface.contact{ name = "seat", between = { lower:face "zmax", upper:face "zmin" }, friction = p.friction }
local wall = support.wall{ name = "wall", on = lower:face "zmin", friction = p.friction, gap = 5*um }
local wait = step.dynamic{ name = "wait", duration = p.steps * 1*us, dt = 1*us, loads = { load.gravity{ z = -1000 } } }
local sole, energy = output.joint{ name = "seat", on = seat }, output.energy{}
local motion = output.history{ name = "motion", on = upper:face "zmax", quantity = "velocity" }
local outputs, corners = { sole, energy, motion }, {}
for _, at in ipairs{ { 0, 0 }, { side, 0 }, { 0, side }, { side, side } } do
  for _, seen in ipairs{ { lower, 0 }, { lower, side }, { upper, side } } do
    local part, height = table.unpack(seen)
    local corner = part:where(function(x, y, z) return near(x, at[1]) and near(y, at[2]) and near(z, height) end)
    local probe = output.history{ name = "corner_" .. #corners, on = corner, quantity = "velocity", direction = { 0, 0, 1 } }
    corners[#corners + 1] = probe
    outputs[#outputs + 1] = probe
  end
end
local result = problem{
  name = "long_run", substructures = { lower, upper }, interfaces = { seat }, supports = { wall }, steps = { wait },
  outputs = outputs,
}:run{}
local closing = 0                                -- on the wall, and of the upper on the lower, at a corner
for i = 1, #corners, 3 do
  local foot, top, sole_ = result[corners[i]], result[corners[i + 1]], result[corners[i + 2]]
  for k = 1, #foot do closing = math.max(closing, -foot[k], top[k] - sole_[k]) end
end
print(("fastest closing of a corner, m/s: %.3f"):format(closing))
local created, largest = 0, 0
local scheme, kinetic, strain = result[energy].scheme, result[energy].kinetic, result[energy].strain
for i = 1, #scheme do
  created = math.max(created, -scheme[i])
  largest = math.max(largest, kinetic[i] + strain[i])
end
local at_end = 0
for _, axis in ipairs{ "x", "y", "z" } do
  local v = result[motion][axis]
  for i = math.floor(0.9 * p.steps), #v do at_end = math.max(at_end, math.abs(v[i])) end
end
print(("energy created: %.2e %% of the largest, balance open by %.2e %%"):format(
  100 * created / largest, 100 * math.max(math.abs(result[energy].balance.max), math.abs(result[energy].balance.min)) / largest))
print(("fastest in the last tenth: %.3e m/s, slid %.3f um; %.1f iterations: %s"):format(
  at_end, result[sole].slip.max / um, result.mean_iterations, result.converged and "converged" or "NOT converged"))

-- plastic_cycle.lua -- an interface without hardening is loaded, unloaded, reloaded: rigid, perfect, rigid, perfect.
--
--    fixed |=======P=======| --> displacement d(t): 0 -> 20 -> 8 -> 30 um
--
-- Run        dygita run decks/hard/plastic_cycle.lua           --set hardening=1*MPa/um
-- See        out/plastic_cycle/static/joint.csv
-- Expect     force and opening of the hand solution at every increment: static error 1e-14; in a dynamic step, pulled
--            slowly, force within 1.9 % and opening within 0.3 % (waves); plastic work force x opening. Energy created 0.001 % in
--            the dynamic step, next to none in the static ones. With --set slow=400 (CFL 6.4) up to 0.13 % at any
--            tolerance: the joint yields and holds again within one time step
-- Read next  long_run.lua

local p = param{ hardening = 0, yield = 10*MPa, n = 4, slow = 100 }

local E, L, side = 100*GPa, 50*mm, 5*mm
local alloy = material.elastic{ name = "alloy", young = E, poisson = 0, density = 5000 }
local function bar(name, from)
  return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, L }, cells = { 1, 1, p.n } } }
end
local left, right = bar("left", 0), bar("right", L)
local joint = interface.plastic{ name = "joint", between = { left:face "zmax", right:face "zmin" }, yield = p.yield, hardening = p.hardening }
local root = support.fixed{ name = "root", on = left:face "zmin" }
local levels = { 0, 20*um, 8*um, 30*um }

-- By hand: two springs in series with the slider; H per metre.
local K, opening = E / (2 * L), 0                -- traction per metre
local function answer(d)
  local trial = K * (d - opening)
  local excess = trial - (p.yield + p.hardening * opening)
  if excess > 0 then opening = opening + excess / (K + p.hardening) end
  return K * (d - opening), opening
end

local function case(name, steps, pulls)
  local state = output.joint{ name = "joint", on = joint }
  local result = problem{
    name = "plastic_cycle", substructures = { left, right }, interfaces = { joint }, supports = { root }, steps = steps,
    solver = solver.latin{ integration = "implicit" },  -- slow: nothing is gained by following waves
    outputs = { state, output.energy{} },
  }:run{ case = name }
  opening = 0
  local off_force, off_opening = 0, 0
  for i = 1, #result[state].normal do
    local s, o = answer(pulls(i))
    off_force = math.max(off_force, math.abs(result[state].normal[i] / side^2 - s) / p.yield)
    off_opening = math.max(off_opening, math.abs(result[state].plastic_opening[i] - o) / (30*um))
  end
  print(("%s: max error, force of the yield force: %.3e, opening of 30 um: %.3e, %s"):format(
    name, off_force, off_opening, result.converged and "converged" or "NOT converged"))
  print(("%s: work of the interface, error: %.3e"):format(name, result[state].plastic_work.last / (p.yield * side^2 * opening) - 1))
end

local m, statics, last = 6, {}, nil
for k = 2, #levels do
  last = step.static{ name = "to_" .. k, after = last, increments = m, loads = { load.displacement{ on = right:face "zmax", z = levels[k] } } }
  statics[#statics + 1] = last
end
case("static", statics, function(i)
  local k, x = (i - 1) // m + 1, ((i - 1) % m + 1) / m
  return levels[k] + x * (levels[k + 1] - levels[k])
end)

local T = 2 * L / math.sqrt(E / 5000)            -- a transit of both bars; each leg takes `slow` of them
local leg, dt = p.slow * T, p.slow * T / 500
local times = { 0, leg, 2 * leg, 3 * leg }
local pull = step.dynamic{
  name = "pull", duration = 3 * leg, dt = dt,
  loads = { load.displacement{ on = right:face "zmax", z = history.piecewise{ times = times, values = levels } } },
}
case("dynamic", { pull }, function(i)
  local t = (i - 0.5) * dt
  local k = math.min(3, math.floor(t / leg) + 1)
  return levels[k] + (t / leg - (k - 1)) * (levels[k + 1] - levels[k])
end)

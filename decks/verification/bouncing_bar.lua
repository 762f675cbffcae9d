-- bouncing_bar.lua -- an elastic bar falls on a rigid wall, bounces twice, and comes back to where it was dropped.
--
--      +---+
--      |bar|  L = 10          |
--      |   |                  |  gravity 10
--      |   |                  v
--      +---+  - - - - - -
--                  drop 5         in units of 1 mm, 0.1 ms, 0.1 MPa, so that E = 900, rho = 1 and c = 30
--    /////////  rigid wall
--
-- Run        dygita run decks/verification/bouncing_bar.lua          --set n=400     --set cfl=1
-- See        paraview out/bouncing_bar/base/bouncing_bar.pvd         colour by velocity
-- Expect     at n = 100, cfl = 0.5, of the drop height: the lower end exact until it is first released, 0.47 % off after a
--            whole period (0.27 % at n = 400) and 2.0 % at most on the way; pressure within 0.07 % rms in the first impact,
--            2.0 % in the second; one spell of contact an impact; 0.04 % of the energy exchanged with the scheme.
--            --solver latin (lumped mass, contact nodes with mass): 3.8 %, 4.6 %; 0.1 %, 8.6 %; 0.8 %
-- Read next  two_bars.lua
--
-- Exact: Doyen, Ern, Piperno, SIAM J. Sci. Comput. 33 (2011). Falls until t = 1, is in contact for 2 L / c, flies with a
-- vibration of that period, lands at t = 11/3 as it had left, and rises from t = 13/3 as it had fallen.

local p = param{ n = 100, cfl = 0.5 }

local length, time = 1*mm, 0.1*ms                -- one unit of each
local speed, stress = length / time, 1000*(length / time)^2
local L, c, g, drop = 10, 30, 10, 5              -- in those units, as everything below that has no unit
local side = L / 10

local metal = material.elastic{ name = "metal", young = 900*stress, poisson = 0, density = 1000 }
local bar = substructure{
  name = "bar", material = metal,
  mesh = mesh.box{ size = { side*length, side*length, L*length }, cells = { 1, 1, p.n } },
}
local wall = support.wall{ name = "wall", on = bar:face "zmin", gap = drop*length }
local dt = p.cfl * L / p.n / c * time
local fall = step.dynamic{
  name = "fall", duration = 16/3*time, dt = dt,
  loads = { load.gravity{ z = -g * length / time^2 } },
}
local lower  = output.history{ name = "lower_end", on = bar:face "zmin", quantity = "displacement", direction = { 0, 0, 1 } }
local push   = output.resultant{ name = "push", on = wall }
local energy = output.energy{}
local drop_test = problem{
  name = "bouncing_bar", substructures = { bar }, supports = { wall }, steps = { fall },
  outputs = { lower, push, energy, output.vtk{ frames = 64 } },
  solver = solver.latin{ mass = "tuned", massless_contact = true },
}
local result = drop_test:run{}

-- The exact solution --------------------------------------------------------------------

local transit = 2 * L / c
local impacts = { { 1, 1 + transit, 300, 500 }, { 11/3, 11/3 + transit, 500, 300 } }  -- from, to, pressure then and there

local function place(t)
  if t < 1 then return drop - g * t^2 / 2 end
  if t < impacts[1][2] then return 0 end
  if t < impacts[2][1] then
    local tau = t - impacts[1][2]
    local phase = tau % transit
    return 10 * tau - g * tau^2 / 2 + 10 * phase * (phase - transit)
  end
  if t < impacts[2][2] then return 0 end
  local tau = t - impacts[2][2]
  return 10 * tau - g * tau^2 / 2
end

-- Errors ----------------------------------------------------------------------------------

local until_release, over_period = 0, 0
local u, at = result[lower], result[lower].time
for i = 1, #u do
  local t = at[i] / time
  local off = math.abs(drop + u[i] / length - place(t)) / drop
  if t <= impacts[1][2] then until_release = math.max(until_release, off) end
  over_period = math.max(over_period, off)
end

-- Root mean square over an impact but for a twentieth of it at each end, of the mean pressure 400.
local function pressure_error(impact)
  local from, to, first, last = table.unpack(impact)
  local sum, n, trim = 0, 0, 0.05 * (to - from)
  local force, middle = result[push].normal, result[push].time
  for i = 1, #force do
    local t = middle[i] / time
    if t > from + trim and t < to - trim then
      local exact = first + (last - first) * (t - from) / (to - from)
      sum, n = sum + (-force[i] / (side * length)^2 / stress - exact)^2, n + 1
    end
  end
  return math.sqrt(sum / n) / 400
end

-- Runs of steps with a force; gaps between them count from one step on.
local function spells(from, to)
  local count, touching, impulse = 0, false, 0
  local force, middle = result[push].normal, result[push].time
  for i = 1, #force do
    local t = middle[i] / time
    if t > from and t < to then
      if force[i] < 0 and not touching then count = count + 1 end
      touching = force[i] < 0
      impulse = impulse - force[i] * dt / time / (side * length)^2 / stress
    end
  end
  return count, impulse
end

local total = 1000 * side^2 * L * length^3 * g * (length / time^2) * drop * length  -- the weight times the drop
local worst = 0
local scheme = result[energy].scheme
for i = 1, #scheme do worst = math.max(worst, math.abs(scheme[i])) end

local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end
say("place until the release, max error of the drop height", 100 * until_release, "%")
say("place after a period, error of the drop height", 100 * math.abs(u.last / (drop * length)), "%")
say("place over a period, max error of the drop height", 100 * over_period, "%")
for k, impact in ipairs(impacts) do
  local count, impulse = spells(k == 1 and 0 or 2.5, k == 1 and 2.5 or 6)
  say("pressure in impact " .. k .. ", rms error of the mean", 100 * pressure_error(impact), "%")
  say("spells of contact in impact " .. k, count, "")
  say("impulse of impact " .. k .. ", error", 100 * (impulse / (800/3) - 1), "%")
end
say("energy exchanged with the scheme, max of weight x drop", 100 * worst / total, "%")

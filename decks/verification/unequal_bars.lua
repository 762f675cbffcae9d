-- unequal_bars.lua -- a short stiff bar runs into a long soft one that is at rest: the contact ends in stages.
--
--        --> 20 m/s
--    +-------------+                                  at rest
--    |    left     |touching +--------------------------------------+
--    +-------------+---------|                right                 |
--      Z1 = 2 Z2, L1 = c1 T  +--------------------------------------+   L2 = 2.5 c2 T
--
-- Run        dygita run decks/verification/unequal_bars.lua          --set n=160     --set cfl=1
-- See        paraview out/unequal_bars/base/unequal_bars.pvd         colour by velocity z
-- Expect     contact stress v Z1 Z2 / (Z1 + Z2) = 105.4 MPa for 2 T, a third of it for 2 T, a ninth of it for T; then the
--            soft bar's free end lets go. At n = 40 cells a T, cfl = 0.5, of the first stress: 0.46 % rms over the
--            plateaus 0.2 T away from the jumps (0.11 % at n = 160); released 0.04 T (3 steps) early, as the foot of the
--            front arrives; momentum of the right bar within 0.1 %. --solver latin (lumped mass): 2.4 %, 7 steps, 0.6 %
-- Read next  yielding_interface.lua
--
-- Exact: both bars by characteristics, v -+ stress / Z along c, on a lattice of 1/n of T.

local p = param{ n = 40, cfl = 0.5, velocity = 20 }

local T = 10*us
local stiff = material.elastic{ name = "stiff", young = 200*GPa, poisson = 0, density = 8000/6.4 }  -- c = 12.6 km/s
local soft  = material.elastic{ name = "soft",  young = 20*GPa,  poisson = 0, density = 3125 }      -- c = 2.5 km/s
local c1, c2 = math.sqrt(200*GPa / 1250), math.sqrt(20*GPa / 3125)
local Z1, Z2 = 1250 * c1, 3125 * c2
local n1, n2 = p.n, math.floor(2.5 * p.n)
local side, L1, L2 = 5*mm, c1 * T, 2.5 * c2 * T
local dt = p.cfl * T / p.n

local left = substructure{
  name = "left", material = stiff, velocity = { 0, 0, p.velocity },
  mesh = mesh.box{ size = { side, side, L1 }, cells = { 1, 1, n1 } },
}
local right = substructure{
  name = "right", material = soft,
  mesh = mesh.box{ origin = { 0, 0, L1 }, size = { side, side, L2 }, cells = { 1, 1, n2 } },
}
local touch = interface.contact{ name = "touch", between = { left:face "zmax", right:face "zmin" } }
local run_in = step.dynamic{ name = "run_in", duration = 7*T, dt = dt }
local push, energy = output.resultant{ name = "push", on = touch }, output.energy{}
local drift = output.history{
  name = "drift", on = right:where(function() return true end), quantity = "velocity", direction = { 0, 0, 1 },
}
local impact = problem{
  name = "unequal_bars", substructures = { left, right }, interfaces = { touch }, steps = { run_in },
  outputs = { push, drift, energy, output.vtk{ frames = 70 } },
  solver = solver.latin{ mass = "tuned", massless_contact = true },
}
local result = impact:run{}

-- The exact solution: invariants a = v - s/Z run right, b = v + s/Z run left, one cell an instant of T / n ----------

local a1, b1, a2, b2 = {}, {}, {}, {}            -- one value per cell, of the left and of the right bar
for i = 1, n1 do a1[i], b1[i] = p.velocity, p.velocity end
for i = 1, n2 do a2[i], b2[i] = 0, 0 end
local exact, impulse = {}, 0                     -- stress in each interval of T / n
for k = 1, 7 * p.n do
  local arriving_1, arriving_2 = a1[n1], b2[1]
  local s = math.min((arriving_2 - arriving_1) / (1 / Z1 + 1 / Z2), 0)
  local leaving_1, leaving_2 = arriving_1 + 2 * s / Z1, arriving_2 - 2 * s / Z2
  local free_1, free_2 = b1[1], a2[n2]
  table.insert(a1, 1, free_1)
  table.insert(b1, leaving_1)
  table.insert(a2, 1, leaving_2)
  table.insert(b2, free_2)
  table.remove(a1)
  table.remove(b1, 1)
  table.remove(a2)
  table.remove(b2, 1)
  exact[k] = s
  impulse = impulse - s * T / p.n
end

-- Errors ----------------------------------------------------------------------------------

local first, release = -p.velocity * Z1 * Z2 / (Z1 + Z2), 0
for k = 1, #exact do if exact[k] < 1e-9 * first then release = k * T / p.n end end
local force, middle = result[push].normal, result[push].time
local sum, n, last = 0, 0, 0
for i = 1, #force do
  local t = middle[i] / T
  local jump = math.min(math.abs(t), math.abs(t - 2), math.abs(t - 4), math.abs(t - 5))
  if t < 5 and jump > 0.2 then                   -- fronts are as wide as some cells
    sum, n = sum + (force[i] / side^2 - exact[math.ceil(t * p.n)])^2, n + 1
  end
  if force[i] < 0 then last = i end
end

local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end
say("exact first stress by characteristics", exact[1] / MPa, "MPa")
say("stress on the plateaus, rms error of the first", -100 * math.sqrt(sum / n) / first, "%")
say("exact release", release / us, "us")
say("release, time steps late", last - release / dt, "")
say("release, part of T late", (last * dt - release) / T, "")
say("momentum of the right bar at the end, error", 100 * (result[drift].last * 3125 * L2 / impulse - 1), "%")

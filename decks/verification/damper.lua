-- damper.lua -- a wave goes through a damper, and a damper stops a block: both as by hand.
--
--    pressure, a step -->|=====left=====| damper |=====right=====|          traction of the damper: c (v_right - v_left)
--
--    block, 1 m/s ->  | damper | wall of the same kind at rest               relative velocity: exp(-c A t / m)
--
-- Run        dygita run decks/verification/damper.lua    --set n=240    --set ratio=4    --solver explicit
-- See        out/damper/wave/report.html                 the joint: its loop is force against stroke
-- Expect     2 c/(2 c + Z) of the incident stress gets through, Z = rho c_P: 2/3, 13.33 of 20 MPa, at c = Z; what is missing is reflected
--            or dissipated, t^2/c per area and time, and booked as damping. A block of mass m that nothing else holds slows down as
--            exp(-c A t/m), along the normal and along the tangent. Off by 0.003 % (stress), 0.05 % (stroke), 0.16 % (energy: the front is
--            blunt) and 0.015 % (block) at n = 60, cfl = 0.5; --solver latin (lumped mass): 0.10, 0.21, 0.51 %
-- Read next  yielding_interface.lua

local p = param{ n = 60, cfl = 0.5, ratio = 1, stress = 20*MPa }

local E, rho, L, side = 200*GPa, 8000, 50*mm, 5*mm
local speed = math.sqrt(E / rho)
local Z, T = rho * speed, L / speed
local steel = material.elastic{ name = "steel", young = E, poisson = 0, density = rho }

local function say(what, value, unit) print(("%-62s %.4g %s"):format(what .. ":", value, unit)) end

-- The wave ------------------------------------------------------------------------------

local function bar(name, from)
  return substructure{
    name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, L }, cells = { 1, 1, p.n } },
  }
end
local left, right = bar("left", 0), bar("right", L)
local c = p.ratio * Z
local damper = interface.viscous{ name = "damper", between = { left:face "zmax", right:face "zmin" }, normal = c, tangential = c }
local push = step.dynamic{                       -- until what the ends send back arrives
  name = "push", duration = 3*T, dt = p.cfl * L / p.n / speed,
  loads = { load.pressure{ on = left:face "zmin", history = history.step{ value = p.stress } } },
}
local joint, energy = output.joint{ name = "joint", on = damper }, output.energy{}
local result = problem{
  name = "damper", substructures = { left, right }, interfaces = { damper }, steps = { push },
  outputs = { joint, energy, output.vtk{ frames = 60 } },
  solver = solver.latin{ mass = "tuned" },
}:run{ case = "wave" }

local through = 2 * c / (2 * c + Z) * p.stress
local force, middle, sum, n = result[joint].normal, result[joint].time, 0, 0
for i = 1, #force do
  if middle[i] > 1.3*T and middle[i] < 2.9*T then sum, n = sum - force[i] / side^2, n + 1 end
end
local last = #force
local time = middle[last] - T                    -- since the arrival
say("wave: stress that gets through, exact (MPa)", through / MPa, "MPa")
say("wave: stress that gets through, error of the mean", 100 * (sum / n / through - 1), "%")
say("wave: stroke at the end, error", 100 * (-result[joint].opening[last] / (through / c * time) - 1), "%")
say("wave: energy dissipated, error", 100 * (result[joint].damping_work.last / (through^2 / c * side^2 * time) - 1), "%")

-- The block -----------------------------------------------------------------------------

local size, tau = 10*mm, 200*us                  -- of a cube, and of its decay
local function all() return true end
local cube = mesh.box{ size = { size, size, size }, cells = { 1, 1, 1 } }
local ground = substructure{ name = "ground", mesh = cube, material = steel }
local base = support.fixed{ name = "base", on = ground:where(all) }
local coefficient = rho * size / tau             -- Pa s/m: tau = m/(c A)

local function slow_down(axis, velocity, direction, held)
  local block = substructure{ name = "block", mesh = cube, material = steel, place = { 0, 0, size }, velocity = velocity }
  local between = interface.viscous{
    name = "damper", between = { ground:face "zmax", block:face "zmin" }, normal = coefficient, tangential = coefficient,
  }
  local coast = step.dynamic{ name = "coast", duration = 400*us, dt = 2*us, loads = { held(block) } }
  local speed_of = output.history{ name = "speed", on = block:where(all), quantity = "velocity", direction = direction }
  local of_block = problem{
    name = "damper", substructures = { ground, block }, interfaces = { between }, supports = { base }, steps = { coast },
    outputs = { speed_of, output.energy{} },
  }:run{ case = axis }
  say(axis .. ": velocity after two times m/(c A), error", 100 * (of_block[speed_of].last / math.exp(-400*us / tau) - 1), "%")
end

slow_down("normal", { 0, 0, 1 }, { 0, 0, 1 }, function(block)
  return load.velocity{ on = block:where(all), x = 0, y = 0 }
end)
slow_down("tangent", { 1, 0, 0 }, { 1, 0, 0 }, function(block)
  return load.velocity{ on = block:where(all), y = 0, z = 0 }
end)

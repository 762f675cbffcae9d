-- press_fit.lua -- a plug too wide for its slot, pressed home in one static step, at rest, and then pushed through.
--
--          | push
--     +----v---+
--    /| a  plug b |/     both walls interfere by 10 um a side; friction
--    /|        |/
--
-- Run        dygita run decks/hard/press_fit.lua               --set friction=1
-- See        out/press_fit/base/press_fit.pvd
-- Expect     side force E A 2 i / L (nu = 0); at rest in a dynamic step; pushed with 1.5 of what friction holds it slides on.
--            Measured: force to rounding, velocity at rest 2e-10 of wave speed times strain, pushed plug within 3 % of a rigid one
-- Read next  held_by_contact.lua

local p = param{ friction = 0.3, interference = 10*um, n = 3, push = 1.5 }

local side = 10*mm
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0, density = 2700 }
local plug = substructure{ name = "plug", material = alloy, mesh = mesh.box{ size = { side, side, side }, cells = { p.n, p.n, p.n } } }
local left  = support.wall{ name = "left", on = plug:face "xmin", gap = -p.interference, friction = p.friction }
local right = support.wall{ name = "right", on = plug:face "xmax", gap = -p.interference, friction = p.friction }
local guide = support.symmetry{ name = "guide", on = plug:face "ymin" }
local seat  = support.symmetry{ name = "seat", on = plug:face "zmin" }
local N = 70*GPa * side^2 * 2 * p.interference / side
local fit  = step.static{ name = "fit", supports = { left, right, guide, seat } }
local rest = step.dynamic{ name = "rest", after = fit, duration = 50*us, dt = 0.5*us }
local push = step.dynamic{
  name = "push", after = rest, duration = 100*us, dt = 0.5*us,
  loads = { load.force{ on = plug:face "zmax", z = -p.push * 2 * p.friction * N } },
}
local held = output.resultant{ name = "held", on = { left, right } }
local motion = output.history{ name = "motion", on = plug:face "zmax", quantity = "velocity", direction = { 0, 0, 1 } }
local grip = output.joint{ name = "grip", on = left }
local result = problem{
  name = "press_fit", substructures = { plug }, supports = { left, right, guide }, steps = { fit, rest, push },
  outputs = { held, motion, grip, output.energy{} },
}:run{}
local speed = math.sqrt(70*GPa / 2700) * 2 * p.interference / side
local resting = 0
for i = 1, 100 do resting = math.max(resting, math.abs(result[motion][1 + i])) end
print(("side force, error: %.3e"):format(result[held].normal:at(fit) / (-2 * N) - 1))
print(("velocity at rest, of wave speed times strain: %.3e"):format(resting / speed))
local mass = 2700 * side^3
local t = 100*us
print(("pushed: velocity %.3f m/s, of a rigid plug that slides %.3f m/s: %s"):format(
  result[motion].last, -(p.push - 1) * 2 * p.friction * N * t / mass, result.converged and "converged" or "NOT converged"))

-- never_closes.lua -- a bar rings above a wall that it never reaches: the contact must do nothing at all.
--
--    fixed |==========|   gap   | wall
--
-- Run        dygita run decks/hard/never_closes.lua            --set gap=0.05*mm (it closes)
-- See        out/never_closes/base/never_closes.pvd
-- Expect     no force, ever; the motion that of the bar without the wall (difference 0); energy kept within rounding.
--            Measured: 0 N, difference 4e-13 of the largest displacement
-- Read next  press_fit.lua

local p = param{ gap = 1*mm, n = 20 }

local L, side = 50*mm, 5*mm
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0, density = 2700 }
local bar = substructure{ name = "bar", material = alloy, mesh = mesh.box{ size = { side, side, L }, cells = { 1, 1, p.n } } }
local root = support.fixed{ name = "root", on = bar:face "zmin" }
local wall = support.wall{ name = "wall", on = bar:face "zmax", gap = p.gap, friction = 0.5 }
local ring = step.dynamic{
  name = "ring", duration = 400*us, dt = 0.5*us,
  loads = { load.traction{ on = bar:face "zmax", z = history.half_sine{ peak = 50*MPa, duration = 20*us } } },
}
local tip = output.history{ name = "tip", on = bar:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
local push, energy = output.resultant{ name = "push", on = wall }, output.energy{}
local function case(name, supports, outputs)
  return problem{
    name = "never_closes", substructures = { bar }, supports = supports, steps = { ring }, outputs = outputs,
    solver = solver.latin{ mass = "lumped" },  -- a tuned one is lumped in cells at a contact, be it ever so far: 0.08 %
  }:run{ case = name }
end
local with, without = case("base", { root, wall }, { tip, push, energy }), case("without", { root }, { tip })
local off = 0
for i = 1, #with[tip] do off = math.max(off, math.abs(with[tip][i] - without[tip][i])) end
print(("largest force: %.3e N, largest displacement %.1f um"):format(math.max(-with[push].normal.min, with[push].normal.max), with[tip].max / um))
print(("difference from the bar without the wall: %.3e of the largest"):format(off / with[tip].max))

-- held_by_contact.lua -- a static step in which a block is held by friction between two jaws, and by nothing else.
--
--       push -> +------+-------+------+ |/
--               | left | block | right| |/ fixed
--               +------+-------+------+ |/
--                          v pull
--
-- Run        dygita run decks/hard/held_by_contact.lua
-- See        out/held_by_contact/holds/held_by_contact.pvd
-- Expect     a pull of 0.5 of what friction can hold: equilibrium, the jaws' forces sum to the pull (error 4e-9). A pull
--            of 1.5: there is no equilibrium: NOT converged, and a warning of a block that moves away. --set friction=0 pull=0.5: an error that names the rigid motion
-- Read next  plastic_cycle.lua

local p = param{ friction = 0.4, n = 2, pull = 0, iterations = 1000 }

local side = 10*mm
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function cube(name, from)
  return substructure{ name = name, material = alloy, mesh = mesh.box{ origin = { from, 0, 0 }, size = { side, side, side }, cells = { p.n, p.n, p.n } } }
end
local left, block, right = cube("left", 0), cube("block", side), cube("right", 2 * side)
local a = interface.contact{ name = "a", between = { left:face "xmax", block:face "xmin" }, friction = p.friction }
local b = interface.contact{ name = "b", between = { block:face "xmax", right:face "xmin" }, friction = p.friction }
local wall = support.fixed{ name = "wall", on = right:face "xmax" }
local jaw = support.symmetry{ name = "jaw", on = { left:face "zmin", left:face "ymin" } }
local N, grip = 1*kN, 0.4                         -- of the full share, whatever the friction
local function case(name, share)
  local clamp = step.static{ name = "clamp", loads = { load.force{ on = left:face "xmin", x = N } } }
  local pull = step.static{
    name = "pull", after = clamp, increments = 4,
    loads = { load.force{ on = left:face "xmin", x = N }, load.force{ on = block:where(function() return true end), z = -share * 2 * grip * N } },
  }
  local force_a, force_b = output.resultant{ name = "force_a", on = a }, output.resultant{ name = "force_b", on = b }
  local way = output.history{ name = "way", on = block:face "zmin", quantity = "displacement", direction = { 0, 0, 1 } }
  local result = problem{
    name = "held_by_contact", substructures = { left, block, right }, interfaces = { a, b }, supports = { wall, jaw },
    steps = { clamp, pull }, outputs = { force_a, force_b, way, output.energy{} },
    solver = solver.latin{ max_iterations = p.iterations },
  }:run{ case = name }
  local load_ = share * 2 * grip * N
  print(("%s: shear in the jaws %.1f and %.1f N of a pull of %.1f N, sum off by: %.2e, moved %.3g mm: %s"):format(
    name, result[force_a].shear.last, result[force_b].shear.last, load_,
    (math.abs(result[force_b].z.last - result[force_a].z.last) - load_) / load_, result[way].last / mm, result.converged and "converged" or "NOT converged"))
end
if p.pull == 0 then
  case("holds", 0.5)
  case("slips", 1.5)
else
  case("pulled", p.pull)
end

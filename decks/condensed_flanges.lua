-- condensed_flanges.lua -- the bolted flanges, tightened and condensed to a superelement for a system model.
--
--           top (6 rows)                            the assembly about its tightened state: what sticks is tied,
--      +----------------+                           what slides is tied along the normal, what is open is free
--      |     upper      |
--      +-----+    +-----+   bolt, tightened         mass and stiffness on 6 motions of `top`, 6 of `side`,
--      |     lower      | side (6 rows)             and the modes up to twice the frequency asked for
--      +----------------+
--        fixed base
--
-- Run        dygita run decks/condensed_flanges.lua                --set mu=0.05    --set up_to=50*kHz
-- See        out/condensed_flanges/base/element.md                 what the rows are, and how Python reads them
--            element_mass.mtx  element_stiffness.mtx  element_damping.mtx  element.csv
-- Expect     12 interface rows and 32 modes; natural frequencies 20057 20057 23985 31175 ... Hz, with a mesh error of +4 % (19278 19278
--            22933 29667 with graded cells of 2.5 mm: more of the joint is open there), the first ten within 0.008 % of the whole linear model's; and the acceleration of one face for a force on the other within 0.007 % up to 30 kHz
--            (tests/decks/test_condensed.cpp measures both). All points of the joint that are closed have slid outwards under the
--            tightening: they are tied, since they stick as soon as the motion turns
-- Read next  bolted_flanges.lua

local p = param{ mu = 0.2, tighten = 0.06*mm, size = 4*mm, up_to = 30*kHz }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = 5e-8 }
local flanges = mesh.gmsh{ file = "../meshes/bolted_flanges.geo", set = { size = p.size, graded = 0 } }
local function part(name)
  return substructure{ name = name, mesh = flanges:volume(name), material = steel }
end
local lower, upper, rod, head, nut = part "lower", part "upper", part "rod", part "head", part "nut"

local thread = interface.bonded{ name = "thread", between = { rod:face "nut_end", nut:face "rod_end" } }
local seat   = interface.bonded{ name = "seat", between = { nut:face "lower", lower:face "nut" } }
local shank  = interface.bonded{ name = "shank", between = { rod:face "head_end", head:face "rod_end" } }
local mating = interface.contact{ name = "mating", between = { lower:face "upper", upper:face "lower" }, friction = p.mu }
local under  = interface.contact{ name = "under_head", between = { upper:face "head", head:face "upper" }, friction = p.mu }
local base   = support.fixed{ name = "base", on = lower:face "base" }

local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = shank, by = p.tighten } } }

local element = output.superelement{ name = "element", on = { upper:face "top", lower:face "side" }, up_to = p.up_to, after = tighten }
local joint   = output.joint{ name = "joint", on = mating }
local result = problem{
  name = "condensed_flanges", substructures = { lower, upper, rod, head, nut }, interfaces = { mating, under, thread, seat, shank },
  supports = { base }, steps = { tighten }, outputs = { element, joint },
}:run{}

local frequency = result[element].frequency
for i = 1, math.min(10, #frequency) do print(("mode %2d: %8.0f Hz"):format(i, frequency[i])) end
print(("of the joint sticks: %.0f mm2, slides: %.0f mm2, open: %.0f mm2"):format(
  result[joint].stick_area.last * 1e6, result[joint].slip_area.last * 1e6, result[joint].open_area.last * 1e6))

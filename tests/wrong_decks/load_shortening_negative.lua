local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local tighten = load.shortening{ on = glue, by = -0.03*mm }
local s = step.static{ name = "tighten", loads = { tighten } }
problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { s } }:run{}

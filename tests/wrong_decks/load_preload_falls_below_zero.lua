local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local pull = step.static{ name = "pull", increments = 2, loads = { load.preload{ on = glue, force = function(t) return -5*kN*t end } } }
problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { support.fixed{ name = "base", on = low:face "zmin" } }, steps = { pull } }:run{}

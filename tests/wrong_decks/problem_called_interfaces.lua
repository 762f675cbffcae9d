local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }, material = steel }
local base = support.fixed{ name = "base", on = cube:face "zmin" }
local rest = step.static{ name = "rest" }
problem{ name = "interfaces", substructures = { cube }, interfaces = {}, supports = { base }, steps = { rest } }

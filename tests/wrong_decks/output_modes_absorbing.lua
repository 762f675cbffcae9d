local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local rest = step.static{ name = "rest" }
local out = support.absorbing{ name = "out", on = box:face "zmin" }
local modes = output.modes{ name = "m" }
problem{ name = "p", substructures = { box }, supports = { out }, steps = { rest }, outputs = { modes } }

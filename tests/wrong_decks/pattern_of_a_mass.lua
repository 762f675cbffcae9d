local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local beam = substructure{ name = "beam", material = steel, mesh = mesh.box{ size = { 0.1, 0.01, 0.01 }, cells = { 5, 1, 1 } } }
local box = mass.point{ name = "box", on = beam:face "xmax", mass = 2, at = { 0.1, 0, 0 } }
local boxes = pattern.line{ of = box, n = 2, step = { 0, 0.05, 0 } }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = box:face "zmin" }
local hot = load.temperature{ parts = { box }, expansion = 12, by = 100 }

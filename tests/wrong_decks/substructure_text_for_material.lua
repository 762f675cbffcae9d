local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local s = substructure{ name = "s", material = "steel", mesh = mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 1, 1, 1 } } }

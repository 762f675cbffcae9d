local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bolt = substructure{ name = "bolt", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }, material = steel, place = { rotate = { axis = { 0, 0, 1 } } } }

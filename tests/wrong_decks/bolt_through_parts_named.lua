local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local bolts = bolt.through{ name = "bolts", size = "M6", parts = { "plate", "cover*" }, material = steel }

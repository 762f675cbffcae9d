local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { 30*mm, 20*mm, 5*mm }, cells = { 3, 2, 1 } } }
local screws = bolt.through{ name = "screw", size = "M6", parts = { plate }, material = steel }

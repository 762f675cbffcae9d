local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", mesh = mesh.box{ size = { 0.01, 0.01, 0.01 }, cells = { 1, 1, 1 } }, material = steel }
local foot = block:region "FOOT"

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local part = substructure{ name = "part", mesh = cube, material = steel }
local warm = load.temperature{ parts = { part }, expansion = 12e-6, by = function(x, y, z) return 100*x end }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local f = frame{ origin = { 0.4, -0.3, 0.2 }, axis = { 1, -2, 2 }, angle = 25*deg }
local part = substructure{ name = "part", mesh = cube, material = steel, frame = f }
local top = part:where{ frame = f, where = function(x, y, z) return near(z, 11*mm) end }

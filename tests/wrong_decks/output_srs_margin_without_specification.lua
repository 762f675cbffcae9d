local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local s = output.srs{ name = "s", on = low:face "zmax", specification = { z = { { 100, 10*g0 }, { 1000, 10*g0 } } }, margin = 3 }

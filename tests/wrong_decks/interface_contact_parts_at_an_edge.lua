local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 10*mm, 0, 10*mm } }
local seat = interface.contact{ name = "seat", between = { low, high } }

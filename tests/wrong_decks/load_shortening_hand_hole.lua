local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local tighten = load.shortening{ on = glue, by = 1*um, hand = { diameter = 10*mm, grip = 20*mm, head = 16*mm, hole = 9*mm, outer = 40*mm, young = 210*GPa, plate_young = 210*GPa } }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure.superelement{ name = "low", stiffness = "element_stiffness.mtx", mass = "element_mass.mtx", points = "element_points.csv" }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 1*mm, 0, 10*mm } }
local touch = interface.bonded{ name = "touch", between = { low:face "top", high:face "zmin" } }

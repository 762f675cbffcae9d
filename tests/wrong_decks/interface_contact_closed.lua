-- 'closed' says that the faces touch, 'gap' that they do not.
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local low = substructure{ name = "low", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } }, material = steel }
local high = substructure{ name = "high", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 } }, material = steel, place = { 0, 0, 10*mm } }
interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" }, gap = 0.1*mm, closed = true }

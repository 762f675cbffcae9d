local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local low = substructure{ name = "low", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }, material = steel }
local shock = step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { load.pressure{ on = low:face "zmax", history = 1*MPa } } }
local a = output.history{ name = "a", on = low:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local s = output.srs{ name = "s", of = a, taper = 0.25 }
problem{ name = "p", substructures = { low }, supports = { support.fixed{ name = "base", on = low:face "zmin" } }, steps = { shock }, outputs = { a, s } }

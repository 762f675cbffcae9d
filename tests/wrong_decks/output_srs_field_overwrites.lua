local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local f = output.srs_field{ name = "p", on = high:face "zmax" }
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local shock = step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { load.pressure{ on = high:face "zmax", history = 1*MPa } } }
problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { support.fixed{ name = "base", on = low:face "zmin" } },
  steps = { shock }, outputs = { f } }

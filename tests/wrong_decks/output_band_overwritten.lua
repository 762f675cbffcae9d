local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }, material = steel }
local base = support.fixed{ name = "base", on = cube:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 10*us, dt = 1*us, loads = { load.pressure{ on = cube:face "zmax", history = 1*MPa } } }
local band = output.history{ name = "srs_band", on = cube:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local srs = output.srs{ name = "srs", of = band, q_factor = 10, from = 1*kHz, to = 100*kHz }
problem{ name = "p", substructures = { cube }, interfaces = {}, supports = { base }, steps = { hit }, outputs = { band, srs } }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", mesh = mesh.box{ size = { 10*mm, 10*mm, 40*mm }, cells = { 1, 1, 4 }, order = 2 }, material = steel }
local fixed = support.fixed{ name = "foot", on = bar:face "zmin" }
local push = load.pressure{ on = bar:face "zmax", history = history.half_sine{ peak = 1*MPa, duration = 10*us } }
local shock = step.dynamic{ name = "shock", duration = 20*us, dt = 1*us, loads = { push } }
problem{ name = "tuned", substructures = { bar }, supports = { fixed }, steps = { shock }, solver = solver.latin{ mass = "tuned" } }

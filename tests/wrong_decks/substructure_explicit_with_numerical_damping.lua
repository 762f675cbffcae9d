local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, integration = "explicit",
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local hit = step.dynamic{ name = "hit", duration = 200*us, dt = 1*us,
  loads = { load.pressure{ on = block:face "zmax", history = history.half_sine{ peak = 10*MPa, duration = 100*us } } } }
problem{ name = "damped", substructures = { block }, steps = { hit }, solver = solver.latin{ numerical_damping = 0.1 } }:run{}

-- Bonded blocks in a row, pulled; what a very loose tolerance leaves opens the energy balance by a quarter.
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local parts, seams = {}, {}
for i = 1, 10 do
  parts[i] = substructure{ name = "p" .. i, mesh = cube, material = steel, place = { (i - 1)*10*mm, 0, 0 } }
  if i > 1 then seams[i - 1] = interface.bonded{ name = "seam" .. i, between = { parts[i - 1]:face "xmax", parts[i]:face "xmin" } } end
end
problem{ name = "row", substructures = parts, interfaces = seams, supports = { support.fixed{ name = "end", on = parts[1]:face "xmin" } },
  steps = { step.static{ name = "pull", loads = { load.pressure{ on = parts[#parts]:face "xmax", history = -1*MPa } } } },
  solver = solver.latin{ static_steps = "iterated", static_tolerance = 0.1 } }:run{}
